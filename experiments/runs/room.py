"""How much memory trajectories take, before they are made."""

from __future__ import annotations

from collections.abc import Sequence

from engines.engine import demands
from engines.process.isolation import EngineStepper
from reference.errors import InputError
from reference.stepper import Stepper
from reference.system import MassSpringSystem


def room_of(steppers: Sequence[Stepper], system: MassSpringSystem, steps: int, beside: int = 0) -> int:
    """The memory [bytes] of a trajectory of every stepper that can take the system, and of some beside."""
    asked = demands(system)
    able = [s for s in steppers if not isinstance(s, EngineStepper) or s.engine.capabilities.issuperset(asked)]
    return (len(able) + beside) * (steps + 1) * (system.positions.nbytes + system.velocities.nbytes)


def check_room(steppers: Sequence[Stepper], system: MassSpringSystem, steps: int, beside: int = 0) -> None:
    """Refuse what could not be kept. Raises InputError, with what is needed and what there is."""
    import psutil

    needed, free = room_of(steppers, system, steps, beside), psutil.virtual_memory().available
    if needed > free:
        raise InputError(
            f"{len(steppers)} steppers, {len(system.masses)} masses and {steps} steps take {needed / 2**30:.3g} GiB of "
            f"memory, where {free / 2**30:.3g} are free: expected fewer of them; see --stepper and --duration"
        )
