"""The changes of a C program that are compiled: what a search is told of them, and what is told of what it finds."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import pytest

from experiments.exercises.c import changes
from experiments.exercises.c.changes import CChanges
from experiments.exercises.c.compiler import Compiled
from experiments.exercises.exercise import Question

TEXT = """#define EXERCISE 1
void step(double *y, double *v, double dt, const struct spring *s)
{
    *y += dt * *v;
    *v -= dt * *y / s->mass;
}
"""

GROUPS = [
    [Question("step", (0.0, 0.0, 0.1, {"mass": 1.0, "gravity": 2.0}), ("y", "v"), "first")],
    [Question("other", (0.0, {"radius": 1.0}), ("x",), "second")],
]


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[tuple[Any, ...]]:
    """What a compiler that compiles anything is asked for."""
    had: list[tuple[Any, ...]] = []

    def with_variants(*given: Any) -> Compiled:
        had.append(given)
        return Compiled(b"made", (), ())

    monkeypatch.setattr(changes.compiler, "with_variants", with_variants)
    return had


def made(text: str = TEXT, groups: Sequence[Sequence[Question]] = GROUPS, **more: Any) -> CChanges:
    """The changes of a program."""
    found = CChanges.of(1, text, groups, **more)
    assert found is not None
    return found


def test_what_a_search_is_told_is_of_each_change_its_own_cost(asked: list[tuple[Any, ...]]) -> None:
    """The cheapest come first; those that are no C, or the same as another, are left out."""
    found = made(most=60)
    task = found.task()
    on = [
        (edit.cost, switches) for edit, switches in zip(found.edits, found.variants.switches, strict=False) if switches
    ]
    assert task == {"changes": on, "places": found.variants.places}
    assert len(on) == 60 < len(found.variants.switches)
    costs = [cost for cost, _ in task["changes"]]
    assert costs == sorted(costs)
    assert costs[0] < costs[-1]
    assert (found.function, found.library) == ("step", Compiled(b"made", (), ()))
    assert asked == [(1, found.variants, False)]
    made(exposed=True)
    assert asked[-1][-1] is True


def test_fields_that_are_given_are_tried(asked: list[tuple[Any, ...]]) -> None:
    """Those of the first question's last argument, of all functions: gravity, which the program never reads."""
    assert any("gravity" in text for text in made().variants.text().splitlines() if "dt" in text)
    assert "radius" not in made().variants.text().split("switches.h")[1]


def test_repairs_are_those_that_were_tried(asked: list[tuple[Any, ...]]) -> None:
    """By their numbers among these; a copy is told in words."""
    found = made()
    tried = [edit for edit, switches in zip(found.edits, found.variants.switches, strict=False) if switches]
    sign = next(i for i, e in enumerate(tried) if found.told(e) == "*y += dt * *v; -> *y -= dt * *v;")
    (repair,) = found.repairs([[sign]])
    assert (repair.function, repair.places, repair.cost) == ("step", ((4, "sign"),), tried[sign].cost)
    assert repair.change == "*y += dt * *v; -> *y -= dt * *v;"
    assert len(tried) < len(found.edits)
    copies = [[i] for i, e in enumerate(tried) if "_given" in found.told(e)]
    assert {repair.change for repair in found.repairs(copies)} == {found.told(tried[i]) for (i,) in copies}
    assert {found.told(tried[i]) for (i,) in copies} == {
        "*y += dt * *v; -> _v_given = a copy of v; / *y += dt * *_v_given;",
        "*v -= dt * *y / s->mass; -> _y_given = a copy of y; / *v -= dt * *_y_given / s->mass;",
    }


@pytest.mark.parametrize("text", ["void step(", "int a;\nint a\n", "void f(void) { }" * 5000])
def test_what_is_not_read_has_no_changes(asked: list[tuple[Any, ...]], text: str) -> None:
    """And nothing is compiled."""
    assert CChanges.of(1, text, GROUPS) is None
    assert asked == []


def test_what_is_not_compiled_has_no_changes(monkeypatch: pytest.MonkeyPatch) -> None:
    """As it was read."""
    monkeypatch.setattr(changes.compiler, "with_variants", lambda *_: None)
    assert CChanges.of(1, TEXT, GROUPS) is None
