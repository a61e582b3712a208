"""Modules that are found by an open folder, as by their path."""

from __future__ import annotations

import importlib.util
import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from experiments.exercises.process.library_finder import LibraryFinder


@pytest.fixture
def finder(tmp_path: Path) -> Iterator[LibraryFinder]:
    """Of a module, a package with one in it, and a folder that is none."""
    for name in ("one.py", "some/__init__.py", "some/two.py", "some.py", "none/three.txt"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(f"name = {name!r}\ndef f(): pass\n", encoding="utf-8")
    folder = os.open(tmp_path, os.O_RDONLY)
    yield LibraryFinder(folder, "/library")
    os.close(folder)


@pytest.mark.parametrize(
    ("name", "file", "is_package"),
    [("one", "one.py", False), ("some", "some/__init__.py", True), ("some.two", "some/two.py", False)],
)
def test_modules_and_packages_are_found_and_read(finder: LibraryFinder, name: str, file: str, is_package: bool) -> None:
    """A package before a module of its name; each with its place, which errors tell."""
    spec = finder.find_spec(name, None)
    assert spec is not None
    assert spec.origin == f"/library/{file}"
    assert (spec.submodule_search_locations is not None) == is_package
    module = importlib.util.module_from_spec(spec)
    finder.exec_module(module)
    assert module.name == file
    assert module.f.__code__.co_filename == f"/library/{file}"


def test_what_is_not_there_is_left_to_others(finder: LibraryFinder) -> None:
    """Nor is a folder without a program a package here."""
    assert [finder.find_spec(name, None) for name in ("two", "none", "some.three")] == [None] * 3
