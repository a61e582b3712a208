"""What is said to bad input."""

from __future__ import annotations

import pytest

from reference.errors import InputError, unknown_name


@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("huen", "did you mean 'heun'?"),
        ("eulr", "did you mean 'euler'?"),
        ("RK4", "expected one of euler, heun, rk4"),
        ("hexa", "expected one of euler, heun, rk4"),  # two letters of four: none is meant
        ("zzz", "expected one of euler, heun, rk4"),
    ],
)
def test_unknown_names_get_the_nearest_one_or_all_there_are(name: str, hint: str) -> None:
    """In one line, in alphabetical order."""
    error = unknown_name("scheme", name, ["rk4", "heun", "euler"])
    assert isinstance(error, InputError)
    assert str(error) == f"unknown scheme {name!r}: {hint}"
