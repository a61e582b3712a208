"""What is seen of steppers that ask for slopes: their formulas, what they should not do, and how they solve."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
import pytest

from reference.derivation.recording import Advance, Recording, Slopes, record
from reference.derivation.seen import NOTHING, Seen, slopes_of
from reference.derivation.updates import NOT_LINEAR, first_updates_of, in_words, updates_of
from reference.errors import InputError, Unsupported
from reference.state import Array, State

HALF = Fraction(1, 2)


@dataclass
class Own:
    """A stepper that is recorded."""

    advance: Callable[[], Advance]
    timed: bool = True
    name: str = "own"

    def recording(self) -> Recording:
        """What it asks, and what it makes of that."""
        return record(self.advance, self.timed)


def seen(advance: Callable[[], Advance] | Advance, timed: bool = True) -> tuple[Seen, list[str]]:
    """Of a stepper; and why something was not seen."""
    reasons: list[str] = []
    return slopes_of(Own(advance, timed), reasons), reasons  # type: ignore[arg-type]


def moved(state: State, h: float, slope: tuple[Array, Array]) -> State:
    """By h times a slope."""
    return State(state.time + h, state.positions + h * slope[0], state.velocities + h * slope[1])


def mean(one: tuple[Array, Array], other: tuple[Array, Array]) -> tuple[Array, Array]:
    """Of two slopes."""
    return (one[0] + other[0]) / 2, (one[1] + other[1]) / 2


def slope_at(slopes: Slopes, state: State, time: float | None = None) -> tuple[Array, Array]:
    """Where it is, at a time."""
    return slopes(state.time if time is None else time, state.positions, state.velocities)


def heun(slopes: Slopes, state: State, h: float) -> State:
    """As in textbooks."""
    k = slope_at(slopes, state)
    return moved(state, h, mean(k, slope_at(slopes, moved(state, h, k))))


def test_heun_is_seen_with_nothing_to_remark() -> None:
    """Two slopes, at the start and at the end; its first step is every step."""
    found, reasons = seen(lambda: heun)
    assert found.tableau is not None
    assert found.updates is not None
    assert found.tableau.text() == {"a": [["0", "0"], ["1", "0"]], "b": ["1/2", "1/2"], "c": ["0", "1"]}
    assert (found.remarks, found.iterates, found.adapts, reasons) == ((), False, False, [])
    assert (found.updates.calls, found.updates.looks_back, found.updates.asks_only_accelerations) == (2, 0, False)
    assert in_words(found.updates) == [
        "f1 = slope(x, v)",
        "f2 = slope(x + h f1.x, v + h f1.v)",
        "x' = x + h f1.x/2 + h f2.x/2",
        "v' = v + h f1.v/2 + h f2.v/2",
    ]
    assert found.first == found.updates


def test_who_writes_into_the_state_is_told_so_whichever_half_it_is() -> None:
    """Positions or velocities."""
    for which in ("positions", "velocities"):

        def writes(slopes: Slopes, state: State, h: float, which: str = which) -> State:
            end = heun(slopes, state, h)
            getattr(state, which)[:] = 7.0
            return end

        assert seen(lambda w=writes: w)[0].remarks == ("it writes into the state it is given",)


def test_slopes_at_other_times_than_their_places_are_remarked() -> None:
    """The second at the start's time; where no time is told there is nothing to remark."""

    def untimely(slopes: Slopes, state: State, h: float) -> State:
        k = slope_at(slopes, state)
        return moved(state, h, mean(k, slope_at(slopes, moved(state, h, k), state.time)))

    found, _ = seen(lambda: untimely)
    assert found.remarks == ("slope 2 is taken 1 of a step on, and is told the time 0 of it on",)
    assert seen(lambda: untimely, timed=False)[0].remarks == ()


def fsal() -> Advance:
    """Heun's step after which a slope is taken at the end, which is the next one's first: first same as last."""

    def step(slopes: Slopes, state: State, h: float) -> State:
        k = (state.memory[0], state.memory[1]) if state.memory else slope_at(slopes, state)
        end = moved(state, h, mean(k, slope_at(slopes, moved(state, h, k))))
        return end.remembering(*slope_at(slopes, end))

    return step


