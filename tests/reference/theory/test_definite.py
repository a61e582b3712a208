"""Which schemes are stable at any dt term by term, and which are not; where matrices stop being definite."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.sparse import csc_array, diags_array
from scipy.sparse.linalg import ArpackNoConvergence

from reference.errors import SolverError
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.state import Array
from reference.theory import definite as module
from reference.theory.definite import DENSE_UP_TO, Definiteness, first_negative, lowest_eigenvector, smallest_root
from reference.theory.equilibria import spring_equilibrium
from reference.theory.linearisation import Linearisation


def of_string(scheme: str, damping: float) -> Definiteness:
    """S(h) of a scheme on the hanging string."""
    system = find_scene("string").system({"masses": 4, "damping": damping, "drag": 0.1})
    return Definiteness(find(scheme), Linearisation(system, spring_equilibrium(system).state), 0.01)


@pytest.mark.parametrize("damping", [0.0, 0.5])
@pytest.mark.parametrize(
    ("scheme", "stable"), [("backward_euler", True), ("implicit_midpoint", True), ("kick_drift", False)]
)
def test_who_is_stable_at_any_dt_by_theory_has_no_negative_term(scheme: str, stable: bool, damping: float) -> None:
    """And S itself is not negative, however long the step; kick-drift's is, beyond 2/w."""
    definite = of_string(scheme, damping)
    assert definite.never_negative == stable
    least = min(np.linalg.eigvalsh(np.asarray(definite.matrix(dt))).min() for dt in (1e-3, 1.0, 1e3))
    assert (least >= -1e-6) == stable


@pytest.mark.parametrize(
    ("coefficients", "beyond", "root"),
    [
        ((3.0, -4.0, 1.0), 0.0, 1.0),
        ((3.0, -4.0, 1.0), 1.0, 3.0),
        ((3.0, -4.0, 1.0), 2.0, 3.0),
        ((3.0, -4.0, 1.0), 3.0, np.inf),
        ((-6.0, 4.0, 2.0), 0.0, 1.0),
        ((-6.0, 4.0, 2.0), -4.0, -3.0),
        ((5.0, 2.0, 1.0), -9.0, np.inf),
        ((-6.0, 2.0, 0.0), 0.0, 3.0),
        ((-6.0, 2.0, 0.0), 3.0, np.inf),
        ((-6.0, 0.0, 0.0), 0.0, np.inf),
        ((0.0, 0.0, 2.0), -1.0, 0.0),
        ((1.0, -1e9, 1.0), 0.0, 1e-9),
        ((1.0, -1e9, 1.0), 1.0, 1e9),
    ],
)
def test_the_smallest_root_beyond_a_number(
    coefficients: tuple[float, float, float], beyond: float, root: float
) -> None:
    """Of quadratics, of lines and of what is constant; of roots far apart, neither is lost by cancellation."""
    assert smallest_root(*coefficients, beyond) == pytest.approx(root, rel=1e-14)


def turned(values: Array) -> Array:
    """A symmetric matrix with these eigenvalues, in no direction of an axis."""
    vectors, _ = np.linalg.qr(np.random.default_rng(4).normal(size=(len(values), len(values))))
    return np.asarray((vectors * values) @ vectors.T)


def chain(size: int, stiffness: float) -> tuple[Callable[[float], Any], Callable[[Array], tuple[float, float, float]]]:
    """S(x) = 4 - x^2 K of a chain held at both ends, sparse, and its coefficients in a direction."""
    springs = [np.full(size - 1, -stiffness), np.full(size, 2 * stiffness), np.full(size - 1, -stiffness)]
    k = csc_array(diags_array(springs, offsets=(-1, 0, 1)))
    return lambda x: csc_array(diags_array(np.full(size, 4.0)) - x**2 * k), lambda q: (4 * q @ q, 0.0, -q @ (k @ q))


@pytest.mark.parametrize("size", [5, DENSE_UP_TO + 50])
@pytest.mark.parametrize("unit", [1e-3, 0.05, 0.4])
def test_a_chain_stops_being_definite_at_two_over_its_highest_frequency(size: int, unit: float) -> None:
    """4 - x^2 w^2 = 0 with w^2 = 4 k sin^2(n pi / (2 n + 2)): of arrays and of large sparse matrices, to 3e-9."""
    matrix, quadratic = chain(size, 9.0)
    limit = 1 / (3 * np.sin(size * np.pi / (2 * size + 2)))
    for start in (0.0, 0.5 * limit):
        assert first_negative(matrix, quadratic, start, unit) == pytest.approx(limit, rel=3e-9)


def test_where_the_search_starts_beyond_or_there_is_no_end() -> None:
    """At the start itself where it is negative from there on; infinite of what stays positive."""
    square, line = turned(np.array([1.0, 2.0, 3.0])), turned(np.array([0.5, 1.0, 2.0]))
    matrix, quadratic = (lambda x: 4 * np.eye(3) - x * square), (lambda q: (4 * q @ q, -q @ (square @ q), 0.0))
    assert first_negative(matrix, quadratic, 0.0, 0.1) == pytest.approx(4 / 3, rel=1e-9)
    assert first_negative(matrix, quadratic, 4 / 3, 0.1) == pytest.approx(4 / 3, rel=1e-9)
    assert first_negative(lambda x: np.eye(3) + x * line, lambda q: (q @ q, q @ (line @ q), 0.0), 0.0, 0.1) == np.inf


@pytest.mark.parametrize(("guess", "start"), [(2.1, 1.0), (2.1, 1.99), (1.9, 1.0), (2.0001, 1.0)])
def test_an_end_that_is_guessed_is_found_from_either_side(guess: float, start: float) -> None:
    """Of the entries 3 and 2 - x: by widening what is looked at, but not below the start."""
    assert module._certified(lambda x: np.diag([3.0, 2.0 - x]), guess, start) == pytest.approx(2.0, rel=1e-8)
    assert module._certified(lambda x: np.diag([3.0, 2.0 - x]), guess, 2.05) == 2.05


