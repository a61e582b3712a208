"""MuJoCo with point masses on slide joints, joined by the edges of a flex that are held at their lengths: a rope."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import ModuleType
from typing import Any

import numpy as np

from engines.engine import CAPABILITIES, COLLISIONS, LAWS, OBSTACLES, Unsupported, changed, refuse_beyond
from engines.mujoco.common import mujoco_module, without
from engines.mujoco.flex import FLEX_OFF, Group, compiled, groups_of, write_masses_and_lengths
from engines.mujoco.sliding_masses import SlidingMasses
from reference.system import MassSpringSystem, Value

#: What is switched off. Constraints are what holds the edges.
ROPE_OFF = tuple(part for part in FLEX_OFF if part != "CONSTRAINT")

#: Of Newton's method. It solves equalities in one iteration; the others take back what that one has rounded.
ITERATIONS = 3


@dataclass(frozen=True)
class MujocoRope:
    """Point masses on one slide joint per axis; a spring is an edge of a flex that a soft equality holds at its length.

    With h = dt, a the acceleration by gravity and drag, J the Jacobian of the edges' lengths, r by how much these are
    too long, p the edges' forces and w their inverse weights (MuJoCo's manual, *Computation*):
        (J M^-1 J^T + R) p = -b J v - k r - J a,   b = 2 / (d T),   k = 1 / (d T^2),   R = (1 - d) / d w
        v' = v + h (a + M^-1 J^T p),   x' = x + h v'
    T is the time constant, here 2 h: MuJoCo allows none that is shorter. An edge loses a quarter of what it is too long
    in a step.

    Attributes:
        impedance: d. MuJoCo takes up to 0.9999.
        weight: w, as a part of 1/m_a + 1/m_b. So little lets edges give way by 1e-7 of what their masses do: a rope
            hardly stretches, yet edges that hold one another, as in a cloth, share their load.
    """

    name: str = "mujoco_rope"
    package: str = "mujoco"
    impedance: float = 0.9999
    weight: float = 1e-3
    capabilities: frozenset[str] = (
        frozenset(CAPABILITIES) - set(OBSTACLES) - {*LAWS, *COLLISIONS} - {"no rest length", "pulls", "angular springs"}
    )
    semantics: str = (
        "stiffness: infinite, whatever is given; damping: without effect, as nothing stretches for long; "
        "drag is Cd [N s/m] as damping of every slide joint, explicit"
    )

    @property
    def interactive_up_to(self) -> int:
        """See Engine: every step solves for the forces of all edges at once."""
        return 1000

    @property
    def settings(self) -> Mapping[str, object]:
        """What was chosen, and what of MuJoCo's step is switched off."""
        return {
            "integrator": "Euler",
            "flex": "dimension 1, its edges held by an equality",
            "solref": "2 dt, 1",
            "solimp": f"{self.impedance:g}, however far off",
            "inverse weight of an edge": f"{self.weight:g} (1/m_a + 1/m_b)",
            "solver": f"Newton, {ITERATIONS} iterations, tolerance 0",
            "disabled": list(ROPE_OFF),
        }

    @property
    def identified_as(self) -> Mapping[str, str]:
        """One scheme in every case."""
        return dict.fromkeys(("plain", "damping", "drag"), "rope_kick_drift")

    def start(self, system: MassSpringSystem, dt: float) -> RopeSimulation:
        """The system, its springs held. Raises Unsupported where MuJoCo refuses it, or a mass is below 1e-14 kg."""
        refuse_beyond(self, system)
        mujoco = mujoco_module()
        groups = groups_of(system)
        held = "".join(f'<flex flex="flex {i}"/>' for i in range(len(groups)))
        model = compiled(mujoco, system, groups, "<edge/>", held)
        model.opt.timestep = dt
        model.opt.integrator = mujoco.mjtIntegrator.mjINT_EULER
        model.opt.disableflags = without(mujoco, ROPE_OFF)
        model.opt.solver = mujoco.mjtSolver.mjSOL_NEWTON
        model.opt.iterations, model.opt.tolerance = ITERATIONS, 0.0
        model.eq_solref[:] = [2 * dt, 1.0]
        model.eq_solimp[:, :2] = self.impedance
        return RopeSimulation(self, mujoco, model, system, groups)


class RopeSimulation(SlidingMasses):
    """A system whose springs are held edges."""

    def __init__(
        self,
        engine: MujocoRope,
        mujoco: ModuleType,
        model: Any,
        system: MassSpringSystem,
        groups: Sequence[Group],
    ) -> None:
        self._engine, self._groups = engine, groups
        super().__init__(mujoco, model, system)

    def change(self, parameter: str, value: Value) -> None:
        """All can change but the stiffness; damping without effect, and to a new rest length it takes some steps."""
        if parameter == "stiffness":
            raise Unsupported("the edges of a rope do not stretch: there is no stiffness to change")
        self.go_on_with(changed(self._engine, self._system, parameter, value), parameter)

    def _write_parameters(self) -> None:
        system, model = self._system, self._model
        write_masses_and_lengths(self._mujoco, model, system, self._groups)
        inverse = np.where(system.fixed, 0.0, 1 / system.masses)
        for j, group in zip(model.flex_edgeadr, self._groups, strict=True):
            weights = self._engine.weight * inverse[system.springs[group]].sum(axis=1)
            model.flexedge_invweight0[j : j + len(group)] = weights


ENGINES = (MujocoRope(),)
