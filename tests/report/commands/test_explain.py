"""`springlab explain`: what a stepper computes, in words, as JSON, and as a figure."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.report.commands.terminal import springlab

KEYS = ["stepper", "identified_as", "one_step", "explicit", "deterministic", "slope_evaluations", "tableau"]
KEYS += ["step_matrix", "step_matrix_of", "substeps", "substep_scheme", "nearest", "changes_with_dt"]
KEYS += ["order", "symplectic", "reversible", "stability"]
KEYS += ["multistep", "difference_equation", "reason"]


def test_the_json_has_exactly_the_promised_form() -> None:
    """Heun, whole."""
    said = springlab("explain", "heun", "--json")
    assert said.code == 0
    document = json.loads(said.out)
    assert list(document) == KEYS
    assert document["tableau"] == {"a": [["0", "0"], ["1", "0"]], "b": ["1/2", "1/2"], "c": ["0", "1"]}
    assert document["step_matrix"][0] == ["1 - a/2", "1 - b/2 - d/2"]
    assert document["stability"] == {"real_axis": 2.0, "imaginary_axis": 0.0}
    assert (document["slope_evaluations"], document["order"], document["explicit"]) == (2, 2, True)
    assert (document["substep_scheme"], document["nearest"], document["changes_with_dt"]) == (None, None, None)


def test_what_cannot_be_told_is_null_with_its_reason(tmp_path: Path) -> None:
    """A step that changes nothing."""
    file = tmp_path / "mine.py"
    file.write_text("def step(x, v, dt, system):\n    return x, v\n", encoding="utf-8")
    document = json.loads(springlab("explain", str(file), "--json").out)
    assert (document["step_matrix"], document["step_matrix_of"], document["substeps"]) == (None, None, None)
    assert document["stability"] == {"real_axis": None, "imaginary_axis": None}
    assert "a step changes nothing" in document["reason"]


@pytest.mark.rotating(3, in_turn=True)
def test_rods_and_sub_steps_are_told_in_json() -> None:
    """What the matrix is of, and of how many sub-steps a step is made."""
    document = json.loads(springlab("explain", "pendulum_heun", "--json").out)
    assert (document["step_matrix_of"], document["substeps"]) == ("small swings of a rod, a = h^2 g/L", 1)
    document = json.loads(springlab("explain", "soft_constraints_cold", "--json").out)
    assert (document["step_matrix_of"], document["substeps"]) == ("the damped oscillator", 4)


def test_the_terminal_has_formulas_and_the_figure_is_written(tmp_path: Path) -> None:
    """Kick-drift's, with a file."""
    file = tmp_path / "region.svg"
    said = springlab("explain", "kick_drift", "--plot", str(file))
    assert said.code == 0
    lines = said.out.splitlines()
    assert "    x' = x + h v + h^2 a1" in lines
    assert "- Stable up to h w = 2 without damping." in lines
    assert file.read_text(encoding="utf-8").startswith("<svg")


def test_bad_input_is_one_line() -> None:
    """Another kind of file, another name."""
    assert springlab("explain", "heun", "--plot", "region.doc").code == 2
    said = springlab("explain", "huen")
    assert (said.code, said.err.strip()) == (2, "springlab: unknown stepper 'huen': did you mean 'heun'?")


def test_a_folder_is_said_to_be_one(tmp_path: Path) -> None:
    """In one line, without all the steppers there are."""
    said = springlab("explain", str(tmp_path))
    words = f"springlab: {tmp_path} is a folder: expected a stepper's name, or FILE.py, FILE.py:FUNCTION or FILE.c"
    assert (said.code, said.err.strip()) == (2, words)


def test_a_solver_is_in_the_catalogue() -> None:
    """It is found by its name, so it is not said to be a stranger."""
    assert "is what the catalogue has by this name" in springlab("explain", "vertex_block_descent").out


@pytest.mark.rotating(3, in_turn=True)
def test_a_file_of_the_users_own_is_explained(tmp_path: Path) -> None:
    """Heun with weights 2/3 and 1/3: no name, and the mistake in numbers."""
    file = tmp_path / "mine.py"
    file.write_text("def step(f, y, t, h):\n    k = f(y, t)\n    return y + h / 3 * (2 * k + f(y + h * k, t + h))\n")
    document = json.loads(springlab("explain", str(file), "--json").out)
    assert document["tableau"] == {"a": [["0", "0"], ["1", "0"]], "b": ["2/3", "1/3"], "c": ["0", "1"]}
    assert (document["identified_as"], document["order"]) == (None, 1)
    assert "b2 is 1/3 where heun has 1/2" in springlab("explain", str(file)).out


def test_a_broken_file_is_told_in_a_line(tmp_path: Path) -> None:
    """And nothing else is claimed."""
    file = tmp_path / "mine.py"
    file.write_text("def step(f, y, t, h):\n    return y[1:]\n")
    document = json.loads(springlab("explain", str(file), "--json").out)
    assert document["reason"] == "mine.py returns y of shape (7,): expected (8,)"
    assert document["step_matrix"] is None
