"""Speed: our time over tuned C's, the worst on one thread, memory for each mass."""

from __future__ import annotations

from dataclasses import replace

import pytest

from experiments.benchmark.meshes import LARGE
from experiments.speed import result_of
from tests.experiments.canned import speed
from tests.experiments.canned.reading import finding, in_order, numbers, records
from tests.experiments.canned.speed import MESHES, TUNED


def test_the_table_has_each_number_in_its_column() -> None:
    """The ratio is of times: over one is slower than C."""
    table = {(row["what"], row["threads"]): row for row in records(speed.usual())}
    for name, (masses, springs, ratio, arrays, peak) in MESHES.items():
        row = table[name, 1]
        assert (row["masses"], row["springs"]) == (masses, springs)
        assert (row["node-steps/s"], row["tuned C, node-steps/s"]) == (pytest.approx(TUNED / ratio), TUNED)
        assert row["time / tuned C"] == pytest.approx(ratio)
        assert table[name, 2]["time / tuned C"] == pytest.approx(ratio / 2)
        assert (row["bytes/mass"], row["peak bytes/mass"]) == (arrays, peak)
        assert row["bytes moved/mass and step"] == 3 * arrays
        assert row["bound by memory, node-steps/s"] == pytest.approx(4 * TUNED / ratio)
        assert row["time / bound by memory"] == pytest.approx(4)


def test_the_table_of_adapters_is_there() -> None:
    """With the reason of who could not be timed."""
    rows = records(speed.usual(), "adapters")
    assert (rows[1]["engine"], rows[1]["masses"], rows[1]["ratio"]) == ("pymunk_springs", 100, 1.2)
    assert rows[1]["step [s]"] > rows[1]["engine's own step [s]"]
    assert rows[-1]["reason"] == "exudyn is not installed"


def test_the_first_sentence_has_the_worst_mesh_on_one_thread() -> None:
    """Not NumPy's, which has no kernel."""
    said = finding(speed.usual(), "one thread of ours")
    assert numbers(said)[-2:] != []
    assert in_order(said, "at most 1.25 times", "cloth 300 x 300")


def test_memory_is_the_most_of_large_systems() -> None:
    """Of the arrays, then of the process."""
    said = finding(speed.usual(), "bytes a mass")
    assert numbers(said)[:2] == [80, 160]
    assert "jello 50^3" in said


def test_the_largest_mesh_is_named_with_its_bound() -> None:
    """Its ratio, how far it is from the bound, and the bytes for each mass that this is of."""
    said = finding(speed.usual(), "On the largest mesh")
    assert in_order(said, "jello 50^3", "1.10 times the time of tuned C", "4.0 times what a copy of the 240 bytes")


def test_the_sweep_is_as_many_times_as_fast() -> None:
    """Four times on one thread, eight on two."""
    sweeps = [numbers(said) for said in speed.usual().findings if said.startswith("The sweep")]
    assert sweeps == [pytest.approx([4, 1]), pytest.approx([8, 2])]


def test_the_adapter_that_adds_most_is_named() -> None:
    """On 100 masses: a fifth, not the four times on ten."""
    said = finding(speed.usual(), "an adapter adds at most")
    assert (numbers(said), "pymunk_springs" in said) == (pytest.approx([100, 20]), True)


def test_without_a_compiler_there_are_no_ratios() -> None:
    """And that is said; nobody is the worst."""
    assert "no C compiler" in speed.no_compiler().findings[0]
    assert records(speed.no_compiler())[0]["time / tuned C"] is None


def test_the_largest_mesh_is_the_one_with_most_springs_that_has_a_bound() -> None:
    """Of two large ones; another has more, and no bound; one that is not large has none to be told."""
    small, *_, large = (row for row in speed.timings() if row.threads == 1 and row.bound is not None)
    assert small.masses < LARGE <= large.masses
    fewer, unbounded = replace(large, what="fewer", springs=10), replace(large, springs=10**7, bound=None)
    for rows in ([large, fewer, unbounded], [fewer, unbounded, large]):
        assert in_order(finding(result_of(rows, []), "On the largest mesh"), "jello 50^3")
    for rows in ([small], [unbounded], [small, unbounded]):
        assert not [said for said in result_of(rows, []).findings if "On the largest mesh" in said]
