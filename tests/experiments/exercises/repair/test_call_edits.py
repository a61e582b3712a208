"""What is tried in place of a call: all of it, of each kind of function."""

from __future__ import annotations

from dataclasses import replace

import pytest

from experiments.exercises.repair.call_edits import of_call
from tests.experiments.exercises.repair.tried import NAMES, tried

#: One array, and a loop's number.
FEW = replace(NAMES, own=["d"])

DEGREES = ("0.017453292519943295", "57.29577951308232")


def along(call: str) -> set[str]:
    """A call without an axis, with one."""
    begin = call.removesuffix(")") + ("" if call.endswith("()") else ", ")
    return {f"{begin}axis={axis}{keep})" for axis in (0, 1) for keep in ("", ", keepdims=True")}


@pytest.mark.parametrize(
    ("call", "found"),
    [
        ("f(a, b, c)", {"too much": {"a", "b", "c"}, "order": {"f(b, a, c)", "f(a, c, b)"}}),
        ("f(a, *b)", {"too much": {"a"}, "order": {"f(*b, a)"}}),
        ("f()", {"name": {"s.mass"}}),
        # an axis is another, or none; what is no axis is only left out
        ("f(a, axis=0)", {"too much": {"a", "f(a)"}, "axis": {"f(a, axis=1)"}}),
        ("f(a, axis=-1)", {"too much": {"a", "f(a)"}, "axis": {"f(a, axis=0)"}}),
        ("f(a, axis=2)", {"too much": {"a", "f(a)"}}),
        ("f(a, axis=d)", {"too much": {"a", "f(a)"}}),
        ("f(a, n=1)", {"too much": {"a", "f(a)"}}),
        (
            "f(a, b=7, axis=1, c=8)",
            {
                "too much": {"a", "f(a, axis=1, c=8)", "f(a, b=7, c=8)", "f(a, b=7, axis=1)"},
                "axis": {"f(a, b=7, axis=0, c=8)"},
            },
        ),
        ("np.cumsum(a)", {"too much": {"a"}, "axis": along("np.cumsum(a)")}),
        ("np.diff(a, axis=0)", {"too much": {"a", "np.diff(a)"}, "axis": {"np.diff(a, axis=1)"}}),
        # of all, that of one
        ("np.mean(a)", {"too much": {"a"}, "index": {"a[i]"}, "axis": along("np.mean(a)")}),
        ("a.sum()", {"name": {"s.mass"}, "index": {"a[i]"}, "axis": along("a.sum()")}),
        (
            "max(a, b)",
            {"too much": {"a", "b"}, "order": {"max(b, a)"}, "index": {"a[i]"}, "axis": along("max(a, b)")},
        ),
        # new arrays
        ("np.array(a)", {"too much": {"a"}, "name": {"s.mass"}, "copy": {"np.array(a, dtype=float)"}}),
        (
            "np.asarray(a, dtype=int, order=b)",
            {"too much": {"a", "np.asarray(a, order=b)", "np.asarray(a, dtype=int)"}},
        ),
        (
            "np.zeros(n)",
            {
                "too much": {"n"},
                "copy": {"np.zeros(n, dtype=float)"},
                "factor": {f"np.zeros(n {more})" for more in ("+ 1", "+ 2", "+ 3", "* d")},
            },
        ),
        (
            "np.full((n, 2), 7)",
            {
                "too much": {"(n, 2)", "7"},
                "order": {"np.full(7, (n, 2))"},
                "factor": {f"np.full((n {more}, 2), 7)" for more in ("+ 1", "+ 2", "+ 3", "* d")}
                | {f"np.full((n, 2 {more}), 7)" for more in ("+ 1", "+ 2", "+ 3", "* d")},
            },
        ),
        ("np.empty()", {"name": {"s.mass"}}),
        # angles
        *(
            (f"{f}(a)", {"too much": {"a"}, "factor": {f"{f}(a * {by})" for by in DEGREES}})
            for f in ("np.sin", "cos", "np.tan")
        ),
        (
            "np.sin(a, b)",
            {"too much": {"a", "b"}, "order": {"np.sin(b, a)"}, "factor": {f"np.sin(a * {by})" for by in DEGREES}},
        ),
        ("np.sin()", {"name": {"s.mass"}}),
        ("np.exp(a)", {"too much": {"a"}}),
        ("np.arctan(a / b)", {"too much": {"a / b"}, "name": {"np.arctan2(a, b)"}}),
        ("atan(a / b)", {"too much": {"a / b"}, "name": {"atan2(a, b)"}}),
        (
            "np.arctan(a / b, c)",
            {"too much": {"a / b", "c"}, "order": {"np.arctan(c, a / b)"}, "name": {"np.arctan2(a, b)"}},
        ),
        ("np.arctan(a * b)", {"too much": {"a * b"}}),
        ("np.linalg.eigvalsh(a)", {"too much": {"a"}, "name": {"np.linalg.eigvals(a)"}}),
        ("eigvalsh(a)", {"too much": {"a"}}),
        # what is counted
        ("range(n)", {"too much": {"n"}, "index": {"range(n + 1)", "range(n - 1)", "range(1, n)"}}),
        (
            "range(1, n)",
            {
                "too much": {"1", "n"},
                "order": {"range(n, 1)"},
                "index": {"range(1 + 1, n)", "range(1 - 1, n)", "range(1, n + 1)", "range(1, n - 1)", "range(n)"},
            },
        ),
        (
            "range(4, n, 3)",
            {
                "too much": {"4", "n", "3"},
                "order": {"range(n, 4, 3)", "range(4, 3, n)"},
                "index": {f"range(4 {by} 1, n, 3)" for by in "+-"}
                | {f"range(4, n {by} 1, 3)" for by in "+-"}
                | {f"range(4, n, 3 {by} 1)" for by in "+-"},
            },
        ),
    ],
)
def test_what_is_tried_is_what_the_function_is_for(call: str, found: dict[str, set[str]]) -> None:
    """What it is given, left out and swapped; its axis; what it makes."""
    assert tried(of_call, f"return {call}", call, FEW) == found
