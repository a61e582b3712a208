"""What a class has handed in, as learning platforms export it: folders by student, zips, notebooks.

Whose a file is its path says: Moodle's folder `Ada Lovelace_123_assignsubmission_file_`, Canvas' file
`lovelaceada_123_456_euler.py`, Brightspace's folder `123-456 - Ada Lovelace - Nov 3, 2026 1100 AM`, or a plain folder
or file by name.
"""

from __future__ import annotations

import os
import re
import shutil
import zipfile
import zlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path, PurePosixPath

from experiments.exercises.handed_in.submission import LARGEST, SUFFIXES, files_of
from reference.errors import InputError

#: How many files a zip may have, and how much [bytes] is taken out of it at most.
MOST_FILES, MOST_BYTES = 10_000, 2**28

#: What students hand in beside programs, and teachers have no lists in.
DOCUMENTS = (".pdf", ".doc", ".docx", ".odt", ".rtf", ".png", ".jpg", ".jpeg", ".html")

#: What a check draws beside the file that it checks ends so.
PICTURE = ".check.png"

MOODLE = re.compile(r"^(?P<name>.+?)_(?P<id>\d+)_assignsubmission_\w+$")
BRIGHTSPACE = re.compile(r"^(?P<id>\d+-\d+) - (?P<name>.+?) - .+$")
CANVAS = re.compile(r"^(?P<name>[a-z0-9-]+?)(_LATE)?_(?P<id>\d+)_\d+_.+$", re.IGNORECASE)


@dataclass(frozen=True)
class HandedIn:
    """A file.

    Attributes:
        name: its path in what was handed in. student: whose it is.
        when: when it was written, by the file or by its zip.
    """

    path: Path
    name: str
    student: str
    when: datetime


def student_of(name: str) -> str:
    """Whose a file is, by its path.

    >>> [student_of(n) for n in ("Ada Lovelace_12_assignsubmission_file_/euler.py", "lovelaceada_1_2_euler-1.py")]
    ['Ada Lovelace', 'lovelaceada']
    >>> [student_of(n) for n in ("12-34 - Bob Noyce - Nov 3, 2026 1100 AM/euler.py", "eve/mine/euler.py", "max.py")]
    ['Bob Noyce', 'eve', 'max']
    """
    top = PurePosixPath(name).parts[0]
    for pattern in (MOODLE, BRIGHTSPACE, CANVAS):
        found = pattern.match(top)
        if found:
            return found["name"].strip()
    return top if "/" in name else PurePosixPath(name).stem


def collect(folder: Path, unpacked: Path) -> list[HandedIn]:
    """All programs and notebooks in a folder or a zip, in zips within it, and in zips in these.

    Of a student who has handed in none of these, the newest of what there is: it gets a row that says so.

    Args:
        unpacked: an empty folder to unpack zips into.

    Raises:
        InputError: where nothing is.
    """
    if not folder.exists():
        raise InputError(f"{folder}: expected a folder, or a zip")
    files = [folder] if folder.is_file() else sorted(p for p in folder.rglob("*") if p.is_file() and not p.is_symlink())
    found: list[HandedIn] = []
    others: list[HandedIn] = []
    for path in files:
        name = path.name if path == folder else path.relative_to(folder).as_posix()
        if any(part.startswith((".", "__")) for part in PurePosixPath(name).parts):
            continue
        if path.suffix.lower() == ".zip":
            # the whole class in one zip has students inside; a student's own zip is the student's
            prefix = "" if path == folder else f"{PurePosixPath(name).with_suffix('')}/"
            found += _of_zip(path, name, prefix, unpacked / f"zip{len(found)}", inner=False)
        elif path.suffix.lower() in SUFFIXES or _is_a_students(name):
            to = found if path.suffix.lower() in SUFFIXES else others
            to.append(HandedIn(path, name, student_of(name), datetime.fromtimestamp(path.stat().st_mtime)))
    programs = [file for file in found if file.path.suffix.lower() in (*SUFFIXES, ".zip")]
    if not programs:
        raise InputError(f"{folder}: expected Python or C files, notebooks or zips in it")
    others += [file for file in found if file not in programs]
    return [*programs, *_of_those_without(programs, others)]


