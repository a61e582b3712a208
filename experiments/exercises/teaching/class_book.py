"""A class's marks: one row for each student and exercise, made of the rows of the table of grades.

The newest file counts. Who is missing, how late a file is, which programs are equal, and who has another's seed are
columns of their own, for the teacher to judge; a mark that was written by hand stays.
"""

from __future__ import annotations

import ast
import hashlib
from collections.abc import Iterable, Mapping, Sequence
from datetime import datetime
from math import ceil
from pathlib import Path

from experiments.exercises.c.text import without_comments
from experiments.exercises.handed_in.collected import HandedIn
from experiments.exercises.handed_in.parsing import parsed
from experiments.exercises.handed_in.submission import IN_C, source_of
from experiments.exercises.teaching.table_file import as_meant, columns_of, read_table, written
from experiments.exercises.teaching.writing import write_anew
from reference.errors import InputError

#: The columns; `by_hand` is the teacher's, and counts in place of the score where it is not empty.
COLUMNS = (
    "student",
    "exercise",
    "score",
    "by_hand",
    "mark",
    "outcome",
    "finding",
    "words",
    "seen",
    "look_at",
    "change",
    "departs",
    "file",
    "handed_in",
    "days_late",
    "earlier_files",
    "same_program_as",
    "same_seed_as",
)

#: How the column of names may be called in a list of students, and that of seeds.
NAMES, SEEDS = ("student", "name", "full name", "username"), ("seed",)


def students_in(file: Path) -> dict[str, str]:
    """The students of a class, each with the seed that was handed out, "" where that is not said.

    A text file has a name on each line; a table a column `student` (or name, full name, username), and maybe `seed`.
    """
    rows = read_table(file)
    columns = {name.strip().lower(): name for name in columns_of(file)}
    name = next((columns[n] for n in NAMES if n in columns), None)
    if name is None:
        lines = file.read_bytes().decode("utf-8-sig").splitlines()
        return {line.strip(): "" for line in lines if line.strip()}
    seed = next((columns[n] for n in SEEDS if n in columns), None)
    return {row[name].strip(): row.get(seed, "") if seed else "" for row in rows if row[name].strip()}


def book(
    graded: Sequence[Mapping[str, str]],
    files: Sequence[HandedIn],
    students: Mapping[str, str] | None = None,
    due: datetime | None = None,
    before: Iterable[Mapping[str, str]] = (),
) -> list[dict[str, str]]:
    """One row for each student and exercise.

    Args:
        graded: rows of `grading`, by file. files: what they are of.
        students: who should have handed in, with the seed each was given; left out, who has.
        due: until when. before: rows of an earlier book, whose marks by hand stay.
    """
    by_name = {file.name: file for file in files}
    by_hand = {(as_meant(row["student"]), row["exercise"]): as_meant(row.get("by_hand", "")) for row in before}
    groups: dict[tuple[str, str], list[tuple[HandedIn, Mapping[str, str]]]] = {}
    for row in graded:
        file = by_name.get(as_meant(row["file"]))
        if file is not None:
            groups.setdefault((file.student, row["exercise"]), []).append((file, row))
    _drop_what_is_of_no_exercise(groups)
    newest = {who: max(found, key=lambda pair: pair[0].when) for who, found in groups.items()}
    programs, seeds = _programs(newest), _seeds(newest, students or {})
    rows = []
    for (student, exercise), (file, row) in sorted(newest.items()):
        late = "" if due is None else str(max(0, ceil((file.when - due).total_seconds() / 86400)))
        hand = by_hand.get((student, exercise), "")
        rows.append(
            {
                **{name: row.get(name, "") for name in COLUMNS},
                "student": student,
                "exercise": exercise,
                "by_hand": hand,
                "mark": hand or row["score"],
                "handed_in": f"{file.when:%Y-%m-%d %H:%M}",
                "days_late": late,
                "earlier_files": str(len(groups[student, exercise]) - 1),
                "same_program_as": ", ".join(programs[student, exercise]),
                "same_seed_as": ", ".join(seeds[student, exercise]),
            }
        )
    there = {student for student, _ in newest}
    for student in students or {}:
        if student not in there:
            hand = by_hand.get((student, ""), "")
            empty = dict.fromkeys(COLUMNS, "")
            rows.append({**empty, "student": student, "by_hand": hand, "mark": hand or "0.0", "outcome": "missing"})
    return rows


