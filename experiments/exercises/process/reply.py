"""What a submission's process leaves, read strictly: one form, bounded, refused as a whole where anything is off.

Whoever wrote it may have been the submission: it shares the process. So nothing is believed but its form, and numbers
that the checker compares itself.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from experiments.exercises.process import child
from experiments.exercises.process.sandbox_errors import NotGradedError

#: An answer is no longer than that [bytes]; no more names, no longer words than that.
LONGEST, MOST_NAMES, LONGEST_WORDS = 2**23, 10_000, 2_000

#: Of a search, so many groups of questions, and repairs of each.
MOST_GROUPS, MOST_REPAIRS = 8, 64

#: What a question's answer may hold beside its values.
FLAGS = ("modified", "overwritten")


@dataclass(frozen=True)
class Reply:
    """What came back.

    Attributes:
        ended: how the process ended where it gave no answer: "timed out" or "crashed"; else "done".
        reason: of that, in a line.
        answers: one for each question, as `child.ask` makes them.
        error: what reading the submission raised: type, words, line.
        layers: of the sandbox, those that were active.
        names: what the submission defines.
        missing: layers that should have been active, and were not.
        search: for each group of questions, the changes that were found, by numbers; see `source_search`.
    """

    ended: str
    reason: str = ""
    answers: Sequence[Mapping[str, Any]] = ()
    error: Mapping[str, Any] | None = None
    layers: Sequence[str] = ()
    names: Sequence[str] = ()
    missing: Sequence[str] = ()
    search: Sequence[Mapping[str, Any]] = ()


def read(mark: bytes, data: bytes, count: int) -> Reply:
    """The reply in what a process that came to its end has left.

    Args:
        mark: what the sandbox said of itself, before the submission was read: no submission can write there.
        data: the answers; a submission may have written there.
        count: of the questions.

    Raises:
        NotGradedError: where the submission was not read, as the sandbox did not stand.
    """
    layers, missing = standing(mark)
    if len(data) > LONGEST:
        return Reply("crashed", f"it answered more than {LONGEST / 2**20:g} MiB")
    if not data:
        return Reply("crashed", "it ended its process before it had answered")
    try:
        reply = child.unpack(data)
        _check(reply, count)
    except (ValueError, UnicodeError):
        return Reply("crashed", "what it answered is not readable")
    answers, names, found = (reply.get(name, ()) for name in ("answers", "names", "search"))
    return Reply("done", "", answers, reply.get("error"), layers, names, missing, found)


def standing(mark: bytes) -> tuple[list[str], list[str]]:
    """Which layers of the sandbox are active and which are missing. Raises NotGradedError where it does not stand."""
    if mark.startswith(child.CLOSED):
        missing = ", ".join(child.unpack(mark[len(child.CLOSED) :])["missing"])
        raise NotGradedError(
            f"this machine has no {missing} to keep submissions in; see --let-submissions-reach-my-files"
        )
    told = child.unpack(mark[len(child.READY) :])
    return list(told["layers"]), list(told["missing"])


def _check(reply: Any, count: int) -> None:
    """Raises ValueError unless everything in it is as `child` writes it."""
    _is_dict(reply, set(), {"names", "answers", "error", "search"})
    _expect(("error" in reply) != ("answers" in reply) and ("names" in reply) == ("answers" in reply))
    _are_words(reply.get("names", []))
    answers = reply.get("answers", [])
    _expect(isinstance(answers, list) and len(answers) == (0 if "error" in reply else count))
    for answer in answers:
        _is_answer(answer)
    if "error" in reply:
        _is_error(reply["error"])
    _expect(isinstance(reply.get("search", []), list) and len(reply.get("search", [])) <= MOST_GROUPS)
    for found in reply.get("search", []):
        _is_search(found)


def _is_search(found: Any) -> None:
    """Numbers of changes, one or two to a repair; how many were tried, and whether that was all."""
    _is_dict(found, {"repairs", "tried", "singles_done", "pairs_done"}, set())
    _expect(type(found["tried"]) is int and all(isinstance(found[n], bool) for n in ("singles_done", "pairs_done")))
    _expect(isinstance(found["repairs"], list) and len(found["repairs"]) <= MOST_REPAIRS)
    for repair in found["repairs"]:
        _expect(isinstance(repair, list) and len(repair) in (1, 2) and all(type(i) is int and i >= 0 for i in repair))


def _is_answer(answer: Any) -> None:
    _is_dict(answer, {"values"}, {"again", "error", *FLAGS})
    _expect(isinstance(answer["values"], list) and all(map(_are_arrays, answer["values"])))
    _expect("again" not in answer or _are_arrays(answer["again"]))
    _expect("again" in answer or "error" in answer)
    _expect(all(isinstance(answer[flag], bool) for flag in FLAGS if flag in answer))
    if "error" in answer:
        _is_error(answer["error"])


def _is_error(error: Any) -> None:
    _is_dict(error, {"type", "words", "line"}, set())
    _are_words([error["type"], error["words"]])
    _expect(error["line"] is None or (type(error["line"]) is int and 0 <= error["line"] <= 2**31))


def _are_arrays(values: Any) -> bool:
    if not (isinstance(values, list) and all(isinstance(value, np.ndarray) for value in values)):
        return False
    for value in values:
        if value.dtype.kind == "U" and not _are_letters(np.ascontiguousarray(value).ravel().view(np.uint32)):
            return False
    return True


def _are_letters(numbers: Any) -> bool:
    """Whether they are code points, and no halves of one."""
    return bool((numbers < 0x110000).all() and not ((numbers >= 0xD800) & (numbers < 0xE000)).any())


def _are_words(words: Any) -> None:
    _expect(isinstance(words, list) and len(words) <= MOST_NAMES)
    for word in words:
        _expect(isinstance(word, str) and len(word) <= LONGEST_WORDS)
        word.encode("utf-8")  # half of a code point cannot be written anywhere


def _is_dict(value: Any, needed: set[str], possible: set[str]) -> None:
    _expect(isinstance(value, dict) and needed <= set(value) <= needed | possible)


def _expect(true: bool) -> None:
    if not true:
        raise ValueError("not a reply")
