"""All results made by hand, by experiment and case: as usual, as large as in the report, and with what is missing."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from experiments.engine_versions.changes import result_of as versions_result
from experiments.experiment import Result
from tests.experiments.canned import (
    advice,
    barrier,
    cost,
    divergence,
    drape,
    energy,
    errata,
    first_order_instability,
    ground_motion,
    less_damping,
    maps,
    million_runs,
    numbering,
    order,
    own_scene,
    scenes,
    speed,
    stability,
    stiff_limit,
)
from tests.experiments.engine_versions.spring_versions import MEASURED

RESULTS: Mapping[str, Mapping[str, Callable[[], Result]]] = {
    "divergence": {
        "usual": divergence.usual,
        "full": divergence.full,
        "no engine": divergence.not_installed,
        "nobody": divergence.of,
    },
    "stability": {"usual": stability.usual, "full": stability.full},
    "maps": {"usual": maps.usual},
    "order": {"usual": order.usual, "full": order.full, "nobody": order.nobody},
    "energy": {"usual": energy.usual, "full": energy.full, "nobody": energy.nobody},
    "stiff_limit": {"usual": stiff_limit.usual, "no engine": lambda: stiff_limit.usual(None)},
    "less_damping": {"usual": less_damping.usual},
    "first_order_instability": {"usual": first_order_instability.usual, "lost": first_order_instability.lost},
    "numbering": {"usual": numbering.usual, "full": numbering.full},
    "errata": {"usual": errata.usual},
    "barrier": {"usual": barrier.usual},
    "drape": {"usual": drape.usual, "no engine": lambda: drape.usual(engine=False)},
    "ground_motion": {"usual": ground_motion.usual, "nobody": ground_motion.nobody},
    "scenes": {"usual": scenes.usual, "no scene": scenes.nothing},
    "cost": {"usual": cost.usual, "full": cost.full},
    "speed": {"usual": speed.usual, "no compiler": speed.no_compiler},
    "million_runs": {"usual": million_runs.usual},
    "advice": {"usual": advice.usual, "nobody": advice.only},
    "motion": {"usual": divergence.usual},
    "own_scene": {"usual": own_scene.usual},
    "versions": {"usual": lambda: versions_result(MEASURED)},
}
