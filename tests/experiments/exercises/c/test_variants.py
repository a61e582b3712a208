"""Which changes of a C program are compiled, and how they are written beside it."""

from __future__ import annotations

import ast
import copy
from collections.abc import Sequence
from contextlib import suppress
from typing import Any

import pytest

from experiments.exercises.c.reading import read
from experiments.exercises.c.tree import ReadProgram, Verbatim, functions_in
from experiments.exercises.c.variants import FEW, Variants
from experiments.exercises.c.written import NotInCError, Writer
from experiments.exercises.repair.edit import Edit, Site, sites_in, what_stands_at

#: With a name outside, a helper, names that are declared one after another and in a loop, conditions.
TEXT = """#define EXERCISE 1
static double rate;
double half(double a)
{
    return a / 2;
}
double *none(double *p)
{
    return p;
}
void step(double *y, double dt, int n)
{
    double a = dt * 3;
    double q[2] = {a, 1};
    int k;
    if (n > 1)
        a = dt + 7;
    for (int i = 0; i < n + 5; i++)
        a += half(i);
    double late = a;
    *y = late * 5;
}
"""


def site_of(program: ReadProgram, text: str) -> Site:
    """The first place of an expression or a statement that is written so."""
    for function in functions_in(program.tree):
        writer = Writer(program)
        writer.enter(function)
        for site in sites_in(function):
            node = what_stands_at(site)
            with suppress(NotInCError, AttributeError):
                written = writer.expression(node) if isinstance(node, ast.expr) else writer.plain(node)
                if written == text:
                    return site
    raise AssertionError(text)


def expression(text: str) -> ast.expr:
    """A tree, as of Python."""
    return ast.fix_missing_locations(ast.parse(text, mode="eval").body)


def made(*changes: Sequence[tuple[str, Any]], text: str = TEXT, most: int = 1000) -> Variants:
    """The program with changes, each of some places: what stands there, and what is put there."""
    program = read(text)
    edits = [Edit(1, "name", 1.0, tuple((site_of(program, old), new) for old, new in change)) for change in changes]
    return Variants(program, edits, most)


def on(*changes: Sequence[tuple[str, Any]], **more: Any) -> list[tuple[tuple[int, int], ...]]:
    """What is switched on for each."""
    return made(*changes, **more).switches


def test_each_place_has_a_number_and_each_text_at_it() -> None:
    """Two texts at one place, one at another, a change of both; the same text again is left out."""
    first, second = expression("dt - 7"), expression("dt * 7")
    other = expression("late + 1")
    changes = [("dt + 7", first)], [("dt + 7", second)], [("late * 5", other)], [("dt + 7", first), ("late * 5", other)]
    variants = made(*changes, [("dt + 7", first)], [("dt + 7", expression("dt + 7"))])
    assert variants.switches == [((0, 1),), ((0, 2),), ((1, 1),), ((0, 1), (1, 1)), (), ()]
    assert variants.places == 3
    text = variants.text()
    assert "#define SPRINGLAB_PLACES 3" in text
    assert "if (SPRINGLAB_AT(0) == 1) { a = dt - 7; } else" in text
    assert "if (SPRINGLAB_AT(0) == 2) { a = dt * 7; } else" in text
    assert "{ a = dt + 7; }" in text


@pytest.mark.parametrize(
    ("old", "new", "known"),
    [
        ("dt + 7", "dt + rate", True),
        ("dt + 7", "dt + a", True),
        ("dt + 7", "dt + q[0]", True),
        ("dt + 7", "dt + k", True),
        ("dt + 7", "dt + late", False),
        ("dt + 7", "dt + i", False),
        ("half(i)", "half(k)", True),
        ("half(i)", "half(i) + i", True),
        ("half(i)", "half(late)", False),
        ("dt * 3", "dt * a", False),
        ("dt * 3", "dt * n", True),
        ("late * 5", "late + i", False),
        ("late * 5", "half(late)", True),
        ("n + 5", "k", True),
        ("n + 5", "late", False),
        ("a / 2", "a / rate", True),
        ("a / 2", "a / dt", True),  # no name of that function: the compiler says so
    ],
)
def test_names_are_declared_before_they_are_used(old: str, new: str, known: bool) -> None:
    """Those that are given, those outside, those above in the block; of a loop within it."""
    assert bool(on([(old, expression(new))])[0]) == known


