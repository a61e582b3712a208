"""Jolt with a soft body whose edges are springs. 2D and 3D, single precision.

Jolt is C++; its port to WebAssembly is an npm package, which Node runs in a process of its own, told what to do over a
pipe (`host.mjs`). It ends when that pipe is closed.
"""

from __future__ import annotations

import json
import subprocess
import sys
import weakref
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from engines.engine import LINEAR_SPRINGS, Precision, changed, refuse_beyond
from engines.vectors import three
from reference.errors import Unsupported
from reference.state import Array
from reference.system import MassSpringSystem, Value

#: Jolt's default.
SUBSTEPS = 5

#: What Node runs, and the package in the environment of this Python.
HOST, PACKAGE = Path(__file__).with_name("host.mjs"), "node_modules/jolt-physics/dist/jolt-physics.wasm-compat.js"


@dataclass(frozen=True)
class JoltSoftBody:
    """Vertices and edges; a fixed mass has the inverse mass 0.

    `Optimize()`, without which Jolt dies in its first step, orders the edges: those nearest to a fixed mass come first.
    Up to 128 masses that is the order `from_fixed`; more of them are solved in groups, in an order of their own.

    Attributes:
        substeps: mNumIterations; each has one sweep over the edges.
    """

    name: str = "jolt_soft_body"
    substeps: int = SUBSTEPS
    package: str = "jolt-physics"
    precision: Precision = "single"
    capabilities: frozenset[str] = LINEAR_SPRINGS - {"damping", "dampings", "drag"}

    @property
    def identified_as(self) -> Mapping[str, str]:
        """XPBD by Gauss-Seidel, a sweep in each sub-step."""
        substeps = "" if self.substeps == SUBSTEPS else f", substeps={self.substeps}"
        return {"plain": f"xpbd_gauss_seidel(order=from_fixed, single=True{substeps})"}

    @property
    def settings(self) -> Mapping[str, object]:
        """What was chosen."""
        return {
            "mNumIterations": self.substeps,
            "mLinearDamping": 0,
            "mMaxLinearVelocity": 1e15,
            "mUpdatePosition": False,
            "mAllowSleeping": False,
        }

    @property
    def semantics(self) -> str:
        """What its numbers mean."""
        return "stiffness is k [N/m] of each edge, by a compliance 1/k; edges have no damping; drag is left out"

    def start(self, system: MassSpringSystem, dt: float) -> JoltSimulation:
        """The system as a soft body. Raises Unsupported beyond the capabilities, or for k = 0."""
        check(self, system)
        return JoltSimulation(self, system, dt)


def check(engine: JoltSoftBody, system: MassSpringSystem) -> None:
    """Raise Unsupported for what Jolt would take for something else."""
    refuse_beyond(engine, system)
    if (system.stiffness <= 0).any():
        raise Unsupported(f"{engine.name} takes a spring without stiffness for a rigid rod")


class JoltSimulation:
    """A Node process with a vertex for each mass."""

    def __init__(self, engine: JoltSoftBody, system: MassSpringSystem, dt: float) -> None:
        self._engine, self._system = engine, system
        self._node = _node()
        weakref.finalize(self, _IDLE.append, self._node)
        self._moved = np.flatnonzero(~system.fixed[system.springs].all(axis=1))
        rows = {"positions": system.positions, "velocities": np.where(system.fixed[:, None], 0.0, system.velocities)}
        self._ask(
            make={
                "dt": dt,
                "substeps": engine.substeps,
                "springs": system.springs[self._moved].tolist(),
                **{name: [three(row) for row in values] for name, values in rows.items()},
                **self._numbers(),
            }
        )

    def step(self) -> None:
        """One JoltInterface.Step."""
        self._ask(steps=1)

    def bare_step(self) -> Callable[[], object]:
        """Node must be told, so the adapter's step is the engine's."""
        return partial(self._ask, steps=1)

    def state(self) -> tuple[Array, Array]:
        """Positions and velocities, vertex by vertex."""
        x, v = (np.array(q, dtype=float).reshape(-1, 3)[:, : self._system.dimension] for q in self._ask(state=True))
        return x.copy(), v.copy()

    def change(self, parameter: str, value: Value) -> None:
        """Every parameter it has can change between two steps."""
        system = changed(self._engine, self._system, parameter, value)
        check(self._engine, system)
        self._system = system
        self._ask(write=self._numbers())

    def _numbers(self) -> Mapping[str, object]:
        system, one = self._system, np.float32(1)
        inverse = np.where(system.fixed, np.float32(0), one / system.masses.astype(np.float32))
        return {
            "inverse": inverse.tolist(),
            "compliance": (one / system.stiffness[self._moved].astype(np.float32)).tolist(),
            "rest": system.rest_lengths[self._moved].tolist(),
            "gravity": three(system.gravity),
        }

    def _ask(self, **told: object) -> Any:
        """The answer to a line. Raises RuntimeError where the process ended instead."""
        pipe_in, pipe_out = self._node.stdin, self._node.stdout
        assert pipe_in is not None
        assert pipe_out is not None
        try:
            pipe_in.write(json.dumps(told) + "\n")
            pipe_in.flush()
            line = pipe_out.readline()
        except BrokenPipeError:
            line = ""
        if not line:
            raise RuntimeError("the process that runs Jolt ended")
        return json.loads(line)


#: Processes whose simulation is no more: they are used again, as starting one takes a third of a second.
_IDLE: list[subprocess.Popen[str]] = []


def _node() -> subprocess.Popen[str]:
    """Node, with the package that is beside this Python. Raises Unsupported where there is no Node."""
    while _IDLE:
        idle = _IDLE.pop()
        if idle.poll() is None:
            return idle
    try:
        command = ["node", str(HOST), str(Path(sys.prefix) / PACKAGE)]
        return subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    except FileNotFoundError:
        raise Unsupported("Jolt runs under Node: expected node on the path") from None


ENGINES = (JoltSoftBody(), JoltSoftBody("jolt_soft_body_once", substeps=1))