def test_the_lowest_eigenvector_of_large_matrices_is_that_of_small_ones(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of a chain; and where the iteration has come to no end, whatever it has, or the start of it."""
    matrix, _ = chain(DENSE_UP_TO + 1, 1.0)
    found, exact = lowest_eigenvector(matrix(1.0)), np.linalg.eigh(matrix(1.0).toarray())[1][:, 0]
    assert abs(found @ exact) > 0.9
    kept = np.eye(DENSE_UP_TO + 1)[:, :1]

    def gives_up(*_: Any, **more: Any) -> None:
        raise ArpackNoConvergence("", values, vectors)

    monkeypatch.setattr("scipy.sparse.linalg.eigsh", gives_up)
    values, vectors = np.array([-0.5]), kept
    assert lowest_eigenvector(matrix(1.0)).tolist() == kept[:, 0].tolist()
    values, vectors = np.zeros(0), np.zeros((DENSE_UP_TO + 1, 0))
    assert lowest_eigenvector(matrix(1.0)).shape == (DENSE_UP_TO + 1,)


class TurnsRound(Definiteness):
    """Damping is negative from 0.02 s on; above 0.5 s the step's equations are not solved."""

    in_proportion = False  # type: ignore[assignment]

    def has_negative_damping(self, dt: float) -> bool:
        """From 0.02 s on."""
        if dt > 0.5:
            raise SolverError("not solved")
        return dt > 0.02


@pytest.mark.parametrize(("last", "expected"), [(0.4, 0.02), (1e3, 0.02), (0.019, np.inf), (0.021, 0.02)])
def test_negative_damping_begins_where_it_does(last: float, expected: float) -> None:
    """Looked for from short steps on, up to where it is asked for, or steps are not solved."""
    of = of_string("kick_drift", 0.5)
    found = TurnsRound(of.scheme, of.linear, of.unit).negative_damping_from(last)
    assert found == pytest.approx(expected, rel=1e-8)
    assert of.negative_damping_from(last) == np.inf


def of_unequal(scheme: str, damping: float) -> Definiteness:
    """S(h) of a scheme on a string of 30, 20 and 50 g with a drag of 0.1 N s/m, of which one spring is damped."""
    words = {"masses": 3, "mass": [0.03, 0.02, 0.05], "drag": 0.1, "damping": [0.0, damping, 0.0]}
    system = find_scene("string").system(words)
    return Definiteness(find(scheme), Linearisation(system, system.start), 0.01)


def test_drag_that_turns_velocities_round_is_negative_from_the_lightest_mass_on() -> None:
    """1 - h Cd/m of 20 g is negative beyond 0.2 s; what is explicit, implicit or exponential never is."""
    turns = of_unequal("kick_drift_drag_afterwards", 0.0)
    assert [turns.has_negative_damping(dt) for dt in (0.1, 0.199, 0.201, 0.29, 0.31, 0.6)] == [False] * 2 + [True] * 4
    assert turns.negative_damping_from(1.0) == pytest.approx(0.2, rel=1e-8)
    for name in ("kick_drift", "kick_drift_exponential_drag", "backward_euler", "drift_kick_exponential_damping"):
        assert not any(of_unequal(name, 0.2).has_negative_damping(dt) for dt in (0.1, 0.21, 1.0)), name


@pytest.mark.parametrize(
    ("scheme", "grow", "part"),
    [
        ("kick_drift", (False, False), -1.0),
        ("backward_euler", (False, False), 1.0),
        ("implicit_midpoint", (False, False), 0.0),
        ("kick_drift_exponential_drag", (False, True), -1.0),
        ("drift_kick_exponential_damping", (True, False), -1.0),
    ],
)
def test_whose_damping_grows_faster_than_dt(scheme: str, grow: tuple[bool, bool], part: float) -> None:
    """Of springs, of drag; only one spring of three is damped, and without it springs' damping does not grow."""
    found = of_unequal(scheme, 0.2)
    assert (found.springs_grow, found.drag_grows) == grow
    assert found.in_proportion == (grow == (False, False))
    assert found.stiffness_part == pytest.approx(part, abs=1e-9)
    assert found.decides
    assert found.never_negative == (scheme in ("backward_euler", "implicit_midpoint"))
    assert not of_unequal(scheme, 0.0).springs_grow


def test_the_damping_of_many_steps_is_that_of_each() -> None:
    """4 Q - 2 E of every spring and mass; and the matrices that it makes, as arrays and sparse ones."""
    for scheme in ("drift_kick_exponential_damping", "kick_drift_exponential_drag"):
        found = of_unequal(scheme, 0.2)
        steps = np.array([0.01, 0.03, 0.1])
        for dt, part in zip(steps.tolist(), found.damping_parts(steps), strict=True):
            for one, other in zip(part, found.damping_part(dt), strict=True):
                assert one == pytest.approx(other, rel=1e-9, abs=1e-15)
            dense = found.matrix(dt)
            assert found.matrix(dt, part) == pytest.approx(dense, rel=1e-9)
            with pytest.MonkeyPatch.context() as patch:
                patch.setattr(module, "DENSE_UP_TO", 1)
                assert found.matrix(dt).toarray() == pytest.approx(dense, rel=1e-9, abs=1e-9)
                assert found.damping_matrix(dt).toarray() == pytest.approx(
                    of_unequal(scheme, 0.2).damping_matrix(dt).toarray()
                )
            assert found.damping_matrix(dt) == pytest.approx(found.damping_matrix(dt).T)
