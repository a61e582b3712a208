"""What the checker knows: right answers that agree with the reference, mistakes that are not taken for another."""

from __future__ import annotations

import doctest
from collections import Counter
from itertools import combinations
from math import sqrt
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from experiments.exercises import exercise as exercise_module
from experiments.exercises.exercise import Exercise, exercises, find
from experiments.exercises.solutions.links import forces, namespace, random_string
from experiments.exercises.solutions.stepping import step
from experiments.exercises.verdict import answer_catalogue, answer_distance, naming
from experiments.exercises.verdict.answer_catalogue import catalogue_of, draw_questions
from reference.errors import InputError
from reference.forces import SpringMotion
from reference.scenes.trusses import bridge as bridge_scene
from reference.schemes.catalogue import schemes
from reference.state import State
from reference.stepper import SchemeStepper
from reference.system import MassSpringSystem

ALL = pytest.mark.parametrize("exercise", exercises().values(), ids=lambda e: e.name)


def hung(count: int) -> tuple[MassSpringSystem, tuple]:  # type: ignore[type-arg]
    """A student's string, as a system of the reference: its anchor is mass 0."""
    x, v, string = random_string(np.random.default_rng(count), count)
    system = MassSpringSystem(
        positions=np.vstack([string["anchor"], x]),
        velocities=np.vstack([np.zeros(2), v]),
        springs=np.array([[i, i + 1] for i in range(count)]),
        masses=np.append(1.0, string["masses"]),
        rest_lengths=string["rest_lengths"],
        stiffness=string["stiffness"],
        drag=string["drag"],
        fixed=np.arange(count + 1) == 0,
    )
    return system, (x, v, namespace(string))


@pytest.mark.parametrize("count", [1, 2, 5])
def test_the_forces_are_those_of_the_reference(count: int) -> None:
    """F = m a, two ways of adding the same five terms: 1e-13 of the largest, some hundred times rounding."""
    system, string = hung(count)
    wanted = (system.masses[:, None] * SpringMotion(system).acceleration(system.start))[1:]
    assert np.abs(forces(*string) - wanted).max() <= 1e-13 * np.abs(wanted).max()
    assert np.abs(forces(*string, drag=-1.0) - wanted).max() > 1e-4 * np.abs(wanted).max()  # shown to fail


@pytest.mark.parametrize("name", ["euler", "heun", "kick_drift", "rk4", "heun_link_by_link", "heun_aliased"])
def test_the_steps_are_those_of_the_catalogue(name: str) -> None:
    """Twenty steps beside the reference's own run of the scheme, to 1e-12 m (`reference.identification.TOLERANCE`)."""
    system, (x, v, string) = hung(4)
    run = SchemeStepper(schemes()[name]).run(system, 0.004, 20).trajectory
    assert run is not None
    for _ in range(20):
        x, v = step(x, v, 0.004, string, name)
    assert np.abs(x - run.positions[-1, 1:]).max() < 1e-12


def test_the_bridge_is_the_scene() -> None:
    """The largest dt of a Warren bridge, 2/w, by the reference's Jacobian of the forces, to 1e-6.

    The scene's roller is a rocker, which holds one end to first order; here both ends are pinned in the same way, so
    that the two are the same matrix: K = -dF/dx, w^2 the largest eigenvalue of M^-1 K.
    """
    system = bridge_scene(truck=0.0)
    members, count = system.springs[:-1], len(system.masses) - 1
    fields = {
        "joints": system.positions[:count],
        "members": members,
        "stiffness": system.stiffness[:-1],
        "masses": system.masses[:count],
        "gravity": 9.81,
        "pinned": 0,
        "roller": 8,
    }
    free = [i for i in range(2 * count) if i not in (0, 1, 16, 17)]
    motion, eps = SpringMotion(system), 1e-6
    columns = []
    for i in free:
        x = np.stack([system.positions, system.positions])
        x[0].flat[i] += eps
        x[1].flat[i] -= eps
        a = [motion.acceleration(State(0.0, place, 0 * place)) for place in x]
        columns.append(((a[1] - a[0]) / (2 * eps)).ravel()[free])
    limit = 2 / sqrt(np.linalg.eigvals(np.array(columns)).real.max())
    found = find("bridge").solutions["largest_dt"](namespace(fields), held="both pinned")
    assert found == pytest.approx(limit, rel=1e-6)


