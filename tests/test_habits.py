"""Habits of every source file: SI units in labels and texts, sorts that give the same order on every machine."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.import_graph import ROOMS

ROOT = Path(__file__).parents[1]

#: What is shown in another unit, as its readers are used to it: bending lengths of cloth, storeys that drift, one step.
OTHERWISE = {
    "report/figures/drape.py": ["mm"],
    "report/figures/ground_motion.py": ["mm"],
    "report/live/controls.py": ["ms"],
}

#: Units with a prefix, or none of SI, that a label might have by mistake.
NOT_SI = (
    "ms",
    "us",
    "min",
    "mm",
    "cm",
    "km",
    "g",
    "kN",
    "mN",
    "kJ",
    "mJ",
    "kHz",
    "MHz",
    "N/mm",
    "N s/mm",
    "mm/s",
    "km/h",
)


def units(text: str) -> Iterator[tuple[int, str]]:
    """The line and the unit of everything in brackets, in any text of a source file, that is not in SI units."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            for unit in re.findall(r"\[([^\[\]]+)\]", node.value):
                if unit in NOT_SI:
                    yield node.lineno, unit


def sorts(text: str) -> Iterator[int]:
    """Lines on which `argsort` may order equal values as the machine likes."""
    for node in ast.walk(ast.parse(text)):
        is_sort = isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == "argsort"
        if is_sort and not any(ast.unparse(keyword) == "kind='stable'" for keyword in node.keywords):
            yield node.lineno


@pytest.mark.rotating(2)
@pytest.mark.parametrize("room", ROOMS)
def test_labels_and_texts_have_si_units(room: str) -> None:
    """But for those that readers know in another."""
    for file in sorted((ROOT / room).rglob("*.py")):
        name = file.relative_to(ROOT).as_posix()
        found = list(units(file.read_text(encoding="utf-8")))
        assert {unit for _, unit in found} == set(OTHERWISE.get(name, ())), f"{name}: {found}"


def test_another_unit_is_caught() -> None:
    """In a text with gaps, too."""
    assert list(units('label = f"{name}: time [ms]"\naxes.set_xlabel("time [s]")')) == [(1, "ms")]


@pytest.mark.rotating(2)
@pytest.mark.parametrize("room", ROOMS)
def test_equal_values_are_ordered_the_same_on_every_machine(room: str) -> None:
    """NumPy's quicker sort orders equal values by the processor's vector instructions; a stable one by their place."""
    for file in sorted((ROOT / room).rglob("*.py")):
        assert not list(sorts(file.read_text(encoding="utf-8"))), file


def test_an_unstable_sort_is_caught() -> None:
    """As a function, as a method, and with another kind."""
    assert list(sorts('np.argsort(a)\nnp.argsort(a, kind="stable")\na.argsort(kind="quicksort")')) == [1, 3]
