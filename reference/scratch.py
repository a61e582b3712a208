"""Folders for a while: each says in its name whose it is, and what a dead owner left is removed by who comes next.

A process that is killed removes nothing. Its number and the time it was started at say for sure that it is no more; a
number alone is given to others later. Processes of another container are not seen from here: theirs are let be.
"""

from __future__ import annotations

import os
import re
import shutil
import stat
import tempfile
from functools import cache
from pathlib import Path

#: A folder's name: the owner's name space of processes, its number, and when it was started.
OWNED = re.compile(r"springlab-(\d+)-(\d+)-(\d+)-")


def scratch_folder() -> Path:
    """A new folder of this process's, to be removed by whoever asked for it. Raises OSError where there is no place."""
    return Path(tempfile.mkdtemp(prefix=owner_prefix()))


def owner_prefix() -> str:
    """What a temporary folder's name begins with, for this process to be its owner; left ones are removed first."""
    number = os.getpid()
    _sweep_once(Path(tempfile.gettempdir()), number)
    return f"springlab-{_name_space()}-{number}-{_started(number) or 0}-"


@cache
def _sweep_once(folder: Path, _: int) -> None:
    sweep(folder)


def sweep(folder: Path) -> list[Path]:
    """Remove from a folder what dead processes of this user have left; what it was."""
    left = []
    for name in os.listdir(folder):
        owner = OWNED.match(name)
        path = folder / name
        if owner and int(owner[1]) == _name_space() and not _alive(int(owner[2]), int(owner[3])) and _ours(path):
            shutil.rmtree(path, ignore_errors=True)
            left.append(path)
    return left


def _ours(path: Path) -> bool:
    """Whether it is a folder of this user's, and no link to one."""
    try:
        found = path.lstat()
    except OSError:  # somebody else has just removed it
        return False
    return stat.S_ISDIR(found.st_mode) and (not hasattr(os, "getuid") or found.st_uid == os.getuid())


def _alive(number: int, started: int) -> bool:
    """Whether a process with that number that was started then is still there; where nobody can know, it is."""
    if not Path("/proc/self/stat").exists():
        return True
    return _started(number) == started


def _started(number: int) -> int | None:
    """When a process was started, in ticks since the machine was; None where there is no such process, or no /proc."""
    try:
        text = Path(f"/proc/{number}/stat").read_text(errors="replace")
    except OSError:
        return None
    # the second field is the program's name in brackets, which may have anything in it (proc(5))
    return int(text.rpartition(")")[2].split()[19])


def _name_space() -> int:
    """The number of the name space in which processes have their numbers; 0 where there are none."""
    try:
        return os.stat("/proc/self/ns/pid").st_ino
    except OSError:
        return 0
