"""MuJoCo with point masses on slide joints, joined by the edges of flexes of dimension 1, which are springs."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import ModuleType
from typing import Any, Literal

import numpy as np

from engines.engine import CAPABILITIES, COLLISIONS, LAWS, Unsupported, changed, refuse_beyond
from engines.mujoco.common import OFF, check_inertia, mujoco_module, update_constants, without
from engines.mujoco.obstacles import add_obstacles, off
from engines.mujoco.sliding_masses import SlidingMasses
from engines.vectors import three
from reference.state import Array
from reference.system import IntArray, MassSpringSystem, Value

Integrator = Literal["Euler", "RK4"]

SCHEMES: Mapping[Integrator, str] = {"Euler": "kick_drift", "RK4": "rk4"}

#: What is switched off: with EULERDAMP, Euler's step would take the drag implicitly.
FLEX_OFF = (*OFF, "EULERDAMP")

#: The numbers of the springs that are one flex, in the order of its edges.
Group = IntArray


@dataclass(frozen=True)
class MujocoFlex:
    """Point masses on one slide joint per axis; a spring is an edge of a flex.

    All edges of a flex have one stiffness and one damping, but each its own rest length: springs that are alike are
    one flex. With h = dt and a(x, v) the acceleration by springs, their damping, drag and gravity:
        Euler     v' = v + h a(x, v),   x' = x + h v'
        RK4       the classic one
    """

    name: str
    integrator: Integrator
    package: str = "mujoco"
    capabilities: frozenset[str] = (
        frozenset(CAPABILITIES) - {*LAWS, *COLLISIONS} - {"no rest length", "pulls", "angular springs"}
    )
    semantics: str = (
        "stiffness is k [N/m] and damping c [N s/m] of the edges of a flex, explicit; drag is Cd [N s/m] as damping of "
        "every slide joint, explicit"
    )

    @property
    def settings(self) -> Mapping[str, object]:
        """What was chosen, and what of MuJoCo's step is switched off."""
        return {"integrator": self.integrator, "flex": "dimension 1", "disabled": list(FLEX_OFF)}

    @property
    def identified_as(self) -> Mapping[str, str]:
        """One scheme in every case."""
        return dict.fromkeys(("plain", "damping", "drag"), SCHEMES[self.integrator])

    def start(self, system: MassSpringSystem, dt: float) -> FlexSimulation:
        """The system as bodies and flexes.

        Raises:
            Unsupported: beyond the capabilities; where MuJoCo refuses it, or a mass is below 1e-14 kg.
        """
        refuse_beyond(self, system)
        mujoco = mujoco_module()
        groups = groups_of(system, system.stiffness, system.damping)
        model = compiled(mujoco, system, groups, '<edge stiffness="1"/>', dt=dt)
        model.opt.timestep = dt
        model.opt.integrator = getattr(mujoco.mjtIntegrator, f"mjINT_{self.integrator.upper()}")
        model.opt.disableflags = without(mujoco, off(system, FLEX_OFF))
        return FlexSimulation(self, mujoco, model, system, groups)


class FlexSimulation(SlidingMasses):
    """A system whose springs are edges."""

    def __init__(
        self,
        engine: MujocoFlex,
        mujoco: ModuleType,
        model: Any,
        system: MassSpringSystem,
        groups: Sequence[Group],
    ) -> None:
        self._engine, self._groups = engine, groups
        super().__init__(mujoco, model, system)

    def change(self, parameter: str, value: Value) -> None:
        """Every parameter can change between two steps.

        Raises:
            Unsupported: for springs of one flex, which were alike, that are to differ.
        """
        system = changed(self._engine, self._system, parameter, value)
        _refuse_unlike(parameter, getattr(system, parameter, None), self._groups)
        self.go_on_with(system, parameter)

    def _write_parameters(self) -> None:
        write_masses_and_lengths(self._mujoco, self._model, self._system, self._groups)
        for flex, group in enumerate(self._groups):
            self._model.flex_edgestiffness[flex] = self._system.stiffness[group[0]]
            self._model.flex_edgedamping[flex] = self._system.damping[group[0]]