def test_a_slope_that_the_step_before_left_counts_as_the_first() -> None:
    """Two slopes are asked for in a step, and three make it; the first step of all asks for three."""
    found, _ = seen(fsal)
    assert found.updates is not None
    assert found.updates.reused
    assert (len(found.updates.points), found.updates.calls, found.updates.looks_back) == (3, 2, 0)
    assert in_words(found.updates)[:2] == [
        "f1 = slope(x, v), as the step before left it",
        "f2 = slope(x + h f1.x, v + h f1.v)",
    ]
    assert found.updates.parts == (0, 1, 1)
    assert found.tableau is not None
    assert (found.tableau.b, found.tableau.order) == ((HALF, HALF), 2)
    assert found.first is not None
    assert (len(found.first.points), found.first.reused) == (3, False)


def test_a_slope_that_was_asked_for_elsewhere_is_an_older_one() -> None:
    """At the place where the step ended, but with another velocity: it is not the first of the next."""

    def step(slopes: Slopes, state: State, h: float) -> State:
        k = (state.memory[0], state.memory[1]) if state.memory else slope_at(slopes, state)
        end = moved(state, h, k)
        return end.remembering(*slope_at(slopes, State(end.time, end.positions, state.velocities)))

    found, _ = seen(lambda: step)
    assert found.updates is not None
    assert (found.updates.reused, found.updates.looks_back) == (False, 1)


def adams() -> Advance:
    """Adams-Bashforth of two steps, begun with Euler's."""

    def step(slopes: Slopes, state: State, h: float) -> State:
        k = slope_at(slopes, state)
        old = (state.memory[0], state.memory[1]) if state.memory else k
        both = (3 * k[0] - old[0]) / 2, (3 * k[1] - old[1]) / 2
        return moved(state, h, both).remembering(*k)

    return step


def test_a_method_of_two_steps_is_told_with_the_older_slope() -> None:
    """Its age stands behind it; its first step is Euler's."""
    found, reasons = seen(adams)
    assert found.updates is not None
    assert (found.updates.looks_back, found.updates.reused, found.tableau, reasons) == (1, False, None, [])
    assert in_words(found.updates) == [
        "f1 = slope(x, v)",
        "x' = x + 3 h f1.x/2 - h f1.x[-1]/2",
        "v' = v + 3 h f1.v/2 - h f1.v[-1]/2",
    ]
    assert found.first is not None
    assert in_words(found.first)[1:] == ["x' = x + h f1.x", "v' = v + h f1.v"]


def test_a_step_by_accelerations_is_told_by_these() -> None:
    """Kick-drift with a root in it, which is written beside its number."""

    def rooted(slopes: Slopes, state: State, h: float) -> State:
        a = slope_at(slopes, state)[1]
        v = state.velocities + h * a
        return State(state.time + h, state.positions + h * state.velocities + 2**0.5 / 2 * h**2 * a, v)

    found, _ = seen(lambda: rooted)
    assert found.updates is not None
    assert found.updates.asks_only_accelerations
    assert in_words(found.updates) == [
        "a1 = acceleration(x, v)",
        "x' = x + h v + 0.7071068 h^2 a1",
        "v' = v + h a1",
        "with 0.7071068 = sqrt(2)/2",
    ]
    assert found.tableau is None


@pytest.mark.parametrize(
    ("spoil", "said"),
    [
        (lambda k, h: np.clip(k, -2.0, 2.0), NOT_LINEAR),  # unit answers are not clipped
        (lambda k, h: np.concatenate([np.clip(k[:1], -0.1, 2.0), k[1:]]), NOT_LINEAR),  # of one mass only
        (lambda k, h: k * (h - 0.25), "its coefficients are no powers of the step length"),
        (lambda k, h: k * h**0.5, "its coefficients are no powers of the step length"),
        (lambda k, h: k * (h - 0.2), "its coefficients are no powers of the step length"),
    ],
)
def test_a_step_that_has_no_formulas_says_why(spoil: Callable[[Array, float], Array], said: str) -> None:
    """Clipped; with nothing at one h; with half a power of h; with another sign at another h."""

    def spoiled(slopes: Slopes, state: State, h: float) -> State:
        p, q = slope_at(slopes, state)
        return moved(state, h, (p, spoil(q, h)))

    found, reasons = seen(lambda: spoiled)
    assert (found.updates, found.tableau) == (None, None)
    assert reasons == [f"no update formulas: {said}"]


def test_a_first_step_without_formulas_has_none() -> None:
    """Though later ones have: it is off by a root of h."""

    def begins(slopes: Slopes, state: State, h: float) -> State:
        p, q = slope_at(slopes, state)
        return moved(state, h, (p, q if state.memory else q * h**0.5)).remembering(p)

    recording = record(lambda: begins)
    assert first_updates_of(recording) is None
    assert updates_of(recording).looks_back == 0
    assert first_updates_of(Recording()) is None


