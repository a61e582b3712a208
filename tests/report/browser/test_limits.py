"""The page's predicted limits against the theory room's, and runs of the page's own code on either side of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import springlab

from reference.errors import SolverError
from reference.forces import SpringMotion
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.springs.kinds import NonlinearSprings
from reference.system import MassSpringSystem
from reference.theory.equilibria import Equilibrium, equilibrium_on_obstacles, spring_equilibrium
from reference.theory.limits import stability_limit
from report.browser.presets import PRESETS
from report.browser.programs import page_schemes
from report.browser.system_data import rest_data, system_data
from tests.reference.systems import two_on_a_floor
from tests.report.browser.node import ask

#: A short string that comes to rest on a circle.
BARRIER = {"masses": 4, "circle_x": 0.2, "circle_y": -0.2, "radius": 0.15}

#: Schemes whose limit beside strong drag is far from its decay, or next to it.
STRONGLY_DRAGGED = (
    "kick_drift_drag_afterwards",
    "kick_drift",
    "kick_drift_implicit_drag",
    "kick_drift_implicit_damping_and_drag",
    "kick_drift_exponential_drag",
)

#: Scenes with parameters, and the schemes that theory answers for in a moment.
CASES: list[tuple[str, dict[str, Any], tuple[str, ...]]] = [
    ("spring", {}, tuple(page_schemes())),
    ("string", {"drag": 0.1, "masses": 4}, tuple(page_schemes())),
    ("string", {"damping": 0.1, "masses": 4}, tuple(page_schemes())),
    ("chain", {}, ("kick_drift", "rk4")),
    ("chain", {"masses": 3, "damping": 1e-3}, tuple(page_schemes())),
    (
        "chain",
        {"masses": 2, "mass": [1.1, 0.0063], "drag": 0.848},
        ("kick_drift_exponential_drag", "kick_drift", "rk4"),
    ),
    (
        "chain",
        {"masses": 3, "mass": [0.0716, 6.93, 3.63], "damping": 3.57},
        ("drift_kick_sequential_damping", "kick_drift"),
    ),
    ("chain", {"masses": 4, "mass": [0.00366, 14.4, 0.765, 12.3], "drag": 0.558}, tuple(page_schemes())),
    ("oscillator", {"drag": 10.0}, STRONGLY_DRAGGED),
    ("oscillator", {"drag": 40.0}, STRONGLY_DRAGGED),
    ("chain", {"masses": 1, "mass": [1e-8], "stiffness": 1.0, "drag": 0.5}, STRONGLY_DRAGGED[1:]),
    ("chain", {"masses": 1, "mass": [0.1], "stiffness": 50.0, "damping": 1e4}, ("kick_drift_implicit_damping",)),
    ("slinky", {"masses": 8, "damping": 0.5}, ("kick_drift", "rk4", "backward_euler")),
    ("string", {"tension_only": 1, "damping": 0.05, "masses": 4}, ("heun", "kick_drift", "rk4")),
    ("string", {"hardening": 2e3, "masses": 4}, ("heun", "kick_drift", "velocity_verlet", "rk4")),
    ("string", {"largest_force": 20.0, "breaking_stretch": 0.2}, ("kick_drift", "rk4")),
    ("cloth", {"rows": 5, "columns": 5}, ("heun", "kick_drift", "velocity_verlet", "rk4")),
    ("strip", {}, ("euler", "kick_drift", "rk4")),
    ("bridge", {}, ("kick_drift", "velocity_verlet", "rk4")),
    ("drop", {"across": 2, "high": 2, "deep": 2}, ("kick_drift",)),
    ("barrier", BARRIER, ("euler", "heun", "kick_drift")),
    ("barrier", BARRIER | {"tension_only": 1}, ("euler", "kick_drift", "rk4")),
    ("barrier", BARRIER | {"hardening": 2e5}, ("euler", "heun", "rk4")),
]

#: With `--full`, the scenes as the page shows them.
FULL: list[tuple[str, dict[str, Any], tuple[str, ...]]] = [
    (name, {}, ("kick_drift", "rk4"))
    for name in ("oscillator", "cloth", "jello", "flag", "falling_cloth", "tablecloth", "soil")
]
FULL += [("drop", {}, ("kick_drift", "rk4", "euler")), ("barrier", {}, ("heun", "kick_drift", "rk4"))]

#: By their definition, of whatever is at rest.
STABLE_AT_ANY_DT = ("backward_euler", "implicit_midpoint", "newmark", "hht", "generalised_alpha", "bdf2")

#: Scenes and schemes that are pushed past their limits every time; with `--full`, all of the page.
PUSHED = ("spring", "oscillator", "string", "strip")
PUSHED_SCHEMES = ("kick_drift", "velocity_verlet", "rk4", "bdf2")

#: What is asked of the page's limits, as a part of them; and where surfaces curve, which both theory and the page
#: difference, each with perturbations of its own.
AGREEMENT, DIFFERENCED = 1e-6, 1e-5


def at_rest(system: MassSpringSystem) -> Equilibrium:
    """As `springlab stability` looks at it."""
    return equilibrium_on_obstacles(system)[0] if system.obstacles else spring_equilibrium(system)


def asked_of_page(system: MassSpringSystem, **more: Any) -> Mapping[str, Any]:
    """A question about a system at rest."""
    return {"system": system_data(system), **rest_data(system), **more}


def agrees(found: Mapping[str, Any], scheme: str, rest: Equilibrium) -> bool:
    """Whether the page's limit of a scheme is theory's; of the same kind, where there is none.

    And about the same rest: without obstacles, where theory has none on them.
    """
    try:
        predicted, alone = stability_limit(find(scheme), rest), False
    except SolverError:
        assert isinstance(rest.stepped, SpringMotion)  # with the springs' own law, and not their tangents on obstacles
        rest = spring_equilibrium(replace(rest.stepped.system, obstacles=()))
        predicted, alone = stability_limit(find(scheme), rest), True
    if found.get("alone", False) != alone:
        return False
    if predicted.dt is None:
        return found["limit"] == 0 if predicted.growth is not None else found["limit"] is None
    curved = rest.contacts is not None and not rest.contacts.flat(rest.system)
    most = DIFFERENCED if curved else AGREEMENT
    return found["limit"] is not None and abs(found["limit"] / predicted.dt - 1) < most


def test_where_damping_takes_less_than_rounding_no_limit_is_told() -> None:
    """In-place Euler on a chain all but undamped: there is a limit of 1.2e-9 s, which doubles about 1 do not show.

    It is not said to be unstable at any dt; without damping it is.
    """
    for damping, expected in ((1e-6, (None, "slow")), (0.0, (0, None))):
        system = find_scene("chain").system({"masses": 3, "damping": damping})
        (answer,) = ask([asked_of_page(system, ask="limits", schemes=["euler_in_place"])])
        told = answer["limits"]["euler_in_place"]
        assert (told["limit"], told.get("reason")) == expected


def test_a_runge_kutta_limit_that_hangs_on_damping_below_rounding_is_not_told() -> None:
    """Heun's and Euler's are as its third root, and as itself; RK4's is its own."""
    system = find_scene("chain").system({"masses": 3, "damping": 1e-9})
    (answer,) = ask([asked_of_page(system, ask="limits", schemes=["euler", "heun", "rk4"])])
    told = {name: (found["limit"], found.get("reason")) for name, found in answer["limits"].items()}
    assert told["euler"] == told["heun"] == (None, "slow")
    assert agrees(answer["limits"]["rk4"], "rk4", at_rest(system))


