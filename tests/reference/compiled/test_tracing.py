"""Tracing: what a scheme computes, written down, comes out the same to the bit, or is refused by name; never wrong."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from reference.compiled.expressions import OPERATIONS, Scalar, Symbol, Untraceable
from reference.compiled.kernels import advance
from reference.compiled.tracing import trace, why_not_compiled
from reference.errors import Unsupported
from reference.motion import Motion
from reference.schemes.catalogue import Scheme, find, schemes
from reference.simulate import simulate
from reference.state import State
from tests.reference.systems import label, moving_string, property_test

STRING = moving_string(4, damping=0.05, drag=0.02)

TRACEABLE = [s for s in schemes().values() if why_not_compiled(s) is None]

Function = Callable[[Any, Any, Any], Any]


def test_tracing_writes_down_what_a_scheme_computes() -> None:
    """Kick-drift by hand: one stage at the state itself, then v + dt a and x + dt (that), with c0 = dt."""
    program = trace(find("kick_drift"))
    assert [[q.text(str) for q in stage] for stage in program.stages] == [["x", "v"]]
    assert [q.text(str) for q in program.end] == ["(x + (c0 * (v + (c0 * a0))))", "(v + (c0 * a0))"]
    assert program.numbers(0.25) == [0.25]


def test_what_depends_on_dt_alone_is_computed_once() -> None:
    """RK4's coefficients: dt / 2, dt and dt / 6, in the order they are met."""
    assert trace(find("rk4")).numbers(0.3) == [0.3 / 2, 0.3, 0.3 / 6]


def check_same_bits(scheme: Scheme, dt: float = 1e-3) -> None:
    """Twenty steps of the loops end where twenty calls of the function do, in every bit."""
    end, run = advance(STRING, scheme, dt, 20), simulate(STRING, scheme, dt, 20 * dt)
    assert end.positions.tolist() == run.positions[-1].tolist()
    assert end.velocities.tolist() == run.velocities[-1].tolist()


def test_the_textbooks_schemes_of_accelerations_are_traced() -> None:
    """Those that need nothing else, all of them."""
    assert {"euler", "heun", "kick_drift", "drift_kick", "velocity_verlet", "rk4"} <= {s.name for s in TRACEABLE}


@pytest.mark.rotating(3)
@pytest.mark.parametrize("scheme", TRACEABLE, ids=label)
def test_every_scheme_of_accelerations_is_traced_to_the_bit(scheme: Scheme) -> None:
    """The catalogue's own."""
    check_same_bits(scheme)


# --- Random expressions ---

BINARY = [np.add, np.subtract, np.multiply, np.divide, np.minimum, np.maximum]
UNARY = [np.negative, np.positive, np.sqrt, np.absolute, np.square, lambda a: a**2]
OF_SCALARS = [np.exp, np.sin, lambda a: a**3, lambda a: 2.0**a, abs, np.sqrt]
COMPARISONS = [np.less, np.greater, np.less_equal, np.greater_equal]


def leaves() -> st.SearchStrategy[Function]:
    """The positions, the velocities, dt, and numbers."""
    numbers = st.sampled_from([0.1, 2, -3, 1 / 3, 0.0, -0.0, 1e300, np.float64(0.7), np.inf])
    names = st.sampled_from([lambda x, v, dt: x, lambda x, v, dt: v, lambda x, v, dt: dt])
    return st.one_of(names, numbers.map(lambda number: lambda x, v, dt: number))


def grown(inner: st.SearchStrategy[Function]) -> st.SearchStrategy[Function]:
    """One operation more."""
    unary = st.tuples(st.sampled_from(UNARY), inner).map(lambda t: lambda *q: t[0](t[1](*q)))
    binary = st.tuples(st.sampled_from(BINARY), inner, inner).map(lambda t: lambda *q: t[0](t[1](*q), t[2](*q)))
    chosen = st.tuples(st.sampled_from(COMPARISONS), inner, inner, inner).map(
        lambda t: lambda *q: np.where(t[0](t[1](*q), t[2](*q)), t[2](*q), t[3](*q))
    )
    scalar = st.tuples(st.sampled_from(OF_SCALARS), st.sampled_from([0.5, 3.0])).map(
        lambda t: lambda x, v, dt: t[0](dt * t[1] + t[1])
    )
    return st.one_of(unary, binary, chosen, scalar)


def traced(function: Function, dt: float) -> Callable[[float, float], float]:
    """What tracing makes of a function, as Numba compiles such texts: of one number x and one v."""
    known: dict[str, Callable[[float], Any]] = {}
    made = function(Symbol("x"), Symbol("v"), Scalar(lambda dt: dt, "dt", known))
    if isinstance(made, Scalar):
        return lambda x, v: made.value(dt)
    if not isinstance(made, Symbol):
        return lambda x, v: made
    numbers = {f"c{k}": float(value(dt)) for k, value in enumerate(known.values())}
    text = repr(made)
    import numba

    compiled = numba.njit(error_model="numpy")(
        eval(f"lambda x, v, {', '.join([*numbers, 'spare'])}: {text}", {"np": np})
    )
    return lambda x, v: compiled(x, v, *numbers.values(), 0.0)