def groups_of(system: MassSpringSystem, *alike: Array) -> list[Group]:
    """Springs that can be one flex: equal in what is given, shapes (s,), and no two between the same masses.

    Of two such MuJoCo would make a single edge.
    """
    pairs: Counter[tuple[int, ...]] = Counter()
    parallel = []
    for pair in map(tuple, np.sort(system.springs, axis=1).tolist()):
        parallel.append(pairs[pair])
        pairs[pair] += 1
    _, kind = np.unique(np.column_stack([*alike, parallel]), axis=0, return_inverse=True)
    return [np.flatnonzero(kind.ravel() == i) for i in range(kind.max(initial=-1) + 1)]


def compiled(
    mujoco: ModuleType,
    system: MassSpringSystem,
    groups: Sequence[Group],
    edge: str,
    equality: str = "",
    dt: float = 0.0,
) -> Any:
    """Bodies, joints and flexes: what is joined to what. The numbers are written later.

    Args:
        edge: the element that says what edges are.
        equality: the elements that say what of them is held.
        dt: the step [s], which decides how hard obstacles are.

    Raises:
        Unsupported: with MuJoCo's own message.
    """
    slides = "".join(f'<joint type="slide" axis="{axis}"/>' for axis in ("1 0 0", "0 1 0", "0 0 1")[: system.dimension])
    inertia = '<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>'
    # apart from one another here, as MuJoCo refuses edges without a length
    bodies = [f'<body name="{i}" pos="{i} 0 0">{inertia}{slides}</body>' for i in np.flatnonzero(~system.fixed)]
    bodies += [f'<body name="{i}" pos="{i} 0 0"/>' for i in np.flatnonzero(system.fixed)]
    flexes = [_flex(f"flex {i}", system.springs[group], edge) for i, group in enumerate(groups)]
    xml = f"""<mujoco>
        <worldbody>{"".join(bodies)}</worldbody>
        <deformable>{"".join(flexes)}</deformable>
        <equality>{equality}</equality>
    </mujoco>"""
    try:
        if not system.obstacles:
            return mujoco.MjModel.from_xml_string(xml)
        spec = mujoco.MjSpec.from_string(xml)
        add_obstacles(mujoco, spec, system, dt)
        model = spec.compile()
    except ValueError as error:
        raise Unsupported("MuJoCo: " + " ".join(str(error).split())) from None
    # masses meet obstacles, edges meet nothing
    model.flex_contype[:] = model.flex_conaffinity[:] = model.flex_selfcollide[:] = 0
    return model


def _flex(name: str, springs: IntArray, edge: str) -> str:
    masses, elements = np.unique(springs, return_inverse=True)
    bodies, pairs = " ".join(map(str, masses)), " ".join(map(str, elements.ravel()))
    return f'<flex name="{name}" dim="1" radius="0.001" body="{bodies}" element="{pairs}">{edge}</flex>'


def write_masses_and_lengths(mujoco: ModuleType, model: Any, system: MassSpringSystem, groups: Sequence[Group]) -> None:
    """All parameters of a system but stiffness and damping into a model of it, in double precision."""
    masses = system.masses[~system.fixed]
    check_inertia("mass", masses, "kg")
    # body 0 is the world; then the free masses, at the origin so that coordinates are positions, and the fixed
    free, fixed = np.split(np.arange(1, 1 + len(system.masses)), [len(masses)])
    model.body_mass[free] = masses
    model.body_inertia[free] = masses[:, None]
    model.body_pos[free] = 0.0
    model.body_pos[fixed] = [three(position) for position in system.positions[system.fixed]] if len(fixed) else 0.0
    model.dof_damping[:] = system.drag
    model.opt.gravity[:] = three(system.gravity)
    update_constants(mujoco, model)
    for j, group in zip(model.flex_edgeadr, groups, strict=True):
        model.flexedge_length0[j : j + len(group)] = system.rest_lengths[group]


def _refuse_unlike(parameter: str, values: Array | None, groups: Sequence[Group]) -> None:
    """What all springs of a flex have in common must stay so."""
    if values is None or parameter not in ("stiffness", "damping"):
        return
    for group in groups:
        if np.ptp(values[group]):
            raise Unsupported(f"{parameter} of springs that began alike cannot become different: they are one flex")


ENGINES = (MujocoFlex("mujoco_flex", "Euler"), MujocoFlex("mujoco_flex_rk4", "RK4"))
