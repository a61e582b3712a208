"""CONTRIBUTING's recipes, followed: what it shows is run, and does what it says."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest

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

CONTRIBUTING = Path(__file__).parents[1] / "CONTRIBUTING.md"


@pytest.fixture
def follow() -> Iterator[Any]:
    """The module that a recipe's code makes; what it enters into the catalogue is taken out again."""
    made: list[str] = []

    def recipe(name: str) -> ModuleType:
        blocks = re.findall(r"```python\n(.*?)```", CONTRIBUTING.read_text(encoding="utf-8"), flags=re.S)
        (code,) = (block for block in blocks if block.startswith(f"# {name}\n"))
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


def test_the_experiment_of_the_recipe_answers_its_question(follow: Any) -> None:
    """A finding with a number that is positive: Euler adds energy (predicted: it grows at any dt)."""
    experiment = follow("experiment").EXPERIMENT
    result = experiment.run(lambda _: None)
    assert re.search(r"[1-9]", result.findings[0])
    assert result.tables[0].rows[-1][1] > result.tables[0].rows[0][1]


def test_the_exercise_of_the_recipe_names_its_mistakes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """In one folder: it is listed, a right solution passes, a mistake is named, and so are two at once."""
    from experiments.exercises import exercise
    from experiments.exercises.judge import judge

    blocks = re.findall(r"```python\n(.*?)```", CONTRIBUTING.read_text(encoding="utf-8"), flags=re.S)
    (code,) = (block for block in blocks if block.startswith("# exercise\n"))
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