@settings(property_test, max_examples=40)
@example(lambda x, v, dt: x + 1e300**2, 0.5, 0)
@given(st.recursive(leaves(), grown, max_leaves=6), st.floats(1e-4, 0.5), st.integers(0, 2**32 - 1))
def test_random_expressions_give_the_same_bits_traced_and_plain(function: Function, dt: float, seed: int) -> None:
    """Of the operations that are known, on a few numbers of all sizes; what is not a number is so in both.

    So it is with a power of numbers that Python itself refuses as too large.
    """
    rng = np.random.default_rng(seed)
    x, v = rng.standard_normal(5) * 10.0 ** rng.integers(-3, 4, 5), rng.standard_normal(5)
    with np.errstate(all="ignore"):
        try:
            plain = np.broadcast_to(np.asarray(function(x, v, dt), dtype=float), 5)
        except OverflowError:  # a power of Python's own numbers, which are no arrays, such as 1e300**2
            with pytest.raises(OverflowError):
                traced(function, dt)
            return
        compiled = traced(function, dt)
        found = np.array([compiled(*pair) for pair in zip(x.tolist(), v.tolist(), strict=True)], dtype=float)
    np.testing.assert_array_equal(found, plain)


def test_every_operation_that_is_known_is_among_those_tried() -> None:
    """So that a new one is tried too."""
    assert set(OPERATIONS) == {*BINARY, *COMPARISONS, *UNARY[:5], np.where}


# --- What is refused ---


REFUSED: dict[str, Function] = {
    "branch": lambda x, v, dt: x if dt > 0.01 else v,
    "branch on a state": lambda x, v, dt: x if x > 0 else v,
    "equality": lambda x, v, dt: x if dt == 0.01 else v,
    "unequal": lambda x, v, dt: x if x != 0 else v,
    "power": lambda x, v, dt: x**3,
    "power of a state": lambda x, v, dt: 2.0**x,
    "function": lambda x, v, dt: np.exp(x),
    "function of arrays": lambda x, v, dt: x / np.linalg.norm(v),
    "sum": lambda x, v, dt: x - x.sum(),
    "method": lambda x, v, dt: x.copy(),
    "shape": lambda x, v, dt: x * x.shape[0],
    "entry": lambda x, v, dt: x[0],
    "entries": lambda x, v, dt: list(x),
    "length": lambda x, v, dt: x / len(x),
    "array": lambda x, v, dt: np.asarray(x) + np.array([1.0, 2.0]),
    "with an array": lambda x, v, dt: x + np.array([[1.0, 2.0]]),
    "options": lambda x, v, dt: np.add(x, v, where=True),
    "reduced": lambda x, v, dt: np.add.reduce(x),
    "math": lambda x, v, dt: math.exp(x),
    "math of dt": lambda x, v, dt: x * math.exp(dt),
    "number": lambda x, v, dt: x * float(dt),
    "matrix": lambda x, v, dt: x @ v,
    "remainder": lambda x, v, dt: x % 2,
    "largest": lambda x, v, dt: max(x, v),
    "and": lambda x, v, dt: x > 0 and v > 0,
    "one argument": lambda x, v, dt: np.where(x > 0),
}


def in_place(x: Any, v: Any, dt: Any) -> Any:
    """Writes to what it was given."""
    x += dt * v
    return x


@pytest.mark.parametrize("name", [*REFUSED, "in place"])
def test_what_is_not_known_is_refused_by_name_and_runs_as_it_is_written(name: str) -> None:
    """Tracing such a step says which scheme and why; nothing is traced that would come out otherwise."""
    function = {**REFUSED, "in place": in_place}[name]

    def odd(motion: Motion, state: State, dt: float) -> State:
        acceleration = motion.acceleration(state)
        return State(
            state.time + dt, function(state.positions, state.velocities, dt), state.velocities + dt * acceleration
        )

    scheme = Scheme(odd, 1)
    with pytest.raises(Unsupported, match=r"^odd is not compiled: "):
        trace(scheme)
    assert why_not_compiled(scheme) is not None


def test_a_branch_on_dt_takes_the_branch_it_should() -> None:
    """Not compiled, it runs as it is written: Euler for long steps, Heun for short ones."""

    def two(motion: Motion, state: State, dt: float) -> State:
        name = "euler" if dt > 0.01 else "heun"
        return find(name).step(motion, state, dt)  # type: ignore[arg-type]

    for dt, name in ((0.02, "euler"), (0.005, "heun")):
        run = partial(simulate, STRING, dt=dt, duration=10 * dt)
        assert run(Scheme(two, 1)).positions.tolist() == run(find(name)).positions.tolist()
    with pytest.raises(Unsupported, match="two is not compiled: it branches on what is known only when it runs"):
        advance(STRING, Scheme(two, 1), 0.02, 1)


def squared(motion: Motion, state: State, dt: float) -> State:
    """Velocity Verlet with dt squared and a minus sign: x - (-dt v) + dt**2 / 2 a."""
    here = motion.acceleration(state)
    x = state.positions - (-(dt * state.velocities)) + dt**2 / 2 * here
    there = motion.acceleration(State(state.time, x, state.velocities + dt * here))
    return State(state.time + dt, x, state.velocities + dt / 2 * (here + there))


@settings(property_test, max_examples=25)
@given(st.floats(1e-5, 1e-2))
def test_powers_and_signs_come_out_to_the_bit(dt: float) -> None:
    """Whatever dt: Python's own power of it is what the loops are given."""
    check_same_bits(Scheme(squared, 2), dt)


def test_the_check_of_bits_fails_on_another_power() -> None:
    """A symbol that is squared by the C library's power instead: seen to differ for some dt."""
    odd = [h for h in np.random.default_rng(0).uniform(1e-5, 1e-2, 4000).tolist() if h**3 != h * h * h]
    assert odd, "powers that are written out round otherwise"


def test_untraceable_is_no_error_of_numpy() -> None:
    """What NumPy does with a symbol by itself is refused, not made into an array of objects."""
    for convert in (np.array, np.asarray, np.zeros_like, float, int, bool, len, list):
        with pytest.raises(Untraceable):
            convert(Symbol("x"))
    with pytest.raises(Untraceable):
        np.ones(2) * Symbol("x")