@pytest.mark.rotating(3)
def test_limits_are_those_of_the_theory_room(request: pytest.FixtureRequest) -> None:
    """All modes of the rest, by the page's own equilibrium, eigenvalues and traced steps: to 1e-6."""
    cases = CASES + (FULL if request.config.getoption("--full") else [])
    systems = [find_scene(name).system(settings) for name, settings, _ in cases]
    questions = [
        asked_of_page(system, ask="limits", schemes=list(schemes))
        for system, (_, _, schemes) in zip(systems, cases, strict=True)
    ]
    for answer, system, (name, settings, schemes) in zip(ask(questions), systems, cases, strict=True):
        rest = at_rest(system)
        for scheme in schemes:
            assert agrees(answer["limits"][scheme], scheme, rest), (name, settings, scheme, answer["limits"][scheme])


@pytest.mark.rotating(3, in_turn=True)
def test_implicit_schemes_are_stable_where_explicit_ones_are_not() -> None:
    """Predicted stable at any dt, and seen to be at ten times what kick-drift stands, which blows up.

    Of A-stable methods no mode that decays or swings grows (Hairer and Wanner, *Solving ODEs II* (1996), IV.3).
    """
    system = find_scene("string").system({"masses": 4, "damping": 0.1})
    names = STABLE_AT_ANY_DT
    (answer,) = ask([asked_of_page(system, ask="limits", schemes=[*names, "kick_drift"])])
    assert [answer["limits"][name]["limit"] for name in names] == [None] * len(names)  # JSON's infinity
    dt, size = 10 * answer["limits"]["kick_drift"]["limit"], 1e-6
    question = asked_of_page(system, ask="at", schemes=[*names, "kick_drift"], dt=dt, steps=200, size=size)
    (grown,) = ask([question])
    assert max(grown[:-1]) < 10 < 1e3 < grown[-1], dict(zip(names, grown, strict=False))


