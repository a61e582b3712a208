"""A function that counts its calls answers otherwise later: its first question is put once more, after all others."""

from __future__ import annotations

from types import ModuleType, SimpleNamespace
from typing import Any, cast

import numpy as np

from experiments.exercises.process.child import ask, ask_firsts_again


def question(function: str, x: float) -> dict[str, Any]:
    """One number in, one out."""
    return {"function": function, "arguments": [np.array([x])], "parts": ["doubled"], "steps": 0}


def program() -> ModuleType:
    """One function that is always the same, and one that answers otherwise from its fourth call on."""
    calls: list[Any] = []

    def same(x: Any) -> Any:
        return 2 * x

    def counts(x: Any) -> Any:
        calls.append(x)
        return 2 * x + (len(calls) > 4)

    return cast(ModuleType, SimpleNamespace(same=same, counts=counts))


def test_who_answers_otherwise_later_is_found_and_nobody_else() -> None:
    """The other answer stands with the first question of that function; each is put twice when it is asked."""
    module, questions = program(), [question("same", 1.0), question("counts", 3.0), question("counts", 5.0)]
    answers = [ask(module, each) for each in questions]
    before = [answer["again"][0].tolist() for answer in answers]
    assert before == [[2.0], [6.0], [10.0]]
    ask_firsts_again(module, questions, answers)
    assert [answer["again"][0].tolist() for answer in answers] == [[2.0], [7.0], [10.0]]
