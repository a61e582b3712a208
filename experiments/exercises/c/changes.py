"""The small changes of a C program's text that are tried, compiled together; and what is told of those that help."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from experiments.exercises.c import compiler
from experiments.exercises.c.compiler import Compiled
from experiments.exercises.c.edits import c_edits_of
from experiments.exercises.c.reading import read
from experiments.exercises.c.tree import ReadProgram, UnreadableError, functions_in
from experiments.exercises.c.variants import Variants
from experiments.exercises.c.written import text_of
from experiments.exercises.exercise import Question
from experiments.exercises.handed_in.parsing import PARSING
from experiments.exercises.repair.edit import Edit
from experiments.exercises.repair.repaired import Repair, repairs
from experiments.exercises.repair.source_edits import edits_of

#: So many changes are compiled, the cheapest ones: it takes a third of a millisecond each.
MOST = 2500


@dataclass(frozen=True, eq=False)
class CChanges:
    """A C program with its changes.

    Attributes:
        library: all of them, compiled.
        tried: of each change that there is one for, its number and what switches it on.
    """

    program: ReadProgram
    function: str
    edits: Sequence[Edit]
    library: Compiled
    variants: Variants

    @classmethod
    def of(
        cls, exercise: int, source: str, groups: Sequence[Sequence[Question]], exposed: bool = False, most: int = MOST
    ) -> CChanges | None:
        """All changes of a program; None for one that is not read, or not compiled as it was read."""
        (question, *_), *_ = groups
        try:
            with PARSING:
                program = read(source)
                edits = [*edits_of(program.tree, _given(program, question)), *c_edits_of(program)]
                edits.sort(key=lambda edit: edit.cost)
                variants = Variants(program, edits, most)
        except (UnreadableError, SyntaxError, ValueError, RecursionError):
            return None
        library = compiler.with_variants(exercise, variants, exposed)
        return cls(program, question.function, edits, library, variants) if library is not None else None

    def task(self) -> dict[str, Any]:
        """What the search is told."""
        tried = [(self.edits[i].cost, self.variants.switches[i]) for i in self._numbers()]
        return {"changes": tried, "places": self.variants.places}

    def _numbers(self) -> list[int]:
        """Of the changes that are tried."""
        return [i for i, on in enumerate(self.variants.switches) if on]

    def repairs(self, found: Sequence[Sequence[int]]) -> list[Repair]:
        """Those with these numbers, of the changes that were tried."""
        tried = [self.edits[i] for i in self._numbers()]
        return repairs(self.function, tried, found, lambda: text_of(self.program, told=True))

    def told(self, edit: Edit) -> str:
        """A change, as it is told to the teacher."""
        (repair,) = repairs(self.function, [edit], [[0]], lambda: text_of(self.program, told=True))
        return repair.change


def _given(program: ReadProgram, question: Question) -> dict[str, list[str]]:
    """The fields of what functions are given: the last of their names stands for that."""
    fields = list(question.arguments[-1])
    return {function.name: fields for function in functions_in(program.tree)}
