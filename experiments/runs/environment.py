"""What a result depends on beside its question: versions, machine, date, and the lock the packages came from."""

from __future__ import annotations

import hashlib
import os
import platform
from datetime import UTC, datetime
from importlib import metadata
from pathlib import Path

PACKAGES = ("springlab", "numpy", "numba", "scipy", "matplotlib", "pymunk", "pybullet", "mujoco")


def environment() -> dict[str, str]:
    """Name and value of everything worth knowing, in the order it is shown."""
    return {
        **{package: _version(package) for package in PACKAGES},
        "Python": platform.python_version(),
        "system": f"{platform.system()} {platform.machine()}",
        "processor": processor(),
        "date": datetime.now(UTC).strftime("%Y-%m-%d %H:%M UTC"),
        "requirements.lock (SHA-256)": _lock_digest(),
    }


def _version(package: str) -> str:
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return "not installed"


def processor() -> str:
    """The processor's name and how many cores there are to work on."""
    cores = f"{os.cpu_count()} cores"
    information = Path("/proc/cpuinfo")
    names = [
        line.partition(":")[2].strip()
        for line in (information.read_text().splitlines() if information.exists() else [])
        if line.startswith("model name")
    ]
    return f"{names[0] if names else platform.processor() or 'unknown'}, {cores}"


def _lock_digest() -> str:
    lock = Path(__file__).parents[2] / "requirements.lock"
    return hashlib.sha256(lock.read_bytes()).hexdigest()[:16] if lock.exists() else "no lock beside this installation"
