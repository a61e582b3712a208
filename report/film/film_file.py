"""Films as files: GIF by Pillow, MP4 by the ffmpeg that imageio-ffmpeg brings along. All or nothing is written."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from itertools import chain
from pathlib import Path

import numpy as np

from reference.errors import InputError
from reference.state import Array
from report.film.drawing import colour_map

#: The endings of files that can be written.
ENDINGS = (".gif", ".mp4")

#: How long the last picture of a GIF stays before it begins again [ms].
PAUSE = 1200


def check_name(path: Path) -> None:
    """Refuse what no film can be written to. Raises InputError."""
    if path.suffix.lower() not in ENDINGS:
        raise InputError(f"--animate {str(path)!r}: expected a file name that ends in {' or '.join(ENDINGS)}")
    if path.is_dir():
        raise InputError(f"--animate {str(path)!r}: expected a file, this is a folder")
    if path.suffix.lower() == ".mp4" and find_spec("imageio_ffmpeg") is None:
        raise InputError(
            f"--animate {str(path)!r}: MP4 needs the package imageio-ffmpeg, which is not installed; expected "
            "pip install 'springlab[video]', or a name that ends in .gif"
        )


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """A new file beside `path`, which takes its place in the end; if anything goes wrong before, nothing is left.

    Raises:
        OSError: naming `path`, where no file can be written there: at once.
    """
    part = path.with_name(f".{os.getpid()}-{path.name}")
    with _named(path):
        path.parent.mkdir(parents=True, exist_ok=True)
        part.open("wb").close()
    try:
        yield part
        with _named(path):
            part.replace(path)
    finally:
        part.unlink(missing_ok=True)


@contextmanager
def _named(path: Path) -> Iterator[None]:
    """What goes wrong with a file is told of the one that was asked for."""
    try:
        yield
    except OSError as error:
        raise OSError(error.errno, error.strerror or "cannot be written", str(path)) from error


def write_film(part: Path, path: Path, frames: Iterator[Array], rate: float) -> None:
    """Write frames (h, w, 3), of bytes, into `part`, which is to become `path`.

    Args:
        part: the file that is written.
        path: what it is to become: its ending says the format.
        frames: all of one size.
        rate: frames in a second.

    Raises:
        OSError: naming `path`, where the disk is full or the like.
    """
    with _named(path):
        (_write_gif if path.suffix.lower() == ".gif" else _write_mp4)(part, frames, rate)


def _write_gif(part: Path, frames: Iterator[Array], rate: float) -> None:
    """All frames in the same colours: nothing flickers."""
    from PIL import Image

    colours = Image.new("P", (1, 1))
    colours.putpalette(_palette())
    pictures = [Image.fromarray(frame).quantize(palette=colours, dither=Image.Dither.NONE) for frame in frames]
    durations = [round(1000 / rate)] * (len(pictures) - 1) + [PAUSE]
    first, *others = pictures
    first.save(part, format="GIF", save_all=True, append_images=others, duration=durations, loop=0)


def _palette() -> list[int]:
    """Red, green, blue of 256 colours: 32 greys, and those of strain, clear and more and more faint on white."""
    greys = np.repeat(np.linspace(0, 255, 32)[:, None], 3, axis=1)
    clear = 255 * colour_map()(np.linspace(0, 1, 56))[:, :3]
    faint = [255 + part * (clear - 255) for part in (1.0, 0.75, 0.5, 0.25)]
    return np.concatenate([greys, *faint]).round().astype(int).ravel().tolist()


def _write_mp4(part: Path, frames: Iterator[Array], rate: float) -> None:
    import imageio_ffmpeg

    first = next(frames)
    high, wide, _ = first.shape
    writer = imageio_ffmpeg.write_frames(
        part, (wide, high), fps=rate, quality=8, macro_block_size=2, ffmpeg_log_level="error"
    )
    writer.send(None)
    try:
        for frame in chain([first], frames):
            writer.send(frame.tobytes())
    finally:
        writer.close()
