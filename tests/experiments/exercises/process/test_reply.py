"""What a submission's process leaves is read strictly: the form that `child` writes, or nothing of it."""

from __future__ import annotations

import json
import struct
from typing import Any

import numpy as np
import pytest

from experiments.exercises.process import child
from experiments.exercises.process.reply import LONGEST, read
from experiments.exercises.process.sandbox_errors import NotGradedError

#: As `child` writes it, to two questions.
GOOD: dict[str, Any] = {
    "names": ["step"],
    "answers": [
        {"values": [[np.ones(2), np.zeros(())]], "overwritten": False, "again": [np.ones(2), np.zeros(())]},
        {"values": [], "error": {"type": "ValueError", "words": "no", "line": 3}},
    ],
}


#: What a search for small changes leaves.
FOUND: dict[str, Any] = {"repairs": [[3], [1, 2]], "tried": 4, "singles_done": True, "pairs_done": False}


#: What the sandbox says of itself before.
MARK = child.READY + child.pack({"layers": ["limits", "landlock", "seccomp"], "missing": []})


def packed(reply: Any) -> bytes:
    """As the child does it."""
    return bytes(child.pack(reply))


def test_what_the_child_writes_is_read() -> None:
    """Answers, names, layers."""
    found = read(MARK, packed(GOOD), 2)
    assert (found.ended, len(found.answers), found.names) == ("done", 2, ["step"])
    assert read(MARK, packed({**GOOD, "search": [FOUND]}), 2).search == [FOUND]
    failed = {"error": {"type": "SyntaxError", "words": "bad", "line": None}}
    assert read(MARK, packed(failed), 2).error == failed["error"]


def test_what_is_handed_over_are_arrays_of_its_own() -> None:
    """Of every kind and shape, beside numbers and words; what receives them may write into them."""
    sent = {"a": [np.arange(6.0).reshape(2, 3), "b", 3], "c": {"d": np.array([True, False])}, "e": np.array("word")}
    got = child.unpack(packed(sent))
    assert (got["a"][0].tolist(), got["a"][1:]) == ([[0.0, 1.0, 2.0], [3.0, 4.0, 5.0]], ["b", 3])
    assert (got["c"]["d"].tolist(), got["e"].tolist()) == ([True, False], "word")
    got["a"][0][0, 0] = 7.0
    assert child.unpack(packed(got))["a"][0][0].tolist() == [7.0, 1.0, 2.0]


def answers(**changed: Any) -> dict[str, Any]:
    """The good reply, its first answer changed."""
    first = {**GOOD["answers"][0], **changed}
    return {**GOOD, "answers": [{k: v for k, v in first.items() if v is not None}, GOOD["answers"][1]]}


@pytest.mark.parametrize(
    "reply",
    [
        [],
        {},
        {**GOOD, "layers": ["limits"]},
        {name: part for name, part in GOOD.items() if name != "names"},
        {**GOOD, "names": [1]},
        {**GOOD, "names": ["\ud800"]},
        {**GOOD, "names": ["x" * 10_000]},
        {**GOOD, "names": ["x"] * 20_000},
        {**GOOD, "walls": np.ones(3)},
        {**GOOD, "answers": GOOD["answers"][:1]},
        {**GOOD, "answers": GOOD["answers"] * 2},
        {**GOOD, "error": {"type": "E", "words": "w", "line": 1}},
        {**GOOD, "search": {}},
        {**GOOD, "search": [{**FOUND, "repairs": [[1, 2, 3]]}]},
        {**GOOD, "search": [{**FOUND, "repairs": [["1"]]}]},
        {**GOOD, "search": [{**FOUND, "repairs": [[-1]]}]},
        {**GOOD, "search": [{**FOUND, "repairs": [[1, -1]]}]},
        {**GOOD, "search": [{**FOUND, "repairs": [[0]] * 100}]},
        {**GOOD, "search": [{**FOUND, "change": "x"}]},
        {**GOOD, "search": [FOUND] * 20},
        answers(again=[1, 2]),
        answers(again=None),
        answers(values=None),
        answers(values=[[1, 2]]),
        answers(values=[[np.ones(2), 1]]),
        answers(values=[np.ones(2)]),
        answers(modified=1),
        answers(score=100),
        answers(error={"type": "E", "words": "\udfff", "line": 1}),
        answers(error={"type": "E", "words": "w", "line": True}),
        answers(error={"type": "E", "words": "w", "line": -1}),
        answers(error={"type": "E", "words": "w"}),
        answers(error="E"),
    ],
)
def test_anything_else_is_refused_as_a_whole(reply: Any) -> None:
    """One thing of another kind, too much, or missing: nothing of it counts."""
    found = read(MARK, packed(reply), 2)
    assert (found.ended, found.reason, found.answers) == ("crashed", "what it answered is not readable", ())


def raw(head: str, rest: bytes = b"") -> bytes:
    """Bytes with a head of one's own."""
    return struct.pack("<Q", len(head)) + head.encode() + rest


