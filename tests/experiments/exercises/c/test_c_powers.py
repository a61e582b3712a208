"""Powers, which C has no operator for, written as C."""

from __future__ import annotations

import ast

import pytest

from experiments.exercises.c.reading import read
from experiments.exercises.c.written import ASSIGNED, Writer

PROGRAM = "double own(double x, double y)\n{\nreturn x;\n}\n"


@pytest.mark.parametrize(
    ("in_python", "in_c"),
    [
        ("x**2", "x * x"),
        ("x**3", "pow(x, 3)"),
        ("x**0.5", "sqrt(x)"),
        ("x**y", "pow(x, y)"),
        ("(x + y)**2", "pow(x + y, 2)"),
        ("(x + y)**0.5", "sqrt(x + y)"),
        ("y / x**2", "y / (x * x)"),
    ],
)
def test_a_power_is_a_product_of_a_name_a_root_or_pow(in_python: str, in_c: str) -> None:
    """A square of more than a name would be computed twice."""
    assert Writer(read(PROGRAM)).expression(ast.parse(in_python, mode="eval").body, ASSIGNED) == in_c
