"""What `import springlab` answers: arrays of the right shapes, the commands' numbers, and how it is shown."""

from __future__ import annotations

import inspect
import json
import sys
from dataclasses import FrozenInstanceError
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import springlab as lab
from click.testing import CliRunner
from PIL import Image

from report.commands.main import springlab as command_line
from tests.report.html import Page

#: A string that is quickly run.
QUICK: dict[str, Any] = {"masses": 4, "duration": 0.05}
WORDS = ["string", "--set", "masses=4", "--duration", "0.05"]


@pytest.fixture(scope="module")
def compared() -> lab.Comparison:
    """Two schemes and an engine."""
    return lab.compare("string", "heun", ["euler", "mujoco_tendons"], **QUICK)


@pytest.fixture(scope="module")
def simulated() -> lab.Simulation:
    """A string with damping that is stiffer from the middle on."""
    return lab.simulate("string", "rk4", changes=[(0.025, "stiffness", 400.0)], damping=0.1, **QUICK)


def said(*words: str) -> Any:
    """What a command prints with --json."""
    done = CliRunner().invoke(command_line, [*words, "--json"], catch_exceptions=False)
    return json.loads(done.stdout)


def test_every_public_function_has_an_example_but_those_that_write() -> None:
    """They are run by tests/test_examples.py; a name in them that is no more fails there."""
    functions = {name: getattr(lab, name) for name in lab.__all__ if inspect.isfunction(getattr(lab, name))}
    without = {name for name, function in functions.items() if ">>>" not in (function.__doc__ or "")}
    assert without == {"report"}
    assert {"simulate", "compare", "identify", "stability", "modes", "scene", "system"} <= functions.keys()


def test_a_comparison_has_arrays_of_every_step_and_the_commands_numbers(compared: lab.Comparison) -> None:
    """51 states of 5 masses in the plane (one holds the string); documents are what the command prints."""
    run = compared["mujoco_tendons"]
    assert run.positions.shape == run.velocities.shape == (51, 5, 2)
    assert compared.true_positions is not None
    assert run.error == pytest.approx(np.linalg.norm(run.positions - compared.true_positions, axis=2).max(axis=1))
    assert (run.outcome, run.reason, run.identified_as) == ("done", "", "kick_drift")
    assert run.deviation is not None
    assert run.deviation.max() < 1e-13
    words = ["--stepper", "heun", "--stepper", "euler", "--stepper", "mujoco_tendons"]
    assert compared.document == said("compare", *WORDS, *words)


def test_a_simulation_has_forces_stretches_and_energies_of_every_step(simulated: lab.Simulation) -> None:
    """By the law of the spring, k (length - rest length) + c times the rate; k is another one from the change on."""
    run = simulated["rk4"]
    system = simulated.scene.system
    a, b = system.springs.T
    between = run.positions[:, b] - run.positions[:, a]
    length = np.linalg.norm(between, axis=2)
    assert run.stretches == pytest.approx(length - system.rest_lengths)
    rate = ((run.velocities[:, b] - run.velocities[:, a]) * between).sum(axis=2) / length
    stiffness = np.where(run.times > 0.025 + 1e-9, 400.0, system.stiffness[0])[:, None]
    assert run.spring_forces == pytest.approx(stiffness * run.stretches + 0.1 * rate)
    kinetic = 0.5 * (system.masses[:, None] * run.velocities**2).sum(axis=(1, 2))
    assert run.energies["kinetic"] == pytest.approx(kinetic)
    words = ["--set", "damping=0.1", "--change", "0.025:stiffness=400", "--stepper", "rk4"]
    assert simulated.document == said("simulate", *WORDS, *words)


def test_other_answers_have_the_commands_numbers() -> None:
    """Which scheme, which modes, up to which dt."""
    found = lab.identify("pymunk_springs", damping=0.5, **QUICK)
    told = said("identify", "pymunk_springs", *WORDS, "--set", "damping=0.5")
    assert (found.identified_as, list(found.ties), found.error) == (
        told["identified_as"],
        told["ties"],
        told["error_m"],
    )
    modes = lab.modes("string", masses=4)
    assert modes.document == said("modes", *WORDS)
    assert modes.shapes.shape == (8, 5, 2)
    assert lab.modes("string", masses=4, lowest=1).frequencies == pytest.approx(modes.frequencies[:1])
    limits = lab.stability("oscillator", "kick_drift", "euler")
    assert limits.predicted["euler"] is None
    assert limits.measured["kick_drift"] == pytest.approx(limits.predicted["kick_drift"], rel=1e-3)


