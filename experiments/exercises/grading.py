"""Grades: the public check, and the hidden one where the teacher's key is given; one submission, or a whole class."""

from __future__ import annotations

import csv
import os
import threading
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass, field, replace
from pathlib import Path
from time import perf_counter

from experiments.exercises.closer_look import CloserLook, Effort, look_closer
from experiments.exercises.exercise import Exercise
from experiments.exercises.handed_in.submission import Submission, read
from experiments.exercises.process.sandbox import Limits
from experiments.exercises.process.sandbox_errors import NotGradedError
from experiments.exercises.teaching.table_file import columns_of, read_table, written
from experiments.exercises.teaching.writing import require_folder, write_anew
from experiments.exercises.verdict.findings import clean
from experiments.exercises.verdict.judge import Verdict, judge, not_asked
from reference.errors import InputError
from reference.files.csv_cell import cell
from reference.printable import printable

#: The columns of a table of grades; `departs` is the first difference; students are told what is `seen` and where to
#: `look_at`, teachers the `change`.
COLUMNS = (
    "file",
    "exercise",
    "seed",
    "public",
    "hidden",
    "score",
    "outcome",
    "finding",
    "words",
    "departs",
    "seen",
    "look_at",
    "change",
    "seconds",
    "digest",
)


#: How long is searched unless told otherwise; and in a class, where many wait.
EFFORT, EFFORT_IN_CLASS = Effort(), Effort(0.7, 0.3, named=0.3, compiled=1200)


@dataclass(frozen=True)
class Grade:
    """A submission's verdicts.

    Attributes:
        public: of the check that students can run.
        hidden: of the other, None where it has not run.
        closer: what else was seen of one that is wrong.
    """

    public: Verdict
    hidden: Verdict | None
    seconds: float
    closer: CloserLook = field(default_factory=CloserLook)

    @property
    def verdict(self) -> Verdict:
        """The one that says most: what is wrong, if something is."""
        return self.hidden if self.hidden is not None and self.public.right else self.public

    @property
    def score(self) -> float:
        """Of 100: half for public questions, half for hidden ones; for the public alone where no others were asked."""
        parts = [v.passed for v in (self.public, self.hidden) if v is not None]
        return sum(100 * sum(passed) / max(1, len(passed)) for passed in parts) / len(parts)


def grade(
    submission: Submission, key: str | None = None, limits: Limits | None = None, effort: Effort | None = EFFORT
) -> Grade:
    """Run the public check, and with a key the hidden one, in a process of its own: the first knows no hidden question.

    Where all answers depend on the student's seed the two are the same, and run once. Where the public check comes to a
    bad end the hidden one is not run.

    Args:
        effort: how long is searched for what would make a wrong one right; None for no closer look.

    Raises:
        NotGradedError: where it is not the submission's fault that there is no grade, twice over.
    """
    begin = perf_counter()
    exercise, seed = submission.exercise, submission.seed_with(key)
    public = _judged(submission, seed, None, limits)
    hidden = None if key is None else public
    if key is not None and not exercise.seeded:
        bad = public.outcome in ("timed out", "crashed")
        hidden = not_asked(exercise, seed, key, public) if bad else _judged(submission, seed, key, limits)
    found = Grade(public, hidden, perf_counter() - begin)
    if found.verdict.right or effort is None:
        return found
    closer = look_closer(exercise, submission.source, seed, found.verdict, limits, effort, submission.language)
    return replace(found, closer=closer, seconds=perf_counter() - begin)


def _judged(submission: Submission, seed: str, key: str | None, limits: Limits | None) -> Verdict:
    """One check; tried again where the first time it was not the submission's fault that it came to nothing."""
    try:
        return judge(submission.exercise, submission.source, seed, key, limits, submission.language)
    except NotGradedError:
        return judge(submission.exercise, submission.source, seed, key, limits, submission.language)


def row_of(submission: Submission, given: Grade, key: str | None) -> dict[str, str]:
    """A grade as a row of the table."""
    verdict = given.verdict
    passed = [("" if v is None else "passed" if v.right else "failed") for v in (given.public, given.hidden)]
    return _row(
        submission.name,
        exercise=str(submission.exercise.number),
        seed=submission.seed,
        public=passed[0],
        hidden=passed[1],
        score=f"{given.score:.1f}",
        outcome=verdict.outcome,
        finding=verdict.name,
        words=" ".join(f.words for f in verdict.findings),
        departs=str(verdict.first_difference or ""),
        seen=" ".join(f.words for f in (*given.closer.findings, *verdict.remarks)),
        look_at=places(given.closer),
        change="; or: ".join(r.change for r in given.closer.told) if key is not None else "",
        seconds=f"{given.seconds:.2f}",
        digest=submission.digest(key),
    )


