"""Where what can be made again is kept: in the user's cache folder, or anywhere that can be written."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from reference import cache
from reference.cache import cache_folder
from reference.scratch import OWNED


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


@pytest.fixture
def no_home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A file stands where the cache should be; the folder for temporary files is given back."""
    (tmp_path / "file").touch()
    (tmp_path / "tmp").mkdir()
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "tmp"))
    monkeypatch.setattr("reference.cache.remarks", {})
    return tmp_path / "tmp"


def test_where_that_cannot_be_written_it_is_a_temporary_folder_that_stays(no_home: Path) -> None:
    """The same one the next time, for this user alone; and there is a remark, once, that says where."""
    found = cache_folder("kernels")
    assert found == cache_folder("kernels") == no_home / f"springlab-cache-{os.getuid()}" / "kernels"
    assert found.parent.stat().st_mode & 0o777 == 0o700
    (remark,) = cache.remarks
    assert remark.endswith(f"/file cannot be written: what would be kept there (compiled kernels) is in {found}")


@pytest.mark.parametrize("how", ["open to others", "a link", "a file"])
def test_a_folder_that_others_can_write_to_is_not_used(no_home: Path, tmp_path: Path, how: str) -> None:
    """Code that is kept there would be run: who is first to have the name could choose it."""
    place = no_home / f"springlab-cache-{os.getuid()}"
    if how == "open to others":
        place.mkdir()
        place.chmod(0o777)
    elif how == "a link":
        (tmp_path / "theirs").mkdir(mode=0o700)
        place.symlink_to(tmp_path / "theirs")
    else:
        place.touch()
    found = cache_folder("kernels")
    assert OWNED.match(found.parent.name)
    assert found.is_dir()


def test_a_user_without_a_home_has_a_cache_too(no_home: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As where the number is nobody's, in a container."""

    def nobody() -> Path:
        raise RuntimeError("no home")

    monkeypatch.setenv("XDG_CACHE_HOME", "")
    monkeypatch.setattr(Path, "home", nobody)
    assert cache_folder("kernels").is_relative_to(no_home)
    assert next(iter(cache.remarks)).startswith("a home cannot be written")
