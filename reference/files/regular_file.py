"""Files that are read whole: only such as have an end, and fit into the memory."""

from __future__ import annotations

import errno
import os
import stat
from pathlib import Path

from reference.errors import InputError


def check_file(path: Path, most: int) -> None:
    """Refuse what is no file with an end (a pipe, a device), or is larger than that [bytes].

    Raises:
        InputError: for these, not naming the file.
        OSError: where there is none, it is a folder, or cannot be looked at.
    """
    found = os.stat(path)
    if stat.S_ISDIR(found.st_mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    if not stat.S_ISREG(found.st_mode):
        raise InputError("is a pipe or a device: expected a file")
    if found.st_size > most:
        raise InputError(f"has {found.st_size / 2**20:,.0f} MiB: expected at most {most / 2**20:,.0f} MiB")