@pytest.mark.parametrize(
    ("old", "new", "may"),
    [
        ("dt + 7", "q", False),
        ("q[0]", "q", False),
        ("dt + 7", "y", False),
        ("dt + 7", "y.at", True),
        ("dt + 7", "x.T", False),
    ],
)
def test_what_stands_there_is_of_its_kind(old: str, new: str, may: bool) -> None:
    """A number for a number, and what is C."""
    text = TEXT.replace("*y = late * 5;", "*y = late * 5 + q[0];")
    assert bool(on([(old, expression(new))], text=text)[0]) == may


def test_a_change_is_in_one_function() -> None:
    """Not in two, and not of what is called."""
    one, other = ("a / 2", expression("a / 3")), ("late * 5", expression("late + 1"))
    assert on([one], [other], [one, other]) == [((0, 1),), ((1, 1),), ()]
    # nor where one of two places gets what is not known there
    fits, not_known = ("dt + 7", expression("dt + 8")), ("dt * 3", expression("dt * late"))
    assert on([fits], [not_known], [fits, not_known], [not_known, fits]) == [((0, 1),), (), (), ()]
    program = read(TEXT)
    call = what_stands_at(site_of(program, "half(i)"))
    assert Variants(
        program, [Edit(1, "name", 1.0, (((call, "func", None), ast.Name("none", ast.Load())),))]
    ).switches == [()]


def test_no_more_are_made_than_are_asked_for() -> None:
    """So many of which something is switched on."""
    changes = [[("dt + 7", expression(f"dt + {i}"))] for i in range(6)]
    assert len(on(*changes, most=2)) == 2
    assert len(on(*changes, most=100)) == 6


def test_values_conditions_and_loops_are_chosen_by_expressions() -> None:
    """A declared value, a test, where a loop begins and what it does then; a list is copied over."""
    variants = made(
        [("dt * 3", expression("dt * 4"))],
        [("n > 1", expression("n < 1"))],
        [("n + 5", expression("n + 6"))],
        [("{a, 1}", expression("[a, 2]"))],
    )
    text = variants.text()
    assert variants.switches[0] == ((0, 1),)
    assert "double a = ({ double springlab_value;\nswitch (SPRINGLAB_AT(0)) {" in text
    assert "case 1: { springlab_value = dt * 4; break; }" in text
    assert "default: { springlab_value = dt * 3; } }\nspringlab_value; });" in text
    assert "case 1: { springlab_value = !!(n < 1); break; }" in text
    assert "default: { springlab_value = !!(n > 1); } }" in text
    assert "case 1: { springlab_value = !!(i < n + 6); break; }" in text
    assert "double q[2] = {a, 1};" in text
    assert "memcpy((void *)&q, &(__typeof__(q)){a, 2}, sizeof q);" in text


def statements(program: ReadProgram, name: str) -> tuple[ast.FunctionDef, list[ast.stmt]]:
    """A function of the program, and its body."""
    (own,) = [function for function in functions_in(program.tree) if function.name == name]
    return own, own.body


def anew(name: str, body: Any) -> tuple[Variants, str]:
    """The program with the statements of a function in another order, or others."""
    program = read(TEXT)
    own, before = statements(program, name)
    variants = Variants(program, [Edit(1, "order", 1.0, (((own, "body", None), body(before)),))])
    return variants, variants.text()


def test_where_statements_are_moved_the_function_is_written_anew() -> None:
    """It goes on to the other one, with what it was given; what is returned is, where something is."""
    variants, text = anew("step", lambda body: [*body[:3], body[4], body[3], *body[5:]])
    assert variants.switches == [((0, 1),)]
    assert "static void springlab_step_1(double *y, double dt, int n)" in text
    assert "case 1: springlab_step_1(y, dt, n); return;" in text
    assert "switch (SPRINGLAB_AT(0)) {" in text
    assert text.index("springlab_step_1(double") < text.index("case 1: springlab_step_1")
    assert text.count("springlab_tick();") == 2  # in both
    _, text = anew("half", lambda body: [ast.copy_location(ast.Pass(), body[0]), *body])
    assert "case 1: return springlab_half_1(a);" in text
    _, text = anew("none", lambda body: [ast.copy_location(ast.Pass(), body[0]), *body])
    assert "case 1: return springlab_none_1(p);" in text