def odd_marks(rows: Iterable[Mapping[str, str]]) -> list[str]:
    """Marks by hand that are no numbers from 0 to 100, a line each: they count as they are.

    >>> odd_marks([{"student": "eve", "exercise": "1", "by_hand": mark} for mark in ("", "87,5", "good")])
    ["by_hand of eve, exercise 1: 'good': expected a number from 0 to 100; it counts as it is"]
    """
    odd = [row for row in rows if row["by_hand"] and not _is_mark(row["by_hand"])]
    return [
        f"by_hand of {row['student']}{', exercise ' * bool(row['exercise'])}{row['exercise']}: {row['by_hand']!r}: "
        "expected a number from 0 to 100; it counts as it is"
        for row in odd
    ]


def _is_mark(text: str) -> bool:
    try:
        return 0 <= float(text.replace(",", ".")) <= 100
    except ValueError:
        return False


def _drop_what_is_of_no_exercise(groups: dict[tuple[str, str], list[tuple[HandedIn, Mapping[str, str]]]]) -> None:
    """Files that are of no exercise have a row only if their student has no other."""
    for student, exercise in list(groups):
        if exercise == "" and any(s == student and e for s, e in groups):
            del groups[student, exercise]


def _programs(newest: Mapping[tuple[str, str], tuple[HandedIn, Mapping[str, str]]]) -> dict[tuple[str, str], list[str]]:
    """Who else has the same program: the same syntax tree, whatever comments, spaces and seeds there are."""
    digests = {who: _digest(file.path) for who, (file, _) in newest.items()}
    return {
        who: sorted(other[0] for other, d in digests.items() if d and d == digests[who] and other[0] != who[0])
        for who in newest
    }


def _digest(path: Path) -> str:
    """Of a program's syntax tree without strings that stand alone and without its seed; "" where it has none.

    Of one in C the text without comments and spaces.
    """
    try:
        source = source_of(path, path.name)
        if path.suffix.lower() in IN_C:
            return hashlib.sha256("".join(without_comments(source).split()).encode()).hexdigest()
        tree = parsed(source)
    except (InputError, OSError, SyntaxError, ValueError, RecursionError, MemoryError):
        return ""
    tree.body = [s for s in tree.body if not (isinstance(s, ast.Assign) and "SEED" in ast.dump(s.targets[0]))]
    for node in ast.walk(tree):
        body = getattr(node, "body", None)
        if isinstance(body, list):
            node.body = [s for s in body if not (isinstance(s, ast.Expr) and isinstance(s.value, ast.Constant))]  # type: ignore[attr-defined]
    return hashlib.sha256(ast.dump(tree).encode()).hexdigest()


def _seeds(
    newest: Mapping[tuple[str, str], tuple[HandedIn, Mapping[str, str]]], students: Mapping[str, str]
) -> dict[tuple[str, str], list[str]]:
    """Whose seed it is, where it is another's: by the class list, else who else has it."""
    owners = {seed: student for student, seed in students.items() if seed}
    found: dict[tuple[str, str], list[str]] = {}
    for who, (_, row) in newest.items():
        seed = row.get("seed", "")
        others = [o[0] for o, (_, r) in newest.items() if seed and r.get("seed") == seed and o[1] == who[1]]
        if seed in owners:
            others.append(owners[seed])
        found[who] = sorted(set(others) - {who[0]})
    return found


def write_book(rows: Sequence[Mapping[str, str]], file: Path) -> None:
    """As CSV, with a byte order mark, by which spreadsheets know UTF-8; nothing in it is a formula."""
    write_anew(file, written(COLUMNS, rows).encode("utf-8-sig"))
