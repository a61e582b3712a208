"""What limits steps, what frames take, how much stiffer springs could be: told of advice made by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from experiments.advice.advice import Advice
from experiments.advice.reasons import Reasons
from experiments.advice.wording import limited_by
from reference.limit import Limit
from reference.outcome import Outcome
from reference.scenes import find
from reference.theory.critical_mode import CriticalMode
from tests.experiments.canned.advice import CABLE, CANNOT, DONE, STABLE, TOO_LONG, UNMEASURED, only
from tests.experiments.canned.reading import finding, records

#: Springs of 200 N/m, the last of 300.
SYSTEM = replace(find("string").system({"masses": 3}), stiffness=np.array([200.0, 200.0, 300.0]))


def with_mode(advice: Advice, shares: tuple[float, ...], frequency: float = 12.5, times: float | None = None) -> Advice:
    """With a mode in which springs have these parts of the energy, and how much stiffer springs could be."""
    mode = CriticalMode(np.zeros((4, 2)), frequency, np.array(shares))
    return replace(advice, reasons=Reasons(mode, times, SYSTEM))


def test_a_limit_is_that_of_one_spring_or_of_many() -> None:
    """Of one that has 35 % of the energy and more; else of as many as have half of it."""
    assert limited_by(STABLE) == ""
    assert limited_by(replace(STABLE, reasons=Reasons(None, 2.0, SYSTEM))) == ""
    one = limited_by(with_mode(STABLE, (0.3, 0.2, 0.5)))
    assert one == "spring 2 (masses 2 and 3, 300 N/m): 50% of the energy of a swing at 12.5 Hz"
    assert limited_by(with_mode(STABLE, (0.36, 0.32, 0.32))).startswith("spring 0 (masses 0 and 1, 200 N/m)")
    assert limited_by(with_mode(STABLE, (0.34, 0.33, 0.33))) == (
        "a swing of many springs at 12.5 Hz, half of its energy in 2 of them"
    )


def test_what_limits_the_step_is_said_once_where_it_is_the_same() -> None:
    """Or of which engines it is said, where it is not; of those without a mode nothing."""
    stable, too_long = with_mode(STABLE, (0.3, 0.2, 0.5)), with_mode(TOO_LONG, (0.3, 0.2, 0.5))
    said = finding(only(stable, too_long, CABLE), "By theory the step is limited by spring 2")
    assert said.endswith("12.5 Hz.")
    other = with_mode(TOO_LONG, (0.9, 0.1, 0.0))
    apart = [f for f in only(stable, other, with_mode(CABLE, (0.3, 0.2, 0.5))).findings if f.startswith("By theory")]
    assert [f.partition(" is limited by ")[0] for f in apart] == [
        "By theory mujoco_tendons, mujoco_cable",
        "By theory pymunk_springs",
    ]


@pytest.mark.parametrize(
    ("predicted", "measured", "certainty", "safe", "substeps"),
    [
        pytest.param(4e-3, 5e-3, "computed", 4e-3, 5, id="the shorter of both"),
        pytest.param(5e-3, 4e-3, "computed", 4e-3, 5, id="whichever it is"),
        pytest.param(None, 4e-3, "computed", 4e-3, 5, id="the measured one alone"),
        pytest.param(1.0, 1.0, "computed", 1.0, 1, id="a step at least"),
        pytest.param(4e-3, None, "certified", 4e-3, 5, id="the predicted one, where it is certified"),
        pytest.param(4e-3, None, "computed", None, None, id="and not where it is not"),
    ],
)
def test_advice_is_taken_from_the_shorter_limit(
    predicted: float | None, measured: float | None, certainty: str, safe: float | None, substeps: int | None
) -> None:
    """In a frame of 1/60 s there are ceil(1/60 / (0.9 limit)) steps: of 4 ms, 4.6."""
    limits = (
        Limit(predicted, "" if predicted else "none", certainty=certainty),
        Limit(measured, "" if measured else "none"),
    )  # type: ignore[arg-type]
    advice = Advice("one", None, *limits, DONE)
    assert (advice.safe, advice.substeps) == (safe, substeps)


def test_steps_of_a_frame_are_told_from_the_fewest_to_the_most() -> None:
    """With whose they are; once, where all take as many."""
    said = finding(only(STABLE, TOO_LONG, CABLE), "A frame of 1/60 s takes")
    assert said == "A frame of 1/60 s takes 1 (mujoco_cable) to 38 (pymunk_springs) steps, each at 0.9 of the limit."
    alone = finding(only(STABLE, replace(STABLE, engine="another")), "A frame of 1/60 s takes")
    assert alone == "A frame of 1/60 s takes 5 steps, each at 0.9 of the limit."
    assert not [f for f in only(UNMEASURED).findings if "A frame" in f]


def test_how_much_stiffer_springs_could_be_is_told_of_those_that_have_a_bound() -> None:
    """From the least to the most; not of any stiffness, nor of none."""

    def told(*times: float | None) -> list[str]:
        found = [
            replace(with_mode(STABLE, (1.0, 0.0, 0.0), times=factor), engine=f"e{i}") for i, factor in enumerate(times)
        ]
        return [f for f in only(*found).findings if "times as stiff" in f]

    (said,) = told(7.5, 2.25, 3.0)
    start = "With dt = 0.001 s all springs could be"
    assert said == f"{start} 2.25 (e1) to 7.5 (e0) times as stiff, by theory, before that is the limit."
    (one,) = told(2.25, float("inf"), 0.0, None)
    assert one == f"{start} 2.25 times as stiff, by theory, before that is the limit."
    assert told(float("inf"), 0.0, None) == []


def test_the_table_has_what_limits_and_all_there_is_to_say() -> None:
    """Each reason once; what perturbations do beyond the limit in words."""
    mine = with_mode(STABLE, (0.3, 0.2, 0.5), times=2.5)
    noted = replace(
        mine, predicted=Limit(4e-3, note="a note"), measured=Limit(4.4e-3, note="a note", grows_beyond=False)
    )
    odd = replace(CABLE, own=Outcome("diverged", "it blew up"), measured=Limit(0.04, note="another", grows_beyond=None))
    first, second, last = records(only(noted, odd, CANNOT))
    assert first["perturbations at 1.1 of the limit"] == "do not grow"
    assert second["perturbations at 1.1 of the limit"] is None
    assert records(only(STABLE))[0]["perturbations at 1.1 of the limit"] == "grow"
    assert (first["steps for 1/60 s"], second["steps for 1/60 s"], last["steps for 1/60 s"]) == (5, 1, None)
    assert first["limited by"] == limited_by(mine)
    assert second["limited by"] is None
    assert (first["times as stiff at the scene's dt"], second["times as stiff at the scene's dt"]) == (2.5, None)
    assert (first["reason"], second["reason"]) == ("a note", "it blew up; another")


def test_ends_and_limits_without_a_step_are_told() -> None:
    """Too slow, crashed; what to use where only theory has a limit."""
    slow = replace(UNMEASURED, own=Outcome("timed out", "60 s"), advised=1e-3)
    said = finding(only(slow), "exudyn_springs at")
    assert said == (
        "exudyn_springs at dt = 0.001 s takes too long (60 s); no limit was measured (it has its own step); 0.002 s is "
        "predicted: use dt = 0.001 s or less."
    )
    at_the_limit = replace(STABLE, measured=Limit(1e-3, grows_beyond=True))
    assert "is stable, but only just, by 0.0%" in finding(only(at_the_limit), "mujoco_tendons at")
