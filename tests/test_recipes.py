"""CONTRIBUTING's recipes, followed: what it shows is run, and does what it says."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from engines.engine import demands
from engines.process.isolation import run_engine
from reference import scenes
from reference.identification import identify
from reference.scenes import find
from reference.schemes import catalogue
from reference.schemes.catalogue import Scheme
from reference.simulate import simulate
from reference.stepper import SchemeStepper
from reference.theory.exact import exact
from tests import wrong
from tests.conformance import test_capabilities
from tests.conformance.cases import CAPABILITIES, GROUPS
from tests.conformance.checks import check_follows, check_state
from tests.conformance.children import look_on
from tests.conformance.refusals import refused_as_expected
from tests.parts import kept

CONTRIBUTING = Path(__file__).parents[1] / "CONTRIBUTING.md"


def code_of(recipe: str) -> str:
    """The code of a recipe, by the comment it begins with."""
    blocks = re.findall(r"```python\n(.*?)```", CONTRIBUTING.read_text(encoding="utf-8"), flags=re.S)
    (code,) = (block for block in blocks if block.startswith(f"# {recipe}\n"))
    return str(code)


@pytest.fixture
def follow() -> Iterator[Any]:
    """The module that a recipe's code makes; what it enters into the catalogue is taken out again."""
    made: list[str] = []

    def recipe(name: str) -> ModuleType:
        code = code_of(name)
        module = ModuleType(f"recipe_{name}")
        sys.modules[module.__name__] = module
        made.append(module.__name__)
        exec(compile(code, f"CONTRIBUTING.md, {name}", "exec"), module.__dict__)
        return module

    with catalogue._SCHEMES.as_it_is(), scenes._SCENES.as_it_is():
        yield recipe
    for name in made:
        del sys.modules[name]


def measured_order(scheme: Scheme) -> float:
    """The slope of the error between two halvings of dt, on a string."""
    system, dt, duration = find("string").system({"masses": 4}), 1e-3, 0.1
    true = exact(system, dt, round(duration / dt)).positions[-1]
    errors = [np.abs(simulate(system, scheme, dt / f, duration).positions[-1] - true).max() for f in (4, 8)]
    return float(np.log2(errors[0] / errors[1]))


def test_the_scheme_of_the_recipe_is_catalogued_of_its_order_and_identified(follow: Any) -> None:
    """Order 2 as it says, by the slope of its error, within 0.05; and it is found when it is looked for."""
    follow("scheme")
    scheme = catalogue.find("midpoint")
    assert measured_order(scheme) == pytest.approx(scheme.order, abs=0.05)
    assert identify(SchemeStepper(scheme), find("string").system({}), 1e-3, 100).identified_as == "midpoint"


#: The recipes of schemes, with the name each enters, and what it asks of the machinery.
SCHEMES = {
    "scheme": "midpoint",
    "scheme with a parameter": "second_order",
    "scheme with memory": "adams_bashforth",
    "scheme with a branch": "careful_euler",
    "scheme that stops early": "damped_by_jacobi",
}


@pytest.mark.parametrize("recipe", SCHEMES)
def test_every_recipe_of_a_scheme_has_its_order(follow: Any, recipe: str) -> None:
    """The one it says, by the slope of its error, within 0.05."""
    follow(recipe)
    scheme = catalogue.find(SCHEMES[recipe])
    assert measured_order(scheme) == pytest.approx(scheme.order, abs=0.05)


def test_parameters_of_a_recipe_make_it_other_methods(follow: Any) -> None:
    """With its second slope half-way it is the midpoint rule, at the end it is Heun: to rounding."""
    follow("scheme")
    follow("scheme with a parameter")
    system = find("string").system({})
    for part, name in (("0.5", "midpoint"), ("1.0", "heun")):
        same = SchemeStepper(catalogue.find(f"second_order(part={part})"))
        matches = identify(same, system, 1e-3, 100).matches
        assert name in [match.scheme for match in matches]


#: Every command that takes a stepper, on a small string; {name} is the scheme's.
COMMANDS = (
    "compare string --set masses=3 --duration 0.05 --stepper {name} --stepper heun --json",
    "identify {name} string --set masses=3 --duration 0.05 --json",
    "stability string --set masses=3 --set damping=0.1 --stepper {name} --json --out {out}",
    "stability string --set masses=2 --map dt damping --range dt=1e-3:2e-2 --stepper {name} --out {out}",
    "sweep string --set masses=3 --stepper {name} --over dt=1e-3:2e-3:2 --duration 0.02 --store {out}/store.sqlite",
)


def project_with_recipes(folder: Path) -> Path:
    """A copy of the rooms in which every recipe of a scheme has been followed: a file each in reference/schemes."""
    for room in ("reference", "engines", "experiments", "report"):
        ignored = shutil.ignore_patterns("__pycache__", "sample", "docs")
        shutil.copytree(CONTRIBUTING.parent / room, folder / room, ignore=ignored)
    for i, recipe in enumerate(SCHEMES):
        (folder / "reference" / "schemes" / f"recipe_{i}.py").write_text(code_of(recipe), encoding="utf-8")
    return folder


def recipes_commands(config: pytest.Config) -> Iterator[tuple[str, str]]:
    """Which scheme goes through which command: of all pairs a third, another one every day; all under --full."""
    names = [*SCHEMES.values(), "second_order(part=0.5)"]
    for i, name in enumerate(names):
        for j, command in enumerate(COMMANDS):
            if config.option.full or kept(i + j, 3, config.option.part):
                yield name, command