def test_what_is_derived_is_told_in_words_and_numbers() -> None:
    """Heun's tableau and step, as the command has them; its page is drawn."""
    found = lab.explain("heun")
    assert found.document == said("explain", "heun")
    assert (found.identified_as, found.order) == ("heun", 2)
    assert "Butcher tableau" in str(found)
    assert found._repr_html_().startswith("<pre>")
    assert found.plot().alt


def test_a_file_of_ones_own_is_a_stepper_and_what_it_should_not_do_is_warned_of(tmp_path: Path) -> None:
    """Heun, which prints besides nothing; and one that changes what it is given."""
    good, bad = tmp_path / "good.py", tmp_path / "bad.py"
    good.write_text("def step(f, y, t, dt):\n    k = f(y, t)\n    return y + dt / 2 * (k + f(y + dt * k, t))\n")
    bad.write_text("def step(f, y, t, dt):\n    y += dt * f(y, t)\n    return y\n")
    assert lab.identify(good, **QUICK).identified_as == "heun"
    with pytest.warns(UserWarning, match="bad"):
        lab.identify(str(bad), **QUICK)


@pytest.mark.rotating(4, in_turn=True)
def test_every_answer_is_shown_as_a_table_and_drawn(compared: lab.Comparison, simulated: lab.Simulation) -> None:
    """A notebook has tables whose columns have headings, and plots with alternative text."""
    identified = lab.identify("heun", **QUICK)
    modes = lab.modes("string", masses=4)
    limits = lab.stability("oscillator", "kick_drift")
    for answer in (compared, simulated, identified, modes, limits):
        page = Page(answer._repr_html_())
        assert page.attributes("scope") == ["col"] * len([name for name in answer.table.columns if name])
        assert [name for name, _ in page.elements].count("tr") == 1 + len(answer.table)
        assert all(str(cell) in page.words for cell in answer.table.columns)
        plot = answer.plot()
        assert plot.alt
        assert plot._repr_html_().startswith("<img alt=")
        assert str(answer.table.rows[0][0]) in str(answer)
    assert {row["scene"] for row in lab.scenes()} >= {"string", "cloth"}


def test_numbers_go_to_pandas_tidily(compared: lab.Comparison, simulated: lab.Simulation) -> None:
    """A row for every mass at every time; a row for every stepper."""
    masses = simulated["rk4"].to_pandas()
    assert list(masses.columns) == ["time", "mass", "x", "y", "vx", "vy"]
    last = masses[(masses["mass"] == 4) & (masses["time"] == simulated["rk4"].times[-1])]
    assert last[["x", "y"]].to_numpy()[0] == pytest.approx(simulated["rk4"].positions[-1, 4])
    assert list(compared.to_pandas()["stepper"]) == ["heun", "euler", "mujoco_tendons"]
    assert set(simulated.to_pandas()["stepper"]) == {"rk4"}


def test_without_pandas_there_is_one_line(compared: lab.Comparison, monkeypatch: pytest.MonkeyPatch) -> None:
    """It says what is missing, and how to have it."""
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ImportError, match=r"^to_pandas\(\) needs pandas: .*pip install pandas") as caught:
        compared.to_pandas()
    assert "\n" not in str(caught.value)


def test_a_comparison_is_drawn_if_any_run_has_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    """One that raised has none; of none there is nothing to draw."""

    def fails(x: Any, v: Any, dt: float, system: Any) -> Any:
        raise ArithmeticError("no")

    monkeypatch.setattr("report.figures.divergence.draw_runs", lambda found, runs: [run.stepper.name for run in runs])
    assert lab.compare("string", "heun", fails, **QUICK).plot()._picture == ["heun", "fails"]
    with pytest.raises(lab.InputError, match="nothing to plot of string: expected a run with a distance"):
        lab.compare("string", fails, **QUICK).plot()


def test_plots_are_saved_by_their_names(compared: lab.Comparison, tmp_path: Path) -> None:
    """As text that a browser draws, or as pixels."""
    plot = compared.plot()
    assert plot.save(tmp_path / "a.svg").read_text(encoding="utf-8").startswith("<svg")
    with Image.open(plot.save(tmp_path / "a.png")) as image:
        assert image.size == pytest.approx(160 * plot.figure.get_size_inches(), abs=1)


