"""What a student gets: the text, to be read and to be printed, the starter, and the exercise's own files."""

from __future__ import annotations

import re
from pathlib import Path

from experiments.exercises.exercise import Exercise
from experiments.exercises.page import page
from experiments.exercises.submission import Submission
from experiments.exercises.writing import write_anew
from reference.errors import InputError


def hand_out(exercise: Exercise, folder: Path, seed: str, key: str | None) -> list[Path]:
    """Write an exercise into a folder. Returns what was written, the file to work in first.

    Raises:
        InputError: where the student's file is there already, or for a seed that does not fit on its line.
    """
    if not (re.fullmatch(r"[^\"'\\]{1,100}", seed) and seed.isprintable()):
        raise InputError(f"seed = {seed[:40]!r}: expected 1 to 100 printable characters, no quotes and no backslash")
    own = folder / f"{exercise.name}.py"
    if own.exists():
        raise InputError(f"{own} is there already: expected another folder")
    keyed = exercise.keyed and key is not None
    starter = exercise.starter
    if exercise.seeded:
        line = f'SEED = "{seed}"' + ("\nKEYED = True" if keyed else "")
        starter = re.sub(r"^SEED = .*$", lambda _: line, starter, flags=re.MULTILINE)
    files = {own.name: starter, "text.md": exercise.text, "text.html": page(exercise)}
    if exercise.files is not None:
        files |= exercise.files(Submission("", "", exercise, seed, keyed=keyed).seed_with(key))
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in reversed(files.items()):  # the student's own file last: it stands for a whole handout
        write_anew(folder / name, text.encode("utf-8"))
    return [folder / name for name in files]
