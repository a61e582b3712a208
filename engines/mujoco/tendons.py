"""MuJoCo with point masses on slide joints, joined by tendons that are springs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import ModuleType
from typing import Any, Literal

import numpy as np

from engines.engine import CAPABILITIES, Unsupported, changed, refuse_beyond
from engines.mujoco.common import OFF, check_inertia, mujoco_module, update_constants, without
from engines.mujoco.obstacles import add_balls, add_obstacles, off
from engines.mujoco.sliding_masses import SlidingMasses
from engines.vectors import three
from reference.system import MassSpringSystem, Value

Integrator = Literal["Euler", "RK4", "implicit"]

#: With and without spring damping and drag, the scheme of each integrator.
SCHEMES: Mapping[Integrator, Mapping[str, str]] = {
    "Euler": {"plain": "kick_drift", "damping": "kick_drift", "drag": "kick_drift"},
    "RK4": {"plain": "rk4", "damping": "rk4", "drag": "rk4"},
    "implicit": {
        "plain": "kick_drift",
        "damping": "kick_drift_implicit_damping",
        "drag": "kick_drift_implicit_damping_and_drag",
    },
}

#: The most nested masses for interactive use: a step of them takes 0.02 s of a processor.
NESTED_UP_TO = 100

#: [m]. Tendons that only push have no force up to this length.
LONGEST = 1e10

#: [m]. The edge of the cube that gives a mass its moments of inertia. Nothing rotates: it only sets the Stokes drag.
CUBE = 1.0


@dataclass(frozen=True)
class MujocoTendons:
    """Point masses on one slide joint per axis; a spring is a tendon between sites, a fixed mass a site of the world.

    Integrators, each with h = dt, f the force of springs and gravity alone, C the damping matrix: of the springs
    (sum of c n n^T over them, n the direction of the spring at the start of the step) plus drag Cd on the diagonal:
        Euler     M v' = M v + h (f(x) - C v),   x' = x + h v'. With `eulerdamp`, MuJoCo's own default, the drag is
                  implicit: (M + h Cd) v' = M v + h (f(x) - C_springs v).
        RK4       the classic one, damping and drag included.
        implicit  (M + h C) v' = M v + h f(x),   x' = x + h v'.

    MuJoCo keeps of C only what couples a body with its ancestors. For `implicit` the bodies are therefore nested, each
    inside the one before it, its coordinates relative to that one's: then C is whole. It costs time, as M is then full.
    Joint damping would act on relative velocities there; the drag is Stokes' law in a viscous medium instead.
    """

    name: str
    integrator: Integrator
    eulerdamp: bool = False
    package: str = "mujoco"

    @property
    def capabilities(self) -> frozenset[str]:
        """All but a largest force and contacts that bounce; nested bodies do not collide with one another.

        What resists bending is a force that the lab sets before each step: within one of RK4 it would have to change.
        """
        lacks = {"largest_force", "restitution"}
        lacks |= {"collisions"} if self.nested else set()
        lacks |= {"angular springs"} if self.integrator == "RK4" else set()
        return frozenset(CAPABILITIES) - lacks

    @property
    def semantics(self) -> str:
        """What its numbers mean."""
        drag = "Stokes drag in a viscous medium" if self.nested else "damping of every slide joint"
        when = "explicit" if self.integrator != "implicit" else "implicit"
        return (
            f"stiffness is k [N/m] and damping c [N s/m] of each tendon, {when}; drag is Cd [N s/m] as {drag}, "
            f"{'implicit' if self.eulerdamp else when}"
        )

    @property
    def disabled(self) -> tuple[str, ...]:
        """What of MuJoCo's step is switched off."""
        return OFF if self.eulerdamp else (*OFF, "EULERDAMP")

    @property
    def nested(self) -> bool:
        """Whether each body is inside the one before it."""
        return self.integrator == "implicit"

    @property
    def interactive_up_to(self) -> int | None:
        """See Engine: nested, a step takes a time as the masses' number to the third power."""
        return NESTED_UP_TO if self.nested else None

    @property
    def settings(self) -> Mapping[str, object]:
        """What was chosen, and what of MuJoCo's step is switched off."""
        return {"integrator": self.integrator, "nested": self.nested, "disabled": list(self.disabled)}

    @property
    def identified_as(self) -> Mapping[str, str]:
        """The schemes written out above."""
        schemes = SCHEMES[self.integrator]
        return {**schemes, "drag": "kick_drift_implicit_drag"} if self.eulerdamp else schemes

    def start(self, system: MassSpringSystem, dt: float) -> TendonSimulation:
        """The system as bodies and tendons.

        Raises:
            Unsupported: beyond the capabilities; where MuJoCo refuses it, a mass is below 1e-14 kg, or springs that
                are damped go slack, as MuJoCo damps tendons that are slack, too.
        """
        refuse_beyond(self, system)
        mujoco = mujoco_module()
        try:
            model = tendon_spec(mujoco, system, self.nested, dt).compile()
        except ValueError as error:
            raise Unsupported("MuJoCo: " + " ".join(str(error).split())) from None
        model.opt.timestep = dt
        model.opt.integrator = getattr(mujoco.mjtIntegrator, f"mjINT_{self.integrator.upper()}")
        model.opt.disableflags = without(mujoco, off(system, self.disabled))
        return TendonSimulation(self, mujoco, model, system)


