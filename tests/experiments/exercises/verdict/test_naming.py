"""Students' programs, named: right ones pass in whatever style, and mistakes are called what they are."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from experiments.exercises.exercise import Exercise, exercises, find
from experiments.exercises.grading import grade
from experiments.exercises.handed_in.submission import read
from experiments.exercises.process import sandbox
from experiments.exercises.teaching.handout import hand_out
from experiments.exercises.verdict.answer_catalogue import catalogue_of
from experiments.exercises.verdict.findings import of_order
from experiments.exercises.verdict.judge import judge
from tests.experiments.exercises import here
from tests.experiments.exercises.confusion import confusion, wrongly
from tests.experiments.exercises.corpus import RIGHT, programs, solution, wrong
from tests.parts import PARTS
from tests.parts import part as part_of

FOLDER = Path(__file__).parents[1]
MODELS = FOLDER / "models"


def test_right_programs_pass_in_whatever_style(corpus_part: slice) -> None:
    """Loops, arrays, classes, complex numbers, lists, single precision, in place on copies ...: all pass."""
    right = [program for program in programs() if program.name == RIGHT]
    assert len(right) >= 60
    assert {program.exercise for program in right} == set(exercises())
    assert wrongly(confusion(right[corpus_part])) == {}


def test_every_exercise_has_a_model_solution() -> None:
    """And there is none of anything else."""
    assert sorted(file.stem for file in MODELS.glob("*.py")) == [e.folder.name for e in exercises().values()]


@pytest.mark.rotating(3)
@pytest.mark.parametrize("exercise", exercises().values(), ids=lambda e: e.name)
def test_every_model_solution_passes(exercise: Exercise) -> None:
    """Public and hidden, with full score."""
    file = MODELS / f"{exercise.folder.name}.py"
    given = grade(read(file, file.name, keyed=False), "sesame")
    assert (given.verdict.name, given.score) == ("right", 100.0)


def test_mistakes_are_called_by_their_name(
    corpus_part: slice, request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A part of them, in this process; with --full all in the sandbox, as `tests.experiments.exercises.confusion` does.

    What the sandbox has not and this process has is not missed here.
    """
    mistakes = [program for program in programs() if program.name != RIGHT]
    for exercise in exercises():
        assert len({program.name for program in mistakes if program.exercise == exercise}) >= 10
    if not request.config.option.full:
        monkeypatch.setattr(sandbox, "run", here.run)
        mistakes = [program for program in mistakes if program.name != "missing_module"]
    assert wrongly(confusion(mistakes[corpus_part])) == {}


@pytest.mark.parametrize("count", [0, 1, PARTS, 100])
def test_every_program_is_in_one_part(count: int) -> None:
    """So that after as many days as there are parts all have been checked."""
    programs = list(range(count))
    parts = [programs[part_of(day)] for day in range(PARTS)]
    assert sorted(program for part in parts for program in part) == programs


@pytest.mark.usefixtures("trusted")
def test_two_mistakes_at_once_are_both_found() -> None:
    """In the forces, and in the step: each changes another parameter of the solution."""
    text = wrong("arrays", "gravity_sign").replace("(v + v1) / 2", "(v + v1)").replace("(a + b) / 2", "(a + b)")
    verdict = judge(find("4"), text)
    assert verdict.outcome == "mistakes"
    assert {f.name for f in verdict.findings} == {"gravity_sign", "half_missing"}
    both = judge(find("4"), wrong("arrays", "modifies_its_input").replace("- pull[1:]", "+ pull[1:]"))
    assert {f.name for f in both.findings} == {"same_side", "modifies_its_input"}


@pytest.mark.usefixtures("trusted")
def test_mistakes_in_several_functions_are_all_found() -> None:
    """Each function by itself: four predictions, each wrong in its own way."""
    text = solution("loops", 5).replace("return 2 / w\n", "return 1 / w\n").replace("2 * sqrt(2) / w", "2 / w")
    text = text.replace("return c / k", "return 2 * c / k").replace("return 2 / w_max", "return 2 / sqrt(k / m)")
    verdict = judge(find("5"), text, "example")
    assert {f.name for f in verdict.findings} == {"limit_of_one", "kick_drifts_limit", "euler_twice", "one_spring"}
    text = wrong("arrays", "kinetic_half_missing", 6).replace("string.gravity * x[:, 1]", "x[:, 1]")
    verdict = judge(find("6"), text.replace("-np.sum(string.damping", "np.sum(string.damping"))
    assert (verdict.outcome, verdict.findings) == ("not in the catalogue", ())  # spring damping with the wrong sign
    verdict = judge(find("6"), text.replace(" - string.drag * np.sum(v**2)", ""))
    assert {f.name for f in verdict.findings} == {"kinetic_half_missing", "height_without_g", "drag_missing"}


