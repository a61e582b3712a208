"""What is tried in place of a value: all of it, by what the value is in and by what it is itself."""

from __future__ import annotations

from dataclasses import replace

import pytest

from experiments.exercises.repair.value_edits import of_value
from tests.experiments.exercises.repair.tried import NAMES, costs, tried

#: What the function has beside `a`; and `a` with one of it.
OTHERS = ("b", "dt", "i", "s.mass")
TIMES = {f"a {by} {other}" for by in "*/" for other in OTHERS}
PLUS = {f"a {by} {other}" for by in "+-" for other in OTHERS}
LATER = {f"a {by} dt * {name}" for by in "+-" for name in NAMES.own}
UNREAD = (
    {f"a {by} s.mass" for by in "*/+-"}
    | {f"a {by} s.mass * {name}" for by in "+-" for name in NAMES.own}
    | {f"a * ({name} - s.mass{column})" for name in NAMES.own for column in ("", "[:, None]")}
)
NORMS = {"a / np.linalg.norm(a)", "a / np.linalg.norm(a, axis=1, keepdims=True)"}
ABOVE_AND_BELOW = {"np.abs(a)", "np.sqrt(a)", "np.minimum(a, 0.0)", "np.maximum(a, 0.0)"}

WHOLE = {
    "sign": {"-a"},
    "factor": {"a * 2", "a * 0.5"} | TIMES,
    "left out": LATER | UNREAD | PLUS | NORMS | ABOVE_AND_BELOW,
    "axis": {"a.T"},
}
ROOT = {"sign": {"-a"}, "factor": TIMES, "left out": PLUS | {"np.abs(a)"}}
TERM = {
    "sign": {"-a"},
    "factor": {"a ** 2", "a * 2", "a * 0.5"} | TIMES,
    "left out": LATER | UNREAD | PLUS | NORMS | {"a ** 0.5", "(a + b) / 2"},
    "axis": {"a.T", "a[:, None]"},
}
FACTOR = {
    "factor": {"a ** 2"} | TIMES,
    "left out": PLUS | NORMS | {"a ** 0.5", "(a + b) / 2"},
    "axis": {"a.T", "a[:, None]"},
}
BESIDE = {"factor": TIMES, "left out": PLUS}


@pytest.mark.parametrize(
    ("text", "found"),
    [
        *((text, WHOLE) for text in ("return a", "x = a", "x += a", "return (a, 3)")),
        *((text, TERM) for text in ("return a + 7", "return 7 - a")),
        *((text, FACTOR) for text in ("return a * 7", "return 7 / a")),
        *((text, ROOT) for text in ("return np.sqrt(a)", "return sqrt(a)")),
        *((text, BESIDE) for text in ("return a ** 7", "return a < 7")),
        ("return f(a)", {"sign": {"-a"}, "left out": {"np.abs(a)"}}),
        ("return a.T", {"factor": {"a ** 2"}}),
        ("return x[a]", {}),
        ("a = 7", WHOLE),
    ],
)
def test_what_is_tried_is_what_the_place_is_for(text: str, found: dict[str, set[str]]) -> None:
    """The whole of what is returned or kept, a term, a factor, under a root, compared, an argument, an index."""
    assert tried(of_value, text, "a") == found


@pytest.mark.parametrize(
    ("node", "ways"),
    [
        ("b", {"b[:, None]", "b.T", "b / np.linalg.norm(b)", "b ** 0.5", "(b + a) / 2"}),
        ("s.c", {"s.c[:, None]", "s.c ** 0.5"}),
        ("f(7)", {"f(7)[:, None]", "f(7).T"}),
        ("(b + 7)", {"(b + 7)[:, None]", "(b + 7) / np.linalg.norm(b + 7)", "(b + 7) ** 0.5"}),
        ("x[7]", {"x[7][:, None]"}),
        ("(b if b else 7)", set()),
    ],
)
def test_what_is_tried_is_what_can_be_done_with_the_value(node: str, ways: set[str]) -> None:
    """A column, the other way round, of length 1, its root, the mean with another: of a factor of each kind."""
    found = tried(of_value, f"return {node} * 3", node.strip("()") if node[0] == "(" else node)
    of_all = {way for kind in ("axis", "left out") for way in found.get(kind, ())}
    assert {
        way for way in of_all if any(part in way for part in ("[:", ".T", "norm(b)", "norm(b + 7)", ".5", "/ 2"))
    } == ways


@pytest.mark.parametrize(
    ("text", "over"),
    [
        ("a * b", {"(a @ a)", "(b @ b)", "a ** 2", "b ** 2"}),
        ("np.dot(b, dt)", {"(b @ b)", "(dt @ dt)", "a ** 2", "b ** 2"}),
    ],
)
def test_a_product_of_vectors_is_made_a_projection(text: str, over: set[str]) -> None:
    """Over the square of the length of one in it, or of what is called one: not of single numbers, not of modules."""
    found = tried(of_value, f"return {text}", text)["left out"]
    assert {one for one in found if "@" in one or "** 2" in one} == {f"{text} / {way}" for way in over}


@pytest.mark.parametrize(
    ("text", "node", "lists"),
    [
        ("return [a, b, 7]", "[a, b, 7]", {"[b, 7]", "[a, 7]", "[a, b]"}),
        ("return [a, b]", "[a, b]", {"[a]", "[b]"}),
        ("return [a]", "[a]", set()),
        ("return (a, b)", "(a, b)", set()),
        ("[a, b] = x", "[a, b]", set()),
        ("f(*a)", "*a", set()),
    ],
)
def test_of_a_list_one_may_be_too_much(text: str, node: str, lists: set[str]) -> None:
    """And nothing else is done to it, nor to several values."""
    assert tried(of_value, text, node) == ({"too much": lists} if lists else {})


def test_without_dt_nothing_is_later() -> None:
    """Nor is the mean of two slopes taken."""
    found = tried(of_value, "return a + 7", "a", replace(NAMES, own=["a", "b"]))["left out"]
    assert not any("dt" in one or "/ 2" in one for one in found)


@pytest.mark.parametrize(
    ("text", "left_out"),
    [
        ("return a", {"abs(a)", "a ** 0.5", "min(a, 0.0)", "max(a, 0.0)"}),
        ("return a * 7", {"a ** 0.5"}),
        ("return f(a)", {"abs(a)"}),
    ],
)
def test_without_numpy_only_pythons_own_is_tried(text: str, left_out: set[str]) -> None:
    """No columns, nothing turned round."""
    found = tried(of_value, text, "a", replace(NAMES, own=["a"], fields={}, unread=[], has_numpy=False))
    assert found.get("left out", set()) == left_out
    assert "axis" not in found


def test_likelier_ones_cost_less() -> None:
    """A single number or a field as a factor is likelier than an array; a factor than a divisor, than a term."""
    names = replace(NAMES, own=["a", "b", "dt", "h", "m", "mass", "k", "g"])
    of = costs(of_value, "return a * 7", "a", names)
    for other in ("dt", "h", "m", "mass", "k", "g", "s.mass"):
        times, over, plus, minus = (of[f"a {by} {other}"] for by in "*/+-")
        assert times < over < plus == minus < of["a + b"]
        assert times < of["a * b"] < of["a / b"] < of["a + b"] == of["a - b"]
    whole = costs(of_value, "return a", "a")
    assert whole["-a"] < whole["a * 2"] < whole["a * s.mass"] < whole["a - s.mass * b"]
    unread = [one for one in whole if one in {f"a {by} s.mass" for by in "*/+-"}]
    assert unread == ["a * s.mass", "a / s.mass", "a + s.mass", "a - s.mass"]