def within(holder: Any, *body: ast.stmt) -> Any:
    """The same condition or loop about other statements."""
    made = copy.copy(holder)
    made.body = list(body)
    return made


def test_a_change_that_moves_anything_is_written_anew() -> None:
    """Whatever else it changes beside."""
    program = read(TEXT)
    own, body = statements(program, "step")
    moved: tuple[Site, Any] = ((own, "body", None), [*body[:3], body[4], body[3], *body[5:]])
    beside = (site_of(program, "late * 5"), expression("late + 1"))
    for sites in ((moved, beside), (beside, moved)):
        text = Variants(program, [Edit(1, "order", 1.0, sites)]).text()
        assert "static void springlab_step_1(" in text
        assert "SPRINGLAB_AT(1)" not in text


@pytest.mark.parametrize(
    ("body", "in_order"),
    [
        (lambda body: [*body[:-2], body[-1]], False),
        (lambda body: [body[1], body[0], *body[2:]], False),
        (lambda body: [body[2], *body[:2], *body[3:]], True),
        (lambda body: [*body[:2], *body[3:]], True),
        (lambda body: [*body[:4], body[-2], body[4], body[-1]], True),
        (lambda body: body[1:], False),
        # in a condition, before and after it is declared
        (lambda body: [*body[:3], within(body[3], body[-1]), *body[4:-1]], False),
        (lambda body: [*body[:-1], within(body[3], body[-1])], True),
        (lambda body: [*body[:3], within(body[3], *body[-2:]), *body[4:-2]], True),
        (lambda body: [*body[:3], within(body[3], *body[-2:]), *body[4:-2], body[-1]], False),
    ],
)
def test_moved_statements_find_their_names(body: Any, in_order: bool) -> None:
    """Of a declaration that is left out, or comes later, nothing is compiled."""
    variants, text = anew("step", body)
    assert bool(variants.switches[0]) == in_order
    assert ("springlab_step_1" in text) == in_order


def test_a_declaration_is_not_left_out() -> None:
    """Its name would be missing below; another statement may be."""
    gone = ast.fix_missing_locations(ast.Pass())
    assert on([("double a = dt * 3;", gone)], [("a = dt + 7;", gone)], [("*y = late * 5;", gone)]) == [
        (),
        ((0, 1),),
        ((1, 1),),
    ]


def test_what_the_compiler_refuses_is_left_out() -> None:
    """And all changes of which it is a part, no others."""
    first, second, other = expression("dt - 7"), expression("dt * 7"), expression("late + 1")
    variants = made(
        [("dt + 7", first)], [("dt + 7", second)], [("late * 5", other)], [("dt + 7", second), ("late * 5", other)]
    )
    variants.refuse({"variant_0_2"})
    assert variants.switches == [((0, 1),), (), ((1, 1),), ()]
    text = variants.text()
    assert "dt - 7" in text
    assert "dt * 7" not in text
    variants.refuse({"variant_1_1"})
    assert variants.switches == [((0, 1),), (), (), ()]


@pytest.mark.parametrize("count", [FEW - 1, FEW])
def test_many_statements_at_one_place_are_in_one_switch(count: int) -> None:
    """A few are asked for one by one; each has lines of its own, by which the compiler names it."""
    text = made(*[[("dt + 7", expression(f"dt + {i}"))] for i in range(count)]).text()
    assert text.count("if (SPRINGLAB_AT(0) == ") == (count if count < FEW else 0)
    assert text.count("switch (SPRINGLAB_AT(0)) {") == (0 if count < FEW else 1)
    for i in range(count):
        assert f'#line 1 "variant_0_{i + 1}"' in text
    assert '#line 1 "ours"' in text


def test_copied_statements_keep_their_names() -> None:
    """A declaration without a value is copied: what follows knows its name."""
    program = read(TEXT)
    copied = [one for one in statements(program, "step")[1] if isinstance(one, Verbatim)]
    assert [one.names for one in copied] == [["k"]]
