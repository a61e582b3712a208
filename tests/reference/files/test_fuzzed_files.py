"""Scene and mesh files changed at random: each is a system, or is refused in one line; never anything else.

In full (`--full`) a thousand of them, otherwise a hundred.
"""

from __future__ import annotations

import random
import re
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from reference.errors import InputError
from reference.files.scene_file import load
from reference.scenes import Setup
from tests.reference.files.mesh_files import BINARY_BLOCK, BLANKET, BLOCK, NEXT_BLOCK
from tests.reference.files.test_scene_file import NAMED, WRITTEN_OUT
from tests.reference.files.test_scenes_of_meshes import SCENE

#: For a file [s]; they take milliseconds.
TIME_LIMIT = 5.0

OBSTACLE = '[[obstacles]]\nkind = "circle"\ncentre = [0.5, -6]\nradius = 0.3\n'
SHAKEN = "[ground_motion]\nfrom_frequency = 0.5\nto_frequency = 5.0\namplitude = 1.0\nduration = 0.2\nlaw = 'linear'\n"
OF_A_BLOCK = SCENE.replace("meshes/blanket.obj", "mesh.vtk")

#: Scene files, and the mesh each takes, by name.
SOUND: list[tuple[str, str, str | bytes]] = [
    (NAMED, "", ""),
    (NAMED + OBSTACLE, "", ""),
    (WRITTEN_OUT, "", ""),
    (WRITTEN_OUT + SHAKEN + "direction = [1, 0.5]\n", "", ""),
    (WRITTEN_OUT + '[ground_motion]\nfile = "mesh.csv"\nscale = 9.81\n', "mesh.csv", "t, x\n0, 1\n0.1, 2\n0.2, -1\n"),
    (SCENE.replace("meshes/blanket", "mesh"), "mesh.obj", BLANKET),
    (OF_A_BLOCK, "mesh.vtk", BLOCK),
    (OF_A_BLOCK, "mesh.vtk", NEXT_BLOCK),
    (OF_A_BLOCK, "mesh.vtk", BINARY_BLOCK),
]

#: What numbers are changed to. None makes a string of so many masses that it would only take long.
NUMBERS = [b"", b"0", b"-1", b"1", b"7", b"nan", b"inf", b"-1e308", b"1e999", b"0x1f", b"99999999999999", b"1e-320"]
NUMBERS += [b"9223372036854775808", b"2.5", b'"two"', b"true", b"[]", b"[1, 2]", b"{}", b"--3", b"1_0"]

Mutation = Callable[[random.Random, bytes], bytes]


def another_byte(rng: random.Random, data: bytes) -> bytes:
    """One byte, in place of what was there."""
    at = rng.randrange(len(data) or 1)
    return data[:at] + rng.randbytes(1) + data[at + 1 :]


def more_bytes(rng: random.Random, data: bytes) -> bytes:
    """Some, between those there are."""
    at = rng.randrange(len(data) + 1)
    return data[:at] + rng.randbytes(rng.randint(1, 8)) + data[at:]


def cut(rng: random.Random, data: bytes) -> bytes:
    """A piece less, often the end."""
    a, b = sorted(rng.randrange(len(data) + 1) for _ in range(2))
    return data[:a] + (data[b:] if rng.random() < 0.5 else b"")


def another_number(rng: random.Random, data: bytes) -> bytes:
    """One of NUMBERS, in place of one that was there."""
    numbers = list(re.finditer(rb"-?\d[\d.e-]*", data))
    if not numbers:
        return data
    found = rng.choice(numbers)
    return data[: found.start()] + rng.choice(NUMBERS) + data[found.end() :]


def shuffled_lines(rng: random.Random, data: bytes) -> bytes:
    """A line twice, a line less, or two lines changing places."""
    lines = data.splitlines(keepends=True) or [b""]
    i, j = rng.randrange(len(lines)), rng.randrange(len(lines))
    kind = rng.randrange(3)
    if kind == 0:
        lines.insert(i, lines[j])
    elif kind == 1:
        del lines[i]
    else:
        lines[i], lines[j] = lines[j], lines[i]
    return b"".join(lines)


