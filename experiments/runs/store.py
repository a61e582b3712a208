"""Where results are kept: one SQLite file, with the arrays beside it, each in a file named by its run's key.

Nothing is written over and nothing is deleted. A run's arrays are in place before its row is, and a row is there whole
or not at all: a process that is killed at any moment leaves a store that opens, and in it every run that was finished.
"""

from __future__ import annotations

import errno
import json
import sqlite3
import threading
from collections.abc import Iterable, Iterator, Mapping, Set
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np

from experiments.runs.environment import environment
from experiments.runs.result_codec import arrays_of, decode, encode
from experiments.runs.stored_rows import ARRAYS_FILE, COLUMN_TYPES, JSON_COLUMNS, TROUBLE, as_text, damage
from experiments.runs.task import Task, digest
from reference.errors import InputError
from reference.outcome import Outcome
from reference.state import Array

#: The format written here. A store of a higher one is a newer springlab's.
FORMAT = 1

#: How long [s] to wait for another springlab that is writing.
PATIENCE = 30.0

SCHEMA = f"""
CREATE TABLE IF NOT EXISTS environments (digest TEXT PRIMARY KEY, document TEXT NOT NULL);
CREATE TABLE IF NOT EXISTS runs (
    key TEXT NOT NULL,            -- of everything that decides the result
    generation INTEGER NOT NULL,  -- 0, 1, ...: how often it had been started over
    question TEXT NOT NULL,       -- of what was asked, whatever springlab answered
    retired INTEGER NOT NULL,     -- 1 where it is to be run again, or the question has a newer answer
    task TEXT NOT NULL, stepper TEXT, version TEXT, settings TEXT, system TEXT, parameters TEXT, dt REAL, steps INTEGER,
    outcome TEXT NOT NULL, reason TEXT NOT NULL, answer TEXT NOT NULL, arrays TEXT,  -- their file
    time_limit REAL NOT NULL, memory_limit REAL NOT NULL,
    seconds REAL NOT NULL, finished TEXT NOT NULL, environment TEXT NOT NULL REFERENCES environments (digest),
    PRIMARY KEY (key, generation)
);
CREATE INDEX IF NOT EXISTS questions ON runs (question);
PRAGMA user_version = {FORMAT};
"""

#: What the system calls a place where nothing can be written.
NO_PLACE = (errno.EACCES, errno.EPERM, errno.EROFS, errno.ENOTDIR, errno.EEXIST, errno.EISDIR)


#: What to do about a store of which only a part can be read.
SALVAGE = "`springlab results --salvage NEW` takes over what can be read"


class StoreError(InputError):
    """A store that cannot be used, or no more. The message is one line: which, and what to do."""


@dataclass(frozen=True)
class Stored:
    """An answer from the store."""

    answer: Any