@pytest.mark.rotating(5)
@pytest.mark.parametrize("damping", [0.0, 1e-9, 1e-5, 1e-3, 0.1])
def test_weak_damping_on_a_floor_is_no_growth(damping: float) -> None:
    """Two masses on a floor 1 cm below: as theory has it, which differences too; Heun's is hidden, or there is none."""
    names, system = ("rk4", "velocity_verlet", "kick_drift", "heun"), two_on_a_floor(damping)
    (answer,) = ask([asked_of_page(system, ask="limits", schemes=[*names])])
    for name in names:
        found, predicted = answer["limits"][name], stability_limit(find(name), spring_equilibrium(system))
        if predicted.dt is None:
            assert (name, found["limit"]) == ("heun", 0 if predicted.growth is not None else None)
            assert found["reason"] == ("" if predicted.growth is not None else "slow")
        else:
            assert found["limit"] == pytest.approx(predicted.dt, rel=1e-6), name


def test_what_the_page_cannot_tell_it_says() -> None:
    """What steps in place do to what nothing holds is lost in rounding; strong damping leaves some equations unsolved.

    Others have limits: kick-drift, of a spring that c = 1e4 N s/m damps between a held mass and m = 0.1 kg, 2 m / c.
    """
    triangle = {"positions": [[0.0, 0.0], [0.3, 0.0], [0.1, 0.3]], "springs": [[0, 1], [1, 2], [0, 2]]}
    for drag in (0.0, 0.1):
        free = springlab.system(**triangle, masses=[0.1, 0.2, 0.3], stiffness=50.0, damping=1.1, drag=drag)
        schemes = ["euler_in_place", "heun_link_by_link", "rk4"]
        in_place, link_by_link, rk4 = ask([asked_of_page(free, ask="limits", schemes=schemes)])[0]["limits"].values()
        for told in (in_place, link_by_link):
            assert (told["limit"], told["reason"]) == (None, "unheld")
        assert rk4["limit"] == pytest.approx(stability_limit(find("rk4"), spring_equilibrium(free)).dt, rel=1e-6)
    strong = find_scene("string").system({"masses": 3, "mass": 0.1, "stiffness": 50.0, "damping": 1e4})
    damping = {"damping": np.array([1e4, 1e-6, 0.5])[: len(strong.springs)]}
    names = ["drift_kick_exponential_damping", "kick_drift"]
    limits = ask([asked_of_page(replace(strong, **damping), ask="limits", schemes=names)])[0]["limits"]
    assert (limits[names[0]]["limit"], limits[names[0]]["reason"]) == (None, "unsolved")
    assert limits["kick_drift"]["limit"] == pytest.approx(2e-5, rel=1e-3)