def _is_a_students(name: str) -> bool:
    """Whether a file that is no program was handed in by somebody: it is in a folder, or what nobody has but students.

    >>> [_is_a_students(name) for name in ("eve/plot.png", "lovelaceada_12_3_report.docx", "eve.pdf", "students.csv")]
    [True, True, True, False]
    >>> _is_a_students("eve.check.png")
    False
    """
    if name.endswith(PICTURE):
        return False
    return "/" in name or CANVAS.match(name) is not None or PurePosixPath(name).suffix.lower() in DOCUMENTS


def _of_those_without(programs: Sequence[HandedIn], others: Sequence[HandedIn]) -> list[HandedIn]:
    """The newest of what is no program, of each student who has handed in nothing else."""
    there = {file.student for file in programs}
    newest = {file.student: file for file in sorted(others, key=lambda file: file.when) if file.student not in there}
    return list(newest.values())


def files_in(paths: Sequence[Path], unpacked: Path) -> list[tuple[Path, str]]:
    """The files that are meant, as `submission.files_of` gives them, and those in zips, also in zips in folders.

    Of who has handed in no program into a folder, what there is: as `collect` has it.

    Args:
        unpacked: an empty folder to unpack zips into.

    Raises:
        InputError: for a path where nothing is, or nothing that can be graded.
    """
    found: list[tuple[Path, str]] = []
    for i, path in enumerate(paths):
        if path.is_dir() or path.suffix.lower() == ".zip":
            found += [(file.path, file.name) for file in collect(path, unpacked / f"path{i}")]
        else:
            found += files_of([path])
    return found


def _of_zip(path: Path, name: str, prefix: str, into: Path, inner: bool) -> list[HandedIn]:
    """What is in a zip. A student's own that cannot be read, or has no program in it, stands for itself: it is told.

    Args:
        inner: whether it was in a zip itself: zips in it are left.
    """
    try:
        inside = list(_out_of_zip(path, prefix, into, inner))
    except InputError:
        if not prefix:
            raise
        inside = []
    if inside or not prefix:
        return inside
    return [HandedIn(path, name, student_of(name), datetime.fromtimestamp(path.stat().st_mtime))]


def _out_of_zip(path: Path, prefix: str, into: Path, inner: bool) -> Iterator[HandedIn]:
    """The programs and notebooks of a zip, and those of zips in it; what leads out of it, or is too large, is left."""
    try:
        with zipfile.ZipFile(path) as archive:
            taken = 0
            if len(archive.infolist()) > MOST_FILES:
                raise ValueError(f"it has more than {MOST_FILES} files")
            for i, entry in enumerate(archive.infolist()):
                inside = PurePosixPath(entry.filename.replace("\\", "/"))
                hidden = any(part.startswith((".", "__")) for part in inside.parts) or inside.is_absolute()
                zipped = inside.suffix.lower() == ".zip" and not inner and not entry.is_dir()
                program = inside.suffix.lower() in SUFFIXES and entry.file_size <= LARGEST
                if not (hidden or zipped or program or entry.is_dir() or prefix) and _is_a_students(str(inside)):
                    # no program, and whose it is is told: it is not unpacked
                    when = datetime(*entry.date_time)
                    yield HandedIn(
                        into / f"{i}{inside.suffix.lower() or '.none'}", str(inside), student_of(str(inside)), when
                    )
                if hidden or not (zipped or program):
                    continue
                taken += entry.file_size
                if taken > MOST_BYTES:
                    raise ValueError(f"its programs and zips have more than {MOST_BYTES} bytes")
                file = into / f"{i}{inside.suffix.lower()}"
                file.parent.mkdir(parents=True, exist_ok=True)
                name, when = f"{prefix}{inside}", datetime(*entry.date_time)
                with archive.open(entry) as packed, file.open("wb") as unpacked:
                    shutil.copyfileobj(packed, unpacked)
                if program:
                    yield HandedIn(file, name, student_of(name), when)
                    continue
                os.utime(file, (when.timestamp(), when.timestamp()))
                found = _of_zip(file, name, f"{prefix}{inside.with_suffix('')}/", into / str(i), inner=True)
                taken += sum(one.path.stat().st_size for one in found if one.path != file)
                yield from found
    except (zipfile.BadZipFile, zlib.error, EOFError, RuntimeError, NotImplementedError, ValueError) as error:
        raise InputError(f"{path}: expected a zip that can be read: {error}") from None
