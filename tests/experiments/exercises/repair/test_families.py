"""Of which kind a change is, on which line, what it costs: by what was written and what was meant."""

from __future__ import annotations

import ast
from functools import cache

import pytest

from experiments.exercises.repair.alike_edits import of_alike
from experiments.exercises.repair.edit import Edit
from experiments.exercises.repair.names import names_in
from experiments.exercises.repair.source_edits import edits_of, without_main
from tests.experiments.exercises.repair.test_edits import SLIPS, function

GIVEN = "_x_given = x.copy() if hasattr(x, 'copy') else x\n"

#: By the kind of the change, what was written and what was meant: each one change away.
CHANGES: list[tuple[str, str, str]] = [
    # operators, and their two sides
    ("sign", "return a1 + d", "return a1 - d"),
    ("sign", "return a1 - d", "return a1 + d"),
    ("operator", "return a1 + d", "return a1 * d"),
    ("operator", "return a1 - d", "return a1 * d"),
    *(("operator", "return a1 * d", f"return a1 {other} d") for other in "/+-@"),
    *(("operator", "return a1 / d", f"return a1 {other} d") for other in "*-"),
    ("operator", "return a1 // d", "return a1 / d"),
    ("operator", "return a1 % d", "return a1 / d"),
    ("operator", "return a1 ** d", "return a1 * d"),
    ("operator", "return a1 @ d", "return a1 * d"),
    *(("order", f"return a1 {same} d", f"return d {same} a1") for same in ("-", "/", "**", "@")),
    ("too much", "return a1 + d", "return a1"),
    ("too much", "return a1 + d", "return d"),
    ("order", "return a1 - d * dt", "return (a1 - d) * dt"),
    ("order", "return (a1 - d) * dt", "return a1 - d * dt"),
    ("sign", "a1 += d", "a1 -= d"),
    ("operator", "a1 *= d", "a1 /= d"),
    ("operator", "a1 += d", "a1 = d"),
    ("copy", "a1 += d", "a1 = a1 + d"),
    ("operator", "a1 = d", "a1 += d"),
    ("operator", "x[0] = d", "x[0] -= d"),
    ("sign", "return -d", "return d"),
    ("sign", "return d", "return -d"),
    # conditions
    ("condition", "return not d", "return d"),
    *(("condition", "return a1 < d", f"return a1 {other} d") for other in (">", "<=", ">=")),
    *(("condition", "return a1 >= d", f"return a1 {other} d") for other in ("<=", ">", "<")),
    *(("condition", "return a1 == d", f"return a1 {other} d") for other in ("!=", "<", ">")),
    ("condition", "return a1 and d", "return a1 or d"),
    ("condition", "return a1 or d", "return a1 and d"),
    ("condition", "return a1 and d", "return d"),
    ("condition", "return x if d else v", "return x"),
    ("condition", "return x if d else v", "return v"),
    ("condition", "return True", "return False"),
    # numbers
    *(("factor", "return 3", f"return {other}") for other in ("4", "2", "6", "1.5", "-3", "0", "1")),
    ("factor", "return 0.5", "return 1.0"),
    ("factor", "return d * a1", "return d ** 2 * a1"),
    ("factor", "return d.sum()", "return (d ** 2).sum()"),
    ("factor", "return f(np.sqrt(d))", "return f(np.sqrt(d * a1))"),
    ("factor", "return d", "return d * 2"),
    ("factor", "return d", "return d * 0.5"),
    ("factor", "f(s.masses)\nreturn d", "f(s.masses)\nreturn d / s.masses"),
    ("factor", "f(s.masses)\nreturn d", "f(s.masses)\nreturn d * s.masses"),
    ("left out", "return d", "return d / s.masses"),
    ("left out", "return d", "return d - s.masses * v"),
    ("name", "return 0.05\nreturn s.masses", "return s.masses\nreturn s.masses"),
    # names and functions
    ("name", "return d", "return a1"),
    ("name", "return s.masses + s.centre", "return s.centre + s.centre"),
    ("copy", "a1 = d", "a1 = d.copy()"),
    ("name", "return np.sin(d)", "return np.cos(d)"),
    ("name", "return d.sum()", "return d.mean()"),
    ("name", "return np.vstack(d)", "return np.hstack(d)"),
    ("name", "return np.arctan(x / v)", "return np.arctan2(x, v)"),
    ("name", "return np.linalg.eigvalsh(d)", "return np.linalg.eigvals(d)"),
    ("name", "f(s.centre)\nreturn np.array(d)", "f(s.centre)\nreturn s.centre"),
    ("name", "f(s.centre)\nreturn g()", "f(s.centre)\nreturn s.centre"),
    ("axis", "return d.T", "return d"),
    ("axis", "return d * a1", "return d.T * a1"),
    ("axis", "return d * a1", "return d[:, None] * a1"),
    (
        "condition",
        "for i in r:\n    up = x[i] - s.anchor",
        "for i in r:\n    up = x[i] - (x[i - 1] if i > 0 else s.anchor)",
    ),
    # arguments
    ("too much", "return f(d)", "return d"),
    ("order", "return f(d, a1)", "return f(a1, d)"),
    ("too much", "return f(d, axis=1)", "return f(d)"),
    ("axis", "return f(d, axis=1)", "return f(d, axis=0)"),
    ("axis", "return f(d, axis=0)", "return f(d, axis=1)"),
    ("axis", "return np.sum(d)", "return np.sum(d, axis=1)"),
    ("axis", "return np.sum(d)", "return np.sum(d, axis=0, keepdims=True)"),
    ("factor", "return np.cos(d)", "return np.cos(d * 0.017453292519943295)"),
    ("factor", "return np.sin(d)", "return np.sin(d * 57.29577951308232)"),
    ("index", "for i in r:\n    f(np.mean(d))", "for i in r:\n    f(d[i])"),
    ("index", "for i in r:\n    f(d.sum())", "for i in r:\n    f(d[i])"),
    ("axis", "return np.sum(d, keepdims=True)", "return np.sum(d, keepdims=True, axis=1)"),
    ("factor", "return np.sin(d, a1)", "return np.sin(d * 0.017453292519943295)"),
    ("index", "for i in r:\n    f(np.sum(d, 0))", "for i in r:\n    f(d[i])"),
    ("factor", "return np.full(4, d)", "return np.full(4 + 1, d)"),
    ("copy", "return np.zeros(3, order=d)", "return np.zeros(3, order=d, dtype=float)"),
    ("copy", "return np.array(d)", "return np.array(d, dtype=float)"),
    ("copy", "return np.zeros_like(d)", "return np.zeros_like(d, dtype=float)"),
    ("factor", "return np.zeros(4)", "return np.zeros(4 + 2)"),
    ("factor", "return np.zeros((dt, 2))", "return np.zeros((dt * d, 2))"),
    ("index", "return range(d)", "return range(d - 1)"),
    ("index", "return range(d)", "return range(d + 1)"),
    ("index", "return range(d)", "return range(1, d)"),
    ("index", "return range(1, d)", "return range(d)"),
    ("index", "return range(1, d)", "return range(1 - 1, d)"),
    # parts of arrays
    *(("index", "return x[1:]", f"return x[{other}]") for other in (":-1", ":", "1:-1", "2:", ":-2", "::-1")),
    ("index", "return x[0]", "return x[:, None]"),
    *(("index", "return x[3]", f"return x[{other}]") for other in ("0", "1", "-1", "4", "2")),
    ("index", "for i in r:\n    f(x[1])", "for i in r:\n    f(x[i])"),
    ("index", "x[3] = d", "x[4] = d"),
    ("index", "return x[d + 1]", "return x[d]"),
    ("sign", "return x[d + 1]", "return x[d - 1]"),
    ("index", "return x[d]", "return x[d + 1]"),
    ("index", "return x[d]", "return x[d - 1]"),
    ("index", "return x[d, 0]", "return x[0, d]"),
    ("index", "return x[d, 0]", "return x[d, 1]"),
    ("index", "return x[d]", "return x"),
    ("copy", "a1 = x[0]", "a1 = x[0].copy()"),
    ("condition", "f(x[d - 1])", "f(x[d - 1] if d > 0 else 0 * x[d - 1])"),
    # what is missing
    ("left out", "return d", "return np.abs(d)"),
    ("left out", "return x * d", "return x * d / np.linalg.norm(x * d)"),
    ("left out", "return d", "return np.sqrt(d)"),
    ("left out", "return d", "return np.maximum(d, 0.0)"),
    ("left out", "return d * a1", "return d ** 0.5 * a1"),
    ("left out", "return f(d)", "return f(np.abs(d))"),
    ("left out", "return d", "return d + dt * v"),
    ("left out", "return x * d", "return ((x + v) / 2) * d"),
    ("left out", "return d * a1", "return d * a1 / (d @ d)"),
    ("left out", "return d", "return d + a1"),
    # items
    ("order", "return x, v", "return v, x"),
    ("order", "return x, v, d, a1", "return a1, v, d, x"),
    ("order", "return x, v, d, a1", "return x, d, v, a1"),
    ("order", "x, v = f(d)", "v, x = f(d)"),
    ("too much", "return [x, v]", "return [x]"),
    # statements
    ("copy", "return d", "x = x.copy()\nreturn d"),
    ("copy", "return d", "x = x.copy()\nv = v.copy()\nreturn d"),
    ("too much", "f(x)\nreturn d", "pass\nreturn d"),
    ("order", "f(1)\ng(2, 3)\nh()\nk(x, y)", "g(2, 3)\nf(1)\nh()\nk(x, y)"),
    ("order", "f(1)\ng(2, 3)\nh()\nk(x, y)", "g(2, 3)\nh()\nk(x, y)\nf(1)"),
    ("condition", "if d:\n    f(x)\nelse:\n    g(v)", "f(x)"),
    ("condition", "if d:\n    f(x)\nelse:\n    g(v)", "g(v)"),
    ("condition", "if d:\n    f(x)", "pass"),
    ("condition", "if d:\n    f(x)\nelif v:\n    g(v)", "if d:\n    f(x)\nif v:\n    g(v)"),
    ("order", "if d:\n    f(x)\n    g(v)", "if d:\n    f(x)\ng(v)"),
    ("order", "while d:\n    f(x)\n    g(v)", "while d:\n    f(x)\ng(v)"),
    ("order", "for i in r:\n    f(x)\ng(v)", "for i in r:\n    f(x)\n    g(v)"),
    ("order", "f(x)\nfor i in r:\n    g(v)", "for i in r:\n    f(x)\n    g(v)"),
    ("order", "for i in r:\n    f(x)\n    g(v)", "f(x)\nfor i in r:\n    g(v)"),
    ("order", "for i in r:\n    f(x)\ng(v)\nh()", "for i in r:\n    f(x)\n    g(v)\nh()"),
    ("order", "a()\nf(x)\nfor i in r:\n    g(v)", "a()\nfor i in r:\n    f(x)\n    g(v)"),
    ("left out", "for i in r:\n    k[i] += x", "for i in r:\n    k[i] += x\n    k[i + 1] -= x"),
    ("left out", "for i in r:\n    k[i] += x", "for i in r:\n    k[i] += x\n    if i > 0:\n        k[i - 1] -= x"),
    ("left out", "for i in r:\n    k[i, 0] -= x", "for i in r:\n    k[i, 0] -= x\n    k[i + 1, 0] += x"),
    ("left out", "w = np.roll(v, 1)", "w = np.roll(v, 1)\nw[-1] = 0.0"),
    ("left out", "w = np.empty(3)", "w = np.empty(3)\nw[0] = 0.0"),
    ("left out", "w = np.empty_like(v)", "w = np.empty_like(v)\nw[0] = 0.0"),
    *(
        (
            "condition",
            f"for i in range({given}):\n    f(x[i])",
            f"for i in range({given}):\n    if {test}:\n        f(x[i])",
        )
        for given in ("d", "1, d")
        for test in ("i > 0", "i == 0", "i < d - 1", "i == d - 1")
    ),
    (
        "order",
        "for i in r:\n    x[i] = f(x)\n    v[i] = f(v)",
        "_v_before = v.copy()\n_x_before = x.copy()\nfor i in r:\n    x[i] = f(_x_before)\n    v[i] = f(_v_before)",
    ),
    ("order", "x = 2 * x\nreturn v - x", f"{GIVEN}x = 2 * x\nreturn v - _x_given"),
    ("order", "x = 2 * x\nreturn x - 3 * x", f"{GIVEN}x = 2 * x\nreturn x - 3 * _x_given"),
    ("order", "x = 2 * x\nreturn x - 3 * x", f"{GIVEN}x = 2 * x\nreturn _x_given - 3 * _x_given"),
    # the same at several places
    ("sign", "k[d] += x * v\nk[a1] += x * v", "k[d] -= x * v\nk[a1] -= x * v"),
    ("name", "f(d)\nreturn a1 * a1", "f(d)\nreturn d * d"),
    ("left out", "return x * x + s.centre", "return (x - s.centre) * (x - s.centre) + s.centre"),
]


