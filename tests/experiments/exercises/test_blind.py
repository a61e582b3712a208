"""Programs of people who had only texts and starters: none that is wrong passes, none that is right is refused."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from experiments.exercises.exercise import Exercise, find
from experiments.exercises.verdict.answer_catalogue import catalogue_of
from experiments.exercises.verdict.judge import judge
from experiments.exercises.verdict.naming import SINGLE
from tests.experiments.exercises.blind_rates import SAMPLES
from tests.experiments.exercises.corpus import solution, wrong

#: What they are warned of (np.matrix, for one) ends nothing in the sandbox, and here neither.
pytestmark = [pytest.mark.filterwarnings("ignore"), pytest.mark.usefixtures("trusted")]

#: Of all samples, by file; those in C are with the others in C.
PROGRAMS = sorted(
    (program for sample in SAMPLES.values() for program in sample if program.language == "python"),
    key=lambda p: (p.name, p.file),
)

#: Whose grade depends on no number: what they return is right to rounding, how they do it is not.
BY_OTHER_MEANS = ("modifies_its_input", "midpoint", "ralston")


def keys(exercise: Exercise, full: bool) -> Iterator[str | None]:
    """The public check, and hidden ones: of one key, or in full of twelve."""
    yield None
    if not exercise.seeded:
        yield from map(str, range(12 if full else 1))


def test_right_ones_pass_and_wrong_ones_do_not(corpus_part: slice, request: pytest.FixtureRequest) -> None:
    """In the public check and in every hidden one, whatever the key: a wrong program is far from right in each.

    Far is twenty times what counts as single precision (SINGLE), or twice the tolerance where numbers are typed in.
    """
    for program in PROGRAMS[corpus_part]:
        name, exercise = program.name, find(str(int(program.name[1:3])))
        for key in keys(exercise, request.config.option.full):
            verdict = judge(exercise, program.text, program.seed, key)
            assert verdict.right == program.right, (name, key, program.words, verdict.name)
            if not program.right and verdict.right_error is not None and verdict.name not in BY_OTHER_MEANS:
                assert verdict.right_error > max(20 * SINGLE, 1.1 * exercise.tolerance), (name, key)


def test_each_check_asks_what_programs_have_got_away_with() -> None:
    """Whatever the key: one mass; masses above, below, left and right of what holds them; springs far from rest."""
    for key in (None, *map(str, range(5))):
        questions = catalogue_of(find("3"), "", key).questions
        assert any(len(q.arguments[0]) == 1 for q in questions)
        separations = [np.diff(x, axis=0, prepend=s["anchor"][None]) for x, _, s in (q.arguments for q in questions)]
        quarters = {tuple(row) for part in separations for row in np.sign(part).tolist()}
        assert quarters == {(1, 1), (1, -1), (-1, 1), (-1, -1)}
        rest_lengths = np.concatenate([q.arguments[2]["rest_lengths"] for q in questions])
        shares = np.concatenate([np.linalg.norm(part, axis=1) for part in separations]) / rest_lengths
        assert shares.min() < 0.01
        assert shares.max() > 3.5


def test_midpoint_is_told_from_heun_though_the_spring_is_linear() -> None:
    """Where drag grows with the speed they part; nothing follows for who multiplies the drag by dt first."""
    heun = solution("loops", 2)
    assert judge(find("2"), heun).name == "right"
    verdict = judge(find("2"), wrong("loops", "midpoint", 2))
    assert (verdict.name, verdict.outcome) == ("midpoint", "another scheme")
    other_way = heun.replace("dt * (k1v + k2v) / 2", "dt / 2 * k1v + dt / 2 * k2v")
    assert judge(find("2"), other_way).name == "right"


#: What students return in place of numbers or arrays, by the name of what is told; `good` is the right value.
ODD = {
    "f'{good}'": "not_numbers",
    "{'a': good}": "returns_a_dict",
    "None": "returns_nothing",
    "[good, None]": "returns_nothing",
    "np.asarray(good) + 1j": "not_numbers",
    "np.asarray(good) * float('nan')": "not_a_number",
    "[[1.0, 2.0], [3.0]]": "ragged",
    "print": "not_numbers",
    "b'12'": "not_numbers",
    "object()": "not_numbers",
    "[good, good]": "wrong_shape",
}

#: What is right, and unusual.
RIGHT = (
    "np.asarray(good) + 0j",
    "np.asarray(good).tolist()",
    "np.array(good, dtype=object)",
    "np.vectorize(decimal.Decimal, otypes=[object])(good)",
    "np.ma.masked_array(good)",
)


@pytest.mark.parametrize("number", [1, 3, 5, 6, 7, 10])
def test_whatever_is_returned_is_told_in_a_sentence(number: int) -> None:
    """Text, dicts, None, complex and ragged arrays: each by its name; fractions and the like are numbers."""
    exercise = find(str(number))
    function, parts = next((q.function, q.parts) for q in catalogue_of(exercise, "example", None).questions)
    text = "import decimal\nimport numpy as np\n" + solution("loops", number)
    for odd, name in (*ODD.items(), *((right, "right") for right in RIGHT)):
        first = f"({odd}, *answer[1:])" if len(parts) > 1 else odd
        good = "answer[0]" if len(parts) > 1 else "answer"
        body = "\n    ".join(("answer = _own(*given)", f"good = {good}", f"return {first}\n"))
        wrapped = f"{text}\n_own = {function}\ndef {function}(*given):\n    {body}"
        verdict = judge(exercise, wrapped, "example")
        assert name in verdict.name, (number, odd, verdict.name)
        assert all(f.words.endswith(".") for f in verdict.findings)
