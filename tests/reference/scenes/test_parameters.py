"""Parameters of scenes as they are given: text, numbers, lists; and what is refused, with its unit."""

from __future__ import annotations

from typing import Any

import pytest

from reference.errors import InputError
from reference.scenes.parameters import converted


@pytest.mark.parametrize(
    ("value", "default", "several", "expected"),
    [
        ("3", 10, False, 3),
        ("3.0", 10, False, 3),
        ("2.5", 0.0, False, 2.5),
        (2, 0.0, True, 2.0),
        ("1,2.5", 0.0, True, [1.0, 2.5]),
        ([1.5], 0.0, True, [1.5]),
        ([1, 2], 0.0, True, [1.0, 2.0]),
    ],
)
def test_a_value_is_a_number_or_several(value: Any, default: Any, several: bool, expected: Any) -> None:
    """Whole where the default is; a list of one number is a list."""
    found = converted("mass", value, default, several)
    assert found == expected
    assert type(found) is type(expected)


@pytest.mark.parametrize(
    ("name", "value", "default", "said"),
    [
        ("drag", "1,2", 0.0, "drag = '1,2': expected one number"),
        ("drag", [1.0], 0.0, "drag = [1.0]: expected one number"),
        ("drag", [1.0, True], 0.0, "drag = [1.0, True]: expected a number"),
        ("drag", [[1.0], 2.0], 0.0, "drag = [[1.0], 2.0]: expected a number"),
        ("masses", "2.5", 3, "masses = '2.5': expected a whole number"),
        ("masses", "1e999", 3, "masses = '1e999': expected a whole number"),
        ("rest_length", "0", 0.1, "rest_length = 0: expected a number > 0 [m], as scenes are laid out by it"),
        ("rest_length", "-1", 0.1, "rest_length = -1: expected a number > 0 [m]"),
        ("rest_length", [0.1, -1.0], 0.1, "rest_length[1] = -1: expected a number > 0 [m]"),
    ],
)
def test_what_is_no_such_number_is_refused(name: str, value: Any, default: Any, said: str) -> None:
    """One of several is enough."""
    with pytest.raises(InputError) as refused:
        converted(name, value, default, several=False)
    assert str(refused.value).startswith(said)
