"""A figure's SVG made fit for a page it shares with others: ids of its own, greys that turn round in the dark."""

from __future__ import annotations

import re
from collections.abc import Iterable

#: What matplotlib writes that a page has no use for.
IDLE = re.compile(r"\s*<metadata>.*?</metadata>|\s*<defs>\s*<style.*?</style>\s*</defs>|<!--.*?-->\s*", re.DOTALL)

#: Where a colour stands in matplotlib's SVG.
COLOUR = re.compile(r"\b(fill|stroke): (#[0-9a-f]{6})\b")

#: The page's paper and ink where it is dark, as levels of grey.
DARK_PAPER, DARK_INK = 0x17, 0xEC

#: The series' colours on dark paper: as bright as on white they are dark, and as far from one another.
DARK_SERIES = {
    "#0072b2": "#4596dc",
    "#d55e00": "#f0803a",
    "#009e73": "#2fc195",
    "#cc79a7": "#dd93bb",
    "#e69f00": "#e69f00",
    "#56b4e9": "#93d5ff",
    "#8c6d31": "#bd9a5a",
}


def inline(svg: str, prefix: str, alt: str) -> str:
    """The SVG for a page: told in words, its ids begin with a prefix, greys and series' colours can be changed by CSS.

    Colours of heat maps stay as they are.
    """
    svg = IDLE.sub("", svg)
    svg = re.sub(r'<(g|image)([^>]*?) id="[^"]*"', r"<\1\2", svg)  # nothing refers to groups and images
    svg = re.sub(r'\bid="([^"]*)"', rf'id="{prefix}-\1"', svg)
    svg = re.sub(r'(url\(#|xlink:href="#)', rf"\1{prefix}-", svg)
    svg = COLOUR.sub(_changeable, svg)
    width = re.search(r'width="([\d.]+)pt"', svg)
    label = alt.replace("&", "&amp;").replace('"', "&quot;").replace("<", "&lt;")
    natural = f' style="max-width: {float(width[1]) * 1.1:.0f}pt"' if width else ""
    svg = re.sub(r' (width|height)="[\d.]+pt"', "", svg, count=2)
    return svg.replace("<svg ", f'<svg role="img" aria-label="{label}"{natural} ', 1)


def dark_colours(html: str) -> Iterable[tuple[str, str]]:
    """The CSS variables a page's pictures use, and the value of each on dark paper."""
    for name in sorted(set(re.findall(r"var\(--c-([0-9a-f]{6})", html))):
        yield f"--c-{name}", _on_dark(f"#{name}")


def _changeable(found: re.Match[str]) -> str:
    what, colour = found.groups()
    if colour in DARK_SERIES or _is_grey(colour):
        return f"{what}: var(--c-{colour[1:]}, {colour})"
    return found[0]


def _is_grey(colour: str) -> bool:
    return colour[1:3] == colour[3:5] == colour[5:7]


def _on_dark(colour: str) -> str:
    if colour in DARK_SERIES:
        return DARK_SERIES[colour]
    level = round(DARK_INK + (DARK_PAPER - DARK_INK) * int(colour[1:3], 16) / 255)
    return f"#{level:02x}{level:02x}{level:02x}"
