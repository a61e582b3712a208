"""Pieces of HTML for the page: a line that is to be seen, and text that can be copied."""

from __future__ import annotations

import html
from collections.abc import Sequence

from report.live.colours import FIXED_COLOUR, LANE_COLOURS, TRUE_COLOUR


def banner(text: str, colour: str, role: str = "status") -> str:
    """A line that is to be seen, as HTML."""
    style = f"padding:.5em .7em;border-left:4px solid {colour};font-size:.85em;line-height:1.35;margin:.2em .8em"
    return f'<div role="{role}" style="{style}">{html.escape(text)}</div>'


def legend(lanes: Sequence[str], strain: float) -> str:
    """Which colour is whose, in the scene and in the plots, as HTML. Args: strain: at which springs are deepest."""
    named = [*zip(lanes, LANE_COLOURS, strict=False), ("true motion", TRUE_COLOUR), ("fixed mass", FIXED_COLOUR)]
    dot = '<span style="display:inline-block;width:.8em;height:.8em;border-radius:50%;background:rgb{}"></span>'
    items = [f'<span style="white-space:nowrap">{dot.format(c)} {html.escape(name)}</span>' for name, c in named]
    said = f"Springs are the deeper in their lane's colour the more they are strained, up to {100 * strain:.3g} %."
    return f'<div style="margin:.2em .8em;font-size:.8em;line-height:1.5">{" &ensp; ".join(items)}<br>{said}</div>'


def copyable(lines: str, note: str) -> str:
    """Text with a button that copies it, as HTML."""
    copy = "const t=this.previousElementSibling;t.select();navigator.clipboard?navigator.clipboard.writeText(t.value)"
    copy += ":document.execCommand('copy');this.textContent='Copied'"
    area = (
        '<textarea readonly aria-label="command" rows="5" style="width:100%;font:.75em monospace" '
        f'onclick="this.select()">{html.escape(lines)}</textarea>'
    )
    button = f'<button type="button" onclick="{html.escape(copy)}">Copy</button>'
    return f'<div style="margin:.2em .8em">{area}{button} <small>{html.escape(note)}</small></div>'