class Store:
    """A store, opened for reading and writing; made where there is none.

    Args:
        file: the SQLite file; arrays go into a folder `arrays` beside it.

    Attributes:
        remarks: a line for each row that was found damaged, and is run again.

    Raises:
        StoreError: if it cannot be written, is no store, or a newer springlab's. So do all methods, and for a full disk
            or another springlab that does not stop writing: what was kept stays kept.
    """

    def __init__(self, file: Path) -> None:
        self.file = file
        self.remarks: list[str] = []
        self._arrays = file.parent / "arrays"
        self._lock = threading.Lock()
        with self._said():
            file.parent.mkdir(parents=True, exist_ok=True)
            self._sql = sqlite3.connect(file, timeout=PATIENCE, isolation_level=None, check_same_thread=False)
        try:
            self._open()
        except BaseException:
            self.close()
            raise

    def find(self, task: Task) -> Stored | None:
        """What is kept of a task; None where it is to be run: not yet, to be run again, or stopped at other limits."""
        with self._said(), self._lock:
            row = self._current(task)
        if row is None:
            return None
        found, why = self._read(row)
        if found is None:
            self.retire([task.key])
        if why:
            self.remarks.append(f"store {self.file}: the run {task.key[:12]} is damaged ({why}), and is run again")
        return found

    def _read(self, row: Mapping[str, Any]) -> tuple[Stored | None, str]:
        """The answer in a row; None where its arrays are gone, or it is damaged, and then why."""
        if why := damage(row):
            return None, why
        document = json.loads(row["answer"])
        try:
            arrays = read_arrays(self._arrays, row["arrays"], arrays_of(document))
            return (None if arrays is None else Stored(decode(document, arrays))), ""
        except (KeyError, TypeError, ValueError, AttributeError, RecursionError):
            return None, "its answer is none"

    def keep(self, task: Task, answer: Any, seconds: float) -> None:
        """Keep a task's answer and how long it took [s]; where another springlab has just kept one, let that be."""
        document, arrays = encode(answer)
        outcome = outcome_of_answer(answer)
        columns = task.labels | {
            "key": task.key,
            "question": task.question,
            "retired": 0,
            "outcome": outcome.ending,
            "reason": outcome.reason,
            "answer": document,
            "time_limit": task.time_limit,
            "memory_limit": task.memory_limit,
            "seconds": seconds,
            "finished": datetime.now(UTC).isoformat(timespec="milliseconds"),
            "environment": self._environment,
        }
        columns |= {name: json.dumps(columns[name]) for name in JSON_COLUMNS}
        with self._changing():
            if self._current(task) is not None:
                return
            # of damaged rows, whose generation may be anything, none counts
            (columns["generation"],) = self._sql.execute(
                "SELECT COALESCE(MAX(generation) + 1, 0) FROM runs "
                "WHERE key = ? AND typeof(generation) = 'integer' AND generation BETWEEN 0 AND 1000000000",
                [task.key],
            ).fetchone()
            columns["arrays"] = self._write(f"{task.key}-{columns['generation']}", arrays) if arrays else None
            self._sql.execute("UPDATE runs SET retired = 1 WHERE question = ?", [task.question])
            places = ", ".join("?" * len(columns))
            self._sql.execute(f"INSERT INTO runs ({', '.join(columns)}) VALUES ({places})", [*columns.values()])

    def retire(self, keys: Iterable[str]) -> None:
        """Let tasks of these keys count as not yet run. Their rows and arrays stay."""
        with self._changing():
            self._sql.executemany("UPDATE runs SET retired = 1 WHERE key = ?", ([key] for key in keys))

    def close(self) -> None:
        """Close the file."""
        with self._lock:
            self._sql.close()

    def _open(self) -> None:
        """Make what is missing, and remove what a killed springlab was writing: arrays are written by one at a time."""
        self._sql.row_factory, self._sql.text_factory = sqlite3.Row, as_text
        document = environment()
        del document["date"]
        self._environment = digest(document)
        with self._said():
            check_format(self.file, self._sql)
            # As safe as any against a process that is killed, and quick.
            self._sql.executescript(f"PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL; {SCHEMA}")
        with self._changing():
            row = [self._environment, json.dumps(document)]
            self._sql.execute("INSERT OR IGNORE INTO environments VALUES (?, ?)", row)
            for half in self._arrays.glob("*.half"):
                half.unlink()

    def _current(self, task: Task) -> dict[str, Any] | None:
        """The row that holds for a task: what was stopped at other limits than its own does not."""
        row = self._sql.execute(
            "SELECT * FROM runs WHERE key = ? AND NOT retired ORDER BY generation DESC LIMIT 1", [task.key]
        ).fetchone()
        if row is None:
            return None
        other_limits = (row["time_limit"], row["memory_limit"]) != (task.time_limit, task.memory_limit)
        return None if row["outcome"] in ("timed out", "crashed") and other_limits else dict(row)

    def _write(self, name: str, arrays: Mapping[str, Array]) -> str:
        """Arrays into a file, there whole or not at all. Its path from the folder of arrays."""
        path = f"{name[:2]}/{name}.npz"  # a folder with a million files is slow
        file = self._arrays / path
        file.parent.mkdir(parents=True, exist_ok=True)
        half = self._arrays / f"{name}.half"
        try:
            with half.open("wb") as opened:
                np.savez(opened, **arrays)  # type: ignore[arg-type]
            half.replace(file)
        finally:
            half.unlink(missing_ok=True)
        return path

    @contextmanager
    def _changing(self) -> Iterator[None]:
        """One change, seen by others whole or not at all."""
        with self._said(), self._lock:
            self._sql.execute("BEGIN IMMEDIATE")
            with self._sql:
                yield

    @contextmanager
    def _said(self) -> Iterator[None]:
        """What SQLite and the disk have to say, in one line."""
        try:
            yield
        except (sqlite3.Error, UnicodeError, OSError) as error:
            raise StoreError(f"store {self.file}: {in_words(error)}") from None


