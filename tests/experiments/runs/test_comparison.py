"""What a comparison says of its runs, from answers made by hand: errors, names, ties, and why there is none."""

from __future__ import annotations

from collections.abc import Sequence
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from experiments.runs import comparison
from experiments.runs.comparison import Comparison, Run, finite, remarks, told, too_slow, why
from reference.changes import Change
from reference.identification import Identification, Match
from reference.outcome import Outcome
from reference.scenes import Setup, find
from reference.state import Trajectory
from reference.system import MassSpringSystem
from tests.experiments.canned.steppers import Named

SETUP = Setup("string", find("string").system({"masses": 3}), 1e-3, 0.0025)


def found(*names: str, stepper: str = "mine", **fields: Any) -> Identification:
    """A stepper that does what these schemes do, to 1e-15 m, and not what RK4 does."""
    ranking = (*(Match(name, 1e-15) for name in names), Match("rk4", 1e-3))
    return Identification(stepper, ranking, 1e-12, **({"reason": ""} if names else {"reason": "none is near"}) | fields)


def run(ending: str = "done", reason: str = "", error: Any = None, **fields: Any) -> Run:
    """One that ended so."""
    return Run(Named("mine"), Outcome(ending, reason), fields.pop("found", found("heun")), error, None, **fields)  # type: ignore[arg-type]


def test_a_run_has_its_largest_error_where_it_has_an_end() -> None:
    """In metres; none of a run that did not, or where the true motion is not known; infinity is no number."""
    errors = np.array([0.0, 3e-3, 1e-3])
    assert run(error=errors).largest_error == 3e-3
    assert run("diverged", "it blew up", errors).largest_error is None
    assert run().largest_error is None
    row = run(error=errors).row
    assert row["error_m"] == 3e-3
    assert [row[key] for key in ("stepper", "kind", "version", "outcome", "reason")] == [
        "mine",
        "engine",
        "1.0",
        "done",
        "",
    ]
    assert run(error=np.array([0.0, np.inf])).row["error_m"] is None
    assert [finite(value) for value in (0.0, -2.5, np.inf, -np.inf, np.nan, None)] == [
        0.0,
        -2.5,
        None,
        None,
        None,
        None,
    ]


def test_an_identification_is_told_with_its_ties_or_why_there_is_none() -> None:
    """And by what it was compared, if anything was."""
    assert told(found("heun", "midpoint", told_apart_by="a push")) == {
        "identified_as": "heun",
        "identification_error_m": 1e-15,
        "ties": ["midpoint"],
        "told_apart_by": "a push",
        "compared_by": "trajectories",
        "why_not_identified": "",
    }
    nothing = told(Identification("mine", (), 1e-12, "it crashed", compared="single steps"))
    assert (nothing["compared_by"], nothing["identification_error_m"]) == ("", None)
    assert nothing["why_not_identified"] == "it crashed"


@pytest.mark.parametrize(
    ("reason", "no_name", "wanted"),
    [
        ("", "", ""),
        ("it blew up", "", "it blew up"),
        ("", "none is near", "not identified; none is near"),
        ("it crashed", "it crashed", "it crashed"),
        ("it blew up", "none is near", "it blew up; not identified; none is near"),
    ],
)
def test_why_is_said_once(reason: str, no_name: str, wanted: str) -> None:
    """How it ended, and why it has no name, where that is something else."""
    assert why(Outcome("done", reason), Identification("mine", (), 1e-12, no_name)) == wanted


def test_remarks_are_said_once_of_all_whom_they_are_about() -> None:
    """Ties by scheme; how schemes were told apart, and what was compared, of all or of whom."""
    tied = found("heun", "midpoint")
    runs = [
        run(found=tied),
        run(found=found("heun", "midpoint", stepper="other")),
        run(found=found("euler", stepper="e")),
    ]
    assert remarks(runs) == ["heun: on this scene it cannot be told from midpoint."]
    pushed = [run(found=found("heun", stepper=name, told_apart_by="a push")) for name in ("a", "b")]
    assert remarks(pushed) == ["Told apart by a push: all."]
    assert remarks([*pushed, run(found=found("rk4", stepper="c"))]) == ["Told apart by a push: a, b."]
    stepwise = found("euler", stepper="d", compared="single steps")
    nameless = found(stepper="n", compared="single steps")
    assert remarks([run(found=stepwise), run(found=nameless)]) == [
        "Named by single steps, each from a state of its own: d."
    ]


