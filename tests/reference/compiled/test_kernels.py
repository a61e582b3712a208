"""Kernels: loops traced from a scheme's function do what the function does, to the bit, for one system and for many."""

from __future__ import annotations

import numpy as np
import pytest

from reference.compiled.kernels import advance
from reference.compiled.sweep import sweep
from reference.errors import InputError, Unsupported
from reference.schemes.catalogue import Scheme, find, schemes
from reference.simulate import simulate
from reference.state import Array
from reference.system import MassSpringSystem
from tests import wrong
from tests.reference.systems import label, moving_string, random_mesh

DT, STEPS = 1e-3, 25
STRING = moving_string(5, damping=0.05, drag=0.02)
MESHES = {d: random_mesh(3, 7, d, anchors=2) for d in (2, 3)}

# --- One system ---


def check_same_bits(scheme: Scheme, function: Scheme, system: MassSpringSystem, threads: int | None = None) -> None:
    """25 steps of the loops end where 25 calls of the function do, in every bit."""
    end = advance(system, scheme, DT, STEPS, threads)
    run = simulate(system, function, DT, STEPS * DT)
    assert end.positions.tolist() == run.positions[-1].tolist()
    assert end.velocities.tolist() == run.velocities[-1].tolist()


@pytest.mark.parametrize("name", ["heun", "kick_drift", "rk4"])
def test_loops_are_the_function_to_the_bit_on_a_string(name: str) -> None:
    """With damping and drag; the string needs no lists of who is joined to whom."""
    check_same_bits(find(name), find(name), STRING)


@pytest.mark.rotating(2)
@pytest.mark.parametrize(("dimension", "threads"), [(3, 1), (2, 2)])
def test_loops_are_the_function_to_the_bit_on_any_mesh(dimension: int, threads: int) -> None:
    """With fixed masses, by one thread or more."""
    check_same_bits(find("heun"), find("heun"), MESHES[dimension], threads)


@pytest.mark.parametrize(
    "other", [find("velocity_verlet"), wrong.heun_of_the_wrong_pair, wrong.heun_without_half], ids=label
)
def test_same_bits_fail_on_another_function(other: Scheme) -> None:
    """Even another scheme of second order."""
    with pytest.raises(AssertionError):
        check_same_bits(find("heun"), other, STRING)


@pytest.mark.parametrize("scheme", [s for s in schemes().values() if s.needs != "accelerations"], ids=label)
def test_schemes_that_ask_more_of_the_springs_are_refused(scheme: Scheme) -> None:
    """With the reason."""
    with pytest.raises(Unsupported, match=f"^{scheme.name} is not compiled: it needs"):
        advance(STRING, scheme, DT, 1)


# --- Many systems ---


def test_a_sweep_gives_every_system_the_bits_it_has_alone() -> None:
    """Twenty strings that differ in all there is to differ in, start and step included: more than one block of them."""
    rng = np.random.default_rng(0)
    m = 20
    parameters = {
        "stiffness": rng.uniform(50, 300, m),
        "damping": rng.uniform(0, 0.1, m),
        "drag": rng.uniform(0, 0.1, m),
        "mass": rng.uniform(0.01, 0.05, m),
        "rest_length": rng.uniform(0.1, 0.2, m),
        "gravity": rng.uniform(0, 20, m),
    }
    dt = rng.uniform(5e-4, 2e-3, m)
    starts = STRING.positions + 0.01 * rng.normal(size=(m, *STRING.positions.shape))
    swept = sweep(STRING, find("heun"), dt, STEPS, parameters, starts)
    for i in range(m):
        system = MassSpringSystem(**{**STRING.to_dict(), "positions": starts[i]})
        for name, values in parameters.items():
            system = system.with_parameter(name, float(values[i]))
        alone = advance(system, find("heun"), float(dt[i]), STEPS)
        assert swept.positions[i].tolist() == alone.positions.tolist(), i
        assert swept.velocities[i].tolist() == alone.velocities.tolist(), i
    assert not swept.blown_up.any()


def test_a_sweep_tells_which_systems_blew_up() -> None:
    """Beyond Heun's limit, and only there; distances are told after every hundred steps."""
    dt = np.array([1e-3, 0.1, 1e-3, 0.5])
    swept = sweep(STRING, find("heun"), dt, 250, limit=10.0)
    assert swept.blown_up.tolist() == [False, True, False, True]
    assert swept.distances.shape == (3, 4)


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"stiffness": np.ones(3)}, "stiffness has shape (3,): expected (2,), one for each system"),
        ({"stiffness": np.array([1.0, -1.0])}, "stiffness = -1: expected a number >= 0 [N/m]"),
        ({"stifness": np.ones(2)}, "unknown parameter 'stifness': did you mean 'stiffness'?"),
        ({"mass": np.array([0.1, np.nan])}, "mass = nan: expected a finite number [kg]"),
    ],
)
def test_a_sweep_of_nonsense_is_refused(parameters: dict[str, Array], message: str) -> None:
    """In one line, as for a single system."""
    with pytest.raises(InputError) as refused:
        sweep(STRING, find("heun"), np.full(2, DT), 5, parameters)
    assert str(refused.value) == message
