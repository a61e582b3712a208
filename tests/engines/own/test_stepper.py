"""Files and functions of users' own: the forms they are written in, and what is said of broken ones."""

from __future__ import annotations

import codecs
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from engines.capability_cases import for_each_capability
from engines.own import stepper as own
from engines.own.stepper import OwnStepper, is_own, own_stepper, stepper_of
from engines.own.system import BESIDES
from engines.process.isolation import in_this_process
from reference.collisions.round_masses import Collisions
from reference.errors import InputError
from reference.scenes import find as find_scene
from reference.springs.breaking import breaks_of
from reference.state import Array
from reference.stepper import catalogued
from tests.reference.systems import moving_string

STRING = moving_string(3, damping=0.4, drag=0.05)
DT, STEPS = 1e-3, 20

#: Forms, and the scheme each is. Heun and kick-drift are written as people would.
FORMS = {
    "heun": """
def step(f, y, t, dt):
    k1 = f(y, t)
    k2 = f(y + dt * k1, t + dt)
    return y + dt / 2 * (k1 + k2)
""",
    "rk4": """
def rk4(h, y, t, fun):
    k1 = fun(t, y)
    k2 = fun(t + h / 2, y + h / 2 * k1)
    k3 = fun(t + h / 2, y + h / 2 * k2)
    k4 = fun(t + h, y + h * k3)
    return y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
""",
    "kick_drift": """
import numpy as np

def step(x, v, dt, system):
    m = system.masses[:, None]
    force = m * system.gravity - system.drag * v
    for (a, b), k, c, rest in zip(system.springs, system.stiffness, system.damping, system.rest_lengths):
        d = x[b] - x[a]
        u = d / np.sqrt(d @ d)
        pull = (k * (np.sqrt(d @ d) - rest) + c * (v[b] - v[a]) @ u) * u
        force[a] += pull
        force[b] -= pull
    v = v + dt * force / m
    return x + dt * v, v
""",
    "drift_kick": """
def step(a, x, v, dt):
    x = x + dt * v
    return x, v + dt * a(x, v)
""",
    "euler": """
def step(x, v, dt, system):
    acc = system.acceleration(x, v)
    return x + dt * v, v + dt * acc
""",
}


def here(file: Path, text: str) -> OwnStepper:
    """A file's stepper, run in this process: its own process has tests below."""
    file.write_text(text, encoding="utf-8")
    found = own_stepper(str(file))
    return OwnStepper(found.engine, isolate=in_this_process)


def apart(one: Array, two: Array) -> float:
    """The largest difference."""
    return float(np.abs(one - two).max())


@pytest.mark.parametrize("name", FORMS)
def test_every_form_steps_as_the_scheme_it_is(name: str, tmp_path: Path) -> None:
    """The same scheme of the catalogue, to the rounding of some steps of a string with damping and drag."""
    run = here(tmp_path / "mine.py", FORMS[name]).run(STRING, DT, STEPS).trajectory
    scheme = catalogued()[name].run(STRING, DT, STEPS).trajectory
    assert run is not None
    assert scheme is not None
    assert apart(run.positions, scheme.positions) < 1e-13
    other = catalogued()["velocity_verlet"].run(STRING, DT, STEPS).trajectory
    assert other is not None
    assert apart(run.positions, other.positions) > 1e-11


@pytest.mark.parametrize("asked", [*BESIDES, "breaking", "collisions", "restitution"])
def test_the_forces_of_the_lab_are_all_forces_of_a_scene(asked: str, tmp_path: Path) -> None:
    """Slopes and accelerations of laws, angular springs and pulls, breaking and collisions: as the scheme steps.

    To the rounding of some steps. Where there is more to a force than stiffness, one who reads that is refused.
    """
    system, thrown = (for_each_capability()[name] for name in (asked, "breaking"))
    system = replace(system, velocities=thrown.velocities)
    if system.collisions:
        system = replace(system, collisions=Collisions(np.array(0.06), system.collisions.restitution))
    for name in ("heun", "drift_kick", "euler"):
        outcome = here(tmp_path / f"{name}.py", FORMS[name]).run(system, DT, STEPS)
        scheme = catalogued()[name].run(system, DT, STEPS).trajectory
        assert outcome.trajectory is not None, outcome.reason
        assert scheme is not None
        assert apart(outcome.trajectory.positions, scheme.positions) < 1e-12
    without = replace(system, nonlinear=None, pulls=np.zeros(1), angular_springs=None, collisions=None)
    plain = catalogued()["euler"].run(without, DT, STEPS).trajectory
    assert plain is not None
    assert apart(scheme.positions, plain.positions) > 1e-9
    own_forces = here(tmp_path / "own.py", FORMS["kick_drift"]).run(system, DT, STEPS)
    assert own_forces.ending == ("unsupported" if asked in BESIDES else "done")
    assert asked not in BESIDES or "own.py, line 7 asks for system.springs" in own_forces.reason


