"""Where on this machine the lab keeps what can be made again."""

from __future__ import annotations

import os
import stat
import tempfile
from contextlib import suppress
from functools import cache
from pathlib import Path

from reference.scratch import scratch_folder

#: What there is to say of it in the end, each once.
remarks: dict[str, None] = {}


def cache_folder(name: str) -> Path:
    """A folder in the user's cache folder; where that cannot be written, in a temporary one, with a remark.

    Raises:
        OSError: where nothing at all can be written.
    """
    home = _home()
    if home is not None and _writable(home / "springlab" / name):
        return home / "springlab" / name
    folder = _temporary(tempfile.gettempdir()) / name
    folder.mkdir(exist_ok=True)
    remarks[f"{home or 'a home'} cannot be written: what would be kept there (compiled kernels) is in {folder}"] = None
    return folder


def _home() -> Path | None:
    """The user's cache folder; None for a user without a home."""
    try:
        return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    except RuntimeError:
        return None


def _writable(folder: Path) -> bool:
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return True
    except OSError:
        return False


@cache
def _temporary(place: str) -> Path:
    """A folder there that stays between runs, and is this user's alone: code in it is run."""
    user = os.getuid() if hasattr(os, "getuid") else 0
    folder = Path(place) / f"springlab-cache-{user}"
    with suppress(FileExistsError):
        folder.mkdir(mode=0o700)
    found = folder.lstat()
    private = stat.S_ISDIR(found.st_mode) and found.st_mode & 0o077 == 0
    if os.name == "posix" and not (private and found.st_uid == user):
        return scratch_folder()
    return folder