@cache
def changed(text: str) -> list[tuple[int, str, float, str]]:
    """Line, kind, cost and text of each change of a function."""
    tree, found = ast.parse(text), []
    for edit in edits_of(tree, {"own": ["masses", "centre"]}):
        with edit.applied():
            found.append((edit.line, edit.family, edit.cost, ast.unparse(tree)))
    return found


@pytest.mark.parametrize(("family", "wrong", "meant"), CHANGES, ids=lambda text: text.replace("\n", " | "))
def test_a_change_is_of_its_kind(family: str, wrong: str, meant: str) -> None:
    """The cheapest that makes the one of the other."""
    text = function(meant)
    kinds = [(cost, kind) for _, kind, cost, made in changed(function(wrong)) if made == text]
    assert family in [kind for cost, kind in kinds if cost == min(kinds)[0]]


@pytest.mark.parametrize("slip", ["both of two lines", "in place in a loop", "turned round", "one slope of two"])
def test_all_changes_cost_about_as_much_and_likelier_ones_come_first(slip: str) -> None:
    """Between one and three: two cheap changes are as far from a text as one that is dear."""
    costs = [cost for *_, cost, _ in changed(function(SLIPS[slip][0]))]
    assert costs == sorted(costs)
    assert costs[0] >= 1.0
    assert costs[-1] <= 3.0


