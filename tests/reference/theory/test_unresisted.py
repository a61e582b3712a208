"""Motion that nothing resists is out of a step before its eigenvalues are asked for, however strong damping is."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import springlab

from reference.schemes.catalogue import Scheme, find, schemes, wide_schemes
from reference.system import MassSpringSystem
from reference.theory.equilibria import spring_equilibrium
from reference.theory.limits import stability_limit
from reference.theory.unresisted import remainder
from tests.reference.systems import label

#: Three springs of four masses, two damped by a thousand times the third.
FREE = MassSpringSystem(
    positions=np.array([[0.0], [1.0], [2.0], [3.0]]),
    springs=np.array([[0, 1], [1, 2], [2, 3]]),
    masses=np.full(4, 0.5),
    rest_lengths=np.ones(3),
    stiffness=np.array([100.0, 1.0, 300.0]),
    damping=np.array([1e5, 3e5, 1e2]),
    drag=0.0,
    gravity=np.array(0.0),
    fixed=np.zeros(4, dtype=bool),
)

#: What a step of the whole state stays within for pairs of masses that nothing holds.
WHOLE = [
    scheme
    for scheme in (*schemes().values(), *wide_schemes().values())
    if scheme.needs == "accelerations" and scheme.linear and not scheme.iterated and not scheme.implicit
]


def pair(mass: float, damping: float, held: bool) -> MassSpringSystem:
    """Two masses on one spring of 100 N/m; one is held, or nothing is."""
    return MassSpringSystem(
        positions=np.array([[0.0], [1.0]]),
        springs=np.array([[0, 1]]),
        masses=np.full(2, mass),
        rest_lengths=np.ones(1),
        stiffness=np.array([100.0]),
        damping=np.array([damping]),
        drag=0.0,
        gravity=np.array(0.0),
        fixed=np.array([held, False]),
    )


@pytest.mark.rotating(4)
@pytest.mark.parametrize("damping", [1.0, 1e5])
@pytest.mark.parametrize("scheme", WHOLE, ids=label)
def test_a_pair_that_nothing_holds_has_the_limit_of_half_its_mass_held(scheme: Scheme, damping: float) -> None:
    """Two masses m swing on one spring as m / 2 does on the wall; that they also move together changes no limit.

    To 1e-6: in steps that are as short as strong damping asks for, slow decay is next to nothing.
    """
    free, held = (
        stability_limit(scheme, spring_equilibrium(pair(mass, damping, is_held)))
        for mass, is_held in ((0.5, False), (0.25, True))
    )
    assert free.stable_steps == held.stable_steps
    assert (free.dt is None) == (held.dt is None)
    if held.dt is not None:
        assert free.dt == pytest.approx(held.dt, rel=1e-6)


@pytest.mark.parametrize(("name", "limit"), [("velocity_verlet", 2.0), ("leapfrog_kick_drift_kick", 4.0)])
def test_strong_damping_beside_weaker_of_a_free_chain(name: str, limit: float) -> None:
    """Limits over the fastest decay g = 1329229.5/s: 2 / g and 4 / g, from eigenvalues by 60 digits."""
    assert stability_limit(find(name), spring_equilibrium(FREE)).dt == pytest.approx(limit / 1329229.5, rel=1e-6)


#: A line of three masses and a triangle; what moves them, and what `heun_link_by_link` and `euler_in_place` allow [s]
#: from eigenvalues by 60 digits; zero where something grows in any step.
LINE = {"positions": [[0.0], [0.3], [0.6]], "springs": [[0, 1], [1, 2]], "stiffness": [50.0, 80.0]}
TRIANGLE = {"positions": [[0.0, 0.0], [0.3, 0.0], [0.1, 0.3]], "springs": [[0, 1], [1, 2], [0, 2]], "stiffness": 50.0}
IN_PLACE = [
    (LINE, {"damping": [1e-9, 2.0]}, 0.0286979, 0.0),
    (TRIANGLE, {"damping": 1.1}, 0.0440, 0.0),
    (TRIANGLE, {"damping": 1.1, "drag": 0.001}, 0.04420642, 3.504908e-05),
]


@pytest.mark.parametrize(("shape", "resisted", "heun", "euler"), IN_PLACE)
def test_in_place_schemes_have_limits_where_nothing_is_held(
    shape: dict[str, object], resisted: dict[str, object], heun: float, euler: float
) -> None:
    """Their steps leave motion that nothing resists as it is, below the limit: it was said to grow at any dt."""
    rest = spring_equilibrium(springlab.system(**shape, masses=[0.1, 0.2, 0.3], gravity=0.0, **resisted))
    assert stability_limit(find("heun_link_by_link"), rest).dt == pytest.approx(heun, rel=1e-5)
    found = stability_limit(find("euler_in_place"), rest)
    assert (found.dt or 0.0) == pytest.approx(euler, rel=1e-6)
    assert found.stable_steps == ("up to a limit" if euler else "none")


def test_what_is_left_of_a_step_is_a_step_without_what_nothing_resists() -> None:
    """Both motions are out of a step of the whole state; of one in place the velocity stays, nearly as it was."""
    rest = spring_equilibrium(FREE)
    whole, in_place, remembers = (remainder(find(n), rest) for n in ("heun", "heun_link_by_link", "adams_bashforth_2"))
    assert whole is not None
    assert in_place is not None
    assert remembers is not None
    assert [r.onto.shape for r in (whole, in_place, remembers)] == [(6, 8), (7, 8), (12, 16)]
    assert [(r.positions, r.velocities) for r in (whole, in_place, remembers)] == [(0, 0), (0, 1), (0, 0)]
    for r in (whole, in_place, remembers):
        np.testing.assert_allclose(r.of(np.eye(r.onto.shape[1])), np.eye(len(r.onto)), atol=1e-14)
    dragged = spring_equilibrium(replace(FREE, drag=1.0))
    slowed, remembers = (remainder(find(name), dragged) for name in ("heun", "adams_bashforth_2"))
    assert slowed is not None
    assert remembers is not None
    assert (slowed.onto.shape, slowed.positions) == ((7, 8), 0)
    assert (remembers.onto.shape, remembers.positions) == ((16, 16), 1)


def test_steps_that_are_differenced_are_left_whole() -> None:
    """What differences leave of (u, 0) is no eigenvector."""
    assert remainder(find("backward_euler"), spring_equilibrium(FREE)) is None
