"""Which changes of a text are tried: what beginners do wrong is one change away from what they meant."""

from __future__ import annotations

import ast

import pytest

from experiments.exercises.repair.source_edits import edits_of

#: By what was done wrong: the lines of a function's body, and the same as they were meant.
SLIPS = {
    "one length for all": ("return d / np.linalg.norm(d)", "return d / np.linalg.norm(d, axis=1, keepdims=True)"),
    "not of length 1": ("n = d\nreturn n", "n = d / np.linalg.norm(d)\nreturn n"),
    "no column": ("return f / s.masses", "return f / s.masses[:, None]"),
    "one slope of two": ("a2 = f(x)\nreturn v + dt * a2", "a2 = f(x)\nreturn v + dt * ((a2 + a1) / 2)"),
    "both of two lines": ("K[i] = b\nK[j] = b\nreturn K", "K[i] += b\nK[j] += b\nreturn K"),
    "both components": ("fx = k * dx\nfy = k * dy\nreturn fx, fy", "fx = -(k * dx)\nfy = -(k * dy)\nreturn fx, fy"),
    "twice in a line": (
        "n = x[i] / size(x[i])\nreturn n, s.centre",
        "n = (x[i] - s.centre) / size(x[i] - s.centre)\nreturn n, s.centre",
    ),
    "two parts of an array": ("return join(k[:-1, 1:], k[:-1, 2:])", "return join(k[:, 1:], k[:, 2:])"),
    "in place in a loop": (
        "for i in r:\n    x[i] = f(x)\nreturn x",
        "_x_before = x.copy()\nfor i in r:\n    x[i] = f(_x_before)\nreturn x",
    ),
    "the last line in the loop": ("for i in r:\n    f(i)\n    g(i)", "for i in r:\n    f(i)\ng(i)"),
    "from the beginning": ("for i in range(n):\n    g(i)", "for i in range(1, n):\n    g(i)"),
    "unpacked the wrong way": ("dv, dy = slope(s)\nreturn dy, dv", "dy, dv = slope(s)\nreturn dy, dv"),
    "turned round": ("w = np.roll(v, 1)\nreturn w", "w = np.roll(v, 1)\nw[0] = 0.0\nreturn w"),
    "only inwards": ("w = v @ n\nreturn w", "w = np.minimum(v @ n, 0.0)\nreturn w"),
    "no root": ("l = x @ x\nreturn l", "l = np.sqrt(x @ x)\nreturn l"),
    "two lines too early": ("x = a\nb = x\nc = x\nreturn b, c", "b = x\nc = x\nx = a\nreturn b, c"),
    "the same name in both": (
        "f += t * x / a1\ng += t * v / a1\nreturn f, g",
        "f += t * x / d\ng += t * v / d\nreturn f, g",
    ),
    "above the first": (
        "for i in r:\n    up = x[i - 1]\nreturn s.centre",
        "for i in r:\n    up = x[i - 1] if i > 0 else s.centre\nreturn s.centre",
    ),
    "below the last": (
        "for i in range(n):\n    f(x[i + 1])",
        "for i in range(n):\n    if i < n - 1:\n        f(x[i + 1])",
    ),
    "projected twice as long": ("c = np.dot(v, d)\nreturn c", "c = np.dot(v, d) / (d @ d)\nreturn c"),
    "a sum of all before": (
        "t = 0\nfor i in r:\n    t += i\n    f(t)",
        "for i in r:\n    t = 0\n    t += i\n    f(t)",
    ),
    "the largest of all signs": ("return np.argmax(v)", "return np.argmax(np.abs(v))"),
    "no root in a product": ("return 2 / (a1 / d)", "return 2 / (a1 / d) ** 0.5"),
    "that of the first": ("for i in r:\n    f(m[0])", "for i in r:\n    f(m[i])"),
}


def function(body: str) -> str:
    """A function of this body, in the form in which trees are written."""
    lines = "\n".join(f"    {line}" for line in body.splitlines())
    return ast.unparse(ast.parse(f"import numpy as np\ndef own(x, v, dt, a1, d, s):\n{lines}"))


def variants(text: str) -> set[str]:
    """The text with each change."""
    tree, found = ast.parse(text), set()
    for edit in edits_of(tree, {"own": ["masses", "centre"]}):
        with edit.applied():
            found.add(ast.unparse(ast.parse(ast.unparse(ast.fix_missing_locations(tree)))))
    return found


@pytest.mark.rotating(5)
@pytest.mark.parametrize("slip", SLIPS)
def test_what_was_meant_is_one_change_away(slip: str) -> None:
    """And what was not meant, a word that is in neither, is not."""
    wrong, meant = SLIPS[slip]
    found = variants(function(wrong))
    assert function(meant) in found
    assert function("return never") not in found
