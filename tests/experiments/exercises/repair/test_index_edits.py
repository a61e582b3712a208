"""What is tried in place of a part of an array: all of it, by the index that is there."""

from __future__ import annotations

import pytest

from experiments.exercises.repair.index_edits import of_subscript
from tests.experiments.exercises.repair.tried import tried


@pytest.mark.parametrize(
    ("part", "index", "condition"),
    [
        ("x[3]", {"x[0]", "x[1]", "x[-1]", "x[4]", "x[2]", "x[i]"}, set()),
        ("x[1]", {"x[0]", "x[-1]", "x[2]", "x[i]"}, set()),
        ("x[0]", {"x[:, None]", "x[1]", "x[-1]", "x[i]"}, set()),
        ("x[-1]", set(), set()),
        ("x[j]", {"x[j - 1]", "x[j + 1]"}, set()),
        ("x[j + 1]", {"x[j]", "x[j - 1]"}, set()),
        ("x[j - 1]", {"x[j]", "x[j + 1]"}, {f"x[j - 1] if j > 0 else {end}" for end in ("0 * x[j - 1]", "s.mass")}),
        ("x[3 - j]", {"x[3]", "x[3 + j]"}, set()),
        ("x[3 * j]", {"x[3 * j - 1]", "x[3 * j + 1]"}, set()),
        ("x[1:]", {"x[:-1]", "x[:]", "x[1:-1]", "x[2:]", "x[:-2]", "x[::-1]"}, set()),
        (
            "x[j, 1]",
            {"x[j - 1, 1]", "x[j + 1, 1]", "x[j, 0]", "x[j, -1]", "x[j, 2]", "x[j, i]", "x[1, j]"},
            set(),
        ),
        ("x[j, k, -1]", {"x[j - 1, k, -1]", "x[j + 1, k, -1]", "x[j, k - 1, -1]", "x[j, k + 1, -1]"}, set()),
    ],
)
def test_another_index_is_tried_and_the_whole_array(part: str, index: set[str], condition: set[str]) -> None:
    """Where it is read: also a field in its place, and a copy where it is kept. Where it is written into, an index."""
    read = {"index": {*index, "x"}, "name": {"s.mass"}, **({"condition": condition} if condition else {})}
    assert tried(of_subscript, f"return {part}", part) == read
    assert tried(of_subscript, f"a = {part}", part) == {**read, "copy": {f"{part}.copy()"}}
    assert tried(of_subscript, f"{part} = a", part) == ({"index": index} if index else {})
