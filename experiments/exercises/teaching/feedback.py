"""What each student gets back: a text and a page by student and exercise, of a row of the class's book."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from html import escape
from pathlib import Path

from experiments.exercises.exercise import find
from experiments.exercises.teaching.writing import write_anew

_PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<style>:root {{ color-scheme: light dark; }}
body {{ font: 17px/1.5 system-ui, sans-serif; max-width: 42rem; margin: 2rem auto; padding: 0 1rem; }}</style></head>
<body><main><h1>{title}</h1>
{body}
</main></body></html>
"""


def sentences(row: Mapping[str, str]) -> list[str]:
    """What the row says to its student; not the change that would mend the program."""
    said = [f"Mark: {row['mark']} of 100."]
    if row["outcome"] == "right":
        said.append("Everything asked was answered rightly.")
    said += [row["words"], row["seen"]]
    if row["departs"]:
        said.append(f"First difference: {row['departs']}.")
    if row["look_at"]:
        said.append(f"A small change of your text would make it right. Look at {row['look_at']}.")
    if row["days_late"] not in ("", "0"):
        said.append(f"Days late: {row['days_late']}.")
    return [sentence for sentence in said if sentence]


def write_feedback(rows: Sequence[Mapping[str, str]], folder: Path) -> list[Path]:
    """Two files for each row that has a file, text and HTML, in a folder of the student's."""
    written = []
    for row in rows:
        if not row["file"]:
            continue
        own = folder / re.sub(r"[^\w .-]", "_", row["student"]).strip(". ")[:100]
        own.mkdir(parents=True, exist_ok=True)
        title, stem = f"{row['student']}: a file that is no submission", "not_a_submission"
        if row["exercise"]:
            exercise = find(row["exercise"])
            title = f"{row['student']}: exercise {exercise.number}, {exercise.title}"
            stem = f"{exercise.number:02}_{exercise.name}"
        text = "\n".join([title, "", *sentences(row)]) + "\n"
        body = "\n".join(f"<p>{escape(sentence)}</p>" for sentence in sentences(row))
        for ending, content in (("txt", text), ("html", _PAGE.format(title=escape(title), body=body))):
            file = own / f"{stem}.{ending}"
            write_anew(file, content.encode("utf-8"))
            written.append(file)
    return written
