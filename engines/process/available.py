"""Which engines are there: beside the lab, or in an environment that is kept for them."""

from __future__ import annotations

from functools import cache
from importlib import metadata
from pathlib import Path

from engines.process.packages import APART


@cache
def installed_version(package: str) -> str | None:
    """The version installed beside the lab, or None. It is looked up once: that takes milliseconds."""
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return None


def available_version(package: str) -> str | None:
    """The version beside the lab; else the one in its kept environment; None where there is neither."""
    return installed_version(package) or (APART[package].version if interpreter(package) else None)


def interpreter(package: str) -> Path | None:
    """The Python of the environment that is kept for a package; None where it is beside the lab, or nowhere."""
    if package not in APART or installed_version(package):
        return None
    return _kept(package)


def how_to_install(package: str) -> str:
    """What is said where an engine is not there."""
    way = f": springlab versions {package} --install makes its environment" if package in APART else ""
    return f"{package} is not installed{way}"


@cache
def _kept(package: str) -> Path | None:
    from engines.process.environments import kept

    return kept(package, APART[package].version)
