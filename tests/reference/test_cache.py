"""Where what can be made again is kept: in the user's cache folder, or anywhere that can be written."""

from __future__ import annotations

from pathlib import Path

import pytest

from reference.cache import cache_folder


def test_it_is_a_folder_in_the_users_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """By the variable that says where, and without it in .cache at home; made, and the same one the next time."""
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    for variable, expected in ((str(tmp_path / "mine"), tmp_path / "mine"), ("", tmp_path / "home" / ".cache")):
        monkeypatch.setenv("XDG_CACHE_HOME", variable)
        found = cache_folder("kernels")
        assert found == expected / "springlab" / "kernels"
        assert list(found.iterdir()) == []
        (found / "kept").touch()
        assert [file.name for file in cache_folder("kernels").iterdir()] == ["kept"]


def test_where_that_cannot_be_written_it_is_a_scratch_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A file stands where the cache should be."""
    (tmp_path / "file").touch()
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    found = cache_folder("kernels")
    assert found.parent == tmp_path
    assert found.is_dir()
    assert "kernels" in found.name
