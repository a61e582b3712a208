"""What a student gets: which files, the student's own first, in a folder that may be new or there already."""

from __future__ import annotations

from pathlib import Path

import pytest

from experiments.exercises.exercise import find
from experiments.exercises.handed_in.submission import header
from experiments.exercises.teaching.handout import hand_out
from reference.errors import InputError


def test_handouts_of_several_exercises_go_into_one_new_folder(tmp_path: Path) -> None:
    """The file to work in first; in C with what programs include, and the text of C."""
    folder = tmp_path / "new" / "own"
    python = hand_out(find("1"), folder, "ada", None)
    assert [file.name for file in python] == ["euler.py", "text.md", "text.html"]
    assert (folder / "text.md").read_text(encoding="utf-8") == find("1").text
    in_c = hand_out(find("4"), folder, "ada", None, "c")
    assert [file.name for file in in_c] == ["whole_state.c", "text.md", "text.html", "exercise.h"]
    assert (folder / "text.md").read_text(encoding="utf-8") == find("4").text_in_c
    with pytest.raises(InputError, match=r"euler\.py is there already"):
        hand_out(find("1"), folder, "ada", None)
    with pytest.raises(InputError, match=r"^exercise 8 cannot be done in C: expected one of 1, 2, 3, 4, 7$"):
        hand_out(find("8"), folder, "ada", None, "c")


@pytest.mark.parametrize(
    ("exercise", "key", "says"),
    [
        ("8", "sesame", {"EXERCISE": 8, "SEED": "ada", "KEYED": True}),
        ("8", None, {"EXERCISE": 8, "SEED": "ada"}),
        ("5", "sesame", {"EXERCISE": 5, "SEED": "ada"}),
        ("1", "sesame", {"EXERCISE": 1}),
    ],
)
def test_a_starter_says_whose_numbers_it_has(
    exercise: str, key: str | None, says: dict[str, object], tmp_path: Path
) -> None:
    """The student's seed where there is one; of the key only where the numbers depend on it."""
    own, *_ = hand_out(find(exercise), tmp_path, "ada", key)
    assert header(own.read_text(encoding="utf-8")) == says


@pytest.mark.parametrize("key", [None, "sesame"])
def test_files_are_made_from_the_seed_and_the_key(key: str | None, tmp_path: Path) -> None:
    """Others for another key, and for another student."""
    made = [hand_out(find("8"), tmp_path / f"{seed}{k}", seed, k) for seed, k in (("ada", key), ("bob", key))]
    made.append(hand_out(find("8"), tmp_path / "other", "ada", "another"))
    texts = [{file.name: file.read_bytes() for file in files} for files in made]
    assert len({text["A.csv"] for text in texts}) == 3


@pytest.mark.parametrize("seed", ["", "x" * 101, "a'b", 'a"b', "a\\b", "a\nb"])
def test_a_seed_that_fits_on_no_line_is_refused(seed: str, tmp_path: Path) -> None:
    """Before anything is written."""
    with pytest.raises(InputError, match="expected 1 to 100 printable characters"):
        hand_out(find("5"), tmp_path / "w", seed, None)
    assert not (tmp_path / "w").exists()
    hand_out(find("5"), tmp_path / "w", "x" * 100, None)