def lines_of(wrong: str, meant: str) -> set[int]:
    """On which lines of the body, from 1, one is made of the other."""
    text = function(meant)
    return {line - 3 for line, _, _, made in changed(function(wrong)) if made == text}


@pytest.mark.parametrize(
    ("wrong", "meant", "lines"),
    [
        ("f(1)\ng(2, 3)\nh()", "g(2, 3)\nf(1)\nh()", {2}),
        ("f(1)\ng(2, 3)\nh()", "g(2, 3)\nh()\nf(1)", {1}),
        ("x = d\nif d:\n    f(x)\n    g(v)", "x = d\nif d:\n    f(x)\ng(v)", {4}),
        ("f(x)\nfor i in r:\n    g(v)\nh()", "f(x)\nfor i in r:\n    g(v)\n    h()", {4}),
        ("for i in r:\n    f(x)\ng(v)\nh()", "for i in r:\n    f(x)\n    g(v)\nh()", {3}),
        ("a()\nf(x)\nfor i in r:\n    g(v)", "a()\nfor i in r:\n    f(x)\n    g(v)", {2}),
        ("f(x)\nfor i in r:\n    g(v)", "for i in r:\n    f(x)\n    g(v)", {1}),
        ("for i in r:\n    f(x)\n    g(v)", "f(x)\nfor i in r:\n    g(v)", {2}),
        ("if d:\n    f(x)\nelif v:\n    g(v)", "if d:\n    f(x)\nif v:\n    g(v)", {3}),
        ("f(x)\nreturn d", "x = x.copy()\nf(x)\nreturn d", {0}),
        ("v = 1\nreturn a1 - x", "v = 1\nreturn a1 + x", {2}),
        (
            "for i in r:\n    x[i] = f(x)\n    v[i] = f(v)",
            "_v_before = v.copy()\n_x_before = x.copy()\nfor i in r:\n    x[i] = f(_x_before)\n    v[i] = f(_v_before)",
            {3},
        ),
    ],
    ids=lambda value: str(value).replace("\n", " | "),
)
def test_the_line_is_that_of_what_is_changed(wrong: str, meant: str, lines: set[int]) -> None:
    """Of what is moved, or taken in, or of the function where a copy is missing."""
    assert lines_of(wrong, meant) == lines


