"""What `springlab translate` asks for and shows, of rows that are made up."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from engines.translation.translation import Spring, Stepping, find
from reference.errors import InputError
from report.commands.translate import _numbers, _show, _typed
from tests.report.commands.terminal import springlab
from tests.report.commands.test_simulate import table


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[tuple[Any, ...]]:
    """What rows were asked for."""
    asked: list[tuple[Any, ...]] = []
    rows = "experiments.translation.rows"
    one = SimpleNamespace(document={})
    for name in (f"{rows}.forward", "experiments.translation.scene_rows.rows_of_scene"):
        monkeypatch.setattr(name, lambda *given: asked.append(given) or [])
    monkeypatch.setattr(f"{rows}.backward", lambda *given: asked.append(given) or one)
    return asked


def test_a_spring_has_what_is_given_and_else_no_damping_on_one_kilogram(asked: list[Any]) -> None:
    """At a sixtieth of a second; run where it is installed."""
    springlab("translate", "--stiffness", "200", "--json")
    words = ["--damping", "0.5", "--mass", "2", "--mass-b", "3", "--dt", "0.25", "--substeps", "4", "--iterations", "7"]
    springlab("translate", "--stiffness", "200", *words, "--engine", "jolt", "--engine", "box2d", "--predict", "--json")
    assert asked == [
        (Spring(200.0, 0.0, 1.0, None), Stepping(1 / 60), [], True),
        (Spring(200.0, 0.5, 2.0, 3.0), Stepping(0.25, 4, 7), [find("jolt"), find("box2d")], False),
    ]


def test_a_scene_has_its_own_step_and_an_engine_s_numbers_a_mass(asked: list[Any]) -> None:
    """Unless others are given."""
    springlab("translate", "string", "--engine", "mujoco", "--json")
    springlab("translate", "string", "--dt", "0.25", "--substeps", "4", "--iterations", "7", "--predict", "--json")
    first, second = ((stepping, chosen, measure) for _, stepping, chosen, _, measure in asked)
    assert first == (Stepping(1e-3), [find("mujoco")], True)
    assert second == (Stepping(0.25, 4, 7), [], False)
    asked.clear()
    words = ("--mass", "2", "--mass-b", "3", "--dt", "0.25")
    springlab("translate", "--from", "mujoco", "stiffness=5", "--json")
    springlab("translate", "--from", "mujoco", "damping=2", *words, "--predict", "--json")
    assert asked == [
        (find("mujoco"), {"stiffness": 5.0}, Spring(1.0, 0.0, 1.0), Stepping(1 / 60), True),
        (find("mujoco"), {"damping": 2.0}, Spring(1.0, 0.0, 2.0, 3.0), Stepping(0.25), False),
    ]


@pytest.mark.parametrize("word", ["--stiffness=2", "--damping=2", "--engine=jolt"])
def test_an_engine_s_numbers_stand_alone(word: str) -> None:
    """What is asked for beside them is refused."""
    said = springlab("translate", "--from", "mujoco", "stiffness=5", word)
    assert (said.code, said.err) == (2, "springlab: --from: expected no --stiffness, --damping or --engine beside it\n")


def test_several_numbers_have_a_translation_of_their_own() -> None:
    """With a comma or a space between them; one number stays one."""
    mujoco = find("mujoco")
    assert _typed(mujoco, ["stiffness=5", "damping=0.5"]) == (mujoco, {"stiffness": 5.0, "damping": 0.5})
    for word in ("solref=0.02,1", "solref=0.02 1"):
        assert _typed(mujoco, [word]) == (find("mujoco_solref"), {"solref_0": 0.02, "solref_1": 1.0})
    assert _typed(mujoco, []) == (mujoco, {})
    for word in ("solref=1,2,3", "solref=1"):
        with pytest.raises(InputError, match="expected two numbers"):
            _typed(mujoco, [word])


@pytest.mark.parametrize(
    ("spring", "wanted", "shown"),
    [
        (None, (200.0, 0.0), ("-", "-")),
        ((200.166666, 0.123456), (200.0, 0.0), ("200.17", "0.1235")),
        ((200.0, 1.9e-10), (200.0, 0.0), ("200", "0")),
        ((200.0, 2.1e-10), (200.0, 0.0), ("200", "2.1e-10")),
        ((200.0, -1.9e-10), (10.0, 0.0), ("200", "0")),
        ((1e-11, 0.5), (2.0, 20.0), ("0", "0.5")),
        ((-3e-11, 0.5), (2.0, 20.0), ("-3e-11", "0.5")),
    ],
)
def test_what_rounding_leaves_is_nothing(
    spring: tuple[float, float] | None, wanted: tuple[float, float], shown: tuple[str, str]
) -> None:
    """By a part of 1e-12 of the largest number there is."""
    assert _numbers(spring, wanted) == shown


def row(engine: str, **fields: Any) -> Any:
    """One, predicted only."""
    plain = {"title": f"{engine}'s", "reason": "", "snippet": "", "wanted": (200.0, 0.5), "measured": None}
    plain |= {"settings": {"a": 1.0, "b": 2.5}, "effective": (190.0, 0.25), "largest_stable_dt": None}
    return SimpleNamespace(engine=engine, **{**plain, **fields})


def test_rows_are_shown_with_what_to_type_and_what_it_makes(capsys: pytest.CaptureFixture[str]) -> None:
    """An engine's name once; what was measured where anything was; why; of one the snippet."""
    rows = [row("one", snippet="code()"), row("two", settings={"c": 1 / 3}, largest_stable_dt=0.0123456, reason="odd")]
    _show(rows, whole=False)
    said = capsys.readouterr().out
    assert table(said, "meant: k = 200 N/m, c = 0.5 N s/m") == [
        ["engine", "type"],
        ["one", "a=1"],
        ["b=2.5"],
        ["two", "c=0.333333"],
    ]
    lines = [line.split() for line in said.splitlines()]
    assert ["engine", "k", "predicted", "c", "predicted", "largest", "stable", "dt", "[s]"] in lines
    assert ["one", "190", "0.25", "none"] in lines
    assert ["two", "190", "0.25", "0.01235"] in lines
    assert "one, one's\ntwo, two's: odd\n" in said
    assert "code()" not in said
    _show([rows[0], row("two", measured=(180.0, 0.125), wanted=(100.0, 0.0))], whole=True)
    said = capsys.readouterr().out
    lines = [line.split() for line in said.splitlines()]
    assert "meant" not in said  # each another
    assert ["one", "190", "0.25", "-", "-", "none"] in lines
    assert ["two", "190", "0.25", "180", "0.125", "none"] in lines
    assert said.endswith("\ncode()\n")