def check_format(file: Path, sql: sqlite3.Connection) -> bool:
    """Whether there is anything in a store yet. Raises StoreError for one of a newer springlab's, or of others'."""
    (found,) = sql.execute("PRAGMA user_version").fetchone()
    tables = {name for (name,) in sql.execute("SELECT name FROM sqlite_master WHERE type = 'table'")}
    if tables and not {"environments", "runs"} & tables:
        raise StoreError(f"store {file}: is no store of springlab's (it has a table {min(tables)!r})")
    if found > FORMAT:
        raise StoreError(f"store {file}: written by a newer springlab, in format {found}; expected {FORMAT} or less")
    if "runs" not in tables:
        return False
    columns = {name for (_, name, *_) in sql.execute("PRAGMA table_info(runs)")}
    for name in COLUMN_TYPES:
        if name not in columns:
            raise StoreError(f"store {file}: its runs have no column {name!r}; {SALVAGE}")
    return True


def opened_to_read(store: Path) -> sqlite3.Connection:
    """A store, opened for reading only; with rows by name.

    Raises:
        StoreError: where there is none, or it is no store, or cannot be read.
    """
    if not store.is_file():
        raise StoreError(f"store {store}: there is none; `springlab run` and `springlab sweep` make one")
    # In a folder that cannot be written, a store can be read only if nobody is writing to it, which is then for sure.
    problem = None
    for how in ("mode=ro", "immutable=1"):
        sql = sqlite3.connect(f"{store.resolve().as_uri()}?{how}", uri=True)
        sql.row_factory = sqlite3.Row
        try:
            sql.execute("SELECT name FROM sqlite_master").fetchall()
            return sql
        except sqlite3.OperationalError as error:
            problem = error
        except TROUBLE as error:
            sql.close()
            raise StoreError(f"store {store}: {in_words(error)}") from None
        sql.close()
    raise StoreError(f"store {store}: cannot be read ({problem})")


def read_arrays(folder: Path, path: str | None, names: Set[str] | None = None) -> dict[str, Array] | None:
    """The arrays of a run; None where the file is gone or broken, as after a power failure.

    Args:
        names: of the arrays it must have; left out, those it has.
    """
    if path is None:
        return {}
    if not ARRAYS_FILE.fullmatch(path):
        return None
    try:
        with (folder / path).open("rb") as file, np.load(file) as opened:
            found = dict(opened)
            return found if names is None or found.keys() == names else None
    except Exception:  # NumPy and zipfile raise nearly anything for a broken file
        return None


def outcome_of_answer(answer: Any) -> Outcome:
    """How a task ended: as its answer is or says, else done."""
    if isinstance(answer, Mapping):
        answer = answer.get("outcome")
    return answer if isinstance(answer, Outcome) else Outcome("done")


def in_words(error: Exception) -> str:
    """What SQLite or the disk has to say, and what to do."""
    text = getattr(error, "strerror", None) or str(error)  # without the file's name, which might say "full"
    if "full" in text or getattr(error, "errno", None) in (errno.ENOSPC, errno.EDQUOT):
        return "the disk is full; what was kept is safe: make room, and run the same command again"
    if "readonly" in text or "unable to open" in text or getattr(error, "errno", None) in NO_PLACE:
        return "cannot be written; expected a folder to write in, or another place by --store"
    if "locked" in text:
        return f"another springlab has been writing to it for {PATIENCE:g} s; run the same command again later"
    if "not a database" in text or "malformed" in text or isinstance(error, UnicodeError):
        return f"is damaged, or no store of springlab's ({text}); {SALVAGE}"
    return text
