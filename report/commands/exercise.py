"""The command `springlab exercise`: list, start, check, gradescope; `exercise_book` has another."""

from __future__ import annotations

import os
import secrets
import shutil
import sys
import tempfile
import textwrap
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import click

from reference.printable import printable
from report.commands.exercise_book import register as register_book
from report.commands.options import json_option
from report.commands.terminal import json_text, progress, show_table
from report.plain import plain

if TYPE_CHECKING:
    from experiments.exercises.exercise import Exercise
    from experiments.exercises.grading import Grade
    from experiments.exercises.handed_in.submission import Submission
    from experiments.exercises.process.sandbox import Limits

#: A key is no longer than that [bytes].
LONGEST_KEY = 2**16

#: The exit code where something could not be graded, and that is no fault of what was handed in.
NOT_GRADED = 3


def _key(context: click.Context, parameter: click.Parameter, file: Path | None) -> str | None:
    """The key in a file, or in the environment: on a command line everybody on the machine could read it."""
    from reference.errors import InputError

    if file is None:
        return os.environ.get("SPRINGLAB_EXERCISE_KEY") or None
    try:
        with file.open("rb") as opened:
            content = opened.read(LONGEST_KEY + 1)
        key = content.decode("utf-8").strip()
    except (OSError, UnicodeDecodeError) as error:
        why = getattr(error, "strerror", None) or "expected text in UTF-8"
        raise InputError(f"--key-file {file}: {why}") from None
    if len(content) > LONGEST_KEY:
        raise InputError(f"--key-file {file}: expected a key of at most {LONGEST_KEY} bytes")
    if not key:
        raise InputError(f"--key-file {file}: expected the key, the file is empty")
    return key


def _no_key(context: click.Context, parameter: click.Parameter, given: str | None) -> None:
    from reference.errors import InputError

    if given is not None:
        shown = "on a command line everybody on this machine can read it"
        raise InputError(f"--key: {shown}; expected --key-file FILE, or the variable SPRINGLAB_EXERCISE_KEY")


def key_option(command: Any) -> Any:
    """The teacher's key, as `key`."""
    secret = "A file with the teacher's secret, what is hidden hangs on it; or the variable SPRINGLAB_EXERCISE_KEY."
    path = click.Path(path_type=Path, dir_okay=False)
    command = click.option("--key-file", "key", type=path, callback=_key, help=secret)(command)
    return click.option("--key", "no_key", hidden=True, expose_value=False, callback=_no_key)(command)


exposed_option = click.option(
    "--let-submissions-reach-my-files",
    "exposed",
    is_flag=True,
    help="Grade on a machine that cannot keep submissions from your files and processes, too.",
)

without_key_option = click.option(
    "--started-without-key", is_flag=True, help="The exercise was handed out without the key that it is graded with."
)


@click.group("exercise")
def exercise_command() -> None:
    """Exercises for students, and a checker that names the mistake."""


@exercise_command.command("list")
@json_option
def list_command(as_json: bool) -> None:
    """All exercises, with minutes and learning goals."""
    from experiments.exercises.exercise import exercises

    columns = ["exercise", "name", "title", "minutes", "goals", "mistakes known"]
    rows = [
        [e.number, e.name, e.title, e.minutes, e.goals, len({m.name for m in e.mistakes})] for e in exercises().values()
    ]
    if as_json:
        click.echo(json_text([dict(zip(columns, row, strict=True)) for row in rows]))
    else:
        show_table("", columns, rows)


