"""Python's text as JavaScript: what is translated, and what is refused."""

from __future__ import annotations

import ast

import pytest

from reference.compiled.expressions import Expression
from reference.errors import Unsupported
from reference.obstacles import KINDS
from report.browser import programs
from report.browser.javascript import Translation, of_expression
from report.browser.programs import page_schemes, unavailable


def lines(text: str, dimension: int | None = 2) -> list[str]:
    """A text's translation."""
    return Translation(dimension).body(ast.parse(text).body)


def test_arrays_are_places_in_two_memories() -> None:
    """Doubles in F, whole numbers in I, rows of vectors one after the other."""
    assert lines("x1[j] = x0[ends_b[j]]") == ["F[x + 2 * j + 1] = F[x + 2 * I[springs + 2 * j + 1] + 0];"]
    assert lines("x[i, axis] += 2.5", None) == ["F[x + d * i + axis] += 2.5;"]


def test_numbers_and_choices_are_said_as_they_are() -> None:
    """Infinity, square roots, a choice, a whole coefficient."""
    assert of_expression("0.0 if q == np.inf else np.sqrt(f) / q") == "((q === Infinity) ? 0.0 : (Math.sqrt(f) / q))"
    assert of_expression("truediv(dt, 6)") == "(dt / 6)"


def test_statements_are_said_one_by_one() -> None:
    """Names are declared, but for arrays that are made, which have room elsewhere; so are arrays that are returned."""
    text = """
a, b = n, 3
flag = True
room = x.copy()
other = np.empty_like(x)
for i in range(n):
    for k in range(1, first[i]):
        f = helper(i, -f, +a)
        plain(a, not b)
        a -= np.minimum(1, np.int64(spring[k]))
c = x2[i] * len(springs) + len(masses) + rest_length[j] + x.shape[1]
d2 = q ** 2
return room, other
"""
    translation = Translation(3, functions=("helper",), plain=("plain",), rooms=("room", "other"))
    assert translation.body(ast.parse(text).body, returned=("x", "v")) == [
        "let a, b, c, d2, f, flag, i, k;",
        "a = n;",
        "b = 3;",
        "flag = true;",
        "F.copyWithin(room, x, x + n * d);",
        "for (i = 0; i < n; i++) {",
        "  for (k = 1; k < I[first + i]; k++) {",
        "    f = helper(F, I, at, i, (-f), (+a));",
        "    plain(a, (!b));",
        "    a -= Math.min(1, I[spring + k]);",
        "  }",
        "}",
        "c = ((((F[x + 3 * i + 2] * s) + n) + F[rest_lengths + 1 * j + 0]) + d);",
        "d2 = (q * q);",
        "F.copyWithin(x, room, room + n * d);",
        "F.copyWithin(v, other, other + n * d);",
    ]
    assert lines("flag = False\nforce1[i] = springs[j, 1]") == [
        "let flag;",
        "flag = false;",
        "F[forces + 2 * i + 1] = I[springs + 2 * j + 1];",
    ]
    assert lines("y = v1[i]", None) == ["let y;", "y = F[v1 + i];"]


@pytest.mark.parametrize(
    "text", ["np.exp(x)", "x ** 3", "np.hypot(x, y)", "x // y", "x if y else z()", "[x for x in y]"]
)
def test_what_a_browser_computes_otherwise_is_refused(text: str) -> None:
    """Powers, exponentials and hypot do not end in the same bits; other things are not known."""
    with pytest.raises(Unsupported):
        of_expression(text)


def test_every_scheme_is_in_the_page_or_has_a_reason() -> None:
    """Those that can be traced are, and those that solve equations as they are written; one of these cannot be said."""
    assert set(page_schemes()) >= {"euler", "heun", "kick_drift", "drift_kick", "velocity_verlet", "rk4"}
    assert set(page_schemes()) >= {"euler_in_place", "heun_link_by_link", "heun_aliased"}
    assert set(page_schemes()) >= {"backward_euler", "implicit_midpoint", "newmark", "hht", "bdf2"}
    assert "RADAU" in unavailable()["radau_iia"]
    assert not set(page_schemes()) & set(unavailable())


def test_schemes_have_their_equations_beside_them() -> None:
    """Where they are sums; in-place schemes have none of the whole state."""
    assert "<math" in page_schemes()["heun"].text
    assert "<math" not in page_schemes()["heun_aliased"].text


def test_pieces_of_programs_are_put_together() -> None:
    """Rooms one after the other, coefficients by their numbers, nothing of none; what is known is not counted again."""
    assert programs._rooms(["xs", "vs"]) == ["const xs = at.room + 0 * n * d, vs = at.room + 1 * n * d;"]
    assert programs._numbers(2) == ["const [c0, c1] = c;"]
    assert (programs._rooms([]), programs._numbers(0)) == ([], [])
    lines = ["let a, n, s;", "n = 3;", "s = 4;", "a = n;"]
    assert programs._without(lines, {"n", "s"}) == ["let a;", "a = n;"]
    x, v, c, a = (Expression(name) for name in ("x", "v", "c10", "a0"))
    moved = Expression("{} + {}", (x, Expression("{} * {}", (c, Expression("{} - {}", (v, a))))))
    assert programs._of_vectors(moved) == "(x[i] + (c[10] * (v[i] - a[0][i])))"
    assert programs._coefficients(["dt", "truediv(dt, 2)"]) == "dt => [dt, (dt / 2)]"


def test_every_kind_of_obstacle_is_known() -> None:
    """One of each is translated."""
    assert {one.kind for one in programs._ONES} == {*KINDS}