class Interactive(Named):
    """An engine that says of itself up to how many masses it is quick."""

    interactive_up_to = 4


def test_a_stepper_is_left_out_of_scenes_that_are_larger_than_it_says() -> None:
    """Which has as many masses as it takes and one more; one that says nothing is never left out."""
    four, five = (find("string").system({"masses": n}) for n in (3, 4))
    assert too_slow(Interactive("slow"), four) is None
    assert too_slow(Named("quick"), five) is None
    left_out = too_slow(Interactive("slow"), five)
    assert left_out is not None
    assert left_out.ending == "unsupported"
    assert left_out.reason == ("left out: with more than 4 masses it takes long, here are 5; --stepper slow runs it")


def test_the_document_has_what_was_asked_and_why_there_is_no_true_motion() -> None:
    """Times are those of all steps, three of them, the last one beyond what was asked."""
    made = Comparison(SETUP, None, (run(),), "it collides")
    document = made.document
    assert [document[key] for key in ("scene", "dt_s", "duration_s", "steps", "why_no_true_motion")] == [
        "string",
        1e-3,
        0.0025,
        SETUP.steps,
        "it collides",
    ]
    assert document["run_duration_s"] == pytest.approx(SETUP.steps * 1e-3)
    assert made.times == pytest.approx(1e-3 * np.arange(SETUP.steps + 1))
    assert document["runs"] == [run().row]


class Runs(Interactive):
    """One that is told what it did, and remembers that it was asked."""

    def __init__(self, name: str, outcome: Outcome) -> None:
        super().__init__(name)
        object.__setattr__(self, "outcome", outcome)
        object.__setattr__(self, "asked", [])

    def run(self, system: MassSpringSystem, dt: float, steps: int, changes: Sequence[Change] = ()) -> Outcome:
        """See Stepper."""
        self.asked.append((dt, steps))  # type: ignore[attr-defined]
        return self.outcome  # type: ignore[attr-defined,no-any-return]


def at(height: float) -> Trajectory:
    """All masses are so high [m] at both times."""
    positions = np.full((2, 4, 2), [0.0, height])
    return Trajectory(np.array([0.0, 1e-3]), positions, np.zeros_like(positions))


@pytest.mark.parametrize("patient", [True, False])
def test_runs_are_compared_with_the_true_motion_and_with_their_schemes(
    patient: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where there are both; who takes long is asked by the patient only, and room is looked for for those who run."""
    setup = Setup("string", find("string").system({"masses": 3}), 1e-3, 1e-3)
    steppers = [
        Runs("named", Outcome("done", "", at(3.0))),
        Runs("stranger", Outcome("done", "", at(5.0))),
        Runs("lost", Outcome("crashed", "killed")),
        Runs("slow", Outcome("done", "", at(7.0))),
    ]
    for stepper in steppers[:3]:
        object.__setattr__(stepper, "interactive_up_to", 4)
    object.__setattr__(steppers[3], "interactive_up_to", 3)
    room: list[list[str]] = []
    names = [found("heun"), found(), found(), found("rk4")]
    known = SimpleNamespace(each=names, known={"heun": at(1.0)})
    monkeypatch.setattr(comparison, "check_room", lambda kept, *_, beside: room.append([s.name for s in kept]))
    monkeypatch.setattr(comparison, "true_motion", lambda *_: (at(2.0), "why not"))
    monkeypatch.setattr(comparison, "identify_all", lambda *_: known)
    made = comparison.compare(setup, steppers, patient=patient)  # type: ignore[arg-type]
    assert room == [["named", "stranger", "lost", "slow"] if patient else ["named", "stranger", "lost"]]
    assert [bool(s.asked) for s in steppers] == [True, True, True, patient]  # type: ignore[attr-defined]
    assert steppers[0].asked == [(1e-3, 1)]  # type: ignore[attr-defined]
    errors = [None if one.error is None else one.error.max() for one in made.runs]
    assert errors == [1.0, 3.0, None, 5.0 if patient else None]
    deviations = [None if one.deviation is None else one.deviation.max() for one in made.runs]
    assert deviations == [2.0, None, None, None]
    assert made.runs[3].outcome.ending == ("done" if patient else "unsupported")
    monkeypatch.setattr(comparison, "true_motion", lambda *_: (None, "why not"))
    known.each = names[:1]
    without = comparison.compare(setup, steppers[:1])  # type: ignore[arg-type]
    assert (without.runs[0].error, without.why_no_true_motion) == (None, "why not")
    assert without.runs[0].deviation is not None
