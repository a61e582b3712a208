"""Limits of engines, measured: on an engine whose every step is known, they are where theory has them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from engines.engine import CAPABILITIES
from engines.measured_limit import (
    ABOVE,
    BELOW,
    ModeRun,
    falls,
    growth_of_engine,
    growths_along_modes,
    growths_of_engine,
    limit_of_engine,
)
from reference.growth_factor import UNRESISTED
from reference.limit import Limit
from reference.measured_stability import PERTURBATION
from reference.outcome import Outcome
from reference.scenes import find
from reference.system import MassSpringSystem
from reference.theory.equilibrium import hanging_string
from tests.conformance.doctored import Doctored, KickDrift

ENGINE = Doctored(KickDrift)

#: A mass on a spring with Cd/m = 5/s, w = 100/s along it, and w^2 = g/L across; at rest, and moved a little along.
DRAG = 5.0
SPRING = find("spring").system({"drag": 0.02 * DRAG})
REST = hanging_string(SPRING).positions
PERTURBED = replace(SPRING, positions=REST + np.array([[0.0, 0.0], [0.0, PERTURBATION * 0.125]]))
SQUARES = (1e4, 9.81 / np.linalg.norm(REST[1]))

#: Kick-drift with explicit drag is stable while dt^2 w^2 + 2 dt Cd/m < 4 [s].
LIMIT = (np.sqrt(DRAG**2 + 4e4) - DRAG) / 1e4


def factor(dt: float) -> float:
    """The growth factor of v' = v - dt (w^2 x + Cd/m v), x' = x + dt v': of the worse of the two motions."""
    steps = [
        np.array([[1 - dt**2 * square, dt * (1 - dt * DRAG)], [-dt * square, 1 - dt * DRAG]]) for square in SQUARES
    ]
    return float(max(np.abs(np.linalg.eigvals(step)).max() for step in steps))


#: Motions that die away faster than that are not looked at.
assert factor(BELOW * LIMIT) < 1 - UNRESISTED


@pytest.mark.rotating(4, in_turn=True)
def test_an_engines_limit_is_where_theory_has_it_and_its_step_is_looked_at_there() -> None:
    """To 1 %: bisection stops within 1e-3, growth is seen from 6e-4 in a step; factors by differences, to 1e-6."""
    limit = limit_of_engine(ENGINE, REST, PERTURBED, 0.01, 1e-3)
    assert isinstance(limit, Limit)
    assert limit.dt == pytest.approx(LIMIT, rel=0.01)
    assert limit.factors is not None
    below, above = limit.factors
    assert below == 1 - UNRESISTED
    assert above == pytest.approx(factor(ABOVE * limit.dt), rel=1e-6)
    assert above > 1.2


@pytest.mark.rotating(4, in_turn=True)
def test_an_engine_that_starts_at_rest_only_is_not_looked_at_there() -> None:
    """It has a limit all the same."""
    resting = Doctored(KickDrift, frozenset(CAPABILITIES) - {"velocities"})
    limit = limit_of_engine(resting, REST, PERTURBED, 0.01, 1e-2)
    assert isinstance(limit, Limit)
    assert limit.dt == pytest.approx(LIMIT, rel=0.02)
    assert limit.factors is None


@pytest.mark.rotating(4, in_turn=True)
def test_beyond_a_limit_perturbations_grow() -> None:
    """At 1.1 of it, by what the run shows."""
    limit = limit_of_engine(ENGINE, REST, PERTURBED, 0.01, 1e-2)
    assert isinstance(limit, Limit)
    assert limit.grows_beyond is True


class StillInLongSteps(KickDrift):
    """Does not move in steps of a second or more: where it is looked at then, nothing grows."""

    def step(self) -> None:
        """Advance by dt."""
        if self.dt < 1:
            super().step()


@pytest.mark.rotating(4, in_turn=True)
def test_growth_beyond_a_limit_is_looked_for_close_to_it() -> None:
    """And not in steps a hundred times as long."""
    limit = limit_of_engine(Doctored(StillInLongSteps), REST, PERTURBED, 0.01, 1e-2)
    assert isinstance(limit, Limit)
    assert limit.grows_beyond is True


def along(dt: float) -> ModeRun:
    """Of x' = x + dt v', v' = v - dt (w^2 x + Cd/m v) along the spring, the eigenvector that is largest."""
    step = np.array([[1 - dt**2 * SQUARES[0], 1 - dt * DRAG], [-(dt**2) * SQUARES[0], 1 - dt * DRAG]])
    values, vectors = np.linalg.eig(step)
    i = int(np.argmax(np.abs(values)))
    left = np.linalg.inv(vectors)[i].conj()
    x, v = PERTURBATION * 0.125 * vectors[:, i].real
    nothing = np.zeros_like(REST)
    positions, velocities = nothing.copy(), nothing.copy()
    positions[1, 1], velocities[1, 1] = x, v / dt
    return ModeRun(dt, positions, velocities, np.array([0.0, left[0], 0.0, left[1]]))


