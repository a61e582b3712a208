"""Examples in docstrings, run: they give what they say."""

from __future__ import annotations

import doctest
import importlib
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]

#: Where the public module stands.
PYTHON = ROOT / "report" / "python"


def module_of(file: Path) -> str:
    """The name that a file is imported by."""
    inside = file.relative_to(PYTHON if file.is_relative_to(PYTHON) else ROOT).with_suffix("")
    return ".".join(inside.parent.parts if inside.name == "__init__" else inside.parts)


#: The modules that have examples.
MODULES = sorted(
    module_of(file)
    for room in ("reference", "engines", "experiments", "report")
    for file in (ROOT / room).rglob("*.py")
    if re.search(r"^ *>>> ", file.read_text(encoding="utf-8"), re.MULTILINE)
)


@pytest.mark.parametrize("name", MODULES)
def test_examples_give_what_they_say(name: str) -> None:
    """Every one, in its module."""
    found = doctest.testmod(importlib.import_module(name))
    assert found.attempted > 0
    assert found.failed == 0


def test_an_example_that_is_wrong_is_seen() -> None:
    """Shown to fail."""
    wrong = doctest.DocTestParser().get_doctest(">>> 1 + 1\n3\n", {}, "wrong", None, None)
    assert doctest.DocTestRunner(verbose=False).run(wrong, out=lambda _: None).failed == 1
