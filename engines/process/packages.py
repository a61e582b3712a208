"""Packages that engines come in and that live in an environment of their own: which version, on which Python.

Most are large, some cannot live beside the lab, and one has wheels for another Python only. None is installed with the
lab: `springlab versions PACKAGE --install` makes its environment, which is kept. Where the package is installed beside
the lab, that one is used.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True)
class Package:
    """One of them.

    Attributes:
        version: which is taken.
        module: what is imported of it.
        python: on which Python, such as "3.12"; None for the lab's own.
        beside: what else it needs, as pip is told.
        npm: whether it is a package of npm, for Node; its environment has both, and what is imported of it is Node's.
        start_up: how long importing it and its first step may take [s], apart from what a run may take.
    """

    version: str
    module: str
    python: str | None = None
    beside: tuple[str, ...] = ()
    npm: bool = False
    start_up: float = 30.0


APART: Mapping[str, Package] = {
    "box2d": Package("2.3.10", "Box2D"),
    "box2d-python": Package("0.1.2", "box2d", python="3.12"),
    "rapier3d": Package("0.36.1", "rapier3d"),
    "drake": Package("1.51.1", "pydrake"),
    "pyPBD": Package("2.2.2", "pypbd"),
    "newton": Package("1.8.0", "newton", beside=("warp-lang==1.19.0",), start_up=180.0),
    "sapien": Package("3.0.3", "sapien", beside=("setuptools<81",)),  # 3.0.2 imports it
    "dartpy": Package("6.20.0", "dartpy"),
    "jolt-physics": Package("1.1.0", "jolt-physics", npm=True),
    "mujoco-warp": Package("4.0.0", "mujoco_warp", start_up=400.0),
}
