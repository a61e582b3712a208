"""An exercise's text as an HTML page that also prints well; it asks for nothing from anywhere."""

from __future__ import annotations

from html import escape

from experiments.exercises.exercise import Exercise

_PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<style>
:root {{ color-scheme: light dark; }}
body {{ font: 17px/1.5 system-ui, sans-serif; max-width: 42rem; margin: 2rem auto; padding: 0 1rem; }}
code {{ font: 0.9em ui-monospace, monospace; }}
table {{ border-collapse: collapse; display: block; overflow-x: auto; }}
td code {{ white-space: nowrap; }}
th, td {{ border-bottom: 1px solid #8888; padding: 0.25rem 0.75rem 0.25rem 0; text-align: left; }}
@media (max-width: 30rem) {{
  table {{ font-size: 0.8em; }}
  th, td {{ padding-right: 0.4rem; }}
}}
@media print {{
  body {{ font-size: 11pt; max-width: none; margin: 0; color: #000; background: #fff; }}
  h2, table {{ break-inside: avoid; break-after: avoid; }}
  table {{ display: table; }}
}}
</style>
</head>
<body>
<main>
{body}</main>
</body>
</html>
"""


def page(exercise: Exercise, text: str) -> str:
    """The page of one of its texts."""
    from markdown_it import MarkdownIt

    body = MarkdownIt("commonmark", {"html": False}).enable("table").render(text)
    return _PAGE.format(title=escape(f"Exercise {exercise.number}: {exercise.title}"), body=body)
