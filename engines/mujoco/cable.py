"""MuJoCo's composite cable with its masses at the joints: the string whose springs do not stretch (k -> infinity)."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from types import ModuleType
from typing import Any, Literal

import numpy as np

from engines.engine import Unsupported, changed, refuse_beyond
from engines.mujoco.common import OFF, check_inertia, mujoco_module, update_constants, without
from reference.state import Array
from reference.system import MassSpringSystem, Value

Integrator = Literal["Euler", "RK4"]

SCHEMES: Mapping[Integrator, str] = {"Euler": "pendulum_kick_drift", "RK4": "pendulum_rk4"}

#: As a fraction of the shortest segment, the radius of the small sphere that feels the drag at the end of each:
#: so small that the torque on it is below rounding.
RADIUS = 1e-9

#: As a fraction of m l^2, the inertia of a segment about itself. Nothing twists, but MuJoCo wants a positive number.
TWIST = 1e-6

#: What turns (y, x) into the vector (x, y) after a quarter turn.
QUARTER_TURN = np.array([-1.0, 1.0])


@dataclass(frozen=True)
class MujocoCable:
    """The cable: rigid massless segments on ball joints, a point mass at the end of each. A planar n-fold pendulum.

    Integrators, with h = dt, th the angles of the segments, w their rates, a(th, w) the pendulum's angular acceleration
    under gravity and drag:
        Euler     w' = w + h a(th, w),   th' = th + h w'
        RK4       the classic one in (th, w)

    The springs of the system are taken in the limit of infinite stiffness, whatever their own. There they keep their
    rest lengths, so that their damping does nothing. Drag is Stokes' law on a small sphere at each mass.
    """

    name: str
    integrator: Integrator
    package: str = "mujoco"
    capabilities: frozenset[str] = frozenset(
        {"2d", "masses", "rest_lengths", "stiffnesses", "dampings", "velocities", "damping", "drag", "tilted gravity"}
    )
    semantics: str = (
        "stiffness: infinite, whatever is given; damping: without effect, as nothing stretches; "
        "drag [N s/m] as Stokes drag (6 pi times viscosity times radius) on a small sphere at each mass"
    )

    @property
    def interactive_up_to(self) -> int:
        """See Engine: MuJoCo compiles and steps the cable in times that grow with the cube of its segments."""
        return 500

    @property
    def settings(self) -> Mapping[str, object]:
        """What was chosen, and what of MuJoCo's step is switched off."""
        return {"integrator": self.integrator, "composite": "cable", "masses": "at the tips", "disabled": list(OFF)}

    @property
    def identified_as(self) -> Mapping[str, str]:
        """The pendulum's scheme, in every case."""
        scheme = SCHEMES[self.integrator]
        return {"plain": scheme, "damping": scheme, "drag": scheme}

    def start(self, system: MassSpringSystem, dt: float) -> CableSimulation:
        """The system as a cable.

        Raises:
            Unsupported: beyond the capabilities, where the velocities stretch a segment, where a mass times its
                segment's length squared is below 1e-14 kg m^2, or where this MuJoCo has no cable (4.0 removed it).
        """
        refuse_beyond(self, system)
        mujoco = mujoco_module()
        model = _compile(mujoco, system)
        model.opt.timestep = dt
        model.opt.integrator = getattr(mujoco.mjtIntegrator, f"mjINT_{self.integrator.upper()}")
        model.opt.disableflags = without(mujoco, OFF)
        return CableSimulation(self, mujoco, model, system)


class CableSimulation:
    """A chain in MuJoCo. The coordinates are rotations, each segment's relative to the one before it."""

    def __init__(self, engine: MujocoCable, mujoco: ModuleType, model: Any, system: MassSpringSystem) -> None:
        self._engine, self._mujoco, self._model, self._system = engine, mujoco, model, system
        _write_parameters(mujoco, model, system)
        self._data = mujoco.MjData(model)
        self._reading = mujoco.MjData(model)  # positions are worked out here: the engine's own step stays untouched
        angles, rates = _angles(system)
        turns = np.diff(angles, prepend=0.0)
        joints = self._data.qpos.reshape(-1, 4)  # a quaternion each; all turns are about the third axis
        joints[:, 0], joints[:, 3] = np.cos(turns / 2), np.sin(turns / 2)
        # MuJoCo's own memory seen as arrays
        self._qpos, self._reading_qpos = self._data.qpos, self._reading.qpos
        self._spin = self._data.qvel[2::3]
        self._tips = self._reading.xipos[1:, :2]  # body 0 is the world
        self._spin[:] = np.diff(rates, prepend=0.0)
        self._positions, self._velocities = system.positions.copy(), np.zeros_like(system.positions)

    def step(self) -> None:
        """One mj_step."""
        self._mujoco.mj_step(self._model, self._data)

    def bare_step(self) -> Callable[[], object]:
        """mj_step."""
        return partial(self._mujoco.mj_step, self._model, self._data)

    def state(self) -> tuple[Array, Array]:
        """Positions from MuJoCo's kinematics at the present angles; velocities from the rates of the segments."""
        self._reading_qpos[:] = self._qpos
        self._mujoco.mj_kinematics(self._model, self._reading)
        positions, velocities = self._positions, self._velocities
        positions[1:] = self._tips
        segments = positions[1:] - positions[:-1]
        rates = self._spin.cumsum()[:, None]
        (segments[:, ::-1] * (rates * QUARTER_TURN)).cumsum(axis=0, out=velocities[1:])
        return positions.copy(), velocities.copy()

    def change(self, parameter: str, value: Value) -> None:
        """Mass, drag and gravity can change; damping too, without effect. Unsupported: stiffness, rest_length."""
        if parameter == "stiffness":
            raise Unsupported("the segments of a cable do not stretch: there is no stiffness to change")
        if parameter == "rest_length":
            raise Unsupported("the segments of a cable are rigid: another rest length would move the masses")
        self._system = changed(self._engine, self._system, parameter, value)
        _write_parameters(self._mujoco, self._model, self._system)


