"""The page's code in Node ends in the reference's bits: positions and velocities after every step."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace

import numpy as np
import pytest

from reference.changes import Change
from reference.drives import Ramp, Sine
from reference.errors import SolverError
from reference.lengths import spring_lengths
from reference.outcome import first_blown_up_frame
from reference.scenes import Setup
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.simulate import simulate
from reference.springs.kinds import NonlinearSprings
from reference.state import Array
from reference.system import MassSpringSystem
from report.browser.changes import MOST_CHANGES, changes_data, drives_data
from report.browser.lab_page import physics
from report.browser.programs import page_schemes
from report.browser.system_data import system_data
from tests.report.browser.node import ask, doubles
from tests.report.browser.systems import random_system, with_masses_together, with_random_kinds

STEPS = 40

#: Of the random systems, those that are run each time; one of them blows up.
SEEDS = range(9)


def of_reference(
    system: MassSpringSystem, name: str, dt: float, changes: Sequence[Change] = (), steps: int = STEPS
) -> Array:
    """Positions and velocities after each step, a row for each, up to the first that is not finite."""
    run = simulate(system, find(name), dt, steps * dt, changes)
    parts = [q[1:].reshape(len(run) - 1, -1) for q in (run.positions, run.velocities)]
    return np.concatenate(parts, axis=1)


def same_bits(one: Array, other: Array) -> bool:
    """The sign of zero included; of numbers that are none, that both are none."""
    bits = np.ascontiguousarray(one).view(np.uint64) == np.ascontiguousarray(other).view(np.uint64)
    return bool((bits | (np.isnan(one) & np.isnan(other))).all())


#: Schemes that add, multiply and divide alone end in the reference's bits. Those that solve equations, or take
#: exponential functions, may have another order of sums, or another last digit.
SOLVING = tuple(name for name, one in page_schemes().items() if one.scheme.implicit)
SOLVING = (*SOLVING, "drift_kick_sequential_damping", "kick_drift_exponential_drag")
EXACT = tuple(name for name in page_schemes() if name not in SOLVING)

#: How near those come in so many steps of at most so long [s], as a part of the largest position and velocity.
NEAR, FEW_STEPS, MOST_DT = 1e-12, 5, 0.02


def compared(
    seeds: Sequence[int], text: str = "", kinds: bool = False, names: Sequence[str] = EXACT, together: bool = False
) -> list[bool]:
    """Of every system and scheme, whether the page ends in the reference's bits.

    Args:
        kinds: springs that are not linear.
        together: masses that some springs of rest length 0 begin with in one place.
    """
    asked, expected = [], []
    for seed in seeds:
        system, dt = random_system(seed)
        if kinds:
            system = with_random_kinds(system, seed)
        if together:
            system = with_masses_together(system)
        for name in names:
            question = {"ask": "run", "system": system_data(system), "scheme": name, "dt": dt, "steps": STEPS}
            asked.append(question)
            expected.append(of_reference(system, name, dt))
    answers = [doubles(answer).reshape(STEPS, -1) for answer in ask(asked, text)]
    return [same_bits(page[: len(own)], own) for page, own in zip(answers, expected, strict=True)]


def test_all_schemes_of_the_page_end_in_the_reference_s_bits(request: pytest.FixtureRequest) -> None:
    """Random meshes in one to three dimensions, with damping, drag, fixed masses and obstacles, up to blow-up.

    Both compute in IEEE doubles, in one order, and + - * / and square roots are rounded alike: no tolerance.
    """
    assert all(compared(range(200) if request.config.getoption("--full") else SEEDS))


@pytest.mark.rotating(4, in_turn=True)
def test_springs_that_are_not_linear_end_in_the_reference_s_bits(request: pytest.FixtureRequest) -> None:
    """Ropes, struts, springs that harden, yield and break, mixed in the same systems: no tolerance, as above."""
    assert all(compared(range(200) if request.config.getoption("--full") else range(4), kinds=True))


@pytest.mark.rotating(7, in_turn=True)
def test_springs_of_rest_length_0_end_in_the_reference_s_bits() -> None:
    """Also where they have no length: shown to fail where what has no direction is divided by nothing."""
    assert all(compared(range(6), together=True, kinds=True))
    text = physics()
    wrong = text.replace(" === 0.0) ? 1.0", " === 0.0) ? 0.0")
    assert wrong != text
    assert not all(compared(range(3), wrong, names=("euler", "rk4"), together=True))


@pytest.mark.rotating(4, in_turn=True)
@pytest.mark.parametrize(
    ("right", "wrong"),
    [("(stretch < 0)", "(stretch > 0)"), ("(largest_force / Math.abs(stretch))", "0"), ("found.push(j)", "0")],
    ids=["a rope that pushes", "what yields is gone", "nothing breaks"],
)
def test_another_law_is_seen(right: str, wrong: str) -> None:
    """Shown to fail: each on the systems that the page's own text passes."""
    assert right in physics()
    assert not all(compared(range(3), physics().replace(right, wrong), True, ("euler", "rk4")))


