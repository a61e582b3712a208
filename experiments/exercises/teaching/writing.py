"""Files written beside submissions: in place of whatever has the name, never through a link to somewhere else."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from reference.errors import InputError


def require_folder(file: Path) -> None:
    """Refuse a file whose folder is not there: a slip in a path makes no folders. Raises InputError."""
    if not file.parent.is_dir():
        raise InputError(f"{file}: there is no folder {file.parent}: expected one that is there")


def write_anew(file: Path, content: bytes) -> None:
    """A file with this content, in one go; a link of that name is replaced, what it leads to stays as it was.

    Raises:
        OSError: where nothing can be written there.
    """
    handle, name = tempfile.mkstemp(dir=file.parent, prefix=f".{file.name}.")
    try:
        with os.fdopen(handle, "wb") as new:
            new.write(content)
        os.chmod(name, 0o644)
        os.replace(name, file)
    except OSError as error:
        os.unlink(name)
        raise OSError(error.errno, error.strerror, str(file)) from None  # a full disk names no file by itself
    except BaseException:
        os.unlink(name)
        raise