@pytest.mark.rotating(9)
@ALL
@pytest.mark.parametrize("key", [None, "sesame"])
def test_no_mistake_can_be_taken_for_another(exercise: Exercise, key: str | None) -> None:
    """On the questions every two mistakes, and the right answer, differ by at least 1e-5 of the largest number.

    Rounding is 1e-9 at most (TOLERANCE). Mistakes of one name are one.
    """
    catalogue = catalogue_of(exercise, "somebody", key)
    answers = [(m.name, catalogue.answers(m.parameters)) for m in exercise.mistakes]
    if exercise.keyed:  # names that are not behind this student's letters cannot be mixed up
        answers = [(name, answer) for name, answer in answers if catalogue.distance(answer, catalogue.right) > 0]
        assert len(answers) >= 3
    answers.append(("", catalogue.right))
    for i, (one, mine) in enumerate(answers):
        for other, theirs in answers[:i]:
            assert one == other or catalogue.differ(mine, theirs, max(1e-5, 2 * exercise.tolerance)), (one, other)


@ALL
def test_every_mistake_has_words_and_a_hint_that_tells_no_number(exercise: Exercise) -> None:
    """A sentence each; names are made for tables, and of one name there is one hint; at least ten for each exercise."""
    names = {m.name for m in exercise.mistakes}
    assert len(names) >= 10
    assert len({(m.name, m.hint) for m in exercise.mistakes}) == len(names)
    for mistake in exercise.mistakes:
        assert mistake.name.isidentifier()
        assert mistake.words[0].isupper()
        assert mistake.words[-1] in ".)"
        assert mistake.hint[-1] in ".?"
    names = Counter(m.name for m in exercise.mistakes)
    words = {(m.name, m.words) for m in exercise.mistakes}
    assert len(words) == len(names)


def test_hidden_questions_depend_on_the_key() -> None:
    """Another key or draw, other numbers; the same, the same; and the hidden questions are not the public ones."""
    drawn = [(None, 0), ("a", 0), ("b", 0), ("a", 1)]
    numbers = [draw_questions(find("4"), "", key, draw)[0].arguments[0].tolist() for key, draw in drawn]
    again = [draw_questions(find("4"), "", key, draw)[0].arguments[0].tolist() for key, draw in drawn]
    assert numbers == again
    assert all(one != other for one, other in combinations(numbers, 2))


def test_questions_depend_on_the_seed_where_everybody_has_numbers_of_their_own() -> None:
    """In exercise 5; in the others all students share one catalogue."""
    own = [catalogue_of(find("5"), seed, None).right[0][0][0].item() for seed in ("ada", "bob")]
    assert own[0] != own[1]
    assert catalogue_of(find("4"), "ada", None) is catalogue_of(find("4"), "bob", None)


def test_an_unknown_exercise_is_refused_in_one_line() -> None:
    """With the numbers that there are, or the nearest name."""
    with pytest.raises(InputError, match=f"^exercise 99: .* 1 .* {max(exercises())}$"):
        find("99")
    with pytest.raises(InputError, match=r"'brigde'.*'bridge'"):
        find("brigde")


@pytest.mark.parametrize(
    ("folders", "field"), [(("e11_waves", "e11_tides"), "11"), (("e11_waves", "e12_waves"), "waves")]
)
def test_two_exercises_of_one_number_or_name_are_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, folders: tuple[str, str], field: str
) -> None:
    """In one line that names what is taken, and both folders; wherever these are, and before their code is run."""
    monkeypatch.setattr(exercise_module, "FOLDERS", [tmp_path / "a", tmp_path / "b"])
    for where, folder in zip("ab", folders, strict=True):
        (tmp_path / where / folder).mkdir(parents=True)
    with pytest.raises(InputError, match=folders[1]) as refused:
        exercises()
    message = str(refused.value)
    assert folders[0] in message
    assert f" {field} " in message
    assert "\n" not in message


@pytest.mark.parametrize("module", [answer_distance, answer_catalogue, naming], ids=lambda m: m.__name__.split(".")[-1])
def test_the_worked_examples_are_true(module: ModuleType) -> None:
    """What the docstrings show is what comes out."""
    tried = doctest.testmod(module, optionflags=doctest.FAIL_FAST)
    assert tried.attempted > 2
    assert tried.failed == 0
