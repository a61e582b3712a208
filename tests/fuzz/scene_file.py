"""Scene files: tables as they are meant with numbers, texts and keys that nobody means, or sound files damaged."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from random import Random
from typing import Any

import numpy as np

from reference.errors import InputError, SolverError
from reference.files.scene_file import load
from reference.scenes import find, scenes
from reference.schemes.catalogue import find as find_scheme
from reference.simulate import simulate
from reference.system import PARAMETERS
from tests.fuzz import wild
from tests.fuzz.doors import Enter
from tests.reference.files.test_fuzzed_files import mutated, written

#: What is taken is also stepped, where it is small and there is not much to do.
MOST_MASSES = 200


def make(random: Random) -> tuple[bytes, str, bytes]:
    """A file, and the mesh or record beside it."""
    if random.random() < 0.3:
        return mutated(random.randrange(10**9))
    return "\n".join(_lines(random)).encode(errors="surrogatepass"), "", b""


def _lines(random: Random) -> Iterator[str]:
    """A whole file, line by line."""
    for name in ("dt", "duration"):
        if random.random() < 0.4:
            yield f"{name} = {_number(random)}"
    if random.random() < 0.5:
        name = wild.one_of(random, [*scenes(), "string"])
        yield f'scene = "{name}"'
        yield "[parameters]"
        for parameter in random.sample([*find(name).parameters], random.randint(0, 2)):
            yield f"{parameter} = {_value(random)}"
    else:
        yield from _system(random)
    for _ in range(random.choice((0, 0, 0, 1))):
        parameter = wild.one_of(random, [*PARAMETERS])
        yield f'[[changes]]\ntime = {_number(random)}\nparameter = "{parameter}"\nvalue = {_value(random)}'
    if random.random() < 0.3:
        kind = wild.one_of(random, ["circle", "sphere", "cylinder", "plane", "box", "cone"])
        yield f'[[obstacles]]\nkind = "{kind}"'
        for name in random.sample(["centre", "radius", "axis", "point", "normal", "half_sizes"], 3):
            yield f"{name} = {_number(random) if name == 'radius' else _list(random, random.randint(1, 3))}"
    if random.random() < 0.2:
        yield "[ground_motion]"
        for name in ("from_frequency", "to_frequency", "amplitude", "duration"):
            yield f"{name} = {_number(random)}"


def _system(random: Random) -> Iterator[str]:
    n, d = random.randint(1, 5), random.randint(1, 3)
    yield "[system]"
    yield f"positions = [{', '.join(_list(random, d, sound=0.97) for _ in range(n))}]"
    pairs = ", ".join(
        str([*range(n)][-2:] if random.random() < 0.9 else [random.randint(-1, n), 0])
        for _ in range(random.randint(0, 2))
    )
    yield f"springs = [{pairs}]"
    for name in ("masses", "stiffness"):
        yield f"{name} = {_value(random)}"
    for name in random.sample(
        ["rest_lengths", "damping", "drag", "gravity", "fixed", "more"], wild.one_of(random, [0, 0, 1, 2])
    ):
        yield f"{name} = {f'[{random.randint(-1, n)}]' if name == 'fixed' else _value(random)}"


def _number(random: Random) -> str:
    if random.random() < 0.85:
        return repr(random.uniform(0.001, 2.0))
    found = wild.number(random)
    return wild.one_of(
        random,
        [repr(found), repr(found), "nan", "inf", "true", '"x"', "1979-05-27", str(int(random.random() * 10**25))],
    )


def _list(random: Random, count: int, sound: float = 0.8) -> str:
    numbers = (repr(random.uniform(-1, 1)) if random.random() < sound else _number(random) for _ in range(count))
    return f"[{', '.join(numbers)}]"


def _value(random: Random) -> str:
    return _number(random) if random.random() < 0.9 else _list(random, random.randint(0, 3))


@contextmanager
def opened(folder: Path) -> Iterator[Enter]:
    """Files are read; what is taken makes three steps, or says why not."""

    def enter(made: Any) -> str:
        file = written(folder, *made)
        try:
            with np.errstate(all="ignore"):
                setup = load(file, {})
                if len(setup.system.masses) <= MOST_MASSES:
                    simulate(setup.system, find_scheme("heun"), setup.dt, 3 * setup.dt)
        except SolverError:
            return "refused"
        except InputError as error:
            return "refused" if len(str(error).splitlines()) == 1 else f"more than a line: {error!r}"
        return "taken"

    yield enter
