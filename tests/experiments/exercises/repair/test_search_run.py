"""What a search tries and finds, and in which order, of a program that is made up: it adds to a number."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pytest

from experiments.exercises.repair.source_search import (
    DEARER,
    ENOUGH,
    STEMS,
    Nearness,
    Search,
    _right_share,
    fields_given,
    search_groups,
)


@dataclass(frozen=True)
class Add:
    """A change: so much more is added."""

    more: float
    cost: float = 1.0
    matters: bool = True


@dataclass
class Adding:
    """A program that adds nothing, unless it is changed; `readable` of what is added to, if anything has to be."""

    readable: float | None = None
    anew_by: float = 0.0
    lasts: int | None = None
    calls: list[str] = field(default_factory=list)

    def _names(self, more: float) -> Mapping[str, Any] | None:
        return {"add": lambda x: x + more} if self.readable in (None, more) else None

    def anew(self) -> Mapping[str, Any] | None:
        """As it is."""
        return self._names(0.0)

    def begin_call(self) -> None:
        """Nothing."""

    @contextmanager
    def reached(self) -> Iterator[Collection[int]]:
        """Nothing of interest."""
        yield {7}

    def can_matter(self, edit: Add, reached: Collection[int]) -> bool:
        """As the change says."""
        return edit.matters and reached == {7}

    @contextmanager
    def changed(self, edits: Sequence[Add]) -> Iterator[Mapping[str, Any] | None]:
        """With what they add."""
        yield self._names(sum(edit.more for edit in edits))

    @contextmanager
    def changed_anew(self, edits: Sequence[Add]) -> Iterator[Mapping[str, Any] | None]:
        """The same, and what only shows then."""
        names = self._names(sum(edit.more for edit in edits) + self.anew_by)
        if names is None or self.lasts is None:
            yield names
            return
        left, add = iter(range(self.lasts)), names["add"]
        yield {"add": lambda x: add(x) + (next(left, None) is None)}


def question(x: float, wanted: float = 5.0, steps: int = 0) -> dict[str, Any]:
    """What is so much more than a number; in steps, fed with what the last returned."""
    right = [[np.array(x + wanted * (i + 1))] for i in range(max(1, steps))]
    asked = {"function": "add", "arguments": [np.array(x)], "parts": ["sum"], "steps": steps}
    return {**asked, "right": right, "scales": [100.0], "tolerance": 1e-9, "pairs": False}


def found(
    edits: Sequence[Add],
    program: Adding | None = None,
    questions: Sequence[Mapping[str, Any]] = (question(1.0), question(2.0)),
    seconds: float = 100.0,
    pair_seconds: float = 100.0,
) -> dict[str, Any]:
    """What the search says."""
    search = Search(edits, program or Adding(), questions, np.copy, lambda a, b: not np.array_equal(a, b))
    return search.run(seconds, pair_seconds)


def test_the_change_that_makes_it_right_is_found() -> None:
    """And those that cost little more; what costs more is not tried, nor what cannot matter."""
    edits = [Add(1.0), Add(5.0, 1.2), Add(5.0, 1.2, False), Add(5.0, 1.2 + 0.9 * DEARER), Add(5.0, 1.3 + DEARER)]
    assert found(edits) == {"repairs": [[1], [3]], "tried": 3, "singles_done": True, "pairs_done": False}


def test_how_dear_a_change_may_be_is_by_the_cheapest_that_does() -> None:
    """Not by the last one that was found."""
    costs = (1.0, 1.0 + 0.9 * DEARER, 1.0 + 1.1 * DEARER)
    assert found([Add(5.0, cost) for cost in costs])["repairs"] == [[0], [1]]


def test_of_many_changes_that_do_a_dozen_is_enough() -> None:
    """The others are not tried."""
    done = found([Add(5.0)] * (ENOUGH + 5))
    assert (done["repairs"], done["tried"]) == ([[i] for i in range(ENOUGH)], ENOUGH)


def test_of_a_right_program_nothing_is_tried() -> None:
    """There is nothing to repair."""
    done = found([Add(1.0)], questions=[question(1.0, 0.0)])
    assert done == {"repairs": [], "tried": 0, "singles_done": True, "pairs_done": True}


def test_two_changes_that_do_together_what_neither_does_are_found() -> None:
    """First all by themselves; then each that comes nearer with all others: from the nearest, each pair twice."""
    edits = [Add(2.0), Add(3.0), Add(-4.0), Add(4.999, matters=False)]
    done = found(edits)
    assert done["repairs"] == [[1, 0], [0, 1]]
    assert (done["singles_done"], done["pairs_done"]) == (True, True)
    # -4 is no nearer than nothing: from 3 and from 2 two pairs each, besides three single changes
    assert done["tried"] == 3 + 4


def test_three_pairs_are_enough() -> None:
    """Then it is not said that all were tried."""
    done = found([Add(2.0), Add(3.0), Add(3.0), Add(3.0)])
    assert len(done["repairs"]) == 3
    assert not done["pairs_done"]


def test_pairs_are_made_of_those_that_come_nearest() -> None:
    """Of so many; the change that does it with another one that is far off is not gone on from."""
    near = [Add(4.9 + 0.001 * i) for i in range(STEMS + 3)]
    done = found([Add(-10.0), *near, Add(15.0)])
    assert done["repairs"] == []
    assert done["tried"] == len(near) + 2 + STEMS * (len(near) + 1)


def test_nearer_is_who_answers_more_questions_then_who_has_more_numbers() -> None:
    """And a change is left at once that answers the first worse than the text as it is."""
    search = Search([Add(2.0), Add(3.0)], Adding(), [question(1.0)], np.copy, lambda a, b: not np.array_equal(a, b))
    search._mattering = [0, 1]
    for one, other, first in (
        (Nearness(0, 1.9), Nearness(1, 1.2), 1),
        (Nearness(1, 1.2), Nearness(1, 1.3), 1),
        (Nearness(1, 1.3), Nearness(1, 1.3), 0),
    ):
        for stems in ([(one, 0), (other, 1)], [(other, 1), (one, 0)]):
            assert search._pairs(stems, [question(1.0)], 100.0) == ([[first, 1 - first], [1 - first, first]], True)
    # what makes the first no worse is gone on from: far from right beside its tolerance, all are as near as can be told
    alike = {**question(1.0), "scales": [1e12], "tolerance": 1e-30}
    assert found([Add(2.0), Add(3.0)], questions=[alike, question(1.0)])["repairs"] == [[1, 0], [0, 1]]
    # of the second question, whose scale is larger, all is nearer than that of the first
    larger = {**question(1.0), "scales": [1e4]}
    assert found([Add(2.0), Add(3.0)], questions=[question(1.0), larger])["repairs"] == [[1, 0], [0, 1]]
    assert found([Add(2.0), Add(3.0)], questions=[larger, question(1.0)])["repairs"] == [[1, 0], [0, 1]]


def test_first_steps_are_looked_at_until_all_may_be_right() -> None:
    """What is right at first and wrong later is near; but a text that is so is to be repaired."""
    later = question(1.0, wanted=0.0, steps=2)
    later["right"][1] = [np.array(3.0)]
    search = Search([], Adding(), [later], np.copy, lambda a, b: not np.array_equal(a, b))
    names = Adding().anew()
    assert names is not None
    assert search.nearness(names, [later]) == (1, 1.0)
    assert search._share(names, later, True) < 1.0
    assert found([Add(1.0)], questions=[later])["tried"] == 1


def test_time_that_is_used_up_is_told() -> None:
    """For single changes, and for pairs."""
    assert found([Add(5.0)], seconds=-1.0) == {
        "repairs": [],
        "tried": 0,
        "singles_done": False,
        "pairs_done": True,
    }
    assert found([Add(2.0), Add(3.0)], pair_seconds=0.0) == {
        "repairs": [],
        "tried": 2,
        "singles_done": True,
        "pairs_done": False,
    }
    assert found([Add(2.0), Add(3.0)], pair_seconds=0.9)["repairs"] == [[1, 0], [0, 1]]
    search = Search([Add(2.0), Add(3.0)], Adding(), [question(1.0)], np.copy, lambda a, b: not np.array_equal(a, b))
    search._mattering = [0, 1]
    assert search._pairs([(Nearness(0, 0.5), 0)], [question(1.0)], -1.0) == ([], False)


def test_what_cannot_be_read_may_be_mended_by_a_change() -> None:
    """All are tried then, also what else could not matter; from those that leave it unreadable nothing follows."""
    edits = [Add(1.0), Add(5.0, matters=False), Add(3.0)]
    done = found(edits, Adding(readable=5.0))
    assert (done["repairs"], done["tried"]) == ([[1]], 3)
    assert found([Add(2.0), Add(3.0)], Adding(readable=5.0))["repairs"] == []


def test_it_has_to_hold_in_all_questions_all_steps_and_anew() -> None:
    """What is right in the few that are tried first is asked all: one that wants more, steps, a module of its own."""
    many = [question(float(i)) for i in range(4)]
    assert found([Add(5.0)], questions=many)["repairs"] == [[0]]
    # the two that are not tried first want another answer
    sizes = [{**q, "arguments": [np.full(i + 1, 1.0)]} for i, q in enumerate(many)]
    right = [{**q, "right": [[q["arguments"][0] + (5.0 if i != 1 else 6.0)]]} for i, q in enumerate(sizes)]
    assert found([Add(5.0)], questions=right)["repairs"] == []
    assert found([Add(5.0)], questions=[question(1.0, steps=3)])["repairs"] == [[0]]
    wrong_later = question(1.0, steps=3)
    wrong_later["right"][2] = [np.array(0.0)]
    assert found([Add(5.0)], questions=[wrong_later])["repairs"] == []
    assert found([Add(5.0)], Adding(anew_by=1.0))["repairs"] == []


@pytest.mark.parametrize(("lasts", "held"), [(2, False), (3, False), (4, False), (5, True)])
def test_what_remembers_its_calls_does_not_hold(lasts: int, held: bool) -> None:
    """Three questions are asked in a module of its own, and two of them once more: five calls have to be right."""
    three = [question(float(i)) for i in range(3)]
    assert found([Add(5.0)], Adding(lasts=lasts), three)["repairs"] == [[0]] * held
    # all of two steps, and the first of them once more
    steps = [question(1.0, steps=2)]
    assert found([Add(5.0)], Adding(lasts=lasts), steps)["repairs"] == [[0]] * (lasts >= 3)


def test_what_cannot_be_made_anew_does_not_hold() -> None:
    """It was changed in place, and cannot be read as a whole."""
    program = Adding()
    program.changed_anew = Adding(readable=-1.0).changed  # type: ignore[method-assign]
    assert found([Add(5.0)], program)["repairs"] == []


@pytest.mark.parametrize(("changes", "right"), [("", 1.0), ("x", 0.5), ("v", 0.5)])
def test_steps_are_fed_with_arrays_and_numbers(changes: str, right: float) -> None:
    """A number stays one; who changes one of several arrays has half."""

    def step(x: Any, y: Any, v: Any) -> Any:
        assert type(y) is float
        moved = x + v, y + 1.0
        if changes:
            {"x": x, "v": v}[changes][0] += 1.0
        return moved

    x, v = np.array([1.0, 2.0]), np.array([0.5, 1.0])
    asked = {
        "function": "step",
        "arguments": [x, 3.0, v],
        "parts": ["x", "y"],
        "steps": 3,
        "right": [[x + i * v, np.array(3.0 + i)] for i in (1, 2, 3)],
        "scales": [1.0, 1.0],
        "tolerance": 1e-9,
        "pairs": False,
    }

    def fresh(value: Any) -> Any:
        return value.copy() if isinstance(value, np.ndarray) else value

    search = Search([], Adding(), [asked], fresh, lambda a, b: not np.array_equal(a, b))
    assert search._share({"step": step}, asked, True) == right


def share(value: Any, want: Any, **other: Any) -> float:
    """Of one part."""
    asked = {"right": [[np.asarray(want)]], "scales": [2.0], "tolerance": 1e-3, "pairs": False, **other}
    return _right_share([np.asarray(value)], asked, 0)


@pytest.mark.parametrize(
    ("value", "want", "expected"),
    [
        ([1.0, 2.0], [1.0, 2.0], 1.0),
        ([1.0, 2.001], [1.0, 2.0], 1.0),
        ([1.0, 2.2], [1.0, 2.0], (1 + 1 / 8) / 2),
        ([1.0, 4.0], [1.0, 2.0], 1 / 2),
        ([1.0, 9.0], [1.0, 2.0], 1 / 2),
        ([1.0], 1.0, 1.0),
        ([[3.0]], 1.0, 0.0),
        ([1.0, 2.0], 1.0, 0.0),
        ([1.0, 2.0, 3.0], [1.0, 2.0], 0.0),
        (["1", "2"], [1.0, 2.0], 0.0),
        ([], [], 1.0),
    ],
)
def test_the_share_of_right_numbers(value: Any, want: Any, expected: float) -> None:
    """To a thousandth of a scale of 2; a tenth of it is one digit of eight; what has another form is no number."""
    assert share(value, want) == pytest.approx(expected)


def test_a_share_is_less_than_one_unless_all_are_right() -> None:
    """Whatever rounding makes of a sum; and no number is better than right."""
    assert share([1.0, 1.0 + 2.1e-3], [1.0, 1.0], tolerance=1e-9) < 1.0
    assert share([1.0, np.nan], [1.0, 1.0]) < 1.0
    assert share([1.0, 1.0], [1.0, 1.0], tolerance=0.0) == 1.0
    two = {
        "right": [[np.array(1.0), np.array([1.0, 2.0, 3.0])]],
        "scales": [1.0, 1.0],
        "tolerance": 0.1,
        "pairs": False,
    }
    assert _right_share([np.array(9.0), np.array([1.0, 2.0, 3.0])], two, 0) == pytest.approx(3 / 4)


def test_pairs_count_in_any_order() -> None:
    """Which comes first, which end; two rows or two columns; no pairs at all."""
    pairs = [[0, 1], [1, 2], [0, 3]]
    for same in ([[3, 0], [2, 1], [0, 1]], [[0, 2, 0], [1, 1, 3]]):
        assert share(same, pairs, pairs=True) == 1.0
    assert share([[0, 1], [1, 2], [0, 2]], pairs, pairs=True) < 1.0
    assert share([], np.zeros((0, 2)), pairs=True) == 1.0
    assert share([], [[0, 0]], pairs=True) == share([[0, 0]], np.zeros((0, 2)), pairs=True) == 0.0
    assert share([[0, 1, 2]], pairs, pairs=True) == 0.0
    assert share([0, 1], pairs, pairs=True) == 0.0
    assert share([["0", "1"], ["1", "2"], ["0", "3"]], pairs, pairs=True) == 0.0
    assert share([[1, 0], [3, 2]], [[2, 3], [0, 1]], pairs=True) == 1.0


def test_fields_that_are_given() -> None:
    """Of each function that is given any, those of its last argument."""
    asked = [
        {"function": "step", "arguments": [1.0, {"mass": 1.0, "gravity": 2.0}]},
        {"function": "names", "arguments": []},
        {"function": "cloth", "arguments": [{"no": 1}, 3]},
    ]
    assert fields_given(asked) == {"step": ["mass", "gravity"]}


def test_groups_share_the_time() -> None:
    """Each group has its own search, of its own changes."""
    had: list[tuple[float, float]] = []

    class Noting(Search):
        def run(self, seconds: float, pair_seconds: float) -> dict[str, Any]:
            had.append((seconds, pair_seconds))
            return super().run(seconds, pair_seconds)

    groups = [[question(1.0, wanted)] for wanted in (5.0, 6.0)]
    edits = {5.0: [Add(5.0)], 6.0: [Add(1.0), Add(6.0)]}

    def begun(group: Sequence[Mapping[str, Any]]) -> tuple[Sequence[Add], Adding]:
        return edits[float(group[0]["right"][0][0]) - 1.0], Adding()

    changed: Callable[..., bool] = lambda a, b: False  # noqa: E731
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("experiments.exercises.repair.source_search.Search", Noting)
        done = search_groups({"groups": groups, "seconds": 60.0, "pair_seconds": 30.0}, begun, np.copy, changed)
        assert search_groups({"groups": [], "seconds": 60.0, "pair_seconds": 30.0}, begun, np.copy, changed) == []
    assert [one["repairs"] for one in done] == [[[0]], [[1]]]
    assert had == [(30.0, 15.0)] * 2
