"""The table of confusion: every mistake in every style, and what the checker called it.

python -m tests.exercises.confusion
"""

from __future__ import annotations

import os
import sys
from collections import Counter
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor

from experiments.exercises.exercise import find
from experiments.exercises.judge import judge
from tests.exercises.corpus import MISTAKES, solution, wrong

#: A style and a mistake, None for none.
Case = tuple[str, str | None]

#: All there are.
CASES: list[Case] = [(style, name) for style, names in MISTAKES.items() for name in (None, *names)]


def named(case: Case) -> str:
    """What the checker says."""
    style, mistake = case
    return judge(find("4"), wrong(style, mistake) if mistake else solution(style)).name


def confusion(cases: Sequence[Case]) -> dict[Case, str]:
    """What the checker says of all of them."""
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return dict(zip(cases, pool.map(named, cases), strict=True))


if __name__ == "__main__":
    found = confusion(CASES)
    wrongly = {case: said for case, said in found.items() if said != (case[1] or "right")}
    count = Counter(case[1] or "right" for case in found)
    for name, many in sorted(count.items()):
        right = sum(1 for case, said in found.items() if (case[1] or "right") == name == said)
        others = sorted({said for case, said in wrongly.items() if (case[1] or "right") == name})
        print(f"{name:32} named right {right} of {many}" + (f"; else {', '.join(others)}" if others else ""))
    three = sum(1 for name, many in count.items() if many == 3 and name != "right")
    print(f"{len(count) - 1} mistakes, {three} of them in three styles")
    print(f"{len(found) - len(wrongly)} of {len(found)} named right")
    sys.exit(bool(wrongly))
