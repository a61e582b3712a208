"""What the site's theme leaves out for those who do not see a page or have no mouse, put in (axe-core's rules)."""

from __future__ import annotations

import re
from pathlib import Path

#: What stands in a page, what is put in its place, and why.
MENDED = (
    (r'(<p class="caption" role="heading")>', r'\1 aria-level="2">', "a heading has a level"),
    (r'<aside class="sidebar-drawer">', '<aside class="sidebar-drawer" aria-label="Pages">', "landmarks have names"),
    (r"<pre\b(?! tabindex)", '<pre tabindex="0"', "what scrolls can be reached by keyboard"),
    (
        r'<div class="(output text_html|table-wrapper[^"]*)"',
        r'<div tabindex="0" class="\1"',
        "what scrolls can be reached by keyboard",
    ),
    (r"<th[^>]*>\s*</th>", "<td></td>", "a heading says something"),
    (r'<div id="search-results"></div>', '<h1>Search</h1><div id="search-results"></div>', "a page has a heading"),
)


def mend(folder: Path) -> None:
    """All pages of a site."""
    for file in sorted(folder.rglob("*.html")):
        text = file.read_text(encoding="utf-8")
        for pattern, better, _ in MENDED:
            text = re.sub(pattern, better, text)
        file.write_text(text, encoding="utf-8")
