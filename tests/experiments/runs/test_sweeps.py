"""What a sweep refuses before anything runs, in the words of its command line."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from engines.engine import Engine
from experiments.runs.sweeps import MOST_RUNS, ParameterSweep, count, judged, tally
from reference.errors import InputError
from reference.obstacles import Circle
from reference.outcome import Outcome
from reference.scenes import find
from reference.stepper import stepper_named
from reference.theory.exact import exact
from tests.conformance.doctored import Doctored

SYSTEM = find("string").system({"masses": 2})


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


def judge(stepper: str = "euler", engine: Engine | None = None, **given: Any) -> dict[str, Any]:
    """Of a string of two for five steps, without identification or trajectory but for what is given."""
    asked = {"system": SYSTEM, "dt": 1e-3, "steps": 5, "changes": (), "identify": False, "keep": False, **given}
    return judged(stepper, engine, **asked)


def test_a_run_is_judged_by_its_largest_distance_from_the_true_motion() -> None:
    """At the end, where it is that of the trajectory to the true motion's, by hand; it is kept where that is asked."""
    found = judge(keep=True)
    run = found["outcome"].trajectory
    true = exact(SYSTEM, 1e-3, 5)
    assert found["error_m"] == pytest.approx(np.linalg.norm(run.positions - true.positions, axis=2).max(), rel=1e-9)
    assert found["error_m"] > 0
    assert judge() == {"outcome": replace(found["outcome"], trajectory=None), "error_m": found["error_m"]}


def test_nothing_is_said_of_a_distance_that_nobody_can_know() -> None:
    """Where the system has obstacles, or the run did not come to its end; nor of a scheme, unless that is asked."""
    on_ground = replace(SYSTEM, obstacles=(Circle((0.0, -9.0), 1.0),))
    assert list(judge(system=on_ground)) == ["outcome"]
    torn = judge(system=SYSTEM.with_parameter("stiffness", 1e9), steps=50)
    assert torn["outcome"].ending == "diverged"
    assert list(torn) == ["outcome"]


def test_the_scheme_is_told_where_that_is_asked() -> None:
    """Of an engine, which is judged itself and not who has the name; its ties in one word."""
    found = judge("no such name", Doctored(), identify=True, steps=60)
    assert found["identified_as"] == "kick_drift"
    assert isinstance(found["ties"], str)
    assert "identified_as" not in judge("no such name", Doctored())


def test_the_reason_that_was_given_most_often_is_told() -> None:
    """Of those that did not run to an end; how many ended how, the most first."""
    tallies = tally([stepper_named("heun"), stepper_named("rk4")])
    for reason in ("b", "a", "a"):
        count(tallies, "heun", Outcome("crashed", reason))
    count(tallies, "heun", Outcome("done", "fine"))
    count(tallies, "rk4", Outcome("diverged", "torn"))
    assert tallies["heun"].row == ["heun", "3 crashed, 1 done", "a"]
    assert tallies["rk4"].row == ["rk4", "1 diverged", None]
