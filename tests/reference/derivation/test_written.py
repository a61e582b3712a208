"""Thirty steppers as users write them: names and formulas of all, and the mistakes of ten, told as what they are.

The files stand in `written`. Each is given to the lab as any user's file, and run in this process.
"""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from engines.own.stepper import OwnStepper, own_stepper
from engines.process.isolation import in_this_process
from reference.derivation.explanation import Explanation, explain
from reference.derivation.updates import in_words
from reference.schemes.catalogue import find
from report.derived import name_line, property_lines

FOLDER = Path(__file__).parent / "written"

#: The right ones.
NAMES = {
    "adams.py": "adams_bashforth_2",
    "bogacki.py": "bogacki_shampine",
    "drift_kick_drift.py": "leapfrog_drift_kick_drift",
    "euler.c": "euler",
    "euler_in_loops.py": "euler",
    "heun_predictor.py": "heun",
    "implicit_by_newton.py": "backward_euler",
    "kick_drift.c": "kick_drift",
    "leapfrog.py": "leapfrog_kick_drift_kick",
    "midpoint_by_iteration.py": "implicit_midpoint",
    "midpoint_scaled.py": "explicit_midpoint",
    "positions_first.py": "drift_kick",
    "ralston_decimal.py": "ralston",
    "rk3_from_table.py": "rk3",
    "rk4.c": "rk4",
    "rk4_accumulated.py": "rk4",
    "ssp_convex.py": "ssprk3",
    "symplectic_by_forces.py": "kick_drift",
    "three_eighths.py": "rk4_three_eighths",
    "verlet_own_forces.py": "velocity_verlet",
}

#: The mistaken ones: what is said of each; and the order it has.
MISTAKES = {
    "bug_heun_weights.py": ("b1 is 2/3 where heun has 1/2, b2 is 1/3 where heun has 1/2", 1),
    "bug_heun_no_half.py": ("b1 is 1 where heun has 1/2, b2 is 1 where heun has 1/2", 0),
    "bug_rk4_third_stage.py": ("a31 is 1/2 where rk4 has 0, a32 is 0 where rk4 has 1/2", 2),
    "bug_rk4_last_half.py": ("a43 is 1/2 where rk4 has 1", 1),
    "bug_ralston_half.py": ("a21 is 1/2 where ralston has 2/3", 1),
    "bug_kutta.c": ("a31 is 1 where rk3 has -1", 1),
    "bug_kick_drift_twice.py": (
        "h^2 a1 in x at the end is 2 where kick_drift has 1, h a1 in v at the end is 2 where kick_drift has 1",
        0,
    ),
    "bug_verlet_dt_squared.py": (
        "h^2 a1 in x where a2 is taken is 1 where velocity_verlet has 1/2, "
        "h^2 a1 in x at the end is 1 where velocity_verlet has 1/2",
        1,
    ),
}


def explained(name: str) -> Explanation:
    """What is told of a file."""
    if name.endswith(".c") and shutil.which("cc") is None:
        pytest.skip("there is no C compiler")
    return explain(OwnStepper(own_stepper(str(FOLDER / name)).engine, isolate=in_this_process))


@pytest.mark.rotating(8)
@pytest.mark.parametrize("name", [n for n in NAMES if "newton" not in n])
def test_each_right_one_is_named(name: str) -> None:
    """By its run; and what is derived of it has the catalogue's order."""
    found = explained(name)
    assert found.identification.identified_as == NAMES[name]
    assert found.order == find(NAMES[name]).order
    assert found.remarks == ()


def test_one_that_solves_by_a_library_has_its_stages() -> None:
    """Backward Euler by SciPy's fsolve: its last point is its stage; a big system of it is left out, as it is slow."""
    from reference.derivation.implicit import tableau_by_points

    recording = OwnStepper(
        own_stepper(str(FOLDER / "implicit_by_newton.py")).engine, isolate=in_this_process
    ).recording()
    assert recording is not None
    solved = recording.solved
    assert solved is not None
    found = tableau_by_points(solved.start, solved.end, solved.h, solved.points, solved.slopes)
    assert found is not None
    assert (found.text()["a"], found.text()["b"]) == ([["1"]], ["1"])


@pytest.mark.rotating(7)
@pytest.mark.parametrize("name", MISTAKES)
def test_each_mistake_is_told_as_what_it_is(name: str) -> None:
    """No name, another order, and the number that is wrong beside the right one."""
    words, order = MISTAKES[name]
    found = explained(name)
    assert found.identification.identified_as is None
    assert found.nearest == words
    assert found.order == order


@pytest.mark.rotating(2, in_turn=True)
def test_times_that_do_not_go_along_are_told() -> None:
    """RK4 that always tells its slopes the time at the start: on these forces it is RK4, on others it is not."""
    found = explained("bug_rk4_time.py")
    assert found.identification.identified_as == "rk4"
    told = [(2, "1/2"), (3, "1/2"), (4, "1")]
    assert found.remarks == tuple(
        f"slope {i} is taken {c} of a step on, and is told the time 0 of it on" for i, c in told
    )
    assert "where slopes do not depend on time" in name_line(found)
    assert any(line.startswith("Order 4 where slopes do not depend on time,") for line in property_lines(found))


@pytest.mark.rotating(2, in_turn=True)
def test_damping_at_the_wrong_velocity_is_told() -> None:
    """Velocity Verlet whose second force takes the old velocity: the same without damping, of lower order with it."""
    found = explained("bug_verlet_damping.py")
    assert found.identification.identified_as is None
    assert found.nearest.startswith("h a1 in v where a2 is taken is 0 where ")
    assert found.follows is not None
    assert (found.follows.undamped_order, found.follows.order) == (2, 1)
    assert found.updates is not None
    assert in_words(found.updates)[1] == "a2 = acceleration(x + h v + h^2 a1/2, v)"


def test_there_are_thirty() -> None:
    """Twenty right ones, ten with a mistake, and none that is not tried."""
    files = {file.name for file in FOLDER.iterdir() if file.suffix in (".py", ".c")}
    assert files == {*NAMES, *MISTAKES, "bug_rk4_time.py", "bug_verlet_damping.py"}
    assert (len(NAMES), len(files)) == (20, 30)
