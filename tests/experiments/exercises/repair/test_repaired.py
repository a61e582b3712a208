"""How a change that makes a program right is told: its places, its cost, and the lines before and after."""

from __future__ import annotations

import ast

import pytest

from experiments.exercises.repair.edit import Edit
from experiments.exercises.repair.repaired import LONGEST_CHANGE, Repair, repairs
from experiments.exercises.repair.source_edits import edits_of


class Text:
    """A program, and its changes by what they make of it."""

    def __init__(self, text: str) -> None:
        self._tree = ast.parse(text)
        self.edits = edits_of(self._tree)

    def written(self) -> str:
        """As it is now."""
        return ast.unparse(ast.fix_missing_locations(self._tree))

    def number(self, old: str, new: str) -> int:
        """The first change that makes one line another."""
        text = self.written()
        return next(i for i, edit in enumerate(self.edits) if self._with(edit) == text.replace(old, new))

    def _with(self, edit: Edit) -> str:
        with edit.applied():
            return self.written()

    def repairs(self, *found: list[int]) -> list[Repair]:
        """Those with these numbers."""
        return repairs("own", self.edits, found, self.written)


FUNCTION = "def own(a, b):\n    c = a + b\n    d = c * a\n    print(d)\n    return d\n"


def test_two_places_are_told_in_the_order_of_the_text_and_cost_what_both_do() -> None:
    """Whichever was found first; cheaper ones stand before; numbers beyond the changes that there are do not count."""
    text = Text(FUNCTION)
    sign, times = text.number("a + b", "a - b"), text.number("c * a", "c / a")
    costs = [text.edits[i].cost for i in (sign, times)]
    both, one = text.repairs([times, sign], [len(text.edits)], [times, len(text.edits)], [sign])[::-1]
    assert one.places == ((2, "sign"),)
    assert (one.function, one.change, one.cost) == ("own", "c = a + b -> c = a - b", costs[0])
    assert both.places == ((2, "sign"), (3, "operator"))
    assert both.change == "c = a + b / d = c * a -> c = a - b / d = c / a"
    assert both.cost == pytest.approx(sum(costs))
    assert text.written() == FUNCTION.strip()


def test_a_line_that_only_goes_or_comes_stands_beside_nothing() -> None:
    """Moved into another's place, or taken out; and no more letters than a table has room for."""
    text = Text("def own(a):\n    if a:\n        a = f(a)\n    return a\n")
    gone = text.number("    if a:\n        a = f(a)\n", "    a = f(a)\n")
    assert text.repairs([gone])[0].change == "if a: / a = f(a) -> a = f(a)"
    taken = Text("def own(a, b):\n    return a\n")
    copied = taken.number("    return a", "    a = a.copy()\n    return a")
    assert taken.repairs([copied])[0].change == "nothing -> a = a.copy()"
    longest = Text(f"def own(a):\n    return a + {'b' * 200}\n")
    assert len(longest.repairs([0])[0].change) == LONGEST_CHANGE


def test_in_a_long_text_only_the_line_that_is_other_is_told() -> None:
    """Also where it is among many that are alike, which a matcher of lines may leave out as too common."""
    text = "def own(a, b):\n" + "    a = a * b\n" * 250 + "    a = a + b\n" + "    a = a * b\n" * 3
    tree = ast.parse(text)
    line = next(node for node in ast.walk(tree) if isinstance(node, ast.Assign) and "+" in ast.unparse(node))
    edit = Edit(line.lineno, "sign", 1.0, (((line, "value", None), ast.parse("a - b", mode="eval").body),))
    (found,) = repairs("own", [edit], [[0]], lambda: ast.unparse(tree))
    assert found.change == "a = a + b -> a = a - b"
