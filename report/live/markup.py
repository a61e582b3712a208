"""Pieces of HTML for the page: a line that is to be seen, and text that can be copied."""

from __future__ import annotations

import html


def banner(text: str, colour: str, role: str = "status") -> str:
    """A line that is to be seen, as HTML."""
    style = f"padding:.5em .7em;border-left:4px solid {colour};font-size:.85em;line-height:1.35;margin:.2em .8em"
    return f'<div role="{role}" style="{style}">{html.escape(text)}</div>'


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
