"""What a task answered comes back bit for bit, or is refused: never as something else."""

from __future__ import annotations

import io
import json
import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from experiments.runs.result_codec import ARRAY, LIMIT, NUMBER, OUTCOME, decode, encode
from reference.limit import Limit
from reference.outcome import Outcome
from reference.state import Trajectory
from tests.experiments.runs.tasks import alike, ended
from tests.reference.systems import property_test

#: NaN and infinities are numbers too.
numbers = st.none() | st.booleans() | st.integers() | st.floats() | st.text()

names = st.text("abxyz_<>. ARRAYnpy0", min_size=1, max_size=5).filter(str.isidentifier)

arrays = hnp.arrays(
    st.sampled_from(["f8", "f4", ">f8", "i8", "u1", "?", "c16"]), hnp.array_shapes(min_dims=0, min_side=0)
)


@st.composite
def outcomes(draw: st.DrawFn) -> Outcome:
    """Ended in any way, with a trajectory or without one."""
    ending = draw(st.sampled_from(["done", "diverged", "crashed", "timed out", "unsupported"]))
    shape = draw(hnp.array_shapes(min_dims=3, max_dims=3, min_side=0))
    motion = st.builds(Trajectory, hnp.arrays(float, shape[:1]), hnp.arrays(float, shape), hnp.arrays(float, shape))
    return Outcome(ending, draw(st.text()), draw(st.none() | motion))


answers = st.recursive(
    numbers | arrays | outcomes(),
    lambda inner: st.lists(inner, max_size=3) | st.tuples(inner) | st.dictionaries(names, inner, max_size=3),
)


def there_and_back(answer: Any) -> Any:
    """As the store does it: JSON as text, as any program can read it, and arrays in a file."""
    document, found = encode(answer)
    file = io.BytesIO()
    np.savez(file, **found)  # type: ignore[arg-type]
    file.seek(0)
    with np.load(file) as opened:
        return decode(json.loads(json.dumps(document, allow_nan=False)), dict(opened))


@pytest.mark.rotating(3)
@property_test
@given(answers)
def test_an_answer_comes_back_bit_for_bit(answer: Any) -> None:
    """Every number, every sign of zero, every NaN within an array; a tuple as a list."""
    assert alike(there_and_back(answer), answer)


def test_a_change_of_the_last_bit_is_noticed() -> None:
    """Shown to fail: the comparison above tells answers apart by one bit, by kind, and by order."""
    x = np.array([0.1, np.nan])
    for one, other in [
        (x, np.nextafter(x, 1)),
        (x, x[:1]),
        (x, x.astype("f4")),
        (np.zeros(1), -np.zeros(1)),
        (0.1, math.nextafter(0.1, 1)),
        (0.0, -0.0),
        (1, 1.0),
        ([1], [1, 1]),
        ({"a": 1, "b": 2}, {"b": 2, "a": 1}),
        (ended("done"), ended("done", frames=3)),
        (Outcome("crashed", "a"), Outcome("crashed", "b")),
        (Outcome("crashed"), None),
    ]:
        assert not alike(one, other)
        assert alike(one, one)


@pytest.mark.parametrize("ending", ["done", "diverged", "crashed", "timed out", "unsupported"])
def test_an_outcome_comes_back_with_all_it_had(ending: Any) -> None:
    """On its own, and within a mapping or a list."""
    outcome = ended(ending, "for a reason")
    assert (outcome.trajectory is not None) == (ending in ("done", "diverged"))
    for answer in (outcome, {"outcome": outcome, "error_m": math.inf}, [outcome, outcome]):
        assert alike(there_and_back(answer), answer)


@pytest.mark.parametrize(
    "limit",
    [
        Limit(0.1 + 0.2, factors=(0.999, 1.001), grows_beyond=True),
        Limit(None, "unstable at any dt", growth=math.inf),
        Limit(1e-3, grows_beyond=False),
    ],
)
def test_a_limit_comes_back_with_all_it_had(limit: Limit) -> None:
    """Every field by value, its tuples as tuples; on its own and within a list. One bit less is another limit."""
    assert there_and_back(limit) == limit
    assert there_and_back([limit, None]) == [limit, None]
    assert there_and_back(Limit(0.3, factors=(0.999, 1.001), grows_beyond=True)) != Limit(
        0.1 + 0.2, factors=(0.999, 1.001), grows_beyond=True
    )


def test_numpys_numbers_come_back_as_pythons() -> None:
    """With the same value."""
    found = there_and_back([np.float64(0.1), np.float32(0.1), np.int64(-3), np.bool_(True), np.float64("inf")])
    assert alike(found, [0.1, float(np.float32(0.1)), -3, True, math.inf])


def test_arrays_in_different_places_have_different_names() -> None:
    """Whatever the mappings they are in are called."""
    _, found = encode({"a": {"b": np.zeros(1), "npy": np.ones(1)}, "a_b": [np.zeros(2), [np.zeros(3)]]})
    assert [*found] == ["answer.a.b", "answer.a.npy", "answer.a_b.0", "answer.a_b.1.0"]


@pytest.mark.parametrize("key", [ARRAY, OUTCOME, LIMIT, NUMBER, "a.b", "", "0", "a b", "a\0b", 1, None, ("a",)])
def test_a_key_that_is_no_name_is_refused(key: Any) -> None:
    """It might be taken for the place of an array or a number, its arrays for another key's, or come back as text."""
    with pytest.raises(TypeError, match=r"an answer with the key .* cannot be kept: expected a name"):
        encode({"inner": [{key: 1.0}]})


REFUSED = [
    object(),
    1j,
    b"bytes",
    {1},
    np.array([object()]),
    np.array(["text"]),
    np.longdouble(1),
    np.datetime64("2026"),
]


@pytest.mark.parametrize("value", REFUSED, ids=lambda value: type(value).__name__)
def test_what_cannot_be_kept_is_refused(value: Any) -> None:
    """Before anything is written: an array of objects would be a pickle, which is not read again."""
    with pytest.raises(TypeError, match="cannot be kept"):
        encode([value])
