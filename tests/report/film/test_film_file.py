"""Films as files: their names, how long pictures stay, and their colours."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image

from reference.errors import InputError
from reference.state import Array
from report.film.drawing import colour_map
from report.film.film_file import check_name, whole_file, write_film


def stripes(*colours: Array) -> Array:
    """A picture (8, 8 k, 3) of k upright stripes of colours, each three bytes."""
    return np.repeat(np.tile(np.array(colours, dtype=np.uint8)[None], (8, 1, 1)), 8, axis=1)


def written(tmp_path: Path, *frames: Array) -> Image.Image:
    """The GIF of some pictures, ten in a second, read back."""
    write_film(tmp_path / "part", tmp_path / "a.GIF", iter(frames), 10.0)
    return Image.open(tmp_path / "part")


def test_the_last_picture_stays_a_while_before_the_film_begins_again(tmp_path: Path) -> None:
    """A second or two; the others as long as asked for."""
    frames = [stripes(np.full(3, value)) for value in (0, 100, 200)]
    with written(tmp_path, *frames) as image:
        assert image.info["loop"] == 0  # for ever
        durations = []
        for i in range(3):
            image.seek(i)
            durations.append(image.info["duration"])
            assert abs(np.array(image.convert("RGB")).astype(int) - frames[i]).max() <= 4
    assert durations[:2] == [100, 100]
    assert 1000 <= durations[2] <= 2000


def test_colours_of_strain_and_greys_come_through(tmp_path: Path) -> None:
    """Clear, and fainter as what is far away is; to a few of 255."""
    clear = 255 * colour_map()(np.linspace(0, 1, 21))[:, :3]
    faint = 255 + 0.5 * (clear - 255)
    greys = np.repeat(np.linspace(0, 255, 12)[:, None], 3, axis=1)
    frame = stripes(*clear, *faint, *greys)
    with written(tmp_path, frame) as image:
        off = np.abs(np.array(image.convert("RGB")).astype(int) - frame).max(axis=(0, 2))
    assert off.max() <= 8


def test_an_mp4_is_handed_to_its_writer_picture_by_picture(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Width and height, then the bytes of each in their order, and the end."""
    told: list[object] = []

    def write_frames(path: Path, size: tuple[int, int], fps: float, **options: object) -> Iterator[None]:
        told.extend([path, size, fps])
        assert options == {"quality": 8, "macro_block_size": 2, "ffmpeg_log_level": "error"}
        try:
            while True:
                told.append((yield))
        finally:
            told.append("closed")

    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", SimpleNamespace(write_frames=write_frames))
    frames = [stripes(np.full(3, value), np.zeros(3)) for value in (10, 20, 30)]
    write_film(tmp_path / "part", tmp_path / "a.MP4", iter(frames), 12.5)
    assert told == [tmp_path / "part", (16, 8), 12.5, *(frame.tobytes() for frame in frames), "closed"]


def test_names_that_a_film_can_have(tmp_path: Path) -> None:
    """Endings in any letters; an old file is no hindrance."""
    (tmp_path / "b.gif").write_text("old")
    for name in ("a.gif", "a.GIF", "b.gif"):
        check_name(tmp_path / name)
    for name in ("a", "a.png", "gif"):
        with pytest.raises(InputError, match=r"ends in \.gif or \.mp4"):
            check_name(tmp_path / name)
    if find_spec("imageio_ffmpeg") is not None:
        check_name(tmp_path / "a.MP4")
    else:
        with pytest.raises(InputError, match="imageio-ffmpeg"):
            check_name(tmp_path / "a.MP4")


def test_a_file_is_there_when_it_is_whole_or_not_at_all(tmp_path: Path) -> None:
    """In a folder of a folder that are made for it; an error leaves what was there."""
    path = tmp_path / "new" / "newer" / "a.gif"
    with whole_file(path) as part:
        part.write_text("one")
        assert not path.exists()
    assert (path.read_text(), len([*path.parent.iterdir()])) == ("one", 1)

    def go_wrong() -> None:
        with whole_file(path) as part:
            part.write_text("two")
            raise ValueError("wrong")

    with pytest.raises(ValueError, match="wrong"):
        go_wrong()
    assert (path.read_text(), len([*path.parent.iterdir()])) == ("one", 1)
