"""Springs of rest length 0: they pull with k times where their masses are apart, also where that is nowhere."""

from __future__ import annotations

import numpy as np
import pytest

from reference.assembly import assemble, spring_blocks
from reference.compiled.kernels import advance
from reference.errors import InputError, Unsupported
from reference.lengths import spring_lengths
from reference.outcome import outcome_of
from reference.schemes.catalogue import Scheme, find, schemes
from reference.simulate import simulate
from reference.stepper import stepper_named
from reference.system import MassSpringSystem
from reference.theory.equilibria import spring_equilibrium
from reference.theory.exact import exact
from reference.theory.limits import stability_limit
from tests.wrong import heun_without_half

W, DT = 20.0, 1e-3


def thrown(damping: float = 0.0) -> MassSpringSystem:
    """A mass where its anchor is, thrown along the first axis at 1 m/s: w = 20/s."""
    return MassSpringSystem(
        positions=np.zeros((2, 2)),
        springs=np.array([[0, 1]]),
        masses=np.array(0.5),
        rest_lengths=np.array(0.0),
        stiffness=np.array(0.5 * W**2),
        damping=np.array(damping),
        fixed=np.array([True, False]),
        velocities=np.array([[0.0, 0.0], [1.0, 0.0]]),
    )


def off(scheme: Scheme) -> float:
    """How far a scheme comes from x = sin(w t) / w, y = -g (1 - cos w t) / w^2 in 0.2 s [m]."""
    run = simulate(thrown(), scheme, DT, 0.2)
    true = np.stack([np.sin(W * run.times) / W, -9.81 / W**2 * (1 - np.cos(W * run.times))], axis=1)
    return float(np.abs(run.positions[:, 1] - true).max())


def test_it_swings_alike_in_all_directions_and_through_its_anchor() -> None:
    """By every scheme: of first order to h w / 2 of 1/w t w = 0.3, of second to (h w)^2 of that; shown to fail."""
    for scheme in schemes().values():
        bound = {1: 0.01, 2: 4e-4}.get(scheme.order, 1e-8)
        assert off(scheme) < bound * 0.2, scheme.name
    assert off(heun_without_half) > 0.01 * 0.2
    run = exact(thrown(), DT, 200)
    assert run.positions[:, 1, 0] == pytest.approx(np.sin(W * run.times) / W, abs=1e-12)


def test_where_it_has_no_length_its_stiffness_is_the_same_in_all_directions() -> None:
    """df/dx = k 1; its damper has no direction there, and gives nothing."""
    system = thrown(damping=3.0)
    by_position, by_velocity = (assemble(system, b, sparse=False) for b in spring_blocks(system, system.start))
    assert by_position == pytest.approx(-0.5 * W**2 * np.eye(2))
    assert not by_velocity.any()
    run = simulate(system, find("kick_drift_implicit_damping"), DT, 0.2)
    assert np.isfinite(run.positions).all()


def test_theory_knows_it() -> None:
    """It hangs at m g / k, and kick-drift's limit is 2 / w."""
    rest = spring_equilibrium(thrown())
    assert rest.state.positions[1] == pytest.approx([0.0, -9.81 / W**2], abs=1e-15)
    assert stability_limit(find("kick_drift"), rest).dt == pytest.approx(2 / W, rel=1e-12)


def test_growing_from_nothing_is_no_blow_up() -> None:
    """A spring without length at rest and at the start may be of any that its scene has."""
    outcome = outcome_of(thrown(), simulate(thrown(), find("rk4"), DT, 0.2))
    assert outcome.ending == "done"
    assert spring_lengths(thrown().positions, thrown().springs).tolist() == [0.0]


def test_what_cannot_have_it_refuses() -> None:
    """Compiled loops, rods; a start without length of any other spring."""
    with pytest.raises(Unsupported, match="rest length 0"):
        advance(thrown(), find("heun"), DT, 1)
    for name in ("pendulum_heun", "rope_kick_drift"):
        assert stepper_named(name).run(thrown(), DT, 1).ending == "unsupported"
    with pytest.raises(InputError, match="expected a length > 0"):
        MassSpringSystem(np.zeros((2, 2)), np.array([[0, 1]]), np.ones(1), np.ones(1), np.ones(1))
