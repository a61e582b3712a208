"""Of which kind values in C are, and what may stand for what: by hand, in the form of trees of Python's kind."""

from __future__ import annotations

import ast

import pytest

from experiments.exercises.c.kinds import NUMBER, UNKNOWN, WHOLE, Kind, kind_in, may_replace

ROW, ROWS, STRUCT = Kind("number", 1), Kind("number", 2), Kind("string", 0)
KINDS = {
    "n": WHOLE,
    "dt": NUMBER,
    "y": ROW,
    "x": ROWS,
    "s": STRUCT,
    "all": Kind("string", 1),
    "many": Kind("whole", 1),
    "p": Kind("void", 0),
}
FIELDS = {"string.masses": ROW, "string.count": WHOLE, "string.drag": NUMBER}


def tree(text: str) -> ast.expr:
    """Of an expression; a call of c_NAME is one of what C writes as (NAME)."""
    made = ast.parse(text, mode="eval").body
    for node in ast.walk(made):
        if isinstance(node, ast.Name) and node.id.startswith("c_"):
            node.id = f"({node.id[2:]})"
    return made


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("n", WHOLE),
        ("q", UNKNOWN),
        ("1", WHOLE),
        ("1.5", NUMBER),
        ("y.at", NUMBER),
        ("x.at", ROW),
        ("dt.at", UNKNOWN),
        ("q.at", UNKNOWN),
        ("s.masses", ROW),
        ("s.count", WHOLE),
        ("s.mass", UNKNOWN),
        ("all[0].drag", NUMBER),
        ("x[0]", ROW),
        ("x[0, 1]", NUMBER),
        ("y[n]", NUMBER),
        ("y[0, 1]", UNKNOWN),
        ("q[0]", UNKNOWN),
        ("n + n", WHOLE),
        ("n * dt", NUMBER),
        ("dt / n", NUMBER),
        ("q + dt", NUMBER),
        ("q + n", UNKNOWN),
        ("q + q", UNKNOWN),
        ("y + 1", ROW),
        ("1 + y", ROW),
        ("n ** 2", NUMBER),
        ("n < dt", WHOLE),
        ("q and dt", WHOLE),
        ("-n", WHOLE),
        ("-dt", NUMBER),
        ("not y", WHOLE),
        ("dt if n else n", NUMBER),
        ("c_double(n)", NUMBER),
        ("c_float(n)", NUMBER),
        ("c_int(dt)", UNKNOWN),
        ("sqrt(n)", NUMBER),
        ("atan2(n, n)", NUMBER),
        ("malloc(n)", Kind("void", 1)),
        ("realloc(y, n)", Kind("void", 1)),
        ("abs_c_(dt)", WHOLE),
        ("sizeof(y)", WHOLE),
        ("own(dt)", UNKNOWN),
        ("s.own(dt)", UNKNOWN),
        ("(dt, dt)", UNKNOWN),
    ],
)
def test_the_kind_of_a_value(text: str, kind: Kind) -> None:
    """As far as it can be told."""
    assert kind_in(tree(text), KINDS, FIELDS) == kind


@pytest.mark.parametrize(
    ("new", "old", "may"),
    [
        ("n", "dt", True),
        ("q", "dt", True),
        ("y", "q", True),
        ("y", "dt", False),
        ("dt", "y", False),
        ("x[0]", "y", True),
        ("x", "y", False),
        ("y[0]", "dt", True),
        ("s", "dt", False),
        ("dt", "s", False),
        ("own(n)", "own(dt)", True),
        ("own(y)", "own(dt)", False),
        ("own(s)", "own(dt)", False),
        ("own(n, y)", "own(dt, n)", False),
        ("own(n)", "own(dt, n)", True),
        ("other(y)", "own(dt)", True),
        ("s.own(y)", "own(dt)", True),
        ("q * dt", "dt", True),
        ("dt + s", "q", False),
        ("p + 1", "q", False),
        ("y + n", "y", True),
        ("y - 1", "y", True),
        ("y + dt", "y", False),
        ("y + many", "y", False),
        ("n + y", "y", False),
        ("y * n", "y", False),
        ("y + y", "y", False),
        ("-y", "y", False),
        ("-s", "q", False),
        ("-dt", "dt", True),
        ("not y", "n", True),
        ("y if n else y", "y", True),
        ("y if n else dt", "q", False),
        ("x[n, q]", "dt", True),
        ("x[n, dt]", "dt", False),
        ("y[n, n]", "q", False),
        ("q[n, n]", "dt", True),
        ("y[1.5]", "dt", False),
        ("sqrt(dt + s)", "dt", False),
    ],
)
def test_what_may_stand_for_what(new: str, old: str, may: bool) -> None:
    """What the compiler would refuse, and what makes no sense, may not."""
    assert may_replace(tree(new), tree(old), False, KINDS, FIELDS) == may


@pytest.mark.parametrize(
    ("new", "may"), [("n", True), ("n + 1", True), ("q", True), ("dt", False), ("y", False), ("n * 0.5", False)]
)
def test_an_index_is_a_whole_number(new: str, may: bool) -> None:
    """Or may be one, for all that is known."""
    assert may_replace(tree(new), tree("n"), True, KINDS, FIELDS) == may
