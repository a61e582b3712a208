"""Parameters that change on the fly change an engine's motion as they change its scheme's (lecture slide 12)."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from engines.engine import CAPABILITIES, Engine, find
from reference.changes import Change
from reference.outcome import Outcome
from reference.scenes import find as find_scene
from reference.system import PARAMETERS
from tests.conformance.checks import check_change, outcomes
from tests.conformance.strings import Case

#: By parameter, two changes: at 0.05 s and at 0.1 s.
VALUES = {
    "mass": (0.03, 0.015),
    "rest_length": (0.13, 0.12),
    "stiffness": (120.0, 300.0),
    "damping": (0.3, 0.0),
    "drag": (0.05, 0.0),
    "gravity": (1.62, 24.8),
}

CASES = {
    **{
        name: Case(name, find_scene("string").system({}), 1e-3, 200, [Change(0.05, name, a), Change(0.1, name, b)])
        for name, (a, b) in VALUES.items()
    },
    "several at once": Case(
        "several at once",
        find_scene("string").system({"damping": 0.05, "drag": 0.02}),
        1e-3,
        200,
        [Change(0.05, "mass", 0.03), Change(0.05, "gravity", 1.62), Change(0.1, "drag", 0.05)],
    ),
}


def of_each(name: str, step: int) -> tuple[float, ...]:
    """A value for each mass, spring or axis, another at every step; masses and springs all differ."""
    if name == "gravity":
        return 3.0 * np.sin(0.1 * step), -9.81 + 2.0 * np.cos(0.13 * step)
    least, most = sorted(VALUES[name])
    count = 11 if name == "mass" else 10
    return tuple(least + (most - least) * (0.5 + 0.4 * np.sin(0.05 * step + np.arange(count))))


def case_of_each(name: str) -> Case:
    """The string with a parameter that is another for each, and at every step."""
    changes = [Change(1e-3 * step, name, of_each(name, step)) for step in range(200)]
    return Case(f"{name} of each", find_scene("string").system({}), 1e-3, 200, changes)


EACH = [name for name in VALUES if name != "drag"]
CASES |= {f"{name} of each": case_of_each(name) for name in EACH}


def driven(scene: str) -> Case:
    """The beginning of a scene that something drives."""
    setup = find_scene(scene).setup({"panels": 4}, 1e-3, 0.2)
    return Case(scene, setup.system, setup.dt, 200, setup.changes)


CASES |= {scene: driven(scene) for scene in ("crossing", "earthquake")}

#: What a change of each asks for, of capabilities.
ASKED = {
    "mass": ("masses",),
    "rest_length": ("rest_lengths",),
    "stiffness": ("stiffnesses",),
    "damping": ("damping", "dampings"),
    "gravity": ("tilted gravity",),
}


@cache
def runs(engine: str) -> dict[str, Outcome]:
    """How all cases end for an engine."""
    return dict(zip(CASES, outcomes(find(engine), list(CASES.values())), strict=True))


@pytest.mark.parametrize("case", CASES)
def test_a_change_acts_as_in_the_scheme_or_is_refused_by_name(engine: Engine, case: str) -> None:
    """The distance max |x_engine - x_scheme| <= 1e-12 of the size, both with the same changes at the same steps."""
    check_change(engine, CASES[case], runs(engine.name)[case])


@pytest.mark.parametrize("name", EACH)
def test_what_differs_on_the_fly_is_refused_just_where_a_capability_is_lacking(engine: Engine, name: str) -> None:
    """Where one is, its words are the reason. Else it may be refused for what it is by itself: rods do not stretch."""
    outcome = runs(engine.name)[f"{name} of each"]
    lacking = [asked for asked in ASKED[name] if asked not in engine.capabilities]
    assert any(CAPABILITIES[asked] in outcome.reason for asked in ASKED[name]) == bool(lacking), outcome.reason
    assert outcome.ending in (("unsupported",) if lacking else ("done", "diverged", "unsupported"))


def test_every_parameter_is_changed() -> None:
    """No parameter of the reference is left out here."""
    assert set(VALUES) == set(PARAMETERS)


def test_every_change_is_felt() -> None:
    """With every change the scheme's trajectory moves by more than a micrometre: to ignore one would show."""
    from tests.conformance.checks import expected

    plain = expected("kick_drift", Case("plain", CASES["mass"].system, 1e-3, 200)).trajectory
    assert plain is not None
    for name in (*VALUES, *(f"{name} of each" for name in EACH)):
        changed = expected("kick_drift", CASES[name]).trajectory
        assert changed is not None
        assert changed.distance(plain).max() > 1e-6