def test_who_asks_more_often_where_slopes_are_large_adapts() -> None:
    """A second slope where the first is longer than a unit vector."""

    def careful(slopes: Slopes, state: State, h: float) -> State:
        k = slope_at(slopes, state)
        return heun(slopes, state, h) if np.abs(k[0]).max() > 1.5 else moved(state, h, k)

    _, reasons = seen(lambda: careful)
    assert reasons == [
        "no update formulas: how often it asks for slopes depends on what they are: it adapts its step, or iterates"
    ]


def test_other_shapes_are_refused() -> None:
    """In one line."""

    def wide(slopes: Slopes, state: State, h: float) -> State:
        slope_at(slopes, state)
        return State(state.time + h, np.tile(state.positions, 2), np.tile(state.velocities, 2))

    with pytest.raises(InputError, match=r"it returns arrays of shape \(1024,\): expected \(512,\)"):
        record(lambda: wide)


def midpoint(slopes: Slopes, state: State, h: float) -> State:
    """Implicit: k = f(y + h k/2), by iterating."""
    k = slope_at(slopes, state)
    for _ in range(80):
        k = slope_at(slopes, moved(state, h / 2, k))
    return moved(state, h, k)


def test_stages_of_what_iterates_are_found() -> None:
    """A = 1/2, b = 1; that it iterates is told, and what it writes into."""

    def rude(slopes: Slopes, state: State, h: float) -> State:
        end = midpoint(slopes, state, h)
        state.positions[:] = 0.0
        return end

    found, reasons = seen(lambda: midpoint)
    assert found.tableau is not None
    assert found.tableau.text() == {"a": [["1/2"]], "b": ["1"], "c": ["1/2"]}
    assert (found.iterates, found.adapts, found.updates, found.remarks, reasons) == (True, False, None, (), [])
    with pytest.raises(Unsupported, match="it asks for slopes too often in a step: it iterates"):
        updates_of(record(lambda: midpoint))

    def untimely(slopes: Slopes, state: State, h: float) -> State:
        return midpoint(lambda time, x, v: slopes(state.time, x, v), state, h)

    said = "slope 1 is taken 1/2 of a step on, and is told the time 0 of it on"
    assert [seen(lambda: untimely, timed)[0].remarks for timed in (True, False)] == [(said,), ()]
    assert seen(lambda: rude)[0].remarks == ("it writes into the state it is given",)


def in_parts(count: Callable[[tuple[Array, Array]], int]) -> Callable[[], Advance]:
    """Heun's steps in so many parts, by what the first slope is."""

    def step(slopes: Slopes, state: State, h: float) -> State:
        n = count(slope_at(slopes, state))
        for _ in range(n):
            state = heun(slopes, state, h / n)
        return state

    return lambda: step


def test_who_makes_steps_of_its_own_is_told_with_how_many() -> None:
    """Forty sub-steps, or four where slopes are small: it adapts them. Forty whatever they are: it does not."""
    found, reasons = seen(in_parts(lambda k: 40 if np.abs(k[1]).max() > 0.1 else 30))
    assert (found.adapts, found.iterates, found.tableau) == (True, True, None)
    assert reasons == [
        "no tableau: it makes steps of its own; in one step it asks 81 times, or 61 where slopes are a thousandth: "
        "it adapts its steps"
    ]
    found, reasons = seen(in_parts(lambda k: 40))
    assert (found.adapts, found.iterates) == (False, True)
    assert reasons == ["no tableau: it makes steps of its own; in one step it asks 81 times"]


def test_points_that_are_no_stages_give_no_tableau() -> None:
    """Iterations that are not done: after sixty of them by a tenth only."""

    def slack(slopes: Slopes, state: State, h: float) -> State:
        k = slope_at(slopes, state)
        for _ in range(60):
            new = slope_at(slopes, moved(state, h / 2, k), state.time + h / 2)
            k = k[0] + 0.02 * (new[0] - k[0]), k[1] + 0.02 * (new[1] - k[1])
        return moved(state, h, k)

    found, reasons = seen(lambda: slack)
    assert found == NOTHING._replace(iterates=True)
    assert reasons == ["no tableau: it iterates, and its stages were not found among the points that it asks at"]
