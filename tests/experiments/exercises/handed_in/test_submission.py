"""Students' files: what is read of them, and which are refused."""

from __future__ import annotations

import doctest
from itertools import combinations
from pathlib import Path

import pytest

from experiments.exercises.exercise import find
from experiments.exercises.handed_in import submission
from experiments.exercises.handed_in.submission import Submission, files_of, read
from experiments.exercises.verdict import unwritten
from reference.errors import InputError

TEXT = 'EXERCISE = 8\nSEED = "ada"\nKEYED = True\n'


def written(folder: Path, data: bytes) -> Path:
    """A file with these bytes."""
    file = folder / "own.py"
    file.write_bytes(data)
    return file


@pytest.mark.parametrize("prefix", [b"", b"\xef\xbb\xbf"], ids=["plain", "byte order mark"])
@pytest.mark.parametrize("ending", ["\n", "\r\n"], ids=["unix", "windows"])
def test_a_file_is_the_same_whatever_the_editor(tmp_path: Path, prefix: bytes, ending: str) -> None:
    """A byte order mark and the ends of lines change neither what it says nor its digest."""
    read_ = read(written(tmp_path, prefix + TEXT.replace("\n", ending).encode()), "own.py")
    assert (read_.source, read_.exercise.number, read_.seed, read_.keyed) == (TEXT, 8, "ada", True)
    assert (read_.says_keyed, read(written(tmp_path, b"EXERCISE = 1"), "own.py").says_keyed) == (True, False)
    assert read_.digest("k") == Submission("own.py", TEXT, find("8"), "ada", True).digest("k")


@pytest.mark.parametrize(
    "text",
    [
        "EXERCISE = 5  # mine\nSEED = 'ada'  # me",
        "EXERCISE: int = 5; SEED: str = 'ada'",
        'import numpy as np; EXERCISE = 5;\nSEED = "ada";',
        "EXERCISE = '5'\nSEED = (\n    'ada'\n)",
        "x = EXERCISE = 'largest_step'\nSEED = 'bob'\nSEED = 'ada'",
        "EXERCISE = 5\nSEED = 'ada'\ndef kick_drift(:\n",
    ],
)
@pytest.mark.parametrize("encoding", ["utf-8", "utf-16", "cp1252"])
def test_whatever_stands_around_the_lines_that_say_whose_it_is(tmp_path: Path, text: str, encoding: str) -> None:
    """Comments, types, brackets, more on the line, an error elsewhere; in any encoding that the file itself tells."""
    told = f"# coding: {encoding}\n" if encoding == "cp1252" else ""
    found = read(written(tmp_path, f"{told}{text}\n# \u00e4".encode(encoding)), "own.py")
    assert (found.exercise.number, found.seed) == (5, "ada")


@pytest.mark.parametrize("text", ["# K\u00f6rper\nEXERCISE = 1\n", "#define EXERCISE 1\n\n/* K\u00f6rper */\n"])
def test_latin_1_is_read_where_nothing_else_is_said(tmp_path: Path, text: str) -> None:
    """As editors on Windows save it: an umlaut in a comment costs nothing, in Python as in C."""
    file = tmp_path / ("own.py" if "define" not in text else "own.c")
    file.write_bytes(text.encode("latin-1"))
    found = read(file, file.name)
    assert (found.exercise.number, found.source) == (1, text)


@pytest.mark.parametrize(
    ("data", "told"),
    [
        (b"# coding: utf-8\nEXERCISE = 1\n\xff\xfe", "UTF-8"),
        (b"EXERCISE = 1\n\xff\xfe\x01", "control"),
        (b"EXERCISE = 1\n\0", "zero"),
        (b"x = 1\n", "EXERCISE"),
        (b"EXERCISE = 8\n", "SEED"),
        (b"EXERCISE = 8\nSEED = '" + b"x" * 101 + b"'", "has no seed"),
        (b"EXERCISE = 1\n#\n# coding: x\n\xff\x01", "control"),
        (b"EXERCISE = 1\n# coding: x\n\xff\x01", "UTF-8"),
        (b"EXERCISE = 1\n" + b"#" * 200, "213"),
    ],
    ids=["no text", "no letter", "zero byte", "no exercise", "no seed", "long seed", "line 3", "line 2", "too large"],
)
def test_what_is_not_a_submission_is_refused_by_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, data: bytes, told: str
) -> None:
    """In one line, which has what is wrong."""
    monkeypatch.setattr(submission, "LARGEST", 200)
    with pytest.raises(InputError, match=rf"^own\.py.*{told}"):
        read(written(tmp_path, data), "own.py")