def _compile(mujoco: ModuleType, system: MassSpringSystem) -> Any:
    """A straight cable of as many segments; the numbers come in _write_parameters. Raises Unsupported in MuJoCo 4."""
    xml = f"""<mujoco><worldbody>
        <composite type="cable" curve="s" count="{len(system.positions)} 1 1" size="1 0 0" initial="ball" prefix="">
            <joint kind="main"/>
            <geom type="capsule" size="0.001"/>
        </composite>
    </worldbody></mujoco>"""
    try:
        spec = mujoco.MjSpec.from_string(xml)
        # pairs of bodies not to be tested for contact, which is off; with two segments MuJoCo gets their names wrong
        for pair in list(spec.excludes):
            spec.delete(pair) if hasattr(spec, "delete") else pair.delete()  # the second in MuJoCo 3.2
        return spec.compile()
    except ValueError as error:
        raise Unsupported("MuJoCo: " + " ".join(str(error).split())) from None


def _write_parameters(mujoco: ModuleType, model: Any, system: MassSpringSystem) -> None:
    """The parameters of a system into the model of a cable: segments along their own first axis, mass at the end."""
    masses, lengths = system.masses[1:], system.rest_lengths
    check_inertia("mass times length squared", masses * lengths**2, "kg m^2")
    radius = RADIUS * lengths.min()
    model.body_pos[1, :2] = system.positions[0]
    model.body_pos[2:, 0] = lengths[:-1]
    model.body_mass[1:] = masses
    model.body_ipos[1:] = np.outer(lengths, [1.0, 0.0, 0.0])
    model.body_iquat[1:] = [1.0, 0.0, 0.0, 0.0]
    model.body_inertia[1:] = np.outer(TWIST * masses * lengths**2, [1.0, 0.0, 0.0])
    # MuJoCo's shortcuts for a centre of mass at the joint or at the middle of the capsule
    model.body_sameframe[1:] = 0
    model.body_simple[1:] = 0
    model.geom_sameframe[:] = 0
    model.geom_pos[:] = model.body_ipos[1:]
    model.geom_quat[:] = [1.0, 0.0, 0.0, 0.0]
    model.geom_type[:] = mujoco.mjtGeom.mjGEOM_SPHERE
    model.geom_size[:] = [radius, 0.0, 0.0]
    model.geom_fluid[:, 0] = 1.0  # the shape feels the fluid, not the body's inertia
    model.opt.viscosity = system.drag / (6 * np.pi * radius)
    model.opt.gravity[:2] = system.gravity
    model.opt.gravity[2] = 0.0
    update_constants(mujoco, model)


def _angles(system: MassSpringSystem) -> tuple[Array, Array]:
    """The angle of each segment from the first axis [rad] and its rate [rad/s] that give the velocities at the start.

    Raises:
        Unsupported: where the velocities would stretch a segment.
    """
    segments = np.diff(system.positions, axis=0)
    relative = np.diff(system.velocities, axis=0)
    lengths = np.linalg.norm(segments, axis=1)
    along = (segments * relative).sum(axis=1) / lengths
    stretching = np.flatnonzero(abs(along) > 1e-12 * abs(system.velocities).max(initial=0.0))
    if len(stretching):
        j = stretching[0]
        raise Unsupported(f"a cable does not stretch, but at the start spring {j} does, by {along[j]:g} m/s")
    rates = (segments[:, 0] * relative[:, 1] - segments[:, 1] * relative[:, 0]) / lengths**2
    return np.arctan2(segments[:, 1], segments[:, 0]), rates


ENGINES = (
    MujocoCable("mujoco_cable", "Euler"),
    MujocoCable("mujoco_cable_rk4", "RK4"),
)
