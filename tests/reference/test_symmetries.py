"""What symmetric schemes do: go back the way they came; and what all whole-state schemes do: not ask for numbers."""

from __future__ import annotations

import numpy as np
import pytest

from reference.forces import SpringMotion
from reference.schemes.catalogue import Scheme, find
from reference.simulate import simulate
from tests import wrong
from tests.reference.systems import IN_PLACE, SOLVED, SOLVED_TO, WHOLE_STATE, label, moving_string

# --- Symmetry in time ---


def check_reversible(scheme: Scheme) -> None:
    """A step of dt and one of -dt lead back: Phi(-dt) Phi(dt) = 1 (HLW V.1), to rounding, 1e-14 of size and speed."""
    system = moving_string(6)
    motion = SpringMotion(system)
    there = scheme.step(motion, system.start, 2e-3)
    back = scheme.step(motion, there, -2e-3)
    assert back.time == 0.0
    assert np.abs(back.positions - system.positions).max() < 1e-14 * system.size
    assert np.abs(back.velocities - system.velocities).max() < 1e-14 * np.abs(there.velocities).max()


@pytest.mark.parametrize("name", ["velocity_verlet", "implicit_midpoint"])
def test_symmetric_schemes_are_reversible(name: str) -> None:
    """Velocity Verlet and the midpoint rule treat start and end of a step alike."""
    check_reversible(find(name))


@pytest.mark.parametrize(
    "scheme",
    [find("euler"), find("kick_drift"), find("heun"), find("rk4"), wrong.verlet_with_one_force, *IN_PLACE],
    ids=label,
)
def test_reversibility_fails_on_others(scheme: Scheme) -> None:
    """Schemes that are not symmetric, rk4 among them, and wrong ones do not come back."""
    with pytest.raises(AssertionError):
        check_reversible(scheme)


@pytest.mark.parametrize(("name", "adjoint"), [("kick_drift", "drift_kick"), ("euler", "backward_euler")])
def test_adjoint_schemes_undo_each_other(name: str, adjoint: str) -> None:
    """Phi*(-dt) Phi(dt) = 1: drift-kick is kick-drift's adjoint, backward Euler is Euler's (HLW II.3)."""
    system = moving_string(6)
    motion = SpringMotion(system)
    there = find(name).step(motion, system.start, 1e-3)
    back = find(adjoint).step(motion, there, -1e-3)
    assert np.abs(back.positions - system.positions).max() < 1e-14 * system.size


# --- Renumbering ---


def renumbering_error(scheme: Scheme, damping: float) -> float:
    """How far a string and the same string renumbered are apart after 100 steps, as a part of the size."""
    system = moving_string(7, damping=damping, drag=0.02)
    order = np.array([3, 0, 6, 1, 7, 5, 2, 4])
    straight = simulate(system, scheme, 1e-3, 0.1).positions
    mixed = simulate(system.renumbered(order), scheme, 1e-3, 0.1).positions
    return float(np.abs(mixed - straight[:, order]).max() / system.size)


def check_renumbering(scheme: Scheme, damping: float) -> None:
    """Numbers are names, not physics: the motion is the same to rounding.

    Each of 100 steps rounds each mass by some eps; 1e-13 allows 450 eps. A solver that stops at 1e-8 m/s may leave as
    much of every velocity for 0.1 s (the size is 0.8 m).
    """
    assert renumbering_error(scheme, damping) < 1e-13 + 0.1 * SOLVED_TO.get(scheme, 0.0)


@pytest.mark.parametrize("damping", [0.0, 0.5])
@pytest.mark.parametrize("scheme", WHOLE_STATE, ids=label)
def test_renumbering_the_masses_changes_nothing(scheme: Scheme, damping: float) -> None:
    """The springs keep their order here, so that sequential impulses too only meet masses of another name."""
    check_renumbering(scheme, damping)


@pytest.mark.parametrize("scheme", [*IN_PLACE, wrong.in_order_of_number, wrong.last_mass_forgotten], ids=label)
def test_renumbering_fails_on_in_place_schemes(scheme: Scheme) -> None:
    """Who is advanced first is seen first by the others: over 1e-6 of the size in 100 steps."""
    with pytest.raises(AssertionError):
        check_renumbering(scheme, 0.0)
    assert renumbering_error(scheme, 0.0) > 1e-6


#: The one whole-state scheme that by theory depends on the order of the springs, where they are damped: it goes over
#: them one after the other, and stops after ten rounds.
ONE_SPRING_AFTER_THE_OTHER = {find("drift_kick_sequential_damping")}


def reordering_error(scheme: Scheme, damping: float) -> float:
    """How far a string and the same string with its springs listed from the tip are apart after 100 steps."""
    system = moving_string(7, damping=damping, drag=0.02)
    backwards = system.with_springs_reversed()
    one, other = (simulate(s, scheme, 1e-3, 0.1).positions for s in (system, backwards))
    return float(np.abs(one - other).max() / system.size)


@pytest.mark.parametrize("scheme", [s for s in SOLVED if s not in ONE_SPRING_AFTER_THE_OTHER], ids=label)
def test_reordering_the_springs_changes_nothing(scheme: Scheme) -> None:
    """The sum of the forces on a mass has no order, but for rounding."""
    assert reordering_error(scheme, 0.5) < 1e-13 + SOLVED_TO.get(scheme, 0.0)


def test_reordering_the_springs_shows_in_sequential_damping_only() -> None:
    """Springs that give up 1 - exp(-dt c/m) = 0.86 of their rate (c = 20 N s/m) show their order after ten rounds.

    Where they give up 0.05 (c = 0.5 N s/m) the rounds have converged.
    """
    (sequential,) = ONE_SPRING_AFTER_THE_OTHER
    assert reordering_error(sequential, 20.0) > 1e-6
    assert reordering_error(sequential, 0.5) < 1e-13