def places(closer: CloserLook) -> str:
    """Where in its text a submission is one or two small changes from being right: lines and kinds."""
    told = [" and ".join(f"line {line}: {family}" for line, family in r.places) for r in closer.told]
    return "; or ".join(dict.fromkeys(told))


def _row(name: str, **values: str) -> dict[str, str]:
    return {"file": _name(name), **{column: _cell(values.get(column, "")) for column in COLUMNS[1:]}}


def _name(name: str) -> str:
    """A file's name for a table: whole, and so that no two are the same; what cannot be printed is escaped."""
    return str(cell(printable(name)))


def _cell(words: str) -> str:
    """Words for a table: one line, and nothing that a spreadsheet would take for a formula."""
    return str(cell(clean(words) if len(words) < 200 else f"{clean(words)} ..."))


def grade_class(
    files: Iterable[tuple[Path, str]],
    table: Path,
    exercise: Exercise | None = None,
    key: str | None = None,
    workers: int | None = None,
    tell: Callable[[str], None] = lambda _: None,
    limits: Limits | None = None,
    keyed: bool = True,
) -> list[dict[str, str]]:
    """Grade many files, each row in the table as soon as it is there; rows that are there already are not done again.

    Args:
        files: each with its name.
        table: a CSV file. A row counts as done if its file, its exercise and the key are what they were.
        workers: how many submissions at once; left out, as many as there are cores.
        keyed: whether the exercise was handed out with the key.

    Raises:
        InputError: if the table is something else, or its folder is not there.
    """
    require_folder(table)
    earlier, wanted = _earlier(table), list(files)
    added = dict.fromkeys(name for row in earlier.values() for name in row if name not in COLUMNS)
    lock, rows = threading.Lock(), []
    _write(table, earlier.values())

    def one(path: Path, name: str) -> dict[str, str]:
        row = _graded(path, name, exercise, key, earlier, limits, keyed)
        with lock, table.open("a", newline="", encoding="utf-8") as file:
            if row is not earlier.get(_name(name)):
                csv.DictWriter(file, [*COLUMNS, *added], restval="").writerow(row)
        return row

    pool = ThreadPoolExecutor(workers or os.cpu_count() or 1)
    try:
        for future in as_completed([pool.submit(one, path, name) for path, name in wanted]):
            rows.append(future.result())
            tell(f"{len(rows)} of {len(wanted)}")
    finally:
        pool.shutdown(cancel_futures=True)
    rows.sort(key=lambda row: row["file"])
    names = {row["file"] for row in rows}
    _write(table, sorted([*rows, *(r for n, r in earlier.items() if n not in names)], key=lambda row: row["file"]))
    return rows


def _graded(
    path: Path,
    name: str,
    exercise: Exercise | None,
    key: str | None,
    earlier: dict[str, dict[str, str]],
    limits: Limits | None,
    keyed: bool,
) -> dict[str, str]:
    """A file's row; whatever goes wrong with it is in the row, and nobody else's."""
    try:
        submission = read(path, name, exercise, keyed)
    except (InputError, OSError) as error:
        return _row(name, score="0.0", outcome="error", finding="not_a_submission", words=str(error))
    done = earlier.get(_name(name))
    if done is not None and done["digest"] == submission.digest(key):
        return done
    try:
        return row_of(submission, grade(submission, key, limits, EFFORT_IN_CLASS), key)
    except NotGradedError as error:
        return _row(name, outcome="not graded", finding="not_graded", words=str(error))
    except Exception as error:  # the checker's own fault: the class goes on
        return _row(name, outcome="not graded", finding="not_graded", words=f"{type(error).__name__}: {error}")


def _earlier(table: Path) -> dict[str, dict[str, str]]:
    """The whole rows of a table, by file; a last line that was cut off is left out."""
    if not table.exists():
        return {}
    if not set(COLUMNS) <= set(columns_of(table)):
        raise InputError(f"{table} is not a table of grades: expected the columns {', '.join(COLUMNS)}")
    return {row["file"]: row for row in read_table(table) if row["digest"]}


def _write(table: Path, rows: Iterable[dict[str, str]]) -> None:
    """The table anew, in one go; columns that somebody has added stay, behind the others."""
    kept = list(rows)
    added = dict.fromkeys(name for row in kept for name in row if name not in COLUMNS)
    write_anew(table, written([*COLUMNS, *added], kept, guarded=True).encode("utf-8"))