class TendonSimulation(SlidingMasses):
    """A system whose springs are tendons."""

    def __init__(self, engine: MujocoTendons, mujoco: ModuleType, model: Any, system: MassSpringSystem) -> None:
        self._engine = engine
        super().__init__(mujoco, model, system, engine.nested)

    def change(self, parameter: str, value: Value) -> None:
        """Every parameter can change between two steps."""
        self.go_on_with(changed(self._engine, self._system, parameter, value), parameter)

    def _write_parameters(self) -> None:
        mujoco, model, system = self._mujoco, self._model, self._system
        masses = system.masses[~system.fixed]
        check_inertia("mass", masses, "kg")
        model.body_mass[1:] = masses  # body 0 is the world
        model.body_inertia[1:] = masses[:, None] * CUBE**2 / 6
        model.tendon_stiffness[:] = system.stiffness
        model.tendon_damping[:] = system.damping
        model.tendon_lengthspring[:] = system.rest_lengths[:, None]  # no slack: from the rest length to the rest length
        _write_law(model, system)
        model.opt.gravity[:] = three(system.gravity)
        if self._nested:
            model.opt.viscosity = system.drag / (3 * np.pi * CUBE)
        else:
            model.dof_damping[:] = system.drag
        update_constants(mujoco, model)


def _write_law(model: Any, system: MassSpringSystem) -> None:
    """Springs that go slack are without force from one length to another; k3 is the second number after k."""
    law = system.nonlinear
    if hasattr(model, "tendon_stiffnesspoly"):
        model.tendon_stiffnesspoly[:, 1] = 0.0 if law is None else law.hardening
    if law is None:
        return
    if (system.slackens & (system.damping > 0)).any():
        raise Unsupported("MuJoCo damps tendons that are slack, too: expected none that go slack with damping")
    model.tendon_lengthspring[law.tension_only, 0] = 0.0
    model.tendon_lengthspring[law.compression_only, 1] = LONGEST
    if law.hardening.any() and not hasattr(model, "tendon_stiffnesspoly"):
        raise Unsupported("this MuJoCo has linear tendons only: hardening needs 3.6 or later")


def tendon_spec(mujoco: ModuleType, system: MassSpringSystem, nested: bool, dt: float) -> Any:
    """Bodies, joints, sites and tendons: what is joined to what. The parameters are written later."""
    spec = mujoco.MjSpec()
    if nested:
        # a step of n nested coordinates works in 120 n^2 bytes, beyond what MuJoCo sets aside from some 900 on
        spec.memory = 2**24 + 128 * (system.dimension * len(system.positions)) ** 2
    parent = spec.worldbody
    for i, fixed in enumerate(system.fixed):
        if fixed:
            spec.worldbody.add_site(name=f"mass {i}", pos=three(system.positions[i]))
            continue
        # every body at the origin, so that coordinates are positions
        body = parent.add_body(mass=1.0, inertia=[1.0, 1.0, 1.0], explicitinertial=True)
        body.add_site(name=f"mass {i}")
        for axis in np.eye(3)[: system.dimension]:
            body.add_joint(type=mujoco.mjtJoint.mjJNT_SLIDE, axis=axis)
        parent = body if nested else parent
    for a, b in system.springs:
        tendon = spec.add_tendon()
        tendon.wrap_site(f"mass {a}")
        tendon.wrap_site(f"mass {b}")
    add_obstacles(mujoco, spec, system, dt)
    add_balls(mujoco, spec, system, dt)
    return spec


ENGINES = (
    MujocoTendons("mujoco_tendons", "Euler"),
    MujocoTendons("mujoco_tendons_eulerdamp", "Euler", eulerdamp=True),
    MujocoTendons("mujoco_tendons_rk4", "RK4"),
    MujocoTendons("mujoco_tendons_implicit", "implicit"),
)
