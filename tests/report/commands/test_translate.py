"""`springlab translate`: its rows, what it refuses, and that a scene's snippet steps the scene."""

from __future__ import annotations

import json
import re

import numpy as np
import pytest

from engines.translation.program import run
from engines.translation.translation import translations
from reference.scenes import find as find_scene
from reference.stepper import stepper_named
from tests.report.commands.terminal import springlab

KEYS = ["engine", "settings", "snippet", "effective_stiffness", "effective_damping"]


@pytest.mark.rotating(3, in_turn=True)
def test_rows_of_all_engines_have_the_promised_keys() -> None:
    """One for each engine there is to translate for; nothing is run with --predict."""
    words = ("--stiffness", "200", "--damping", "0.5", "--mass", "0.2", "--dt", "0.004", "--predict", "--json")
    said = springlab("translate", *words)
    assert (said.code, said.err) == (0, "")
    rows = json.loads(said.out)
    assert [row["engine"] for row in rows] == list(translations())
    for row in rows:
        assert list(row)[:5] == KEYS
        assert {"largest_stable_dt_s", "reason"} <= set(row)
        assert row["measured_stiffness"] is None
        assert row["snippet"]


@pytest.mark.rotating(5, in_turn=True)
@pytest.mark.parametrize("width", [80, 100])
def test_tables_fit_a_terminal(monkeypatch: pytest.MonkeyPatch, width: int) -> None:
    """No line is longer, no setting is broken, and what only rounding leaves of a damping is 0."""
    monkeypatch.setenv("COLUMNS", str(width))
    monkeypatch.setenv("TTY_COMPATIBLE", "1")  # Rich takes this for a terminal
    said = springlab("translate", "--stiffness", "200", "--mass", "0.02", "--dt", "0.001", "--predict")
    lines = re.sub(r"\x1b\[\d*m", "", said.out).splitlines()
    assert max(map(len, lines)) <= width
    assert any(line.split() == ["bullet", "springElasticStiffness=200"] for line in lines)
    assert any(line.split() == ["mujoco", "200.17", "0", "0.02"] for line in lines)


def test_what_a_spring_really_has_is_told_not_what_is_missing() -> None:
    """Of the predicted row's own numbers: erp 0.2 and cfm 0.001 of 2 kg mean c = 800 N s/m, and damp with 268."""
    said = springlab("translate", "--from", "bullet", "erp=0.2", "cfm=0.001", "--mass", "2", "--predict", "--json")
    (row,) = json.loads(said.out)
    assert f"really {row['effective_damping']:.3g} N s/m of damping" in row["reason"]
    assert f"really {row['effective_stiffness'] / row['stiffness']:.1%} as stiff" in row["reason"]
    assert row["effective_damping"] == pytest.approx(268, abs=0.5)


def test_a_step_that_blows_up_is_said_to() -> None:
    """H w = 3: semi-implicit Euler is stable up to 2, and the row has no other promise than that."""
    said = springlab("translate", "--stiffness", "900", "--dt", "0.1", "--engine", "mujoco", "--predict", "--json")
    (row,) = json.loads(said.out)
    assert row["largest_stable_dt_s"] == pytest.approx(2 / 30, rel=1e-5)
    assert "blows up" in row["reason"]


@pytest.mark.parametrize(
    ("words", "row"),
    [
        (["box2d", "hertz=4", "damping_ratio=0.7"], ("box2d", 631.654682, 35.1858377)),
        (["mujoco", "solref=0.2 0.5"], ("mujoco_solref", 100.0, 10.0)),
        (["mujoco", "stiffness=5"], ("mujoco", 5.0, 0.0)),
        (["bullet", "erp=0.2", "cfm=0.02"], ("bullet_constraint", 600.0, 40.0)),
        (["godot", "stiffness=20", "damping=1"], ("godot", 20.0, 1.0)),
    ],
)
def test_an_engines_own_numbers_are_told_in_si(words: list[str], row: tuple[str, float, float]) -> None:
    """On 1 kg at 1/60 s, where nothing else is said."""
    said = springlab("translate", "--from", *words, "--predict", "--json")
    assert (said.code, said.err) == (0, "")
    (found,) = json.loads(said.out)
    assert (found["engine"], found["stiffness"], found["damping"]) == (row[0], *map(pytest.approx, row[1:]))


def test_what_was_meant_is_told_first() -> None:
    """The spring that the engine's numbers ask for, beside what it makes of them: 4 Hz of 1 kg."""
    said = springlab("translate", "--from", "box2d", "hertz=4", "damping_ratio=0.7", "--predict")
    assert "meant: k = 631.655 N/m, c = 35.1858 N s/m" in said.out
    assert "k predicted" in said.out
    assert "largest stable dt [s]" in said.out
    assert "k measured" not in said.out
    assert "k measured" not in springlab("translate", "--stiffness", "200", "--engine", "mujoco", "--predict").out


def test_a_scene_is_translated_as_a_whole() -> None:
    """A row for each kind of spring; the snippet has all of it, and moves as the scheme that it is said to be."""
    words = ("--engine", "pymunk", "--predict", "--json")
    said = springlab("translate", "string", *words)
    assert said.code == 0, said.err
    rows = json.loads(said.out)
    assert len(rows) == 2  # the spring to the anchor joins one mass to what is fixed, the others two
    elongations = run(rows[0]["snippet"])
    trajectory = stepper_named("drift_kick").run(find_scene("string").system({}), 1e-3, 100).trajectory
    assert trajectory is not None
    lengths = np.linalg.norm(trajectory.positions[:, 1] - trajectory.positions[:, 0], axis=1)
    assert np.abs(elongations[:101] - (lengths - 0.125)).max() < 1e-12
    assert rows[0]["largest_stable_dt_s"] == pytest.approx(0.01011295, rel=1e-6)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["translate"], "expected SCENE"),
        (["translate", "string", "--stiffness", "3"], "expected SCENE alone"),
        (["translate", "--stiffness", "-3"], "stiffness = -3: expected"),
        (["translate", "--stiffness", "3", "--mass", "0"], "mass = 0: expected"),
        (["translate", "--stiffness", "3", "--mass-b", "nan"], "mass-b = nan: expected"),
        (["translate", "--stiffness", "3", "--dt", "0"], "dt = 0: expected"),
        (["translate", "--stiffness", "3", "--engine", "box2"], "did you mean 'box2d'"),
        (["translate", "--stiffness", "3", "--engine", "mujoco", "--substeps", "2"], "mujoco has none to set"),
        (["translate", "--from", "box2d", "herz=4"], "did you mean 'hertz'"),
        (["translate", "--from", "box2d", "damping_ratio=1"], "expected hertz=NUMBER"),
        (["translate", "--from", "box2d", "hertz=four"], "expected SETTING=NUMBER"),
        (["translate", "--from", "bullet", "erp=0.2", "cfm=0"], "cfm > 0"),
        (["translate", "--from", "box2d", "hertz=0", "damping_ratio=0.7"], "box2d: hertz = 0, damping_ratio = 0.7: "),
        (["translate", "--from", "box2d", "hertz=1e200"], "box2d: hertz = 1e+200: "),
        (["translate", "--from", "jolt", "compliance=inf"], "jolt: compliance = inf: expected a finite number"),
        (["translate", "--stiffness", "1e300", "--mass", "1e-300"], "stiffness = 1e+300, mass = 1e-300: "),
    ],
)
def test_bad_words_are_one_line(words: list[str], said: str) -> None:
    """Exit code 2, and what was expected."""
    done = springlab(*words)
    assert done.code == 2
    assert said in done.err
    assert done.err.count("\n") == 1
