"""The table of confusion: every program of `corpus`, and what the checker called it.

python -m tests.experiments.exercises.confusion [EXERCISE ...] [--blind]

With --blind, rates on programs that the checker's catalogue was not made from (`blind_rates`).
"""

from __future__ import annotations

import os
import sys
from collections import Counter
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from itertools import groupby

from experiments.exercises.grading import grade
from tests.experiments.exercises.corpus import RIGHT, Program, programs

#: The teacher's secret, of the hidden questions: right programs have to answer these too.
KEY = "sesame"

#: What the checker says where it has no name; that is an answer too.
UNKNOWN = "not in the catalogue"


def called(program: Program) -> str:
    """What the checker says."""
    return grade(program.submission, KEY if program.name == RIGHT else None, None, None).verdict.name


def confusion(chosen: Sequence[Program]) -> dict[Program, str]:
    """What the checker says of all of them."""
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return dict(zip(chosen, pool.map(called, chosen), strict=True))


def wrongly(found: dict[Program, str]) -> dict[str, str]:
    """Those that were called something else."""
    return {
        f"{program.exercise}, {program.name} in {program.style}": said
        for program, said in found.items()
        if not program.is_called(said)
    }


def summary(found: dict[Program, str]) -> str:
    """How many programs were called what they are, and how many something else."""
    kinds = Counter(_kind(program, said) for program, said in found.items())
    return ", ".join(f"{words} {many}" for words, many in sorted(kinds.items()))


def _kind(program: Program, said: str) -> str:
    if program.name == RIGHT:
        return "right and passed" if said == RIGHT else "right and refused"
    if said == RIGHT:
        return "wrong and passed"
    if said == UNKNOWN:
        return "wrong and not in the catalogue"
    return "wrong and named right" if program.is_called(said) else "wrong and named wrongly"


def _table(found: dict[Program, str]) -> None:
    for exercise, ours in groupby(found, key=lambda program: program.exercise):
        print(f"exercise {exercise}")
        said = {program: found[program] for program in ours}
        for name in dict.fromkeys(program.name for program in said):
            calls = [call for program, call in said.items() if program.name == name]
            others = sorted({call for call in calls if call != name})
            print(f"  {name:34} {calls.count(name)} of {len(calls)}" + (f"; {', '.join(others)}" if others else ""))
        print(f"  {summary(said)}")


if __name__ == "__main__":
    if "--blind" in sys.argv:
        from tests.experiments.exercises import blind_rates

        blind_rates.main()
        sys.exit()
    numbers = [int(word) for word in sys.argv[1:]]
    found = confusion([program for program in programs() if not numbers or program.exercise in numbers])
    _table(found)
    print(f"all: {summary(found)}")
    for program, said in wrongly(found).items():
        print(f"{program}: {said}")
    sys.exit(bool(wrongly(found)))