@exercise_command.command("start")
@click.argument("exercise")
@click.argument("folder", required=False, type=click.Path(path_type=Path, file_okay=False))
@click.option(
    "--seed",
    metavar="WORD",
    default="example",
    show_default=True,
    help="Yours, where an exercise gives everybody other numbers.",
)
@click.option("--language", type=click.Choice(["python", "c"]), default="python", show_default=True)
@key_option
def start_command(
    exercise: str, folder: Path | None, seed: str, language: Literal["python", "c"], key: str | None
) -> None:
    """Write EXERCISE into FOLDER: its text, and the file to begin with."""
    from rich.console import Console
    from rich.markdown import Markdown

    from experiments.exercises.exercise import find
    from experiments.exercises.teaching.handout import hand_out

    found = find(exercise)
    written = hand_out(found, folder or Path(found.name), seed, key, language)
    Console().print(Markdown(found.text if language == "python" else found.text_in_c))
    for file in written:
        click.echo(f"written: {file}")
    click.echo(f"Then: springlab exercise check {written[0]}")


@exercise_command.command("check")
@click.argument("files", nargs=-1, required=True, type=click.Path(path_type=Path))
@click.option("--exercise", metavar="NAME", help="Which it is; what the file says where left out.")
@key_option
@click.option(
    "--csv", "table", type=click.Path(path_type=Path, dir_okay=False), help="Grades of a class; goes on from there."
)
@click.option("--jobs", type=click.IntRange(min=1), help="Submissions at once; as many as there are cores.")
@exposed_option
@without_key_option
@click.option("--plot/--no-plot", default=True, help="Draw where numbers differ, beside a file.")
@json_option
def check_command(
    files: tuple[Path, ...],
    exercise: str | None,
    key: str | None,
    table: Path | None,
    jobs: int | None,
    exposed: bool,
    started_without_key: bool,
    plot: bool,
    as_json: bool,
) -> None:
    """Check FILES, and say what they are: the scheme, or the mistake. A folder is a class.

    Exit code 1 where something is not right, 3 where something could not be graded.
    """
    from experiments.exercises.exercise import find
    from experiments.exercises.handed_in.collected import files_in
    from experiments.exercises.handed_in.submission import read
    from experiments.exercises.process.sandbox import Limits

    limits, keyed = Limits(exposed=exposed), not started_without_key

    chosen = find(exercise) if exercise else None
    with tempfile.TemporaryDirectory() as unpacked:
        found = files_in(files, Path(unpacked))
        if table is not None or len(found) > 1:
            sys.exit(_check_class(found, chosen, key, table, jobs, limits, keyed, as_json))
        ((path, name),) = found
        beside = files[0] if path.is_relative_to(unpacked) else path
        sys.exit(_check_one(beside, read(path, name, chosen, keyed), key, limits, plot, as_json))


def _check_one(path: Path, submission: Submission, key: str | None, limits: Limits, plot: bool, as_json: bool) -> int:
    """Grade one submission, and say what it is; the exit code."""
    from experiments.exercises.grading import grade
    from experiments.exercises.process.sandbox_errors import NotGradedError
    from reference.errors import InputError

    if submission.says_keyed and key is None:
        raise InputError(f"{submission.name} was started with a key: only whoever has it can check the answers")
    try:
        with progress("check") as tell:
            tell(submission.name)
            given = grade(submission, key, limits)
    except NotGradedError as error:
        click.echo(f"springlab: {submission.name} was not graded, which is not its fault: {error}", err=True)
        return NOT_GRADED
    if _started_without(submission, given, key):
        click.echo(f"springlab: {STARTED_WITHOUT}", err=True)
    if as_json:
        _print_grade(submission, given, key)
    else:
        _show_grade(path, submission, given, plot)
    return int(not given.verdict.right)


#: What is said where a file has no word of a key, is graded with one, and is not right.
STARTED_WITHOUT = "the file does not say that it was started with a key; if it was not: --started-without-key"


def _started_without(submission: Submission, given: Grade, key: str | None) -> bool:
    with_key = submission.exercise.keyed and submission.keyed and key is not None
    return with_key and not submission.says_keyed and not given.public.right


def _print_grade(submission: Submission, given: Grade, key: str | None) -> None:
    from experiments.exercises.grading import row_of

    findings = [{"name": f.name, "words": f.words, "hint": f.hint} for f in given.verdict.findings]
    row: dict[str, Any] = row_of(submission, given, key)
    click.echo(json_text({**row, "findings": findings, "deviation": given.verdict.error}))


