"""Divergence: engines' distances from the true motion are not their distances from their schemes."""

from __future__ import annotations

import pytest

from tests.experiments.canned import divergence
from tests.experiments.canned.divergence import DEVIATION, ERRORS
from tests.experiments.canned.reading import finding, numbers, records


def test_the_table_has_both_distances_in_their_columns() -> None:
    """The largest of all times; a stranger's nearest scheme is no identification; a crash has neither, but a reason."""
    known, stranger, crashed = records(divergence.usual())
    assert (known["stepper"], known["kind"], known["outcome"]) == ("KickDrift", "engine", "done")
    assert (known["error [m]"], known["identified as"]) == (ERRORS["kick_drift"], "kick_drift")
    assert known["deviation [m]"] == DEVIATION
    assert (stranger["error [m]"], stranger["identified as"], stranger["deviation [m]"]) == (ERRORS[None], None, 1e-6)
    assert (crashed["outcome"], crashed["error [m]"], crashed["deviation [m]"]) == ("crashed", None, None)
    assert crashed["reason"].startswith("killed by SIGSEGV")
    assert stranger["reason"] == "not identified; nearest kick_drift at 1e-06 m"


def test_the_table_over_time_has_both_at_every_time() -> None:
    """From none at the start; none at all for who left nothing."""
    rows = records(divergence.usual(), "divergence_over_time")
    own = [row for row in rows if row["stepper"] == "KickDrift"]
    assert [row["time [s]"] for row in own] == pytest.approx([1e-3 * i for i in range(21)])
    assert (own[10]["error [m]"], own[-1]["error [m]"]) == pytest.approx(
        (0.5 * ERRORS["kick_drift"], ERRORS["kick_drift"])
    )
    assert own[-1]["deviation [m]"] == pytest.approx(DEVIATION, abs=0.0)
    assert {(row["error [m]"], row["deviation [m]"]) for row in rows if row["stepper"] == "Segfaults"} == {(None, None)}


def test_the_first_sentence_counts_and_has_the_worst_of_both() -> None:
    """Of springs: engines with distance constraints go farther from the string, and are another system's."""
    first = finding(divergence.full(), "are identified")
    assert numbers(first) == pytest.approx([15, 16, DEVIATION, ERRORS["euler"]], abs=0.0)
    assert "exudyn_springs_euler is up to" in first
    assert finding(divergence.full(), "Not identified").endswith(": stranger (nearest kick_drift at 1e-06 m).")


def test_the_worst_of_identified_engines_is_said() -> None:
    """In both sentences, whoever it is."""
    noisy = divergence.of(divergence.ran("a", "rk4"), divergence.ran("b", "kick_drift", 1e-9, deviation=3e-13))
    assert numbers(finding(noisy, "are identified")) == pytest.approx([2, 2, 3e-13, ERRORS["rk4"]])
    assert numbers(finding(noisy, "rounding")) == pytest.approx([3e-13])
    assert "a is up to" in finding(noisy, "are identified")


def test_where_all_have_constraints_the_farthest_of_them_is_said() -> None:
    """There are no others."""
    constrained = [divergence.ran("cable", "pendulum_rk4"), divergence.ran("rope", "rope_kick_drift")]
    assert "cable is up to 2.4e-01 m" in finding(divergence.of(*constrained), "are identified")


def test_why_euler_looks_as_good_is_said_where_both_ran() -> None:
    """With both distances, Euler's first; nothing without an engine of each, or where they are apart."""
    assert numbers(finding(divergence.full(), "first order")) == [0.02, ERRORS["euler"], ERRORS["kick_drift"]]
    alone = divergence.of(divergence.ran("a", "kick_drift"), divergence.ran("b", "rk4"))
    apart = divergence.of(divergence.ran("a", "kick_drift"), divergence.ran("b", "euler", 1.0))
    assert not [sentence for sentence in (*alone.findings, *apart.findings) if "first order" in sentence]


def test_failures_have_their_reasons() -> None:
    """One for who did not come to its end."""
    (failure,) = divergence.usual().failures
    assert failure.startswith("Segfaults: crashed, killed by SIGSEGV")
