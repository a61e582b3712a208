"""What is tried in place of a node, by the kind of the change, as text."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator
from typing import Any

from experiments.exercises.repair.edit import sites_in, what_stands_at
from experiments.exercises.repair.names import Names
from experiments.exercises.repair.nodes import Replacement

#: Two arrays and a loop's number; the mass is never read.
NAMES = Names(
    own=["a", "b", "dt", "i"],
    fields={"s": ["mass"], "np": ["pi"]},
    unread=["s.mass"],
    loops=["i"],
    arrays=["x"],
    has_numpy=True,
)

#: What makes the replacements of a node, of the names there are and of what it is in.
Making = Callable[[Any, Names, ast.AST], Iterator[Replacement]]


def first(text: str, wanted: str) -> tuple[Any, ast.AST]:
    """The first node of a statement that is written so, and what it is in."""
    for site in sites_in(ast.parse(text)):
        if ast.unparse(what_stands_at(site)) == wanted:
            return what_stands_at(site), site[0]
    raise AssertionError(text)


def text_of(node: ast.AST) -> str:
    """In the form of a tree that is read: of a node that stands at two places Python writes brackets about both."""
    return ast.unparse(ast.parse(ast.unparse(ast.fix_missing_locations(node))))


def tried(making: Making, text: str, wanted: str, names: Names = NAMES) -> dict[str, set[str]]:
    """By kind, what is tried in place of a node; all of it is at the node's line, and costs as much as one change."""
    node, holder = first(text, wanted)
    found: dict[str, set[str]] = {}
    for family, cost, new in making(node, names, holder):
        assert 1.0 <= cost <= 3.0
        assert new.lineno == node.lineno
        found.setdefault(family, set()).add(text_of(new))
    return found


def costs(making: Making, text: str, wanted: str, names: Names = NAMES) -> dict[str, float]:
    """What each of them costs at least, in the order in which they are made."""
    node, holder = first(text, wanted)
    found: dict[str, float] = {}
    for one in making(node, names, holder):
        new = text_of(one.node)
        found[new] = min(one.cost, found.get(new, one.cost))
    return found