@pytest.mark.usefixtures("trusted")
def test_what_nobody_knows_is_not_given_a_name() -> None:
    """A force that is a third too large: no name, but the step, the mass and the numbers where it first differs."""
    verdict = judge(find("4"), solution("loops").replace("force = k *", "force = 1.333 * k *"))
    assert (verdict.outcome, verdict.findings, verdict.error) == ("not in the catalogue", (), None)
    assert verdict.first_difference is not None
    assert (verdict.first_difference.step, verdict.first_difference.index) == (1, (0, 0))


def test_right_at_first_is_not_another_order() -> None:
    """Two results that have changed places are seen in the first step; where that is right, they have not."""
    catalogue = catalogue_of(find("1"), "", None)
    other = [[[v, y], *steps[1:]] for (y, v), *steps in catalogue.right]
    later = [[*steps[:-1], [1.1 * part for part in steps[-1]]] for steps in catalogue.right]
    finding = of_order(catalogue, other)
    assert finding is not None
    assert finding.name == "results_in_another_order"
    assert of_order(catalogue, later) is None


def test_another_order_is_not_all_where_another_function_is_wrong() -> None:
    """Energies in another order are told where the power is right; else nothing would be said of the power."""
    catalogue = catalogue_of(find("6"), "", None)
    reordered = [[[*answer[0][1:], answer[0][0]]] for answer in catalogue.right]
    assert of_order(catalogue, reordered) is not None
    assert of_order(catalogue, [[[2 * part for part in answer[0]]] for answer in reordered]) is None
    wrong_power = [answer if len(answer[0]) > 1 else [[2 * answer[0][0]]] for answer in reordered]
    assert of_order(catalogue, wrong_power) is None


@pytest.mark.usefixtures("trusted")
def test_link_by_link_first_differs_at_the_second_mass() -> None:
    """The first mass's predictor still sees everything as it was: x of mass 0 is right for longer than that of mass 1.

    In the first step, positions of mass 0 are x + dt/2 (v + v + dt a): as they should be.
    """
    verdict = judge(find("4"), wrong("loops", "heun_link_by_link"))
    assert verdict.first_difference is not None
    assert (verdict.first_difference.step, verdict.first_difference.part, verdict.first_difference.index[0]) == (
        1,
        "x",
        1,
    )
    assert verdict.error is not None
    assert verdict.error < 1e-12


@pytest.mark.usefixtures("trusted")
def test_another_scheme_is_said_to_be_right_in_itself() -> None:
    """Positions with the new velocities, where Euler was asked for."""
    text = (FOLDER / "models" / "e01_euler.py").read_text(encoding="utf-8")
    old = "    return y + dt * v, v + dt * force / spring.mass\n"
    assert old in text
    verdict = judge(find("1"), text.replace(old, "    v += dt * force / spring.mass\n    return y + dt * v, v\n"))
    assert (verdict.outcome, verdict.name) == ("another scheme", "kick_drift")


@pytest.mark.rotating(3)
@pytest.mark.usefixtures("trusted")
@pytest.mark.parametrize("exercise", exercises().values(), ids=lambda e: e.name)
def test_every_starter_runs_and_fails_politely(exercise, tmp_path: Path) -> None:  # type: ignore[no-untyped-def]
    """As it was handed out: it runs by itself, and the checker says that nothing is written yet."""
    own, *others = hand_out(exercise, tmp_path / "work", "somebody", None)
    assert {"text.md", "text.html"} <= {f.name for f in others}
    done = subprocess.run([sys.executable, own], capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout
    verdict = grade(read(own, own.name)).verdict
    assert (verdict.outcome, verdict.name) == ("error", "not_written_yet")
    changed = own.read_text(encoding="utf-8").replace('"""', '"""My own: ', 1)
    assert judge(exercise, changed, "somebody").outcome in ("mistake", "mistakes", "not in the catalogue", "error")


@pytest.mark.rotating(3)
@pytest.mark.parametrize(
    ("text", "name", "line"),
    [
        ("EXERCISE = 1\ndef step(:\n", "syntax", 2),
        ("def step(y, v, dt, s):\n    return y / 0, v\n", "division_by_zero", 2),
        ("def step(y, v, dt, s):\n    return f(y), v\ndef f(y):\n    return [][1]\n", "index_error", 4),
        ("\nimport scipy\n", "missing_module", 2),
        ("def step(y, v, dt, s):\n    return None\n", "returns_nothing", None),
        ("def step(y, v, dt, s):\n    return y\n", "wrong_count", None),
        ("def step(y, v, dt, s):\n    return {y: v}, v\n", "returns_a_dict", None),
        ("def step(y, v, dt, s):\n    return y + 1j, v\n", "not_numbers", None),
        ("def steps(y, v, dt, s):\n    return y, v\n", "missing_function", None),
    ],
)
def test_errors_name_the_students_own_line(text: str, name: str, line: int | None) -> None:
    """The line of the submission that is nearest to the error; none where a result is wrong as a whole."""
    verdict = judge(find("1"), text)
    assert (verdict.outcome, verdict.name, verdict.findings[0].line) == ("error", name, line)