def test_where_a_law_has_a_corner_there_is_no_limit() -> None:
    """Springs stretched by half that yield below that: their force stays as it is, and no linear one does that."""
    system = find_scene("string").system({"masses": 4})
    yielding = replace(system, nonlinear=NonlinearSprings(largest_force=np.array([0.1])))
    rest = {"rest": (1.5 * system.positions).ravel().tolist(), "contacts": []}
    question = {"system": system_data(yielding), **rest, "ask": "corner"}
    assert ask([question, {**question, "system": system_data(system)}]) == [True, False]


def test_a_limit_off_by_a_hundred_thousandth_is_seen() -> None:
    """Shown to fail, as is a limit where there is none."""
    system = find_scene("spring").system({})
    assert agrees({"limit": 0.02}, "kick_drift", at_rest(system))
    assert not agrees({"limit": 0.02 * (1 + 1e-5)}, "kick_drift", at_rest(system))
    assert not agrees({"limit": 0.02}, "euler", at_rest(system))


def test_the_rest_is_found_anew_when_parameters_change() -> None:
    """A string of half the stiffness hangs lower: every mass by what its springs carry over k (slide 4)."""
    system = find_scene("string").system({})
    settings = {"stiffness": 100.0, "gravity": 3.7}
    (answer,) = ask([asked_of_page(system, ask="limits", schemes=["kick_drift"], set=settings)])
    changed = find_scene("string").system(settings)
    expected = spring_equilibrium(changed).state.positions
    # Newton's method ends where forces are 1e-11 of the weight: 1e-11 of a sag of 5 cm
    assert np.abs(np.reshape(answer["rest"], (-1, 2)) - expected).max() < 1e-10
    assert agrees(answer["limits"]["kick_drift"], "kick_drift", at_rest(changed))


@pytest.mark.rotating(3, in_turn=True)
def test_runs_grow_beyond_the_limit_and_stay_below_it(request: pytest.FixtureRequest) -> None:
    """A perturbation of 1e-6 of a spring's length at rest grows over 1.02 times the limit, and not under 0.98 times it.

    Over it a run is three times as long as theory needs for a growth by 1e5, a thousandfold is asked for, as a part
    of the perturbation is in the mode that grows; below it, within a hundredfold: a mode of a step that is not
    symmetric may rise a little at first. Where that takes more steps than `most`, as with Euler on a string with a
    little drag, whose growth at 1.02 times the limit is 0.01 (dt w)^2 = 1e-8 a step, there is nothing to be seen.
    What is predicted stable at any dt does not grow at twenty times the limit of kick-drift. The slinky is left out:
    nothing holds it, its springs are as short as they can be, and so it rests where all its masses are in one place.
    """
    full = request.config.getoption("--full")
    presets = [preset for preset in PRESETS if (full or preset.stem in PUSHED) and preset.scene != "slinky"]
    schemes = [scheme for scheme in page_schemes() if full or scheme in PUSHED_SCHEMES]
    for preset in presets:
        system = alone(preset.setup.system)
        size = 1e-6 * float(np.median(system.rest_lengths)) or 1e-6 * system.size
        (answer,) = ask([asked_of_page(system, ask="grown", schemes=schemes, size=size, most=20_000, long=60)])
        seen = {scheme: (below, beyond) for scheme, below, beyond in answer}
        assert seen.keys() >= {scheme for scheme in PUSHED_SCHEMES if scheme in schemes}, preset.stem
        for scheme, (below, beyond) in seen.items():
            assert below < 100, (preset.stem, scheme, below)
            assert (beyond is None) == (scheme in STABLE_AT_ANY_DT), (preset.stem, scheme)
            assert beyond is None or beyond > 1000, (preset.stem, scheme, beyond)


def alone(system: MassSpringSystem) -> MassSpringSystem:
    """Without obstacles, and in the frame that falls with what nothing holds: there it can be at rest."""
    gravity = system.gravity if system.fixed.any() else 0 * system.gravity
    return replace(system, obstacles=(), gravity=gravity)