def test_what_is_changed_together_costs_a_little_more() -> None:
    """A tenth for each place; two lines in the same way, three, and four, and not five."""
    single = {cost for _, family, cost, _ in changed(function("k[d] += x * v")) if family == "sign"}
    rows = "\n".join(f"k[{i}] += x * v" for i in range(5))
    for count in (2, 3, 4, 5):
        meant = function("\n".join(f"k[{i}] {'-' if i < count else '+'}= x * v" for i in range(5)))
        costs = [cost for *_, cost, made in changed(function(rows)) if made == meant]
        assert costs == ([] if count == 5 else [pytest.approx(min(single) + 0.1 * (count - 1))])


@pytest.mark.parametrize(
    ("wrong", "never"),
    [
        ("k[d] *= x", "k[d] *= x\nk[d + 1] *= x"),
        ("w = np.zeros(3)", "w = np.zeros(3)\nw[0] = 0.0"),
        ("return f(d)", "return f(d, axis=1)"),
        ("return d + a1", "return a1 + d"),
        ("return f(d)", "return f(d * 0.017453292519943295)"),
        ("return f(d)", "return f(d, dtype=float)"),
        ("return np.zeros(3, dtype=d)", "return np.zeros(3, dtype=d, dtype=float)"),
        ("return np.sum(d, axis=1)", "return np.sum(d, axis=1, axis=0)"),
        ("return np.sum(d)", "return np.eigvals(d)"),
        ("return f(d, axis=a1)", "return f(d, axis=0)"),
        ("return np.arctan(x * v)", "return np.arctan2(x, v)"),
        ("return np.zeros(4)", "return np.zeros(4 * np)"),
        ("return np.sin() + eigvalsh()", "return eigvals()"),
        ("f(s.centre)\nreturn g(d)", "f(s.centre)\nreturn s.centre"),
        ("return 2000000.0", "return 4000000.0"),
        ("a1 = d\nreturn a1", "v = d\nreturn a1"),
        ("return d * a1", "return -d * a1"),
    ],
)
def test_what_would_be_the_same_or_no_slip_is_not_tried(wrong: str, never: str) -> None:
    """A product of its sides in another order, a sign inside a product; what belongs to other functions."""
    assert function(never) not in [made for *_, made in changed(function(wrong))]