def another_word(rng: random.Random, data: bytes) -> bytes:
    """A word in another's place."""
    words = list(re.finditer(rb"\w+", data))
    if not words:
        return data
    found = rng.choice(words)
    return data[: found.start()] + rng.choice(words)[0] + data[found.end() :]


MUTATIONS: list[Mutation] = [
    another_byte,
    more_bytes,
    cut,
    another_number,
    another_number,
    shuffled_lines,
    another_word,
]


def mutated(seed: int) -> tuple[bytes, str, bytes]:
    """A scene file and its mesh, one of them changed in one to three ways."""
    rng = random.Random(seed)
    scene, name, mesh = SOUND[seed % len(SOUND)]
    files = [scene.encode(), mesh if isinstance(mesh, bytes) else mesh.encode()]
    which = 1 if name and rng.random() < 0.75 else 0
    for _ in range(rng.randint(1, 3)):
        files[which] = rng.choice(MUTATIONS)(rng, files[which])
    return files[0], name, files[1]


class TooLong(BaseException):
    """Not an Exception: no one else is to catch it."""


@contextmanager
def time_limit(seconds: float, of_the_processor: bool = False) -> Iterator[None]:
    """Raise TooLong where what is done in it takes longer [s]: by the clock, or of the processor, however busy."""
    timer, strikes = (signal.ITIMER_PROF, signal.SIGPROF) if of_the_processor else (signal.ITIMER_REAL, signal.SIGALRM)

    def stop(*_: object) -> None:
        raise TooLong

    before = signal.signal(strikes, stop)
    signal.setitimer(timer, seconds)
    try:
        yield
    finally:
        signal.setitimer(timer, 0.0)
        signal.signal(strikes, before)


def ending(read: Callable[[], object], seconds: float = TIME_LIMIT) -> str:
    """Nothing where a file was read, or refused in one line; else what happened."""
    try:
        with time_limit(seconds):
            answer = read()
    except InputError as error:
        return "" if len(str(error).splitlines()) == 1 else f"not one line: {error!r}"
    except TooLong:
        return f"not read within {seconds:g} s"
    except BaseException as error:
        return f"{type(error).__name__}: {error}"
    return "" if isinstance(answer, Setup) else f"answers {answer!r}"


def written(folder: Path, scene: bytes, name: str, mesh: bytes) -> Path:
    """The scene file, its mesh beside it."""
    (folder / "scene.toml").write_bytes(scene)
    if name:
        (folder / name).write_bytes(mesh)
    return folder / "scene.toml"


def test_files_changed_at_random_are_read_or_refused_in_a_line(tmp_path: Path, request: pytest.FixtureRequest) -> None:
    """No traceback, no hang, no crash; both happen, or nothing would be shown."""
    count, refused = 1000 if request.config.getoption("--full") else 100, 0
    for seed in range(count):
        file = written(tmp_path, *mutated(seed))
        told = ending(lambda file=file: load(file, {}))  # type: ignore[misc]
        assert told == "", f"seed {seed}: {told}"
        try:
            load(file, {})
        except InputError:
            refused += 1
    assert 0.3 * count < refused < 0.95 * count


@pytest.mark.parametrize("i", range(len(SOUND)))
def test_unchanged_they_are_read(tmp_path: Path, i: int) -> None:
    """Each is a system."""
    scene, name, mesh = SOUND[i]
    file = written(tmp_path, scene.encode(), name, mesh if isinstance(mesh, bytes) else mesh.encode())
    assert len(load(file, {}).system.springs) > 1


def refuse_in_two_lines() -> None:
    """As no file should be refused."""
    raise InputError("one\ntwo")


def wait_for_ever() -> None:
    """As no file should be read."""
    while True:
        pass


def test_other_endings_are_seen() -> None:
    """Shown to fail: an exception, a second line, an exit, a reader that never ends, no answer."""
    assert ending(lambda: 1 / 0) == "ZeroDivisionError: division by zero"
    assert ending(lambda: exit(1)).startswith("SystemExit")
    assert ending(refuse_in_two_lines).startswith("not one line")
    assert ending(wait_for_ever, 0.05) == "not read within 0.05 s"
    assert ending(lambda: None) == "answers None"