@pytest.mark.parametrize(
    "data",
    [
        b"short",
        b"\xff" * 64,
        struct.pack("<Q", 2**63) + b"{}",
        raw("[" * 100_000),
        raw(json.dumps({"fields": {"layers": {"dtype": "<U1", "shape": [1]}}}), struct.pack("<I", 0x110000)),
        raw(json.dumps({"dtype": "<f8", "shape": [2**40, 2**40]})),
        raw(json.dumps({"dtype": "O", "shape": [1]}), b"\0" * 8),
        raw(json.dumps({"dtype": "<f8", "shape": [-1]}), b"\0" * 8),
        raw('{"fields": {"layers": NaN}}'),
        packed(GOOD)[:-4],
    ],
)
def test_bytes_of_other_kinds_are_refused(data: bytes) -> None:
    """Cut short, nested, of shapes that no memory holds, letters that are none."""
    assert read(MARK, data, 2).ended == "crashed"


@pytest.mark.parametrize(
    ("head", "told"),
    [
        ({"dtype": "<M8[s]", "shape": [1]}, "not handed over"),
        ({"dtype": "<f8", "shape": [1, -1]}, "not handed over"),
        ({"dtype": "<f8", "shape": [1] * 9}, "not handed over"),
        ({"dtype": "<f8", "shape": [2]}, "cut short"),
        ({"dtype": "<f8", "shape": [1] * 8}, ""),
    ],
)
def test_arrays_of_other_kinds_are_not_unpacked(head: dict[str, Any], told: str) -> None:
    """Dates, shapes of less than nothing or of more than eight axes, what has no bytes: each by what it is."""
    data = raw(json.dumps(head), struct.pack("<d", 2.5))
    if told:
        with pytest.raises(ValueError, match=told):
            child.unpack(data)
    else:
        assert child.unpack(data).ravel().tolist() == [2.5]


@pytest.mark.parametrize("numbers", [(65, 0xD800), (0xDFFF, 65), (65, 0x110000), (0x110000, 65)])
def test_letters_that_are_none_are_refused(numbers: tuple[int, int]) -> None:
    """An array of words one of whose numbers is no code point."""
    bad = np.frombuffer(struct.pack("<2I", *numbers), "<U1")
    assert read(MARK, packed(answers(again=[bad, bad])), 2).ended == "crashed"


@pytest.mark.parametrize(
    "reply",
    [
        answers(again=None, error={"type": "E" * 2000, "words": "w", "line": 2**31}),
        answers(error={"type": "E", "words": "w", "line": 0}),
        answers(modified=True, overwritten=True),
        {**GOOD, "names": ["x" * 2000] * 100},
        {**GOOD, "names": ["x"] * 10_000},
        {**GOOD, "search": []},
        {**GOOD, "search": [{**FOUND, "repairs": [[0]] * 64}] * 8},
        answers(again=[np.array(["\ud7ff\ue000\U0010ffff"])]),
        {"error": {"type": "E", "words": "w", "line": 1}, "search": [FOUND]},
    ],
)
def test_what_is_within_bounds_is_read(reply: Any) -> None:
    """The most there may be of each."""
    assert read(MARK, packed(reply), 2).ended == "done"


@pytest.mark.parametrize(
    "reply",
    [
        answers(error={"type": "E" * 2001, "words": "w", "line": 1}),
        answers(error={"type": "E", "words": "w", "line": 2**31 + 1}),
        {**GOOD, "names": ["x"] * 10_001},
        {**GOOD, "search": [FOUND] * 9},
        {**GOOD, "search": [{**FOUND, "repairs": [[0]] * 65}]},
        {**GOOD, "search": [{**FOUND, "repairs": [[]]}]},
        {**GOOD, "search": [{**FOUND, "tried": True}]},
        {**GOOD, "search": [{**FOUND, "pairs_done": 1}]},
        answers(overwritten=0),
        {**GOOD, "answers": [*GOOD["answers"][:1], {"values": []}]},
        {"error": {"type": "E", "words": "w", "line": 1}, "names": []},
        {"names": ["step"]},
    ],
)
def test_what_is_a_little_beyond_them_is_refused(reply: Any) -> None:
    """One more of anything, or another kind of number."""
    assert read(MARK, packed(reply), 2).ended == "crashed"


def test_an_answer_is_bounded() -> None:
    """By its bytes."""
    assert "MiB" in read(MARK, b"x" * (LONGEST + 1), 2).reason


def test_a_process_that_ends_itself_has_not_answered() -> None:
    """There is nothing."""
    assert read(MARK, b"", 2).ended == "crashed"


def test_where_a_layer_is_missing_nothing_is_graded() -> None:
    """It is told which, and the way out; and where that way was taken, it is read."""
    closed = child.CLOSED + child.pack({"layers": ["limits"], "missing": ["landlock", "seccomp"]})
    with pytest.raises(NotGradedError, match=r"landlock, seccomp .*--let-submissions-reach-my-files"):
        read(closed, b"", 2)
    exposed = child.READY + child.pack({"layers": ["limits"], "missing": ["landlock", "seccomp"]})
    assert read(exposed, packed(GOOD), 2).missing == ["landlock", "seccomp"]