def test_forces_of_its_own_leave_out_springs_that_broke(tmp_path: Path) -> None:
    """They are given a system without: k = c = 0. As kick-drift steps it, to rounding."""
    system = for_each_capability()["breaking"]
    mine = here(tmp_path / "mine.py", FORMS["kick_drift"]).run(system, DT, STEPS).trajectory
    scheme = catalogued()["kick_drift"].run(system, DT, STEPS).trajectory
    assert mine is not None
    assert scheme is not None
    assert apart(mine.positions, scheme.positions) < 1e-12
    assert breaks_of(system, scheme, DT)


def test_a_file_runs_in_a_process_of_its_own(tmp_path: Path) -> None:
    """By its name, with its function; and a crash of it is an outcome."""
    file = tmp_path / "two.py"
    file.write_text(FORMS["euler"] + "\ndef dead(x, v, dt, system):\n    import os\n    os._exit(3)\n")
    assert own_stepper(str(file)).run(STRING, DT, 3).ending == "done"
    stepper = own_stepper(f"{file}:dead")
    assert stepper.name == "two.py:dead"
    assert stepper.run(STRING, DT, 3).ending == "crashed"


@pytest.mark.rotating(2)
def test_a_hang_is_ended(tmp_path: Path) -> None:
    """After its time limit."""
    file = tmp_path / "hang.py"
    file.write_text("def step(x, v, dt, system):\n    while True:\n        pass\n")
    outcome = OwnStepper(own_stepper(str(file)).engine, time_limit=1.0).run(STRING, DT, 3)
    assert (outcome.ending, outcome.reason) == ("timed out", "no answer within 1 s")


#: Broken files, and what each is said to be.
BROKEN = {
    "return 1 / 0, v": "mine.py, line 2: ZeroDivisionError: division by zero",
    "return": "mine.py returns nothing: a return is missing",
    "return x": "mine.py returns an array of float64 of shape (4, 2): expected positions and velocities",
    "return x[0], v": "mine.py returns positions of shape (2,): expected (4, 2)",
    "return x + 0j, v": "mine.py returns an array of complex128 of shape (4, 2) for positions: expected real numbers",
    "return 'x', v": "mine.py returns a str for positions: expected real numbers",
    "return x, v, dt": "mine.py returns 3 things: expected positions and velocities",
}


@pytest.mark.parametrize("line", BROKEN)
def test_a_broken_file_is_told_in_a_line(line: str, tmp_path: Path) -> None:
    """What it does, and where."""
    stepper = here(tmp_path / "mine.py", f"def step(x, v, dt, system):\n    {line}\n")
    outcome = stepper.run(STRING, DT, 3)
    assert (outcome.ending, outcome.reason) == ("crashed", BROKEN[line])


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("def step(x, v, dt, system):\n    x += dt * v\n    return x, v\n", "changes"),
        ("import random\ndef step(x, v, dt, system):\n    return x, v + random.random()\n", "random"),
        ("seen = []\ndef step(x, v, dt, system):\n    seen.append(1)\n    return x, v + len(seen)\n", "remembers"),
        ("def step(x, v, dt, system):\n    return x + dt * v, v\n", None),
    ],
)
def test_what_a_step_should_not_do_is_told(text: str, word: str | None, tmp_path: Path) -> None:
    """By name; nothing of one that does none of it."""
    remarks = here(tmp_path / "mine.py", text).remarks()
    assert len(remarks) == (word is not None)
    assert word is None or word in remarks[0]


@pytest.mark.parametrize(
    ("form", "written"),
    [
        ("f, y, t, dt", "y"),
        ("a, x, v, dt", "x"),
        ("a, x, v, dt", "v"),
        ("x, v, dt, system", "x"),
        ("x, v, dt, system", "v"),
        ("x, v, dt, string", "x"),
        ("x, v, dt, string", "v"),
    ],
)
def test_who_writes_into_what_it_is_given_is_told_in_every_form(form: str, written: str, tmp_path: Path) -> None:
    """Each array that a form has: what is written into is a copy, so that it can be told and no state is another."""
    end = "y" if written == "y" else "(x, v)"
    text = f"def step({form}):\n    {written}[...] += 1.0\n    return {end}\n"
    assert here(tmp_path / "mine.py", text).remarks() == (
        "mine.py changes the arrays it is given: it was given copies",
    )
    assert here(tmp_path / "mine.py", text.replace("+=", "==")).remarks() == ()


