"""In-place schemes by their loops: the bits of the scheme's function, or the function itself."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Callable

import pytest

from reference.compiled import in_place
from reference.compiled.expressions import Untraceable
from reference.compiled.in_place import step_of, trace_in_place
from reference.forces import SpringMotion
from reference.motion import MotionByMass
from reference.pendulum import PendulumMotion
from reference.scenes import find as find_scene
from reference.schemes.catalogue import Scheme, find
from reference.simulate import simulate
from reference.state import State
from reference.system import MassSpringSystem
from tests.reference.systems import IN_PLACE, label, moving_string, random_mesh

DT, STEPS = 1e-3, 10
MESHES = {d: random_mesh(4, 9, d, anchors=2) for d in (2, 3)}


@pytest.fixture
def for_all(monkeypatch: pytest.MonkeyPatch) -> None:
    """Systems of any size have loops, in runs of any length."""
    monkeypatch.setattr(in_place, "COMPILED_FROM", 0)
    monkeypatch.setattr(in_place, "LONG_FROM", 0)


def is_by_loops(scheme: Scheme, system: MassSpringSystem) -> bool:
    """Whether its step is not the function's."""
    return not hasattr(step_of(scheme, SpringMotion(system)), "func")


@pytest.mark.rotating(3)
@pytest.mark.usefixtures("for_all")
@pytest.mark.parametrize("scheme", IN_PLACE, ids=label)
def test_loops_are_the_function_to_the_bit(scheme: Scheme) -> None:
    """On meshes with damping, drag and fixed masses, in the plane and in space, by one kernel; and a run has them."""
    for system in MESHES.values():
        check_same_bits(scheme, system)


def check_same_bits(scheme: Scheme, system: MassSpringSystem) -> None:
    """Steps by loops, and a run, end where as many calls of the function do, in every bit."""
    assert is_by_loops(scheme, system)
    step, state = scheme.on(SpringMotion(system)), system.start
    for _ in range(STEPS):
        state = step(state, DT)
    end = simulate(system, scheme, DT, STEPS * DT)
    assert end.positions[-1].tolist() == state.positions.tolist()
    assert end.velocities[-1].tolist() == state.velocities.tolist()