def test_which_line_is_missing_is_told_in_the_language(tmp_path: Path) -> None:
    """Of the program; a seed may have a hundred letters."""
    for name, line in (("own.py", "EXERCISE = 4"), ("own.c", "#define EXERCISE 4")):
        (tmp_path / name).write_text("\n", encoding="utf-8")
        with pytest.raises(InputError, match=f"expected a line such as {line}$"):
            read(tmp_path / name, name)
    assert len(read(written(tmp_path, b"EXERCISE = 8\nSEED = '" + b"x" * 100 + b"'"), "own.py").seed) == 100


def test_the_last_line_that_says_something_counts() -> None:
    """In Python, also where it cannot be read, and in C."""
    for text in ('EXERCISE = 4\nEXERCISE = 5\nSEED = "ada"\nSEED = "bob"', "EXERCISE = 4\ndef (\nEXERCISE = 5"):
        assert submission.header(text)["EXERCISE"] == 5
    assert submission.header_in_c("#define EXERCISE 4\n#define EXERCISE 3\n") == {"EXERCISE": 3}


def test_the_worked_examples_are_true() -> None:
    """What the docstrings show is what comes out."""
    for module in (submission, unwritten):
        tried = doctest.testmod(module)
        assert (tried.attempted > 0, tried.failed) == (True, 0)


def test_folders_and_links_are_not_submissions(tmp_path: Path) -> None:
    """A link may lead to a file that is not the student's."""
    link = tmp_path / "link.py"
    link.symlink_to(written(tmp_path, TEXT.encode()))
    for path in (link, tmp_path, tmp_path / "nowhere.py"):
        with pytest.raises(InputError, match=r"^own\.py"):
            read(path, "own.py")


def test_an_exercise_that_is_given_goes_before_the_one_in_the_file(tmp_path: Path) -> None:
    """As in Gradescope's zip, which is of one exercise; one that gives everybody the same has no seed."""
    chosen = read(written(tmp_path, TEXT.encode()), "own.py", find("1"))
    assert (chosen.exercise.number, chosen.seed) == (1, "")


def test_files_of_a_class_are_found_in_folders_and_below(tmp_path: Path) -> None:
    """By their path from the folder; nothing that is hidden, and nothing but Python."""
    for name in ("b/own.py", "a.py", ".trash/own.py", "b/.cache/x.py", "b/notes.txt"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).touch()
    assert [name for _, name in files_of([tmp_path])] == ["a.py", "b/own.py"]
    assert [name for _, name in files_of([tmp_path / "b/own.py", tmp_path / "b/notes.txt"])] == ["own.py", "notes.txt"]
    for nothing in (tmp_path / ".trash" / "own.py" / "x", tmp_path / "nowhere"):
        with pytest.raises(InputError, match=str(nothing)):
            files_of([nothing])
    (tmp_path / "empty").mkdir()
    with pytest.raises(InputError, match="empty"):
        files_of([tmp_path / "empty"])


def test_the_key_makes_the_numbers_only_of_files_that_were_started_with_it() -> None:
    """Whether it was is the teacher's to say: what the file says of itself changes nothing."""
    seeds = [
        Submission("", "", find("8"), "ada", says, keyed).seed_with(key)
        for keyed in (False, True)
        for says in (False, True)
        for key in (None, "k")
    ]
    assert len({*seeds[:5], seeds[6]}) == 1
    assert seeds[5] == seeds[7] != seeds[0]
    assert Submission("", "", find("5"), "ada").seed_with("k") == "ada"


def test_the_digest_is_that_of_all_that_a_grade_depends_on() -> None:
    """Exercise, key and text: another of any is another digest."""
    cases = [("x", "1", None), ("x", "1", "k"), ("x", "2", None), ("y", "1", None)]
    digests = [Submission("n", text, find(exercise)).digest(key) for text, exercise, key in cases]
    assert all(one != other for one, other in combinations(digests, 2))
    assert Submission("other name", "x", find("1")).digest(None) == digests[0]