def _show_grade(path: Path, submission: Submission, given: Grade, plot: bool) -> None:
    """In sentences; where numbers differ, drawn in the terminal and, if asked for, in a file beside the submission."""
    from experiments.exercises.handed_in.collected import PICTURE
    from experiments.exercises.teaching.plot import as_png, in_terminal
    from experiments.exercises.teaching.words import paragraphs

    click.echo("\n".join(map(_wrapped, paragraphs(submission, given))))
    lines = given.verdict.lines
    if lines is None:
        return
    click.echo("\n" + in_terminal(lines))
    if plot:
        picture = path.with_suffix(PICTURE)
        try:
            as_png(lines, picture, given.verdict.name)
        except OSError as error:
            click.echo(f"no picture, {printable(str(picture))} cannot be written: {error.strerror}", err=True)
        else:
            click.echo(f"written: {printable(str(picture))}")


def _wrapped(line: str) -> str:
    """A line of words as wide as the terminal, if it is one."""
    if not sys.stdout.isatty():
        return line
    width = min(shutil.get_terminal_size().columns, 100)
    return textwrap.fill(line, width, subsequent_indent="  ", drop_whitespace=True)


def _check_class(
    files: list[tuple[Path, str]],
    exercise: Exercise | None,
    key: str | None,
    table: Path | None,
    jobs: int | None,
    limits: Limits,
    keyed: bool,
    as_json: bool,
) -> int:
    """Grade many submissions, and show a row for each; the exit code."""
    from experiments.exercises.grading import grade_class

    _require_layers(limits)
    with tempfile.TemporaryDirectory() as folder, progress("check") as tell:
        rows = grade_class(files, table or Path(folder) / "grades.csv", exercise, key, jobs, tell, limits, keyed)
    if as_json:
        click.echo(json_text(rows))
    else:
        shown = ["file", "exercise", "public", "hidden", "score", "outcome", "finding"]
        show_table("", shown, [[plain(row[c]) for c in shown] for row in rows])
    seeds = Counter((row["exercise"], row["seed"]) for row in rows if row["seed"])
    for (number, seed), count in seeds.items():
        if count > 1:
            click.echo(f"Exercise {number}: {count} files have the seed {seed}.", err=as_json)
    if table is not None:
        click.echo(f"written: {table}", err=as_json)
    left = sum(row["outcome"] == "not graded" for row in rows)
    if left:
        words = f"{left} not graded, which is not their fault: the same command tries them again"
        click.echo(f"springlab: {words}", err=True)
    return NOT_GRADED if left else int(any(row["outcome"] != "right" for row in rows))


def _require_layers(limits: Limits) -> None:
    """Where layers of the sandbox are missing: nothing is graded, or it is said on standard error which.

    Raises:
        InputError: with what could be done.
    """
    from experiments.exercises.process import sandbox
    from reference.errors import InputError

    missing = sandbox.missing()
    if not missing:
        return
    words = f"this machine has no {', '.join(missing)} to keep submissions in (report/docs/exercises.md)"
    if not limits.exposed:
        raise InputError(f"{words}: expected one that has, or --let-submissions-reach-my-files")
    click.echo(f"springlab: {words}", err=True)


@exercise_command.command("gradescope")
@click.argument("exercise")
@click.option(
    "-o", "--out", type=click.Path(path_type=Path, dir_okay=False), default=Path("autograder.zip"), show_default=True
)
@key_option
@exposed_option
@without_key_option
def gradescope_command(exercise: str, out: Path, key: str | None, exposed: bool, started_without_key: bool) -> None:
    """Write the zip that Gradescope runs EXERCISE by. Without a key, it gets one of its own."""
    from experiments.exercises.exercise import find
    from experiments.exercises.teaching.gradescope import write_zip

    found = find(exercise)
    write_zip(found, key or secrets.token_hex(16), out, exposed, not started_without_key)
    click.echo(f"written: {out}")


register_book(exercise_command, key_option, exposed_option, without_key_option)