def test_answers_cannot_be_changed(compared: lab.Comparison) -> None:
    """They are frozen."""
    with pytest.raises(FrozenInstanceError):
        compared.runs = ()  # type: ignore[misc]


def test_an_engine_that_refuses_is_an_answer_with_nothing_in_it() -> None:
    """Not an exception: its arrays have no frames, and its reason is told."""
    run = lab.simulate("cloth", "pymunk_springs")["pymunk_springs"]
    assert run.outcome == "unsupported"
    assert run.reason
    assert run.positions.shape[0] == 0
    assert run.energies == {}
    assert run.spring_forces.shape[0] == 0


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: lab.simulate("strin"), "did you mean 'string'"),
        (lambda: lab.simulate("string", "huen"), "did you mean 'heun'"),
        (lambda: lab.simulate("string", stifness=3.0), "did you mean 'stiffness'"),
        (lambda: lab.simulate("string", changes=["0.1:drag=1"]), "expected .time, parameter, value."),
        (lambda: lab.simulate("string", time_limit=-1.0), "time_limit = -1: expected a finite number > 0"),
        (lambda: lab.simulate("string", 7), "stepper 7: expected a name"),
        (lambda: lab.simulate(7), "scene 7: expected a name"),
        (lambda: lab.modes("string", lowest=0), "lowest = 0: expected a number >= 1"),
        (lambda: lab.system([[0.0]], [], masses=1, stifness=1, stiffness=1), "did you mean 'stiffness'"),
        (lambda: lab.simulate("string").plot("energies"), "expected paths, energy, forces"),
    ],
)
def test_what_makes_no_sense_is_refused_in_a_line(call: Any, message: str) -> None:
    """With what was expected."""
    with pytest.raises(lab.InputError, match=message) as caught:
        call()
    assert "\n" not in str(caught.value)


def test_names_that_are_not_there_are_told_with_those_that_are(compared: lab.Comparison) -> None:
    """Of runs and of columns."""
    with pytest.raises(KeyError, match="expected one of heun, euler"):
        compared["rk4"]
    with pytest.raises(KeyError, match="expected one of stepper"):
        compared.table["error"]


def test_a_system_of_ones_own_falls_as_it_should() -> None:
    """Free fall, x = -g t^2 / 2: the reference's Verlet has it exactly, but for rounding."""
    stone = lab.system([[0.0, 0.0]], np.zeros((0, 2), dtype=int), masses=2.0, stiffness=1.0, gravity=9.81)
    run = lab.simulate(stone, "velocity_verlet", dt=1e-2, duration=0.5)[0]
    assert run.positions[:, 0, 1] == pytest.approx(-9.81 * run.times**2 / 2, abs=1e-13)


def test_a_ramp_and_a_change_act_on_a_system_that_is_there_already() -> None:
    """As on a named scene: the same motion, to the bit."""
    ramp, change = lab.Ramp("stiffness", 0.01, 0.03, 300.0), lab.Change(0.02, "drag", 0.1)
    named = lab.simulate("string", "heun", changes=[ramp, change], **QUICK)[0]
    there = lab.simulate(lab.scene("string", **QUICK), "heun", changes=[ramp, change])[0]
    assert np.array_equal(named.positions, there.positions)
    assert not np.array_equal(named.positions, lab.simulate("string", "heun", **QUICK)[0].positions)


@pytest.mark.rotating(4, in_turn=True)
def test_a_page_is_written_and_says_what_was_found(tmp_path: Path) -> None:
    """Of one experiment; its file needs no other."""
    page = lab.report(only=["errata"], out=tmp_path / "page")
    assert page.path == tmp_path / "page" / "index.html"
    assert page.findings[0] in page.path.read_text(encoding="utf-8").replace("&#39;", "'")
    assert str(page.path) in page._repr_html_()


@pytest.mark.parametrize("name", ["dt", "duration"])
def test_a_time_that_is_no_number_is_named(name: str) -> None:
    """With its value."""
    with pytest.raises(lab.InputError, match=f"{name} = 'a'"):
        lab.simulate("string", "euler", **{name: "a"})


def heun(f: Any, y: Any, t: float, dt: float) -> Any:
    """As the scheme of this name."""
    k = f(y, t)
    return y + dt / 2 * (k + f(y + dt * k, t + dt))


