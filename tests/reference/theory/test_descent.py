"""The way down to a rest, part by part: what forces are small against, how far steps lead, and where they end."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from reference.errors import SolverError
from reference.springs.angular import AngularSprings
from reference.state import Array
from reference.system import MassSpringSystem
from reference.theory.least_energy import Descent, force_tolerance, least_energy, stiffness_across


def made(positions: list[list[float]], springs: list[list[int]], **fields: Any) -> MassSpringSystem:
    """Masses of 2 kg of which the first is fixed, on springs of 100 N/m that rest at 1 m, without gravity."""
    plain: dict[str, Any] = {
        "masses": np.array(2.0),
        "rest_lengths": np.array(1.0),
        "stiffness": np.array(100.0),
        "gravity": np.zeros(2),
        "fixed": np.arange(len(positions)) == 0,
    }
    springs_ = np.array(springs, dtype=int).reshape(-1, 2)
    return MassSpringSystem(positions=np.array(positions), springs=springs_, **{**plain, **fields})


def descent(system: MassSpringSystem) -> Descent:
    """Downhill with all masses' own weights."""
    return Descent(system, system.masses[:, None] * system.gravity)


#: Two angular springs with arms of 1 and 2 m, and of 2 and 4 m.
BENDS = AngularSprings(np.array([[0, 1, 2], [1, 2, 3]]), np.array([3.0, 5.0]))
CORNERS = [[0.0, 0.0], [1.0, 0.0], [1.0, 2.0], [5.0, 2.0]]


def test_how_much_angular_springs_resist_across_an_arm() -> None:
    """4 kappa over the shorter arm squared, of whichever resists more: 12 and 5 N/m."""
    assert stiffness_across(made(CORNERS, [[0, 1]])) == 0.0
    assert stiffness_across(made(CORNERS, [[0, 1]], angular_springs=BENDS)) == pytest.approx(12.0, rel=1e-12)


def test_what_may_be_left_of_a_force() -> None:
    """A billionth of the weight; of the stiffest spring or bend what rounding of the farthest place leaves, 8 times."""
    springs, k = [[0, 1], [1, 2]], np.array([2.0, 3.0])
    rounding = 8 * np.finfo(float).eps * (5.0 + 5.0)
    for bends, stiffest in ((None, 3.0), (BENDS, 12.0)):
        system = made(CORNERS, springs, stiffness=k, angular_springs=bends)
        assert force_tolerance(system, 0.0) == pytest.approx(rounding * stiffest, rel=1e-12)
        assert force_tolerance(system, 50.0) == pytest.approx(5e-8 + rounding * stiffest, rel=1e-12)


@pytest.mark.parametrize(
    ("fields", "weight"),
    [
        # 1 m/s^2 to one side and 10 down on two of 2 kg; the springs are at rest
        ({"gravity": np.array([1.0, -10.0])}, 44.0),
        # no weight: the first spring is 0.5 m too long and pulls on one free mass, the second is 1 m, and pulls on two
        ({"rest_lengths": np.array([0.5, 1.0])}, 50.0 + 2 * 100.0),
        # the same, damped and in motion: what dampers do is no tension
        (
            {
                "rest_lengths": np.array([0.5, 1.0]),
                "damping": np.array(7.0),
                "velocities": np.array([[0.0, 0.0], [3.0, 4.0], [5.0, 6.0]]),
            },
            50.0 + 2 * 100.0,
        ),
        # nothing pulls: a millionth of what the springs' stiffness is worth
        ({}, 1e-6 * 200.0),
        # or the bends', by the shortest spring of 1 m
        (
            {"angular_springs": AngularSprings(np.array([[0, 1, 2]]), np.array(250.0))},
            1e-6 * 1000.0,
        ),
        ({"stiffness": np.zeros(2)}, 1.0),
    ],
    ids=["weight", "tension", "moving", "springs", "bends", "nothing"],
)
def test_what_forces_are_small_against(fields: dict[str, Any], weight: float) -> None:
    """The larger of what is carried and what the start pulls with; where there is neither, a part of what could."""
    system = made([[0.0, 0.0], [1.0, 0.0], [1.0, 2.0]], [[0, 1], [1, 2]], **{"rest_lengths": [1.0, 2.0], **fields})
    assert descent(system).weight == pytest.approx(weight, rel=1e-12)


