"""What stands beside an experiment on the report's page: the lab in a state that shows it, and its exercise."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType


@dataclass(frozen=True)
class Beside:
    """Where to go on from an experiment.

    Attributes:
        state: of the lab in a browser, as a link has it; empty where the lab does not show it.
        exercise: the number of the exercise; None where there is none.
    """

    state: str = ""
    exercise: int | None = None


#: By the experiment's name. States name scenes of `presets` and schemes of the catalogue.
BESIDE: Mapping[str, Beside] = MappingProxyType(
    {
        "divergence": Beside("s=string&w=kick_drift,euler,heun,rk4", 8),
        "stability": Beside("s=string&w=kick_drift,rk4&dt=0.0099", 5),
        "maps": Beside("s=string&w=heun,rk4&dt=0.0099&at=0:damping:0.05", 5),
        "order": Beside("s=oscillator&w=euler,kick_drift,heun,rk4&dt=0.005&speed=0.1", 2),
        "energy": Beside("s=string&w=euler,kick_drift,rk4&dt=0.0005", 6),
        "stiff_limit": Beside("s=string&w=kick_drift&dt=0.001&at=0:stiffness:20000"),
        "less_damping": Beside("s=oscillator&w=kick_drift,rk4&dt=0.01&at=0:damping:1&speed=0.1"),
        "first_order_instability": Beside("s=string&w=euler,kick_drift&dt=0.002", 1),
        "numbering": Beside("s=string&w=heun,heun_link_by_link&dt=0.002", 4),
        "errata": Beside("s=string&w=heun,heun_link_by_link,heun_aliased&dt=0.002", 4),
        "barrier": Beside("s=barrier&w=kick_drift", 7),
        "drape": Beside("s=drape&w=kick_drift", 9),
        "ground_motion": Beside("s=earthquake&w=kick_drift,rk4", 10),
        "scenes": Beside("s=jello&w=kick_drift"),
    }
)


def scenes_beside() -> set[str]:
    """The names of the scenes that these states show, and the lessons."""
    states = [beside.state for beside in BESIDE.values() if beside.state]
    return {"oscillator", "string", "cloth"} | {state.partition("&")[0].removeprefix("s=") for state in states}
