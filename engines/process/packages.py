"""Packages that engines come in and that live in an environment of their own: which version, on which Python.

Most are large, some cannot live beside the lab, and one has wheels for another Python only. None is installed with the
lab: `springlab versions PACKAGE --install` makes its environment, which is kept. Where the package is installed beside
the lab, that one is used.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib import metadata
from pathlib import Path


@dataclass(frozen=True)
class Package:
    """One of them.

    Attributes:
        version: which is taken.
        module: what is imported of it.
        python: on which Python, such as "3.13"; None for the lab's own.
        beside: what else it needs, as pip is told.
        start_up: how long importing it and its first step may take [s], apart from what a run may take.
    """

    version: str
    module: str
    python: str | None = None
    beside: tuple[str, ...] = ()
    start_up: float = 30.0


APART: Mapping[str, Package] = {
    "box2d": Package("2.3.10", "Box2D"),
    "box2d-python": Package("0.1.2", "box2d", python="3.13"),
    "rapier3d": Package("0.36.1", "rapier3d"),
    "newton": Package("1.8.0", "newton", beside=("warp-lang==1.19.0",), start_up=180.0),
}


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
