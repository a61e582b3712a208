"""A user's own scene: what it is made of, in its rows, and its motion with the dt that is said."""

from __future__ import annotations

import numpy as np
import pytest

from experiments.advice import own_scene
from experiments.advice.own_scene import made_of
from experiments.experiment import Result
from reference.changes import Change
from reference.scenes import Setup, find
from tests.experiments.canned import advice, divergence
from tests.experiments.canned.advice import STABLE, TOO_LONG
from tests.experiments.canned.reading import numbers, records

SYSTEM = find("string").system({"masses": 2, "stiffness": 300.0, "damping": 0.2, "drag": 0.05, "mass": 0.03})


def made(**changed: object) -> Result:
    """Of a small string."""
    return made_of(Setup(**{"name": "mine", "system": SYSTEM, "dt": 1e-3, "duration": 0.01, "changes": (), **changed}))  # type: ignore[arg-type]


def test_rows_have_the_parameters_and_their_units() -> None:
    """Each in its own."""
    rows = {row["what"]: (row["value"], row["unit"]) for row in records(made())}
    assert (rows["masses"], rows["of them fixed"], rows["springs"]) == ((3, ""), (1, ""), (2, ""))
    assert (rows["stiffness"], rows["damping along springs"]) == (("300", "N/m"), ("0.2", "N s/m"))
    assert (rows["mass of one"], rows["drag on every mass"]) == (("0.03", "kg"), ("0.05", "N s/m"))
    assert (rows["dt"], rows["duration"]) == (("0.001", "s"), ("0.01", "s"))
    assert rows["gravity"] == ("0, -9.81", "m/s^2")


def test_unequal_parameters_are_ranges_from_the_least() -> None:
    """And changes have their first and last time."""
    unequal = SYSTEM.with_parameter("stiffness", np.array([500.0, 100.0]))
    changes = tuple(Change(t, "drag", 0.1) for t in (0.003, 0.001))
    rows = {row["what"]: row["value"] for row in records(made(system=unequal, changes=changes))}
    assert rows["stiffness"] == "100 to 500"
    assert numbers(rows["drag changes"]) == [2, 0.001, 0.003]


def test_the_sentence_has_counts_and_the_dt_it_is_shown_with() -> None:
    """Its own; a quarter of that, and so on, where it blows up."""
    assert numbers(made().findings[0]) == [3, 2, 0.01, 1e-3]
    stiff = SYSTEM.with_parameter("stiffness", 3e5)
    dt = numbers(made(system=stiff, duration=0.1).findings[0])[-1]
    assert dt == pytest.approx(1e-3 / 4)


@pytest.mark.parametrize(("own", "dt"), [((STABLE, TOO_LONG), 1e-3), ((TOO_LONG,), 0.45e-3)])
def test_engines_are_compared_with_the_scenes_dt_or_with_the_shortest_advised(
    own: tuple[object, ...], dt: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where none survives its own; and the sentence says which."""
    asked: list[Setup] = []

    def compared(setup: Setup, *_: object) -> object:
        asked.append(setup)
        return divergence.usual().data["comparison"]

    monkeypatch.setattr(own_scene, "compare", compared)
    longer = advice.advised("longer", None, None, 0.9e-3, advice.DIVERGED, 0.8e-3)
    result = own_scene.moved(advice.SETUP, advice.only(*own, longer), lambda _: None)  # type: ignore[arg-type]
    assert asked[0].dt == dt
    assert numbers(result.findings[0])[0] == dt
    assert ("as none comes to its end" in result.findings[0]) == (dt != advice.SETUP.dt)