@pytest.mark.rotating(4, in_turn=True)
def test_a_scheme_of_every_recipe_goes_through_every_command(tmp_path: Path, request: pytest.FixtureRequest) -> None:
    """Nothing but a new file in reference/schemes: listed, compared, identified, its limit found, mapped and swept."""
    folder = project_with_recipes(tmp_path)
    pairs = list(recipes_commands(request.config))
    calls = [["list", "--json"]]
    calls += [[word.format(name=name, out=tmp_path / "out") for word in command.split()] for name, command in pairs]
    # maps of a few points: how many there are is no matter of the scheme
    small = "from experiments.limits import stability_map\nstability_map.SWEPT, stability_map.ENGINE = 8, 4\n"
    program = (
        small
        + f"from report.commands.main import springlab\nfor words in {calls!r}:\n"
        + ("    print('>>>', words, flush=True)\n    assert not springlab(words, standalone_mode=False), words\n")
    )
    environment = {**os.environ, "PYTHONPATH": str(folder)}
    words = [sys.executable, "-c", program]
    done = subprocess.run(words, capture_output=True, text=True, env=environment, cwd=tmp_path, check=False)
    assert done.returncode == 0, done.stdout[-500:] + done.stderr[-2000:]
    listed = json.loads(done.stdout.partition("\n")[2].partition(">>>")[0])
    assert set(SCHEMES.values()) <= {row["stepper"] for row in listed["schemes"]}
    compared = sum(command.startswith("compare") for _, command in pairs)
    assert compared
    assert done.stdout.count('"outcome": "done"') >= 2 * compared


def check_swing(scheme: Scheme) -> None:
    """The stretch is s cos(w t) with w^2 = 2 k / m: velocity Verlet is within twice s (w t) (w dt)^2 / 24."""
    setup = find("dumbbell").setup({"mass": 0.2})
    rate, stretch = np.sqrt(2 * 40.0 / 0.2), 0.05
    x = simulate(setup.system, scheme, setup.dt, setup.duration).positions
    found = x[-1, 1, 0] - x[-1, 0, 0] - 0.5
    allowed = stretch * rate * setup.duration * (rate * setup.dt) ** 2 / 24
    assert found == pytest.approx(stretch * np.cos(rate * setup.duration), abs=2 * allowed)


def test_the_scene_of_the_recipe_swings_as_theory_says(follow: Any) -> None:
    """And by wrong integrators it does not."""
    follow("scene")
    check_swing(catalogue.find("velocity_verlet"))
    for scheme in (wrong.heun_without_half, wrong.verlet_with_one_force, catalogue.find("euler")):
        with pytest.raises(AssertionError):
            check_swing(scheme)


def test_the_engine_of_the_recipe_is_what_it_claims(follow: Any) -> None:
    """It is identified with the scheme it says, and says what it cannot do."""
    (engine,) = follow("engine").ENGINES
    system = find("string").system({})

    class Direct:
        """The engine in this very process: the recipe's module is in no file a new process could import."""

        name, kind, version = engine.name, "engine", None

        def run(self, system: Any, dt: float, steps: int, changes: Any = ()) -> Any:
            return run_engine(engine, system, dt, steps, tuple(changes))

    assert identify(Direct(), system, 1e-3, 200).identified_as == engine.identified_as["plain"]
    damped = run_engine(engine, find("string").system({"damping": 0.1}), 1e-3, 10)
    assert (damped.ending, "damping" in damped.reason) == ("unsupported", True)


def test_the_engine_of_the_recipe_passes_the_suite(follow: Any) -> None:
    """What the suite asks of every engine, asked in this process: capabilities, refusals, changes, states, words."""
    (engine,) = follow("engine").ENGINES
    for group, cases in GROUPS.items():
        for case in cases.values():
            outcome = run_engine(engine, case.system, case.dt, case.steps, tuple(case.changes))
            if not refused_as_expected(engine, group, case, outcome) and not case.system.obstacles:
                check_follows(engine, case, outcome)
    for case in CAPABILITIES.values():
        if engine.capabilities.issuperset(demands(case.system)):
            check_state(case.system, *look_on(engine, [case.system]))
    test_capabilities.test_an_engine_declares_known_capabilities_and_catalogued_schemes(engine)
    test_capabilities.test_an_engine_says_what_its_numbers_mean_and_what_was_chosen(engine)


def test_the_experiment_of_the_recipe_answers_its_question(follow: Any) -> None:
    """A finding with a number that is positive: Euler adds energy (predicted: it grows at any dt)."""
    experiment = follow("experiment").EXPERIMENT
    result = experiment.run(lambda _: None)
    assert re.search(r"[1-9]", result.findings[0])
    assert result.tables[0].rows[-1][1] > result.tables[0].rows[0][1]


@pytest.mark.rotating(4, in_turn=True)
def test_the_exercise_of_the_recipe_names_its_mistakes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """In one folder: it is listed, a right solution passes, a mistake is named, and so are two at once."""
    from experiments.exercises import exercise
    from experiments.exercises.verdict.judge import judge

    code = code_of("exercise")
    folder = tmp_path / "e11_momentum"
    folder.mkdir()
    (folder / "exercise.py").write_text(code)
    (folder / "text.md").write_text("# 11 Momentum\n")
    (folder / "starter.py").write_text("EXERCISE = 11\n")
    monkeypatch.setattr(exercise, "FOLDERS", [*exercise.FOLDERS, tmp_path])
    found = exercise.find("11")
    right = "def momentum(v, masses):\n    return sum(m * u for m, u in zip(masses, v))\n"
    assert judge(found, right).name == "right"
    assert judge(found, right, key="k").name == "right"
    assert judge(found, right.replace("sum(", "-sum(")).name == "sign"
    assert judge(found, right.replace("sum(", "-1 / len(v) * sum(")).name == "sign + mean"
