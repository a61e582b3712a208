"""What `springlab translate` says of settings that make no sense: it names what was typed."""

from __future__ import annotations

import pytest
from click.testing import CliRunner

from reference.errors import InputError
from report.commands.main import springlab


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (["box2d", "hertz=-4", "damping_ratio=0.7"], "hertz = -4"),
        (["mujoco", "solref=0.02"], "two numbers"),
    ],
)
def test_what_was_typed_is_named(words: list[str], named: str) -> None:
    """And no other quantity is blamed."""
    done = CliRunner().invoke(springlab, ["translate", "--from", *words])
    assert isinstance(done.exception, InputError)
    assert named in str(done.exception)