def apart(seeds: Sequence[int], text: str = "", kinds: bool = False) -> dict[str, float]:
    """By how much schemes that solve equations are off at most, as a part of the largest number of the run."""
    asked, expected = [], []
    for seed in seeds:
        system, dt = random_system(seed)
        system = with_random_kinds(system, seed) if kinds else system
        dt = min(dt, MOST_DT)
        for name in SOLVING:
            with suppress(SolverError):  # springs that go slack between two states: it is told, here as there
                expected.append((name, of_reference(system, name, dt, steps=FEW_STEPS)))
                question = {"ask": "run", "system": system_data(system), "scheme": name, "dt": dt}
                asked.append({**question, "steps": FEW_STEPS})
    most: dict[str, float] = dict.fromkeys(SOLVING, 0.0)
    for answer, (name, own) in zip(ask(asked, text), expected, strict=True):
        page, half = doubles(answer).reshape(FEW_STEPS, -1), own.shape[1] // 2
        for part in (slice(0, half), slice(half, 2 * half)):
            scale = np.abs(own[:, part]).max() or 1.0
            most[name] = max(most[name], float(np.abs(page[:, part] - own[:, part]).max() / scale))
    return most


@pytest.mark.rotating(4, in_turn=True)
@pytest.mark.parametrize("kinds", [False, True], ids=["linear", "kinds"])
def test_schemes_that_solve_equations_agree_to_rounding(request: pytest.FixtureRequest, kinds: bool) -> None:
    """Newton's method and the solvers end where the reference's end: LAPACK's order of sums is its own."""
    most = apart(range(100) if request.config.getoption("--full") else range(8), kinds=kinds)
    assert max(most.values()) < NEAR, most


@pytest.mark.rotating(4, in_turn=True)
def test_a_derivative_that_is_wrong_is_seen() -> None:
    """Shown to fail: the damping of springs, and a Newton's method that stops a round early."""
    text = physics()
    for right, wrong in (
        ("damping.data[j], made, d * d * j)", "0, made, d * d * j)"),
        ("nd.times(1e-09, nd.abs(velocities).max())", "nd.times(1e9, nd.abs(velocities).max())"),
    ):
        right = right.replace("damping.data", "coefficients.data")
        assert right in text
        assert max(apart(range(3), text.replace(right, wrong)).values()) > 1e3 * NEAR


@pytest.mark.rotating(4, in_turn=True)
def test_a_large_system_is_solved_by_iteration_and_by_elimination_alike() -> None:
    """A cloth of 192 coordinates: short steps are iterated, and where no iteration is allowed, eliminated."""
    system = find_scene("cloth").system({"rows": 8, "columns": 8, "damping": 0.05})
    question = {"ask": "run", "system": system_data(system), "scheme": "backward_euler", "dt": 1e-3, "steps": 3}
    never = physics().replace('"ROUNDS": 40', '"ROUNDS": 0')
    assert never != physics()
    expected = of_reference(system, "backward_euler", 1e-3, steps=3)
    for text in (physics(), never):
        (answer,) = ask([question], text)
        off = np.abs(doubles(answer).reshape(3, -1) - expected).max(axis=0)
        assert off.max() < NEAR * np.abs(expected).max()


def test_a_step_without_a_solution_is_told() -> None:
    """Backward Euler of 20 s on springs of all kinds: the reference raises, the page's run says so."""
    system = with_random_kinds(random_system(3)[0], 3)
    with pytest.raises(SolverError):
        of_reference(system, "backward_euler", 20.0, steps=3)
    question = {"ask": "blown", "system": system_data(system), "scheme": "backward_euler", "dt": 20.0, "steps": 3}
    (answer,) = ask([{**question, "at_once": 3}])
    assert answer["what"] == "unsolved"