def kick_by(part: float) -> Any:
    """Functions of one name: kick by a part of dt, then drift."""

    def step(a: Any, x: Any, v: Any, dt: float) -> Any:
        v = v + part * dt * a(x, v)
        return x + dt * v, v

    return step


@pytest.mark.rotating(4, in_turn=True)
def test_functions_are_steppers_by_names_of_their_own() -> None:
    """Each is told from the scheme, and from the other function, of its name; by position and by keyword."""
    found = lab.compare("string", "heun", heun, stepper=[kick_by(1.0), kick_by(0.5)], **QUICK)
    assert [run.stepper for run in found.runs] == ["heun", "heun (function)", "step", "step (2)"]
    assert [run.identified_as for run in found.runs] == ["heun", "heun", "kick_drift", None]
    assert lab.simulate("string", stepper=heun, **QUICK)[0].positions[-1] == pytest.approx(found[0].positions[-1])
    assert lab.identify(partial(kick_by, 1.0)(), **QUICK).identified_as == "kick_drift"
    tableau = lab.explain(heun).document["tableau"]
    assert tableau == lab.explain("heun").document["tableau"]


@pytest.mark.rotating(4, in_turn=True)
def test_functions_have_limits_of_stability() -> None:
    """Of half a kick: that of kick-drift at half the stiffness, sqrt(2) times as long; measured to a part of 1e-4."""
    limits = lab.stability("oscillator", kick_by(1.0), kick_by(0.5))
    system = lab.scene("oscillator").system
    whole = 2 * (system.masses[1] / system.stiffness[0]) ** 0.5
    assert limits.predicted == {"step": pytest.approx(whole), "step (2)": None}
    assert limits.measured["step"] == pytest.approx(whole, rel=2e-4)
    assert limits.measured["step (2)"] == pytest.approx(2**0.5 * whole, rel=2e-4)


def test_a_function_that_fails_is_an_outcome_and_ends_nothing() -> None:
    """With its line; also one that would end the program. One that remembers is warned of at the caller's line."""

    def leaves(x: Any, v: Any, dt: float, system: Any) -> Any:
        raise SystemExit

    run = lab.simulate("string", leaves, **QUICK)[0]
    assert (run.outcome, run.reason.split(": ")[-1]) == ("crashed", "SystemExit")
    assert ", line " in run.reason
    (row,) = lab.stability("oscillator", leaves).document
    assert row["outcome"] == "crashed"
    calls: list[int] = []

    def counts(x: Any, v: Any, dt: float, system: Any) -> Any:
        calls.append(1)
        return x + dt * v, v + 1e-3 * len(calls)

    with pytest.warns(UserWarning, match="remembers other runs") as caught:
        assert not lab.explain(counts).document["deterministic"]
    assert {Path(warning.filename) for warning in caught} == {Path(__file__)}


#: No step: a function without arguments, two of Python's own, a table, a module.
NO_STEPS = {
    "a test": test_a_page_is_written_and_says_what_was_found,
    "print": print,
    "len": len,
    "dict": {},
    "lab": lab,
}


@pytest.mark.parametrize("given", NO_STEPS.values(), ids=NO_STEPS)
def test_what_is_no_step_is_refused_in_one_short_line(given: Any) -> None:
    """What has no hash is refused as well."""
    for call in (lambda it: lab.identify(it), lambda it: lab.simulate("string", it)):
        with pytest.raises(lab.InputError, match="expected") as told:
            call(given)
        assert len(str(told.value)) < 250


def test_only_public_names_are_listed() -> None:
    """What `dir` lists is what the package offers."""
    assert dir(lab) == sorted(lab.__all__)


@pytest.mark.parametrize(("force", "holds"), [(0.5, False), (1.5, True)])
def test_a_spring_that_would_break_at_rest_has_no_rest(force: float, holds: bool) -> None:
    """It carries m g = 0.1 kg 9.81 m/s^2 = 0.981 N there."""
    one: dict[str, Any] = {"masses": 0.1, "stiffness": 40.0, "fixed": [0], "gravity": 9.81, "breaking_force": force}
    hung = lab.system([[0.0, 0.0], [0.0, -0.5]], [[0, 1]], **one)
    if holds:
        assert lab.modes(hung).equilibrium[1, 1] == pytest.approx(-0.5 - 0.981 / 40.0)
        return
    with pytest.raises(lab.SolverError, match=r"spring 0 would carry 0\.981 N"):
        lab.modes(hung)
