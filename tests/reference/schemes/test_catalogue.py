"""The catalogue: what is said of a scheme where it is defined is what is known of it."""

from __future__ import annotations

from dataclasses import fields, replace
from math import inf
from typing import Any

import numpy as np
import pytest

from reference.errors import InputError
from reference.forces import SpringMotion
from reference.motion import Motion
from reference.scenes import find as find_scene
from reference.schemes import catalogue
from reference.schemes.catalogue import Scheme, constraint_schemes, find, scheme, schemes, wide_schemes
from reference.state import State
from reference.theory.differences import differences
from reference.theory.equilibria import spring_equilibrium
from reference.theory.layout import layout_of
from reference.theory.step_map import _by_linear_motion
from tests.reference.systems import label, moving_string


def entered(**said: Any) -> Scheme:
    """What the catalogue has of a step of which something is said; on trial."""
    with catalogue._SCHEMES.as_it_is():

        @scheme(**{"order": 1, **said})
        def on_trial(motion: Motion, state: State, dt: float) -> State:
            """Go nowhere, for the time being."""
            return state

        return find("on_trial")


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("order", 4),
        ("kind", "in_place"),
        ("implicit", True),
        ("linear", False),
        ("one_step", False),
        ("iterated", True),
        ("interactive_up_to", 7),
        ("aliases", ("trying",)),
    ],
)
def test_each_thing_said_of_a_scheme_is_kept_as_that(name: str, value: Any) -> None:
    """And nothing else is another for it; what is not said is as `Scheme` has it."""
    plain, found = entered(), entered(**{name: value})
    differing = [
        f.name for f in fields(Scheme) if f.name != "step" and getattr(plain, f.name) != getattr(found, f.name)
    ]
    assert differing == [name]
    assert getattr(found, name) == value
    assert all(getattr(plain, f.name) == f.default for f in fields(Scheme) if f.name not in ("step", "order"))


def test_a_trial_leaves_nothing() -> None:
    """The name is free again."""
    entered(aliases=("trying",))
    assert "on_trial" not in schemes()
    with pytest.raises(InputError, match="unknown scheme 'trying'"):
        find("trying")


@pytest.mark.parametrize(("alias", "name"), [("semi_implicit_euler", "kick_drift"), ("symplectic_euler", "kick_drift")])
def test_a_scheme_is_found_by_its_other_names(alias: str, name: str) -> None:
    """And is the same."""
    assert find(alias) is find(name)


#: Each so large that an explicit step of 1 ms multiplies what it acts on by 300: c dt/m, Cd dt/m, k dt^2/m.
STIFF = {"damping": 6e3, "drag": 6e3, "stiffness": 6e6}

#: They take of a velocity, or of each spring's rate, what decays in a step, by an exponential: that is bounded too, and
#: solves nothing.
BOUNDED_ALL_THE_SAME = ("drift_kick_sequential_damping", "kick_drift_exponential_drag")


#: Every scheme there is.
ALL = [*schemes().values(), *wide_schemes().values(), *constraint_schemes().values()]


@pytest.mark.parametrize("known", ALL, ids=label)
def test_a_scheme_is_implicit_if_something_stiff_does_not_throw_it_far(known: Scheme) -> None:
    """Explicit, v1 = (1 - 300) v0 or v0 - 300 x0/dt; implicit, |v1| <= v0 + 2 x0/dt = 21 m/s of what is solved for.

    On a spring without gravity, x0 = 1 cm longer than at rest, at v0 = 1 m/s; 2 x0/dt is the midpoint rule's.
    """
    reached = []
    for name, value in STIFF.items():
        system = find_scene("spring").system({"stretch": 0.01, "velocity": 1.0, "gravity": 0.0, name: value})
        end = known.on(SpringMotion(system))(system.start, 1e-3)
        reached.append(float(np.abs(end.velocities).max()))
    assert (min(reached) < 25.0) == (known.implicit or known.name in BOUNDED_ALL_THE_SAME), reached


@pytest.mark.parametrize("known", ALL, ids=label)
def test_a_scheme_is_linear_if_it_steps_all_perturbations_at_once(known: Scheme) -> None:
    """Given as columns, linearised about a string at rest: then it has the step map that differences of steps have.

    Others refuse so many at once. Three unequal masses in the plane, damped and dragged; differences to 1e-6 of 1.
    """
    system = find_scene("string").system({"masses": 3, "damping": 0.3, "drag": 0.02})
    rest = spring_equilibrium(replace(system, masses=np.array([1.0, 0.02, 0.03, 0.01])))
    try:
        at_once = _by_linear_motion(known, rest, 1e-3)
    except (ValueError, IndexError):
        assert not known.linear
        return
    differenced = differences(known.on(rest.motion), *layout_of(known, rest, 1e-3))
    assert (np.abs(at_once - differenced).max() < 1e-6) == known.linear


