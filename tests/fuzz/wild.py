"""Numbers, texts and choices that nobody means: what the generators of all doors draw from."""

from __future__ import annotations

from collections.abc import Sequence
from random import Random
from typing import Any, TypeVar

T = TypeVar("T")

NUMBERS = [0.0, -0.0, 1.0, -1.0, 5e-324, -5e-324, 1e-310, 1e-160, 1e-50, 1e-49, 1e-20, 1e-3, 0.5, 2.5, 7.0, 1e3, 1e9]
NUMBERS += [2.0**31, 2.0**53, 2.0**63, 1e20, 1e49, 1e50, 1e51, 1e100, 1e155, 1e300, 1.7e308, -1e308]
NONE = ["nan", "inf", "-inf", "1e999", "", "0x1f", "--3", "1_0", "½", "\uff11", "1e", "1,2", "true", "None"]

TEXTS = [
    "",
    " ",
    "\x00",
    "\x1b[2J",
    "\x1b]0;x\x07",
    "\n",
    "\r",
    "\u202e",
    "é",
    "漢",
    "\U0001f600",
    "\udcff",
    "%s",
    "{}",
]
TEXTS += [
    "../../etc/passwd",
    "/dev/zero",
    "/dev/stdin",
    "/proc/self/mem",
    "=1+1",
    "\uff1d1",
    ";=1",
    "'",
    '"',
    "$(x)",
    "`x`",
]


def number(random: Random) -> float:
    """A float of any size, often one of NUMBERS."""
    return (
        random.choice(NUMBERS) if random.random() < 0.7 else random.uniform(-1, 1) * 10.0 ** random.uniform(-320, 308)
    )


def number_text(random: Random) -> str:
    """A number as text, sometimes none."""
    if random.random() < 0.15:
        return random.choice(NONE)
    value = number(random)
    return str(int(value)) if random.random() < 0.3 and abs(value) < 1e40 else repr(value)


def text(random: Random) -> str:
    """A text; sometimes a long one."""
    found = "".join(random.choice([*TEXTS, "a", "b", "_", "1"]) for _ in range(random.randint(0, 4)))
    return found * random.choice([1, 1, 1, 1, 300]) if found else found


def value(random: Random, depth: int = 2) -> Any:
    """Anything that JSON or MessagePack can say."""
    kind = random.randrange(8 if depth else 6)
    if kind == 6:
        return [value(random, depth - 1) for _ in range(random.randint(0, 4))]
    if kind == 7:
        return {text(random): value(random, depth - 1) for _ in range(random.randint(0, 3))}
    choices: list[Any] = [None, random.random() < 0.5, random.randint(-3, 2**40), number(random), text(random), b"\xff"]
    return choices[kind]


def one_of(random: Random, choices: Sequence[T]) -> T:
    """One of them."""
    return choices[random.randrange(len(choices))]


def damaged(random: Random, data: bytes) -> bytes:
    """The same with some bytes others, some less, some more, or a piece of zeros."""
    whole = bytearray(data)
    for _ in range(random.choice((1, 1, 2, 8))):
        at = random.randrange(len(whole) + 1)
        kind = random.randrange(5)
        if kind == 0:
            whole[at : at + 1] = random.randbytes(1)
        elif kind == 1:
            del whole[at : at + random.choice((1, 8, 512))]
        elif kind == 2:
            whole[at:at] = random.randbytes(random.choice((1, 8)))
        elif kind == 3:
            piece = min(random.choice((4, 64, 4096)), len(whole) - at)
            whole[at : at + piece] = bytes(piece)
        else:
            del whole[at:]
    return bytes(whole)
