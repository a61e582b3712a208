"""What makes a program right: which changes of its text, and how that is told."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from difflib import SequenceMatcher

from experiments.exercises.repair.edit import Edit

#: How long a change is in a table [letters].
LONGEST_CHANGE = 160


@dataclass(frozen=True)
class Repair:
    """A change that makes the program right.

    Attributes:
        places: line and kind of each change. function: whose questions it was looked for.
        change: the lines before and after.
        cost: how far from the text.
    """

    function: str
    places: tuple[tuple[int, str], ...]
    change: str
    cost: float


def repairs(
    function: str, edits: Sequence[Edit], found: Sequence[Sequence[int]], written: Callable[[], str]
) -> list[Repair]:
    """The changes with these numbers, cheapest first; none where there is no such number.

    Args:
        function: whose questions they were looked for.
        written: writes the tree as it is at the moment.
    """
    made = []
    for numbers in found:
        if max(numbers) < len(edits):
            chosen = [edits[i] for i in numbers]
            places = tuple(sorted((edit.line, edit.family) for edit in chosen))
            made.append(Repair(function, places, _change(chosen, written), sum(edit.cost for edit in chosen)))
    return sorted(made, key=lambda repair: repair.cost)


def _change(edits: Sequence[Edit], written: Callable[[], str]) -> str:
    """The lines that are other, before and after."""
    before = written().splitlines()
    with ExitStack() as stack:
        for edit in edits:
            stack.enter_context(edit.applied())
        after = written().splitlines()
    gone, new = [], []
    for kind, i, j, k, n in SequenceMatcher(None, before, after, autojunk=False).get_opcodes():
        if kind != "equal":
            gone += [line.strip() for line in before[i:j]]
            new += [line.strip() for line in after[k:n]]
    return f"{' / '.join(gone) or 'nothing'} -> {' / '.join(new) or 'nothing'}"[:LONGEST_CHANGE]