@pytest.mark.rotating(4, in_turn=True)
def test_one_rounding_more_is_seen() -> None:
    """Shown to fail: a square root that is off by its last bit."""
    wrong = physics().replace("= Math.sqrt(", "= 1.0000000000000002 * Math.sqrt(")
    assert not all(compared(range(3), wrong))


def test_some_of_the_random_systems_blow_up() -> None:
    """And so the last states, where forces are infinite, are compared too."""
    systems = [random_system(seed) for seed in SEEDS]
    ends = [of_reference(system, "rk4", dt)[-1] for system, dt in systems]
    assert any(not np.isfinite(end).all() for end in ends)


def test_when_and_where_it_blows_up_hangs_on_no_number_of_steps_at_once() -> None:
    """Euler on the string: the spring beyond 100 times its length, and the step, are the reference's in any batches."""
    setup = find_scene("string").setup({}, 2e-3, 1.0)
    run = simulate(setup.system, find("euler"), setup.dt, 1.0)
    frame = first_blown_up_frame(setup.system, run)
    lengths = spring_lengths(run.positions[[0, frame]], setup.system.springs)
    which = int(np.argmax(lengths[1] > 100 * np.maximum(lengths[0], setup.system.rest_lengths)))
    asked = {"ask": "blown", "system": system_data(setup.system), "scheme": "euler", "dt": setup.dt, "steps": 400}
    answers = ask([{**asked, "at_once": batch} for batch in (1, 7, 16, 400)])
    assert answers == [{"steps": frame, "what": "spring", "which": which}] * 4


def test_random_systems_blow_up_at_the_reference_s_steps() -> None:
    """The first frame that `blow_up` tells of, in long steps, with springs of all kinds: the same, or none in both."""
    asked, expected = [], []
    for seed in (*range(30), 87, 103, 168):  # of the last three a mass is flung away
        system = with_random_kinds(random_system(seed)[0], seed)
        dt = float(np.random.default_rng(seed).uniform(0.02, 0.3))
        run = simulate(system, find("heun"), dt, STEPS * dt)
        frame = first_blown_up_frame(system, run)
        expected.append(frame if frame < len(run) else STEPS)
        question = {"ask": "blown", "system": system_data(system), "scheme": "heun", "dt": dt, "steps": STEPS}
        asked.append({**question, "at_once": STEPS})
    answers = ask(asked)
    assert [answer["steps"] for answer in answers] == expected
    assert {answer.get("what") for answer in answers} >= {None, "spring", "distance", "energy"}


def test_changes_on_the_fly_act_on_the_same_steps() -> None:
    """Each of the parameters, one number for all, and masses that are held and let go (slide 12)."""
    system, _ = random_system(3)
    system = replace(system, obstacles=(), fixed=np.zeros(len(system.masses), dtype=bool))
    changes = [
        Change(0.0, "stiffness", 120.0),
        Change(0.003, "mass", 0.05),
        Change(0.0105, "gravity", 3.7),
        Change(0.011, "rest_length", 0.4),
        Change(0.02, "damping", 0.3),
        Change(0.02, "drag", 0.1),
        Change(0.025, "hold", (1.0,)),
        Change(0.03, "release", (1.0,)),
        Change(0.032, "break", (0.0,)),
        Change(0.034, "stiffness", 90.0),  # not of what is gone
    ]
    question = {"ask": "run", "system": system_data(system), "scheme": "heun", "dt": 1e-3, "steps": STEPS}
    (answer,) = ask([{**question, "changes": changes_data(changes)}])
    expected = of_reference(system, "heun", 1e-3, changes)
    assert same_bits(doubles(answer).reshape(STEPS, -1), expected)


@pytest.mark.parametrize("scene", ["crossing", "earthquake"])
def test_what_is_driven_acts_on_the_same_steps(scene: str) -> None:
    """A truck that crosses (slide 28) and ground that shakes (slide 29): at the scene's own dt, to the bit."""
    setup = find_scene(scene).setup({}, None, 0.3)
    drives = drives_data(setup)
    assert changes_data(setup.changes) == []
    question = {
        "ask": "run",
        "system": system_data(setup.system),
        "scheme": "heun",
        "dt": setup.dt,
        "steps": setup.steps,
    }
    with_it, without = (doubles(a) for a in ask([{**question, "drives": drives}, question]))
    expected = of_reference(setup.system, "heun", setup.dt, setup.changes, setup.steps)
    assert same_bits(with_it.reshape(setup.steps, -1), expected)
    assert not same_bits(without.reshape(setup.steps, -1), expected)