@pytest.mark.parametrize("known", ALL, ids=label)
def test_a_scheme_is_of_one_step_if_it_steps_alike_without_its_past(known: Scheme) -> None:
    """The second step from what the first remembers, and from its positions and velocities alone, to the bit."""
    system = moving_string(3, damping=0.3, drag=0.02)
    advance = known.on(SpringMotion(system))
    first = advance(system.start, 1e-3)
    after, without = advance(first, 1e-3), advance(replace(first, memory=()), 1e-3)
    assert np.array_equal(after.velocities, without.velocities) == known.one_step
    assert bool(first.memory) != known.one_step


def test_solvers_of_constraints_come_to_no_end_and_others_do() -> None:
    """They stop after so many sweeps; of the others those do that solve for damping as an engine does."""
    assert {each.name for each in ALL if each.iterated} == {
        *constraint_schemes(),
        "drift_kick_sequential_damping",
        "kick_drift_truncated_damping",
    }


def test_a_parameter_that_is_none_is_refused_by_name() -> None:
    """With what was meant, where the scheme has any; else with that it has none."""
    with pytest.raises(InputError, match=r"unknown parameter of scheme .* 'round': did you mean 'rounds'"):
        find("drift_kick_sequential_damping").with_parameters(round=3)
    with pytest.raises(InputError, match=r"^scheme 'heun' has no parameters: rounds was given$"):
        find("heun").with_parameters(rounds=3)


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("hht(alpha=7)", "from -0.333333 to 0"),
        ("hht(alpha=nan)", "from -0.333333 to 0"),
        ("hht(alpha=0.1)", "from -0.333333 to 0"),
        ("generalised_alpha(radius=1.1)", "from 0 to 1"),
        ("newmark(beta=-0.1)", "from 0 to 1"),
        ("newmark(gamma=inf)", "from 0 to 1.5"),
        ("xpbd_jacobi(iterations=0)", "1 or more"),
        ("soft_constraints_cold(sweeps_after=-1)", "0 or more"),
    ],
)
def test_a_parameter_out_of_its_range_is_refused(name: str, expected: str) -> None:
    """In a line with the parameter, its value and what it may be."""
    scheme, parameter = name.rstrip(")").split("(")
    with pytest.raises(InputError, match=f"^{parameter.partition('=')[0]} = .* of scheme '{scheme}': .* {expected}$"):
        find(name)


@pytest.mark.parametrize(
    ("asks", "hint"),
    [
        ("jacobians", "annotate its first parameter with MotionOfSprings"),
        ("acceleration_of", "annotate its first parameter with MotionByMass"),
        ("temperature", "it is given acceleration, slope"),
    ],
)
def test_what_a_scheme_asks_for_beyond_its_needs_is_refused_with_the_way(asks: str, hint: str) -> None:
    """By which annotation it would be given that; or what it is given, where there is none."""

    def curious(motion: Motion, state: State, dt: float) -> State:
        """Ask for what a type checker would not let it."""
        getattr(motion, asks)
        return state

    system = find_scene("string").system({"masses": 1})
    expected = f"scheme 'curious' asks for motion.{asks}, but says it needs accelerations: {hint}"
    with pytest.raises(InputError, match=f"^{expected}$"):
        Scheme(curious, 1).on(SpringMotion(system))(system.start, 1e-3)


def test_what_is_expected_of_a_parameter_is_said_by_its_kind() -> None:
    """A count with a last value, one without, a number without bounds: each is refused in its own words."""
    with catalogue._SCHEMES.as_it_is():

        @scheme(order=1, ranges={"few": (2, 3)})
        def on_trial(motion: Motion, state: State, dt: float, *, few: int = 2, many: int = 9, a: float = 0.5) -> State:
            """Go nowhere, for the time being."""
            return state

        trial = find("on_trial")
    assert trial.with_parameters(few=3, many=1, a=-1e300).name == "on_trial(a=-1e+300, few=3, many=1)"
    for name, value, expected in (
        ("few", 4, "a number from 2 to 3"),
        ("many", 0, "1 or more"),
        ("a", inf, "a finite number"),
    ):
        with pytest.raises(InputError, match=f"^{name} = {value} of scheme 'on_trial': expected {expected}$"):
            trial.with_parameters(**{name: value})


def test_a_parameter_may_be_the_ends_of_its_range() -> None:
    """These are methods, too: the most damping, and none."""
    assert find(f"hht(alpha={-1 / 3})").parameters["alpha"] == -1 / 3
    assert find("generalised_alpha(radius=1.0)").parameters["radius"] == 1
    assert find("soft_constraints_cold(sweeps_after=0)").parameters["sweeps_after"] == 0


def test_every_number_without_a_default_range_has_one() -> None:
    """Counts are 1 or more; what a scheme takes beside them says from where to where."""
    for each in (*schemes().values(), *wide_schemes().values(), *constraint_schemes().values()):
        numbers = {name for name, value in each.parameters.items() if isinstance(value, float)}
        assert numbers <= dict(each.ranges).keys() <= each.parameters.keys(), each.name
