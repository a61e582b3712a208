"""Forces seen from outside, as they jump where a mass flies past its spring's other end; and tableaux from them."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import numpy as np
import pytest

from engines.engine import find as find_engine
from engines.engine import version
from engines.own.stepper import stepper_of
from engines.process.isolation import EngineStepper, in_this_process
from reference.derivation.explanation import explain
from reference.derivation.force_jumps import Taken, forces_taken
from reference.derivation.of_schemes import tableau_of_scheme
from reference.derivation.oscillators import runs_of
from reference.derivation.seen import forces_of
from reference.derivation.stages import tableau_by_jumps
from reference.derivation.step_matrix import step_matrix
from reference.derivation.tableau import Tableau
from reference.errors import Unsupported
from reference.motion import Motion
from reference.schemes.catalogue import Scheme, find
from reference.state import State
from reference.stepper import SchemeStepper, Stepper, stepper_named
from report.derived import force_lines

HALF = Fraction(1, 2)


def seen(stepper: Stepper) -> Tableau | None:
    """Its tableau, from its steps alone."""
    runs = runs_of(stepper)
    return tableau_by_jumps(forces_taken(runs), step_matrix(runs))


@pytest.mark.parametrize(
    "name",
    ["euler", "heun", "explicit_midpoint", "ralston", "rk3", "ssprk3", "bogacki_shampine", "rk4", "rk4_three_eighths"],
)
def test_tableaux_are_seen_from_outside(name: str) -> None:
    """The same fractions as of the slopes that the scheme asks for, also of those that do the same on a line."""
    known = tableau_of_scheme(find(name))
    found = seen(stepper_named(name))
    assert known is not None
    assert found is not None
    order = sorted(range(known.stages), key=lambda i: known.c[i])  # stages come in the order of c, at one c as they did
    if order == list(range(known.stages)):
        assert found.same(known)
    assert (sorted(found.b), sorted(found.c), found.order) == (sorted(known.b), sorted(known.c), known.order)


@pytest.mark.parametrize(
    ("name", "taken"),
    [
        ("kick_drift", [(0, 1, 1)]),
        ("drift_kick", [(1, 1, 0)]),
        ("velocity_verlet", [(0, HALF, HALF), (1, HALF, 0)]),
        ("leapfrog_drift_kick_drift", [(HALF, 1, HALF)]),
    ],
)
def test_leapfrogs_take_forces_where_they_say_and_have_no_tableau(name: str, taken: list[tuple[Fraction, ...]]) -> None:
    """As x' = x + h v + h^2 sum beta F/m, v' = v + h sum b F/m; on a line Verlet is Heun, but for what F1 adds to x."""
    stepper = stepper_named(name)
    found = forces_taken(runs_of(stepper))
    assert [(f.at, f.in_velocity, f.in_position) for f in found] == taken
    assert seen(stepper) is None


def test_a_wrong_weight_is_seen() -> None:
    """Of an own step with forces of its own: 1/3 and 2/3, where Heun has halves."""

    def step(x, v, dt, system):  # type: ignore[no-untyped-def]
        (m, k), rest = (system.masses[1::2, None], system.stiffness[:, None]), system.rest_lengths[:, None]

        def slope(x, v):  # type: ignore[no-untyped-def]
            a = 0 * x
            along = x[1::2] - x[::2]
            length = np.linalg.norm(along, axis=1)[:, None]
            a[1::2] = -k * (length - rest) * along / length / m
            return v, a

        p, q = slope(x, v)
        r, s = slope(x + dt * p, v + dt * q)
        return x + dt * (p + 2 * r) / 3, v + dt * (q + 2 * s) / 3

    (start, end) = forces_taken(runs_of(stepper_of(step)))
    assert (start.in_velocity, end.in_velocity, end.at) == (Fraction(1, 3), Fraction(2, 3), 1)


@pytest.mark.rotating(4)
@pytest.mark.parametrize("name", ["mujoco_tendons_rk4", "exudyn_springs"])
def test_the_stages_of_an_engines_rk4_are_seen(name: str) -> None:
    """Both at the middle, too; its tableau is the classic one, and not that of the 3/8 rule."""
    engine = find_engine(name)
    if version(engine) is None:
        pytest.skip(f"{engine.package} is not installed")
    found = explain(EngineStepper(engine, isolate=in_this_process))
    known, other = tableau_of_scheme(find("rk4")), tableau_of_scheme(find("rk4_three_eighths"))
    assert known is not None
    assert other is not None
    assert found.tableau is not None
    assert found.tableau.same(known)
    assert not found.tableau.same(other)
    assert found.order == 4
    assert len(found.seen.taken) == 4
    assert force_lines(found)[1] == "v' = v + h (F1/6 + F2/3 + F3/3 + F4/6)/m"


def test_what_cannot_be_seen_is_said() -> None:
    """Yoshida's method takes a force behind where it began."""
    with pytest.raises(Unsupported, match="beyond c ="):
        forces_taken(runs_of(stepper_named("yoshida_4")))
    assert Taken(HALF, Fraction(1), 0.25).text() == {"at": "1/2", "in_velocity": "1", "in_position": "0.25"}


def in_stages(rows: Sequence[Sequence[float]], weights: Sequence[float]) -> SchemeStepper:
    """A Runge-Kutta method with these rows of a below its first stage."""

    def step(motion: Motion, state: State, dt: float) -> State:
        slopes = [motion.slope(state)]
        for row in rows:
            at = state
            for c, slope in zip(row, slopes, strict=True):
                at = at + c * dt * slope
            slopes.append(motion.slope(at))
        for c, slope in zip(weights, slopes, strict=True):
            state = state + c * dt * slope
        return state

    return SchemeStepper(Scheme(step, 1))


FIFTHS = [0.1, 0.2, 0.3, 0.2, 0.2]


def test_five_stages_are_seen_from_outside() -> None:
    """Every coefficient of a made-up method, no two alike in their places."""
    found = seen(in_stages([[0.25], [0.125, 0.375], [0.2, 0.2, 0.35], [0.1, 0.2, 0.3, 0.4]], FIFTHS))
    assert found is not None
    text = found.text()
    assert text["a"][1:] == [
        ["1/4", "0", "0", "0", "0"],
        ["1/8", "3/8", "0", "0", "0"],
        ["1/5", "1/5", "7/20", "0", "0"],
        ["1/10", "1/5", "3/10", "2/5", "0"],
    ]
    assert text["b"] == ["1/10", "1/5", "3/10", "1/5", "1/5"]


def test_five_stages_of_other_numbers_have_none() -> None:
    """No simple fraction near them gives their betas and their step matrix."""
    assert seen(in_stages([[0.25], [0.125, 0.375], [0.2, 0.2, 0.35], [0.1, 0.2171, 0.2829, 0.4]], FIFTHS)) is None


def test_more_forces_than_can_be_told_apart_are_counted() -> None:
    """Six stages: where they take forces is told, and that there is no tableau."""
    six = in_stages([[0.2], [0, 0.4], [0, 0, 0.6], [0, 0, 0, 0.8], [0, 0, 0, 0, 1.0]], [0.1, 0.2, 0.2, 0.2, 0.2, 0.1])
    reasons: list[str] = []
    found = forces_of(runs_of(six), step_matrix(runs_of(six)), reasons)
    assert (len(found.taken), found.tableau) == (6, None)
    assert reasons == ["no tableau: 6 forces are taken in a step, and from outside 5 at most tell one"]