@pytest.mark.parametrize(
    ("wrong", "meant"),
    [
        ("return d", "return abs(d)"),
        ("return d", "return d ** 0.5"),
        ("return d", "return min(d, 0.0)"),
        ("return d", "return max(d, 0.0)"),
        ("return f(d)", "return f(abs(d))"),
    ],
)
def test_without_numpy_what_is_missing_is_pythons_own(wrong: str, meant: str) -> None:
    """And nothing of NumPy's is tried."""
    own, wanted = (text.replace("import numpy as np\n\n", "") for text in (function(wrong), function(meant)))
    made = [(family, text) for _, family, _, text in changed(own)]
    assert ("left out", wanted) in made
    assert not any("np." in text for _, text in made)


def test_only_functions_classes_and_numbers_are_changed() -> None:
    """Not what is done when the file is run, and none of its imports."""
    text = "import numpy as np\nEXERCISE = 3\nrate = 2 * 3\nprint(1 - 2)\nif __name__ == '__main__':\n    print(1)\n"
    edits: list[Edit] = edits_of(without_main(ast.parse(text)))
    assert {edit.line for edit in edits} == {2, 3}
    assert "__main__" not in ast.unparse(without_main(ast.parse(text)))


@pytest.mark.parametrize(("second", "together"), [("b = v + 2", True), ("b = v * 2", False), ("b = v + d", False)])
def test_lines_that_differ_in_names_and_numbers_only_are_changed_together(second: str, together: bool) -> None:
    """The number in both at once, where both are sums of a name and a number; not a line made of something else."""
    tree = ast.parse(f"def step(x, v, d):\n    a = x + 2\n    {second}\n    return a, b\n")
    top = tree.body[0]
    both = [edit for edit in of_alike(top, names_in(top, tree, {})) if len(edit.sites) == 2]
    assert bool(both) == together
