"""The command `springlab exercise book`: a class's marks, one row for each student, and what students get back."""

from __future__ import annotations

import tempfile
from datetime import datetime
from pathlib import Path

import click

from report.commands.terminal import progress, show_table
from report.plain import plain

_FILE = click.Path(path_type=Path, dir_okay=False)


def register(group: click.Group, key_option: object, exposed_option: object, without_key_option: object) -> None:
    """Add the command to `springlab exercise`, with the options that its commands share."""
    command = click.command("book")(_book)
    for option in (without_key_option, exposed_option, key_option):
        command = option(command)  # type: ignore[operator]
    group.add_command(command)


@click.argument("handed_in", type=click.Path(path_type=Path))
@click.option(
    "--out", type=_FILE, default=Path("book.csv"), show_default=True, help="The book; its marks by hand stay."
)
@click.option("--grades", type=_FILE, help="The table of grades; goes on from there. Beside the book where left out.")
@click.option("--exercise", metavar="NAME", help="Which it is; what each file says where left out.")
@click.option("--students", type=_FILE, help="Who should have handed in: a name a line, or a table; maybe with seeds.")
@click.option("--due", type=click.DateTime(["%Y-%m-%d", "%Y-%m-%dT%H:%M"]), help="Until when; later files are late.")
@click.option(
    "--feedback", type=click.Path(path_type=Path, file_okay=False), help="A folder for what students get back."
)
@click.option("--platform", type=click.Choice(["moodle", "canvas", "brightspace"]), help="Also in its columns.")
@click.option("--jobs", type=click.IntRange(min=1), help="Submissions at once; as many as there are cores.")
def _book(
    handed_in: Path,
    out: Path,
    grades: Path | None,
    exercise: str | None,
    students: Path | None,
    due: datetime | None,
    feedback: Path | None,
    platform: str | None,
    jobs: int | None,
    key: str | None,
    exposed: bool,
    started_without_key: bool,
) -> None:
    """Grade HANDED_IN, a folder or a zip of a learning platform, and keep one row for each student."""
    from experiments.exercises.exercise import find
    from experiments.exercises.grading import grade_class
    from experiments.exercises.handed_in.collected import collect
    from experiments.exercises.process.sandbox import Limits
    from experiments.exercises.teaching.class_book import book, odd_marks, students_in, write_book
    from experiments.exercises.teaching.feedback import write_feedback
    from experiments.exercises.teaching.table_file import read_table
    from experiments.exercises.teaching.writing import require_folder

    require_folder(out)
    chosen = find(exercise) if exercise else None
    expected = students_in(students) if students else None
    table = grades or out.with_suffix(".grades.csv")
    with tempfile.TemporaryDirectory() as folder, progress("check") as tell:
        files = collect(handed_in, Path(folder))
        found = [(file.path, file.name) for file in files]
        limits = Limits(exposed=exposed)
        graded = grade_class(found, table, chosen, key, jobs, tell, limits, not started_without_key)
        rows = book(graded, files, expected, due, read_table(out) if out.exists() else ())
    write_book(rows, out)
    shown = [
        "student",
        "exercise",
        "mark",
        "outcome",
        "finding",
        "look_at",
        "days_late",
        "same_program_as",
        "same_seed_as",
    ]
    show_table("", shown, [[plain(row[name]) for name in shown] for row in rows])
    click.echo(f"written: {out}")
    for words in odd_marks(rows):
        click.echo(f"springlab: {out}: {plain(words)}", err=True)
    for written in _for_platform(rows, platform, out) if platform else ():
        click.echo(f"written: {written}")
    if feedback is not None:
        click.echo(f"written: {len(write_feedback(rows, feedback))} files in {feedback}")
    if _key_does_not_fit(rows, key, started_without_key):
        click.echo(
            "springlab: no file of exercise 8 is right; if it was handed out without a key: ", nl=False, err=True
        )
        click.echo("--started-without-key", err=True)


def _for_platform(rows: list[dict[str, str]], platform: str, out: Path) -> list[Path]:
    """A file for each exercise, beside the book."""
    from experiments.exercises.exercise import find
    from experiments.exercises.teaching.platforms import table
    from experiments.exercises.teaching.writing import write_anew

    written = []
    for number in dict.fromkeys(row["exercise"] for row in rows if row["exercise"]):
        own = [row for row in rows if row["exercise"] in (number, "")]
        file = out.with_name(f"{out.stem}.{platform}.{number}.csv")
        write_anew(file, table(own, platform, find(number).title).encode("utf-8"))
        written.append(file)
    return written


def _key_does_not_fit(rows: list[dict[str, str]], key: str | None, started_without_key: bool) -> bool:
    """Whether a class was graded with a key, and not one of its keyed answers is right: the key may not be theirs."""
    from experiments.exercises.exercise import exercises

    keyed = {str(number) for number, exercise in exercises().items() if exercise.keyed}
    own = [
        row
        for row in rows
        if row["exercise"] in keyed and row["outcome"] in ("right", "mistake", "not in the catalogue")
    ]
    return (
        key is not None and not started_without_key and len(own) > 1 and all(row["outcome"] != "right" for row in own)
    )
