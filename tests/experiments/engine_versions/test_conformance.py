"""What is told of a version of an engine, row by row: from answers made by hand, and no engine."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, cast

import pytest

from engines.process.isolation import EngineStepper
from experiments.engine_versions import conformance
from experiments.engine_versions.conformance import SINGLE, capability, identified, measure
from reference.identification import TOLERANCE, Identification, Match
from reference.limit import Limit
from reference.outcome import Outcome
from tests.conformance.doctored import Doctored

CRASHED = Outcome("crashed", "killed by SIGSEGV")


def stepper(outcome: Outcome | None = None, **fields: Any) -> Any:
    """One whose runs all end so."""
    asked: list[Any] = []

    def run(system: object, dt: float, steps: int) -> Outcome:
        asked.append((system, dt, steps))
        return outcome or Outcome("done")

    claims = {"plain": "heun", "damping": "euler", "drag": "rk4"}
    parts = {"name": "mine", "precision": "double", "claims": (), "engine": Doctored(), "identified_as": claims}
    return SimpleNamespace(run=run, asked=asked, **{**parts, **fields})


@pytest.mark.parametrize(("precision", "limits"), [("double", 3), ("single", 0)])
def test_each_version_has_its_rows(precision: str, limits: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Named in three cases; limits in three, but in single precision, where rounding hides them; what it can do."""
    monkeypatch.setattr(conformance, "_identity", lambda stepper, case: f"is {case}")
    monkeypatch.setattr(conformance, "_limit", lambda stepper, case: f"limit {case}")
    monkeypatch.setattr(conformance, "capability", lambda stepper, name: f"can {name}")
    rows = measure(stepper(precision=precision))
    assert rows["runs"] == "yes"
    assert [key for key in rows if key.startswith("identified, ")] == [
        f"identified, {case}" for case in ("plain", "damping", "drag")
    ]
    assert rows["identified, drag"] == "is drag"
    assert len([key for key in rows if key.startswith("largest stable dt [s], ")]) == limits
    can = [key for key in rows if key.startswith("can: ")]
    assert "can: 3d" in can
    assert "can: 2d" not in can
    assert len(rows) == 1 + 3 + limits + len(can)


def test_one_that_does_not_run_has_that_row_alone() -> None:
    """After a single step."""
    made = stepper(CRASHED)
    assert measure(made) == {"runs": "crashed: killed by SIGSEGV"}
    ((_, _, steps),) = made.asked
    assert steps == 1


@pytest.mark.parametrize(
    ("found", "said"),
    [
        (CRASHED, "crashed: killed by SIGSEGV"),
        (Identification("mine", (Match("heun", 1e-15), Match("rk4", 1e-3)), 1e-12), "heun"),
        (
            Identification("mine", (Match("rk4", 0.0123), Match("heun", 1.0)), 1e-12, "far"),
            "none; nearest rk4 at 1e-02 m",
        ),
    ],
)
def test_it_is_told_what_it_is(found: Any, said: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Or how far the nearest is, or how it ended."""
    monkeypatch.setattr(conformance, "identified", lambda stepper, case: found)
    assert conformance._identity(stepper(), "plain") == said


def test_what_leaves_no_trajectory_is_not_compared() -> None:
    """In either precision; in single a step is looked at first."""
    assert identified(stepper(CRASHED), "plain") == CRASHED
    single = stepper(CRASHED, precision="single")
    assert identified(single, "plain") == CRASHED
    assert [steps for _, _, steps in single.asked] == [1]


@pytest.mark.parametrize(
    ("limit", "value"),
    [
        (Limit(0.0123456789), 0.01234568),
        (Limit(None, "unstable at any dt"), "unstable at any dt"),
        (Outcome("timed out", "60 s"), "timed out: 60 s"),
    ],
)
def test_a_limit_is_a_number_in_seven_figures_or_why_there_is_none(
    limit: Any, value: object, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Measured at random, to a millionth, beginning at what the fastest mode lasts."""
    asked: list[Any] = []

    def measured(*given: Any) -> Any:
        asked.append(given)
        return limit

    monkeypatch.setattr(conformance, "measure_at_random", measured)
    assert conformance._limit(stepper(), "drag 0.1") == value
    ((_, system, rest, dt, precision),) = asked
    assert system.drag == 0.1
    assert precision == 1e-6
    assert dt == pytest.approx(1 / conformance.fastest_rate(rest))


@pytest.mark.parametrize(
    ("case", "claim"),
    [("3d", "heun"), ("damping", "euler"), ("drag", "rk4")],
)
def test_a_system_is_held_against_the_claim_of_its_kind(case: str, claim: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """By damping and by drag, if it has them; to rounding, or not so near in single precision."""
    tolerances: list[float] = []

    def found(name: str, outcome: object, system: object, known: Any, tolerance: float) -> Identification:
        tolerances.append(tolerance)
        (claimed,) = known
        return Identification(name, (Match(claimed, 1e-13),), 1e-12)

    monkeypatch.setattr(conformance, "identify_run", found)
    monkeypatch.setattr(conformance, "_claimed", lambda scheme, case: None)
    monkeypatch.setattr(conformance, "demands", lambda system: set())
    asked: list[str] = []

    class Claims(dict[str, str]):
        def __getitem__(self, what: str) -> str:
            asked.append(what)
            return super().__getitem__(what)

    claims = Claims(plain="heun", damping="euler", drag="rk4")
    assert capability(stepper(identified_as=claims), case) == "kept"
    assert [dict.__getitem__(claims, what) for what in asked] == [claim]
    for single, tolerance in ((claim, SINGLE), (f"{claim}(single=True)", TOLERANCE)):
        named = dict.fromkeys(claims, single)
        assert capability(stepper(identified_as=named, precision="single"), case) == "kept"
        assert tolerances[-1] == tolerance
    assert tolerances[0] == TOLERANCE


def test_what_is_refused_or_broken_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """Refused with its reason; stepped though it is not among what it can; stepped by another scheme."""
    refused = Outcome("unsupported", "mine cannot do meshes")
    assert capability(stepper(refused), "3d") == "refused: mine cannot do meshes"
    monkeypatch.setattr(conformance, "demands", lambda system: {"flying"})
    assert capability(stepper(), "3d") == "broken: it is not among its capabilities, yet not refused"
    monkeypatch.setattr(conformance, "demands", lambda system: set())
    other = Identification("mine", (Match("heun", 1.0),), 1e-12, "far")
    monkeypatch.setattr(conformance, "identify_run", lambda *_: other)
    monkeypatch.setattr(conformance, "_claimed", lambda scheme, case: None)
    assert capability(stepper(), "3d") == f"broken: {other}"


@pytest.mark.parametrize(("capabilities", "scene"), [({"2d", "1d"}, "string"), ({"1d"}, "chain")])
def test_who_cannot_do_the_plane_hangs(capabilities: set[str], scene: str) -> None:
    """A chain from a point, in place of the string that swings."""
    made = cast(EngineStepper, SimpleNamespace(engine=SimpleNamespace(capabilities=capabilities)))
    assert conformance._scene_for(made) == scene