@pytest.mark.parametrize(
    ("text", "word", "said"),
    [
        ("x = 1\n", "", "expected a function step, it has none"),
        ("\nstep = lambda f, y, t, dt: y\n", "", ", line 2: step is a lambda: expected def step(...)"),
        ("step = other = 1\n", ":other", ", line 1: other is a variable: expected def other(...)"),
        ("class step:\n    pass\n", "", ", line 1: step is a class: expected def step(...)"),
        ("async def step(f, y, t, dt):\n    return y\n", "", ", line 1: step is an async function: expected def step"),
        (
            "def step(f, y, *, dt, t=0):\n    return y\n",
            "",
            ", line 1: step takes dt after a star, by name only: expected them before it",
        ),
        ("def step(:\n", "", "line 1: expected Python"),
        ("def step(foo, bar):\n    pass\n", "", "expected step(x, v, dt, system)"),
        (FORMS["euler"] + FORMS["rk4"], ":stp", "unknown function of mine.py 'stp': did you mean 'step'?"),
        (FORMS["rk4"] + FORMS["rk4"].replace("def rk4", "def two"), "", "unknown function of mine.py 'step'"),
        (FORMS["euler"], ":stp", "unknown function of mine.py 'stp': did you mean 'step'?"),
    ],
)
def test_what_is_no_stepper_is_refused(text: str, word: str, said: str, tmp_path: Path) -> None:
    """Before anything runs."""
    file = tmp_path / "mine.py"
    file.write_text(text)
    with pytest.raises(InputError) as refused:
        own_stepper(f"{file}{word}")
    assert said in str(refused.value)
    with pytest.raises(InputError, match="expected a file that can be read"):
        own_stepper(str(tmp_path / "nothing.py"))


def test_a_file_that_begins_with_a_mark_is_read_as_python_does(tmp_path: Path) -> None:
    """Editors on Windows begin UTF-8 with one, and end lines with two characters."""
    file = tmp_path / "mine.py"
    file.write_bytes(codecs.BOM_UTF8 + FORMS["euler"].replace("\n", "\r\n").encode())
    assert own_stepper(str(file)).name == "mine.py"


def test_which_names_are_files() -> None:
    """Those that end like one, perhaps with a function."""
    assert is_own("a.py") and is_own("b/c.py:d") and is_own("e.c")  # noqa: PT018
    assert not is_own("heun") and not is_own("sweeps(rounds=3)")  # noqa: PT018


def test_of_a_function_those_parameters_count_that_have_no_default() -> None:
    """Others are its own, and so is what it takes besides by any name."""

    def step(x, v, dt, system, gain=2.0, **more):  # type: ignore[no-untyped-def]
        return x + dt * v, v + gain / 2 * dt * system.acceleration(x, v)

    run = stepper_of(step).run(STRING, DT, STEPS).trajectory
    euler = catalogued()["euler"].run(STRING, DT, STEPS).trajectory
    assert run is not None
    assert euler is not None
    assert np.array_equal(run.positions, euler.positions)


def test_a_function_of_this_process_is_a_stepper() -> None:
    """As in a notebook, and in the exercises' form: one mass, by its height."""

    def step(y, v, dt, spring):  # type: ignore[no-untyped-def]
        a = (-spring.stiffness * (y + spring.rest_length) - spring.damping * v) / spring.mass - spring.gravity
        return y + dt * v, v + dt * a

    system = find_scene("spring").system({"damping": 0.2})
    run = stepper_of(step).run(system, DT, STEPS).trajectory
    euler = catalogued()["euler"].run(system, DT, STEPS).trajectory
    assert run is not None
    assert euler is not None
    assert apart(run.positions, euler.positions) < 1e-14
    assert stepper_of(step).run(STRING, DT, 2).ending == "unsupported"


C_FILE = """
#include "springlab.h"
static int calls = 0;
void step(double *y, int n, double t, double h)
{
    double k1[n], k2[n], w[n];
    calls++;
    slope(y, t, k1);
    for (int i = 0; i < n; i++) w[i] = y[i] + h * k1[i];
    slope(w, t + h, k2);
    for (int i = 0; i < n; i++) y[i] += h / 2 * (k1[i] + k2[i]) BUG;
}
"""


@pytest.mark.skipif(shutil.which("cc") is None, reason="there is no C compiler")
def test_a_c_file_is_a_stepper(tmp_path: Path) -> None:
    """Heun in C; what is static in it begins anew with each run, and what does not compile is told by its line."""
    heun = catalogued()["heun"].run(STRING, DT, STEPS).trajectory
    assert heun is not None
    stepper = here(tmp_path / "mine.c", C_FILE.replace("BUG", ""))
    run = stepper.run(STRING, DT, STEPS).trajectory
    assert run is not None
    assert apart(run.positions, heun.positions) < 1e-13
    assert stepper.remarks() == ()
    remembers = here(tmp_path / "counts.c", C_FILE.replace("BUG", "+ (calls > 1)"))
    assert "remembers earlier calls" in remembers.remarks()[0]
    outcome = here(tmp_path / "bad.c", C_FILE.replace("BUG", "+ nothing")).run(STRING, DT, 1)
    assert outcome.ending == "crashed"
    assert outcome.reason.startswith("bad.c, line 11: ")
    assert own.SUFFIXES == (".py", ".c")


def test_who_writes_into_what_was_read_changes_no_run() -> None:
    """Positions and velocities are handed out as copies, as every engine does."""

    def step(x, v, dt, system):  # type: ignore[no-untyped-def]
        return x + dt * v, v

    running = stepper_of(step).engine.start(STRING, DT)
    running.step()
    before = [array.tolist() for array in running.state()]
    for array in running.state():
        array[...] = 99.0
    assert [array.tolist() for array in running.state()] == before