def test_a_spring_in_compression_gives_way_across_itself_unless_that_is_left_out() -> None:
    """Along it k; across it k (1 - L0 / L): -25 N/m of one of 0.8 m, 20 N/m of one of 1.25 m."""
    for length, across, left in ((0.8, -25.0, 0.0), (1.25, 20.0, 20.0)):
        down = descent(made([[0.0, 0.0], [0.0, -length]], [[0, 1]]))
        q = np.array([0.0, -length])
        assert down.stiffness(q).toarray() == pytest.approx(np.diag([across, 100.0]), abs=1e-12)
        assert down.stiffness(q, tension_only=True).toarray() == pytest.approx(np.diag([left, 100.0]), abs=1e-12)


def test_no_step_leads_farther_than_it_may() -> None:
    """A mass that hangs on a spring, from 0.5 m above its rest: in steps of 1 cm, the first of them as long as that."""

    class Short(Descent):
        """Downhill in short steps; where it has looked."""

        longest = 0.01

        def energy(self, q: Array) -> float:
            """As ever."""
            seen.append(q)
            return super().energy(q)

    seen: list[Array] = []
    system = made([[0.0, 0.0], [0.0, -1.5]], [[0, 1]], gravity=np.array([0.0, -100.0]))
    down = Short(system, system.masses[:, None] * system.gravity)
    assert down.newton(down.downhill(np.array([0.0, -2.5]))) == pytest.approx([0.0, -3.0], abs=1e-12)
    moves = np.abs(np.diff(np.array(seen), axis=0)).max(axis=1)
    assert moves.max() == pytest.approx(0.01, rel=1e-9)
    assert moves[0] == pytest.approx(0.01, rel=1e-9)


def test_newtons_method_goes_on_until_all_masses_are_at_rest() -> None:
    """One that hangs at rest already beside one that is off to its side."""
    gravity = np.array([0.0, -10.0])
    system = made([[0.0, 0.0], [0.0, -1.2], [3.0, 0.0], [3.2, -1.1]], [[0, 1], [2, 3]], gravity=gravity)
    fixed = np.array([True, False, True, False])
    down = descent(MassSpringSystem(**{**system.to_dict(), "fixed": fixed, "obstacles": ()}))
    q = down.newton(np.array([0.0, -1.2, 3.2, -1.1]))
    assert q == pytest.approx([0.0, -1.2, 3.0, -1.2], abs=1e-12)


def test_where_one_force_is_left_there_is_no_rest() -> None:
    """Though the others balance: a search that gives up is told."""

    class Lazy(Descent):
        """Does not move."""

        def downhill(self, q: Array, driving: float | None = None) -> Array:
            """Not at all."""
            return q

        def newton(self, q: Array) -> Array:
            """Neither."""
            return q

    system = made([[0.0, 0.0], [0.0, -1.5]], [[0, 1]], gravity=np.array([0.0, -10.0]))
    with pytest.raises(SolverError, match="do not balance anywhere near the start"):
        Lazy(system, system.masses[:, None] * system.gravity).off_ridges(np.array([0.0, -1.5]))


@pytest.mark.parametrize("springs", [[], [[0, 1]]])
def test_what_nothing_holds_stays_where_it_is(springs: list[list[int]]) -> None:
    """Beside a spring at rest, or alone."""
    system = made([[0.0, 0.0], [1.0, 0.0], [4.0, 3.0], [5.0, 5.0]], springs, gravity=np.zeros(2))
    assert least_energy(system).positions == pytest.approx(system.positions, abs=1e-12)


def test_a_flat_valley_is_no_ridge() -> None:
    """A free chain may be moved and turned: none of that is downwards. One that is pressed buckles, to the side."""
    free = made([[0.0, 0.0], [0.8, 0.6], [1.6, 0.0]], [[0, 1], [1, 2]], fixed=np.zeros(3, dtype=bool))
    assert descent(free).downwards(free.positions.ravel()) is None
    pressed = made([[0.0, 0.0], [0.8, 0.0], [1.6, 0.0]], [[0, 1], [1, 2]], fixed=np.array([True, False, True]))
    away = descent(pressed).downwards(np.array([0.8, 0.0]))
    assert away is not None
    assert np.abs(away) == pytest.approx([0.0, 1.0], abs=1e-9)