def breaking_line(drive: Ramp | Sine) -> Setup:
    """Three masses below one another, of which the lowest breaks off at once, and what drives all springs."""
    system = MassSpringSystem(
        positions=np.array([[0.0, 0.0], [0.0, -0.5], [0.0, -1.0]]),
        springs=np.array([[0, 1], [1, 2]]),
        masses=np.array([0.2]),
        rest_lengths=np.array([0.5]),
        stiffness=np.array([50.0]),
        damping=np.array([0.05]),
        drag=0.01,
        fixed=np.array([True, False, False]),
        nonlinear=NonlinearSprings(breaking_force=np.array([np.inf, 0.5])),
    )
    return Setup("line", system, 4e-3, 0.8, tuple(drive.changes(system, 4e-3, 0.8)))


@pytest.mark.rotating(5)
@pytest.mark.parametrize("name", ["damping", "stiffness", "rest_length", "mass", "drag", "gravity"])
def test_no_ramp_and_no_sine_brings_a_broken_spring_back(name: str) -> None:
    """Of each parameter, at every step from 0.3 s on, when a spring is gone: to the bit.

    Of damping and stiffness it is shown to fail: where a table's numbers are taken as they stand, broken springs damp.
    """
    drives = (Ramp(name, 0.3, 0.8, 0.9), Sine(name, 0.3, 0.004, 4.0))
    setups = [breaking_line(drive) for drive in drives]
    asked = []
    for setup in setups:
        question = {"ask": "run", "system": system_data(setup.system), "scheme": "heun", "dt": setup.dt}
        asked.append({**question, "steps": setup.steps, "drives": drives_data(setup)})
    wrong = physics().replace("    breakSprings(memory, []);\n    memory.most = null;", "    memory.most = null;")
    as_it_stands = ask(asked, wrong)
    for setup, right, other in zip(setups, ask(asked), as_it_stands, strict=True):
        assert len(setup.changes) > MOST_CHANGES  # so it is a table
        expected = of_reference(setup.system, "heun", setup.dt, setup.changes, setup.steps)
        assert expected[-1, 5] < -1.5 < expected[-1, 3]  # the lowest mass has fallen, what held it has not
        assert same_bits(doubles(right).reshape(setup.steps, -1), expected)
        gone = same_bits(doubles(other).reshape(setup.steps, -1), expected)
        assert gone == (name not in ("damping", "stiffness"))


@pytest.mark.rotating(4, in_turn=True)
def test_at_another_dt_what_is_driven_is_off_by_straight_lines_between_the_middles_of_steps() -> None:
    """Ground that shakes at 0.5 to 5 Hz, a table of h = 1 ms, steps of 0.4 ms.

    A sine of angular frequency w is off by at most (w h)^2 / 8 of its amplitude, here 1.2e-4, and the sway, which is
    linear in the ground's motion, by that of its own largest value. A table that lags by a step is off by far more.
    """
    setup, finer = (find_scene("earthquake").setup({}, dt, 1.0) for dt in (None, 4e-4))
    (table,) = drives_data(setup)
    values = np.frombuffer(base64.b64decode(table["rows"]))
    late = base64.b64encode(np.concatenate([values[:1], values[:-1]]).tobytes()).decode()
    asked = {"ask": "run", "system": system_data(finer.system), "scheme": "rk4", "dt": finer.dt, "steps": finer.steps}
    tables = ({"drives": [table]}, {"drives": [{**table, "rows": late}]})
    runs = [doubles(answer).reshape(finer.steps, -1) for answer in ask([{**asked, **one} for one in tables])]
    places = slice(0, finer.system.positions.size)
    expected = of_reference(finer.system, "rk4", finer.dt, finer.changes, finer.steps)[:, places]
    sway = np.abs(expected - finer.system.positions.ravel()).max()
    off, off_late = (np.abs(run[:, places] - expected).max() / sway for run in runs)
    assert off <= 1.2e-4 < off_late