@pytest.mark.parametrize("part", [1 - 1e-4, 1 + 1e-4, 1 + 1e-3])
def test_growth_along_a_mode_is_its_eigenvalues(part: float) -> None:
    """Near the limit the eigenvalue -1 (1 + g): g of 1e-5 in a step is seen, to 2e-7, the perturbation's square."""
    rest = replace(SPRING, positions=REST)
    found = growths_along_modes(ENGINE, rest, [along(part * LIMIT)])
    assert isinstance(found, dict)
    assert found["growth"][0] == pytest.approx(factor_along(part * LIMIT) - 1, abs=2e-7)
    assert (found["growth"][0] > 0) == (part > 1)


def factor_along(dt: float) -> float:
    """The growth factor of the motion along the spring."""
    step = np.array([[1 - dt**2 * SQUARES[0], dt * (1 - dt * DRAG)], [-dt * SQUARES[0], 1 - dt * DRAG]])
    return float(np.abs(np.linalg.eigvals(step)).max())


def test_growth_is_measured_case_by_case() -> None:
    """Below the limit the worse motion dies away by its factor in a step, to a tenth of SEEN; above it grows."""
    cases = [(REST, PERTURBED, part * LIMIT) for part in (0.5, 2.0, 0.5)]
    found = growths_of_engine(ENGINE, cases, 400)
    assert isinstance(found, dict)
    below, above, again = found["growth"]
    assert below == again < 0 < above == np.inf
    assert below == growth_of_engine(ENGINE, REST, PERTURBED, 0.5 * LIMIT, 400)


def test_a_run_ends_once_all_is_lost() -> None:
    """A hundred times as far: what a nonlinear system does after that is another matter, and takes its time."""
    made = []

    class Counting(KickDrift):
        def step(self) -> None:
            made.append(1)
            super().step()

    assert growth_of_engine(Doctored(Counting), REST, PERTURBED, 3 * LIMIT, 1000) == np.inf
    assert len(made) < 10
    made.clear()
    assert growth_of_engine(Doctored(Counting), REST, PERTURBED, 0.5 * LIMIT, 200) < 0
    assert len(made) == 200


def test_what_an_engine_cannot_do_is_an_outcome_with_its_reason() -> None:
    """From whichever is asked."""
    dragless = Doctored(KickDrift, frozenset(CAPABILITIES) - {"drag"})
    outcome = Outcome("unsupported", f"KickDrift cannot do {CAPABILITIES['drag']}")
    assert limit_of_engine(dragless, REST, PERTURBED, 0.01, 1e-2) == outcome
    assert growths_along_modes(dragless, replace(SPRING, positions=REST), [along(LIMIT)]) == outcome
    assert growths_of_engine(dragless, [(REST, PERTURBED, 0.01)], 10) == outcome


@pytest.mark.parametrize(
    ("stiffness", "gravity", "fallen"),
    [
        ((200.0, 200.0, 200.0), (0.0, -9.81), False),
        ((200.0, 0.0, 200.0), (0.0, -9.81), True),
        ((200.0, 0.0, 200.0), (3.0, 0.0), True),
        ((200.0, 0.0, 200.0), (0.0, 0.0), False),
    ],
)
def test_what_springs_do_not_hold_falls(stiffness: tuple[float, ...], gravity: tuple[float, ...], fallen: bool) -> None:
    """A string whose second spring has no stiffness, numbered from either end, where there is weight along any axis."""
    string = find("string").system({"masses": 3, "stiffness": 1.0})
    for springs in (string.springs, string.springs[::-1, ::-1].copy()):
        stiff = np.array(stiffness if springs is string.springs else stiffness[::-1])
        assert falls(replace(string, springs=springs, stiffness=stiff, gravity=np.array(gravity))) is fallen


def test_what_falls_grows_as_what_does_not() -> None:
    """Of two masses in free fall the swing about the fall is looked at: by Galileo it is the one without gravity.

    Along their spring at half and at 1.2 of the limit 2/w, to 1e-6 of 1 in a step; and so of any perturbation.
    """
    pair = MassSpringSystem(
        positions=np.array([[0.0, 0.0], [0.0, 0.5]]),
        springs=np.array([[0, 1]]),
        masses=np.array([0.02, 0.02]),
        rest_lengths=np.array(0.5),
        stiffness=np.array(100.0),
        gravity=np.array([0.0, -9.81]),
    )
    floating, moves = replace(pair, gravity=np.zeros(2)), PERTURBATION * np.array([[0.0, -1.0], [0.0, 1.0]])
    assert (falls(pair), falls(floating)) == (True, False)
    for part in (0.5, 1.2):
        dt, square = part * 2 / 100.0, 4 * part**2
        values, vectors = np.linalg.eig(np.array([[1 - square, 1.0], [-square, 1.0]]).T)
        x, v = vectors[:, np.argmax(np.abs(values))].conj()
        left = np.array([0.0, -x, 0.0, x, 0.0, -v, 0.0, v])
        run = ModeRun(dt, moves, np.zeros((2, 2)), left)
        found = [growths_along_modes(ENGINE, system, [run]) for system in (pair, floating)]
        assert isinstance(found[0], dict)
        assert isinstance(found[1], dict)
        assert found[0]["growth"] == pytest.approx(found[1]["growth"], abs=1e-6)
        moved = [replace(system, positions=pair.positions + moves) for system in (pair, floating)]
        falling, still = (growth_of_engine(ENGINE, pair.positions, system, dt, 100) for system in moved)
        assert falling == pytest.approx(still, abs=1e-6)
        assert (falling > 0) == (part > 1)
