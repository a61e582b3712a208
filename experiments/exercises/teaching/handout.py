"""What a student gets: the text, to be read and to be printed, the starter, and the exercise's own files."""

from __future__ import annotations

import re
from pathlib import Path

from experiments.exercises.exercise import Exercise, exercises
from experiments.exercises.handed_in.submission import IN_C, Language, Submission
from experiments.exercises.teaching.page import page
from experiments.exercises.teaching.writing import write_anew
from reference.errors import InputError

#: What programs in C include, in the folder of the exercise's own C files.
HEADER = Path(__file__).parents[1] / "c" / "exercise.h"


def hand_out(exercise: Exercise, folder: Path, seed: str, key: str | None, language: Language = "python") -> list[Path]:
    """Write an exercise into a folder. Returns what was written, the file to work in first.

    Raises:
        InputError: where the student's file is there already, for a seed that does not fit on its line, or for an
            exercise that cannot be done in the language.
    """
    if not (re.fullmatch(r"[^\"'\\]{1,100}", seed) and seed.isprintable()):
        raise InputError(f"seed = {seed[:40]!r}: expected 1 to 100 printable characters, no quotes and no backslash")
    starter = exercise.starter if language == "python" else exercise.starter_in_c
    if starter is None:
        able = ", ".join(str(n) for n, e in exercises().items() if e.starter_in_c is not None)
        raise InputError(f"exercise {exercise.number} cannot be done in C: expected one of {able}")
    own = folder / f"{exercise.name}{'.py' if language == 'python' else IN_C[0]}"
    if own.exists():
        raise InputError(f"{own} is there already: expected another folder")
    keyed = exercise.keyed and key is not None
    if exercise.seeded:
        line = f'SEED = "{seed}"' + ("\nKEYED = True" if keyed else "")
        starter = re.sub(r"^SEED = .*$", lambda _: line, starter, flags=re.MULTILINE)
    text = exercise.text if language == "python" else exercise.text_in_c
    files = {own.name: starter, "text.md": text, "text.html": page(exercise, text)}
    if language == "c":
        files[HEADER.name] = HEADER.read_text(encoding="utf-8")
    if exercise.files is not None:
        files |= exercise.files(Submission("", "", exercise, seed, keyed=keyed).seed_with(key))
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in reversed(files.items()):  # the student's own file last: it stands for a whole handout
        write_anew(folder / name, text.encode("utf-8"))
    return [folder / name for name in files]
