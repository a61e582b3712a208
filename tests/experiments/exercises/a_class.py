"""A class of 200, with all ten exercises: mistakes in every style, and right solutions, as files of students.

python -m tests.experiments.exercises.a_class FOLDER && time springlab exercise check FOLDER --csv grades.csv
"""

from __future__ import annotations

import sys
from itertools import cycle, islice
from pathlib import Path

from tests.experiments.exercises.corpus import programs


def write(folder: Path, count: int = 200) -> None:
    """Write this number of submissions."""
    folder.mkdir(parents=True, exist_ok=True)
    for i, program in enumerate(islice(cycle(programs()[::3]), count)):
        name = f"student_{i:03}_{program.exercise}_{program.name.replace(' ', '_')}.py"
        (folder / name).write_text(f"# student {i}\n{program.text}", encoding="utf-8")


if __name__ == "__main__":
    write(Path(sys.argv[1]))
