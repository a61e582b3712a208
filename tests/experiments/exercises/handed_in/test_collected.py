"""What is taken of what a class has handed in: at the borders of what may be, and by whom it is."""

from __future__ import annotations

import os
import zipfile
from datetime import datetime
from pathlib import Path

import pytest

from experiments.exercises.handed_in import collected
from experiments.exercises.handed_in.collected import collect, files_in, student_of
from experiments.exercises.handed_in.submission import LARGEST
from reference.errors import InputError

TEXT = "EXERCISE = 1\n"


def zipped(file: Path, **entries: str) -> Path:
    """A zip with files of these texts; __ in a name is a slash, and a dot stands before py."""
    with zipfile.ZipFile(file, "w") as archive:
        for name, text in entries.items():
            archive.writestr(
                zipfile.ZipInfo(name.replace("__", "/").replace("_py", ".py"), (2026, 11, 3, 10, 20, 30)), text
            )
    return file


def names(folder: Path, unpacked: Path) -> list[tuple[str, str]]:
    """Name and student of what is taken."""
    return [(file.name, file.student) for file in collect(folder, unpacked)]


@pytest.mark.parametrize(
    ("name", "student"),
    [
        ("Ada Lovelace_12_assignsubmission_file_/a/euler.py", "Ada Lovelace"),
        ("Ada_Lovelace_12_assignsubmission_onlinetext_/euler.py", "Ada_Lovelace"),
        ("12-34 - Bob Noyce - Nov 3, 2026 1100 AM/euler.py", "Bob Noyce"),
        ("lovelaceada_LATE_1_2_euler.py", "lovelaceada"),
        ("lovelaceada_1_2_euler.py", "lovelaceada"),
        ("Lovelace-Ada_1_2_euler.py", "Lovelace-Ada"),
        ("eve/mine/euler.py", "eve"),
        ("euler_1.py", "euler_1"),
    ],
)
def test_whose_a_file_is(name: str, student: str) -> None:
    """By what learning platforms write; else by folder, else by name."""
    assert student_of(name) == student


def test_a_zip_of_as_many_files_and_bytes_as_may_be_is_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """One more is refused."""
    file = zipped(tmp_path / "class.zip", ada_py=TEXT, bob_py=TEXT)
    for limit, most in (("MOST_FILES", 2), ("MOST_BYTES", 2 * len(TEXT))):
        with monkeypatch.context() as patch:
            patch.setattr(collected, limit, most)
            assert names(file, tmp_path / f"{limit}0") == [("ada.py", "ada"), ("bob.py", "bob")]
            patch.setattr(collected, limit, most - 1)
            with pytest.raises(InputError, match="expected a zip that can be read"):
                collect(file, tmp_path / f"{limit}1")


def test_programs_of_the_largest_size_are_taken_out(tmp_path: Path) -> None:
    """A larger one is not: of who has no other nothing is said but that."""
    file = zipped(tmp_path / "class.zip", ada_py="#" * LARGEST, bob_py="#" * (LARGEST + 1))
    assert names(file, tmp_path / "out") == [("ada.py", "ada")]


def test_links_and_hidden_files_are_left(tmp_path: Path) -> None:
    """Also in folders that are hidden; a link to a program is none."""
    folder = tmp_path / "class"
    for name in ("ada/a.py", "ada/.hidden.py", ".git/b.py", "__MACOSX/c.py", "bob/d.C"):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(TEXT, encoding="utf-8")
    os.symlink(folder / "ada" / "a.py", folder / "bob" / "link.py")
    assert names(folder, tmp_path / "out") == [("ada/a.py", "ada"), ("bob/d.C", "bob")]


def test_in_a_zip_too(tmp_path: Path) -> None:
    """What is hidden, or leads out by a name from the root; what is inside has the zip's date."""
    file = zipped(tmp_path / "class.zip", ada__a_py=TEXT)
    with zipfile.ZipFile(file, "a") as archive:
        for name in ("/etc/b.py", "__MACOSX/c.py", "ada/.d.py", "ada/e.txt", "eve\\f.py"):
            archive.writestr(name, TEXT)
    found = collect(file, tmp_path / "out")
    assert sorted(f.name for f in found) == ["ada/a.py", "eve/f.py"]
    assert found[0].when == datetime(2026, 11, 3, 10, 20, 30)
    assert found[0].path.read_text(encoding="utf-8") == TEXT


def test_of_who_has_no_program_the_newest_file_stands(tmp_path: Path) -> None:
    """In a folder, or called as a platform does; a list of the teacher's is nobody's."""
    folder = tmp_path / "class"
    for i, name in enumerate(
        ("ada/a.py", "ada/z.png", "eve/old.txt", "eve/new.pdf", "max.pdf", "list.csv", "a.check.png")
    ):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(TEXT, encoding="utf-8")
        os.utime(folder / name, (1e9 + i, 1e9 + i))
    assert names(folder, tmp_path / "out") == [("ada/a.py", "ada"), ("eve/new.pdf", "eve"), ("max.pdf", "max")]
    os.utime(folder / "eve" / "old.txt", (2e9, 2e9))
    assert ("eve/old.txt", "eve") in names(folder, tmp_path / "again")
    meant = files_in([folder], tmp_path / "third")
    assert sorted(name for _, name in meant) == ["ada/a.py", "eve/old.txt", "max.pdf"]


def test_zips_in_folders_are_looked_into(tmp_path: Path) -> None:
    """Each by its own: of two of one student both; one file that is no zip, by itself, is meant as it is."""
    folder = tmp_path / "class"
    folder.mkdir()
    zipped(folder / "ada.zip", euler_py=TEXT)
    zipped(folder / "bob.ZIP", euler_py=TEXT, deep__heun_py=TEXT)
    (folder / "eve.py").write_text(TEXT, encoding="utf-8")
    assert sorted(names(folder, tmp_path / "out")) == [
        ("ada/euler.py", "ada"),
        ("bob/deep/heun.py", "bob"),
        ("bob/euler.py", "bob"),
        ("eve.py", "eve"),
    ]
    meant = files_in([folder / "eve.py", folder / "ada.zip", folder], tmp_path / "meant")
    assert sorted(name for _, name in meant) == sorted(
        ["eve.py", "euler.py", "ada/euler.py", "bob/deep/heun.py", "bob/euler.py", "eve.py"]
    )
    assert len({path for path, _ in meant}) == 5