def test_short_runs_are_as_written(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two steps of the function take less than compiling its loops, or loading them: a run of two asks for none."""
    scheme, system = find("euler_in_place"), moving_string(in_place.COMPILED_FROM)
    shortest = math.ceil(in_place.LONG_FROM / len(system.masses))
    made = [hasattr(step_of(scheme, SpringMotion(system), steps), "func") for steps in (shortest - 1, shortest)]
    assert made == [True, False]
    monkeypatch.setattr(in_place, "_trusted", lambda scheme: pytest.fail("loops are asked for"))
    assert len(simulate(system, scheme, DT, 2 * DT).times) == 3


def test_small_systems_and_other_equations_run_as_written(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whole-state schemes too: they have loops of their own, which `simulate`, that keeps all states, does not use."""
    scheme, large = find("euler_in_place"), moving_string(in_place.COMPILED_FROM)
    assert is_by_loops(scheme, large)
    assert not is_by_loops(scheme, moving_string(in_place.COMPILED_FROM - 2))
    assert not is_by_loops(find("heun"), large)
    monkeypatch.setattr(in_place, "COMPILED_FROM", 0)
    assert hasattr(step_of(find("euler"), PendulumMotion(find_scene("string").system({}))), "func")


@pytest.mark.usefixtures("for_all")
@pytest.mark.parametrize("scheme", IN_PLACE[:1], ids=label)
def test_one_mass_that_is_pulled_has_the_function_take_all(scheme: Scheme) -> None:
    """The loops know of no pulls."""
    system = MESHES[2].with_parameter(f"pull.{len(MESHES[2].masses) - 1}.y", 3.0)
    assert not is_by_loops(scheme, system)


# --- Functions that loops would not be ---


def from_the_last(motion: MotionByMass, state: State, dt: float) -> State:
    """Euler in place, from the last mass to the first."""
    end = State(state.time + dt, state.positions.copy(), state.velocities.copy())
    for i in reversed(range(len(end.positions))):
        slope = motion.acceleration_of(i, end)
        end.positions[i] += dt * end.velocities[i]
        end.velocities[i] += dt * slope
    return end


def first_mass_apart(motion: MotionByMass, state: State, dt: float) -> State:
    """Euler in place, the first mass with twice the acceleration."""
    end = State(state.time + dt, state.positions.copy(), state.velocities.copy())
    for i in range(len(end.positions)):
        slope = motion.acceleration_of(i, end)
        end.positions[i] += dt * end.velocities[i]
        end.velocities[i] += (2 * dt if i == 0 else dt) * slope
    return end


@pytest.mark.rotating(2)
@pytest.mark.usefixtures("for_all")
@pytest.mark.parametrize("function", [from_the_last, first_mass_apart], ids=label)
def test_what_goes_over_the_masses_in_another_way_runs_as_written(function: Callable[..., State]) -> None:
    """It can be traced, and its loops are found to be wrong."""
    scheme = Scheme(function, 1, "in_place")
    trace_in_place(scheme)
    assert not is_by_loops(scheme, MESHES[2])


def looks_back(motion: MotionByMass, state: State, dt: float) -> State:
    """Each mass moves as the one before it."""
    end = State(state.time + dt, state.positions.copy(), state.velocities.copy())
    for i in range(len(end.positions)):
        end.positions[i] += dt * end.velocities[i - 1]
    return end


def copies_later(motion: MotionByMass, state: State, dt: float) -> State:
    """A copy of what has moved already."""
    end = State(state.time + dt, state.positions.copy(), state.velocities.copy())
    for i in range(len(end.positions)):
        end.positions[i] += dt * end.velocities[i]
    return State(end.time, end.positions.copy(), end.velocities)


def writes_into_the_given(motion: MotionByMass, state: State, dt: float) -> State:
    """The state that it was given is another afterwards."""
    for i in range(len(state.positions)):
        state.positions[i] += dt * state.velocities[i]
    return state


def asks_for_all(motion: MotionByMass, state: State, dt: float) -> State:
    """Euler."""
    return state + dt * motion.slope(state)


@pytest.mark.usefixtures("for_all")
@pytest.mark.parametrize(
    ("function", "reason"),
    [
        (looks_back, "another mass than the loop is at"),
        (copies_later, "copies whole arrays after its first loop"),
        (writes_into_the_given, "changes in place what it was given"),
        (asks_for_all, "asks for all accelerations"),
    ],
    ids=label,
)
def test_what_cannot_be_written_down_runs_as_written(function: Callable[..., State], reason: str) -> None:
    """And says why, to who asks."""
    scheme = Scheme(function, 1, "in_place")
    with pytest.raises(Untraceable, match=reason):
        trace_in_place(scheme)
    assert not is_by_loops(scheme, MESHES[2])


def test_a_row_is_read_when_it_is_used() -> None:
    """As NumPy's is, which is no copy: `slope_x = v[i]` is what v is later."""

    def without_copy(motion: MotionByMass, state: State, dt: float) -> State:
        end = State(state.time + dt, state.positions.copy(), state.velocities.copy())
        for i in range(len(end.positions)):
            v = end.velocities[i]
            end.velocities[i] += dt * motion.acceleration_of(i, end)
            end.positions[i] += dt * v
        return end

    without_copy.__annotations__["motion"] = MotionByMass
    scheme = Scheme(without_copy, 1, "in_place")
    assert in_place._trusted(scheme) is not None


def test_the_loop_that_is_printed_is_what_is_made() -> None:
    """Of Euler in place, line for line, but for the system's arguments."""
    documented = in_place.__doc__ or ""
    printed = textwrap.dedent(documented[documented.index("    for i in") : documented.index("What asks for")])
    text = trace_in_place(find("euler_in_place")).text
    made = textwrap.dedent(text[text.index("    for i in range(len(x)):") : text.index("    return w0")])
    assert printed.replace("...", ", ".join(in_place._GIVEN)).split() == made.split()
