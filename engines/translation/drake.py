"""Drake: spring-dampers between the bodies of a multibody plant that is discrete."""

from __future__ import annotations

from engines.translation.program import ELONGATION, written
from engines.translation.translation import Settings, Stepping, Translation, newtons
from reference.system import MassSpringSystem


def drake(system: MassSpringSystem, stepping: Stepping, steps: int, settings: list[Settings]) -> str:
    """A plant with a body for each mass that moves."""
    return (
        "import numpy as np\n"
        "from pydrake.multibody.plant import MultibodyPlant\n"
        "from pydrake.multibody.tree import LinearSpringDamper, SpatialInertia, UnitInertia\n"
        "from pydrake.systems.analysis import Simulator\n\n"
        + written(system, stepping.dt, steps, settings)
        + """
plant = MultibodyPlant(dt)
plant.mutable_gravity_field().set_gravity_vector(gravity)
ends = []  # of springs: a body, and where on it
for i, (place, mass) in enumerate(zip(positions, masses)):
    if mass is None:
        ends.append((plant.world_body(), place))
    else:
        inertia = SpatialInertia(mass, np.zeros(3), UnitInertia.SolidSphere(1.0))
        ends.append((plant.AddRigidBody(f"mass {i}", inertia), np.zeros(3)))
for (a, b), rest, k, c in zip(springs, rest_lengths, stiffness, damping):
    plant.AddForceElement(LinearSpringDamper(*ends[a], *ends[b], rest, k, c))
plant.Finalize()
simulator = Simulator(plant)
context = simulator.get_mutable_context()
free = [i for i, mass in enumerate(masses) if mass is not None]
plant.SetPositions(context, np.ravel([[1, 0, 0, 0, *positions[i]] for i in free]))


def place(i):
    return plant.GetPositions(context).reshape(-1, 7)[free.index(i), 4:] if i in free else positions[i]

"""
        + ELONGATION
        + """

elongations = [elongation(place)]
for step in range(steps):
    simulator.AdvanceTo((step + 1) * dt)
    elongations.append(elongation(place))
"""
    )


TRANSLATIONS = (
    Translation(
        "drake",
        "Drake: linear spring-damper, discrete plant",
        {"stiffness": None, "damping": 0.0},
        scheme=lambda stepping: "kick_drift",
        snippet=drake,
        package="drake",
        note="its springs and dampers are explicit",
        **newtons(),  # type: ignore[arg-type]
    ),
)
