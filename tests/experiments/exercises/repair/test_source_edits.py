"""Which places of a program are changed at all."""

from __future__ import annotations

import ast

from experiments.exercises.repair.source_edits import edits_of


def texts(text: str, name: str = "own") -> list[str]:
    """What each change makes of the last statement of the program."""
    tree, found = ast.parse(text), []
    for edit in edits_of(tree):
        with edit.applied():
            found.append(ast.unparse(ast.parse(ast.unparse(tree)).body[-1]))
    return found


def test_of_what_is_written_only_the_index_and_the_order_change() -> None:
    """A name that is written into stays; who has unpacked two values the wrong way has them swapped."""
    found = texts("def own(x, a, b):\n    x[3] = a\n    x, b = f(a)")
    lines = {line.strip() for text in found for line in text.splitlines()}
    assert {"x[2] = a", "b, x = f(a)"} <= lines
    assert not any(line.startswith(("-x", "a, b =", "x, a =", "x, x =")) for line in lines)


def test_decorators_and_annotations_are_not_changed() -> None:
    """Nor what a class is of; numbers outside of functions are."""
    assert all("@cache(2)" in text for text in texts("@cache(2)\ndef own(a: f(3)) -> g(4):\n    return a"))
    for part in ("a: f(3)", "-> g(4)"):
        assert all(part in text for text in texts("def own(a: f(3)) -> g(4):\n    return a"))
    assert all("(Base(5))" in text for text in texts("class Own(Base(5)):\n    def own(self):\n        return 6"))
    assert "rate = 4" in texts("rate = 3")
    assert texts("print(3)") == []
