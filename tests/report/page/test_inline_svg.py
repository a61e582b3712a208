"""A figure's SVG on a page: its own ids, its words, colours that follow the page."""

from __future__ import annotations

from report.figures import draw
from report.page.inline_svg import DARK_SERIES, dark_colours, inline
from tests.report.html import Page
from tests.report.page.canned import RESULTS

SVG = (
    '<svg width="720pt" height="400pt" viewBox="0 0 720 400" xmlns="x">\n <metadata>m</metadata>\n'
    ' <defs>\n  <style type="text/css">*{a: b}</style>\n </defs>\n<g id="figure_1"><!-- 1 --><path id="p1" '
    'style="fill: #ffffff; stroke: #0072b2"/><use xlink:href="#p1" clip-path="url(#c1)" style="stroke: #123456"/>'
    "</g></svg>"
)


def test_ids_are_its_own_and_all_that_is_idle_is_gone() -> None:
    """What refers to them does so by the new ones."""
    svg = inline(SVG, "one", 'less < more & "so"')
    assert 'id="one-p1"' in svg
    assert 'xlink:href="#one-p1"' in svg
    assert "url(#one-c1)" in svg
    for idle in ("metadata", "<style", "<!--", "figure_1", 'width="720pt"'):
        assert idle not in svg
    (picture,) = Page(svg).of("svg")
    assert picture["aria-label"] == 'less < more & "so"'


def test_greys_and_series_can_be_changed_and_other_colours_stay() -> None:
    """White paper becomes the page's, and a colour of a heat map is what it is."""
    svg = inline(SVG, "one", "")
    assert "fill: var(--c-ffffff, #ffffff); stroke: var(--c-0072b2, #0072b2)" in svg
    assert "stroke: #123456" in svg
    assert dict(dark_colours(svg)) == {"--c-0072b2": DARK_SERIES["#0072b2"], "--c-ffffff": "#171717"}


def test_dark_colours_are_readable_on_dark_paper() -> None:
    """WCAG 2.2, 1.4.11: graphics have a contrast of 3 at least; here 4.5, as text is drawn too."""
    svg = inline(draw("divergence", RESULTS["divergence"]["usual"]()).svg(), "one", "")
    colours = {**dict(dark_colours(svg)), **{f"--c-{name[1:]}": value for name, value in DARK_SERIES.items()}}
    assert colours["--c-000000"] == "#ececec"
    for name in (*(f"--c-{name[1:]}" for name in DARK_SERIES), "--c-000000", "--c-333333"):
        assert contrast(colours.get(name, "#ececec"), "#171717") > 4.5
    assert contrast("#0072b2", "#171717") < 4.5  # shown to fail: the colour for white paper


def contrast(one: str, other: str) -> float:
    """WCAG's contrast of two colours."""
    light, dark = sorted((_luminance(one), _luminance(other)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


def _luminance(colour: str) -> float:
    parts = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
