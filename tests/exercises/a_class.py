"""A class of 200: every mistake in every style, and right solutions, as files of students.

python -m tests.exercises.a_class FOLDER && time springlab exercise check FOLDER --csv grades.csv
"""

from __future__ import annotations

import sys
from itertools import cycle, islice
from pathlib import Path

from tests.exercises.confusion import CASES
from tests.exercises.corpus import solution, wrong


def write(folder: Path, count: int = 200) -> None:
    """Write so many submissions."""
    folder.mkdir(parents=True, exist_ok=True)
    for i, (style, mistake) in enumerate(islice(cycle(CASES), count)):
        text = wrong(style, mistake) if mistake else solution(style)
        (folder / f"student_{i:03}_{mistake or 'right'}.py").write_text(f"# student {i}\n{text}", encoding="utf-8")


if __name__ == "__main__":
    write(Path(sys.argv[1]))
