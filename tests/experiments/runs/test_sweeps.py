"""What a sweep refuses before anything runs, in the words of its command line."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest

from experiments.runs.sweeps import MOST_RUNS, ParameterSweep
from reference.errors import InputError
from reference.stepper import stepper_named


def sweep(**given: Any) -> ParameterSweep:
    """Heun over two masses, but for what is given."""
    return ParameterSweep("spring", [stepper_named("heun")], **{"axes": {"mass": [1.0, 2.0]}, "settings": {}, **given})


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"time_limit": 0.0}, "--time-limit 0: expected a number > 0 [s]"),
        ({"time_limit": np.nan}, "--time-limit nan: expected a number > 0 [s]"),
        ({"memory_limit": -(2**31)}, "--memory-limit -2: expected a number > 0 [GiB]"),
        ({"settings": {"mass": "1"}}, "--over mass: expected a parameter that is not set to one value as well"),
        (
            {"axes": {"dt": [1e-3]}, "dt": 1e-3},
            "--over dt: expected a parameter that is not set to one value as well",
        ),
        (
            {"axes": {"mass": range(5000), "stiffness": range(2001)}},
            "--over makes 10,005,000 runs: expected at most 10,000,000",
        ),
    ],
)
def test_what_makes_no_sense_is_refused(given: Mapping[str, Any], words: str) -> None:
    """Limits in the units they are typed in, a parameter both varied and set, more runs than anybody waits for."""
    with pytest.raises(InputError) as refused:
        sweep(**given)
    assert str(refused.value) == words


def test_a_sweep_has_all_combinations() -> None:
    """Each stepper with each value of each axis; as many as there may be are no more than that."""
    assert len(sweep(axes={"mass": [1.0, 2.0], "stiffness": [1.0, 2.0, 3.0]})) == 6
    assert len(sweep(axes={"mass": range(MOST_RUNS // 1000), "stiffness": range(1000)})) == MOST_RUNS
