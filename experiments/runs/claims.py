"""Which scheme an engine says it is: what its `identified_as` names, looked up."""

from __future__ import annotations

from engines.engine import Engine
from reference.stepper import SchemeStepper, stepper_named


def claimed(engine: Engine, case: str = "plain") -> SchemeStepper | None:
    """The scheme an engine is known to step by; None where it names none.

    Args:
        case: "plain", with "damping" of the springs, or with "drag".
    """
    name = engine.identified_as.get(case)
    return None if name is None else stepper_named(name)
