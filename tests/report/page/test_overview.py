"""The first screen's three sentences: made of the numbers, and of what is not there."""

from __future__ import annotations

import pytest

from experiments.experiment import Result, Table, find
from report.page.overview import explained, length, sentences
from report.page.sections import Section
from tests.experiments.canned import divergence as canned_divergence
from tests.experiments.canned import stability as canned_stability
from tests.experiments.canned.reading import in_order, numbers

COLUMNS = ["stepper", "kind", "outcome", "error [m]", "identified as", "deviation [m]"]


def divergence(*engines: tuple[str, float, str | None, float]) -> Section:
    """The experiment's section, with these engines in its table."""
    rows = [[name, "engine", "done", error, scheme, deviation] for name, error, scheme, deviation in engines]
    return Section(find("divergence"), Result([""], [Table("divergence", COLUMNS, rows)]))


def stability(*differences: float | None) -> Section:
    """The experiment's section, with these relative differences in its table."""
    rows = [[f"s{i}", value] for i, value in enumerate(differences)]
    return Section(find("stability"), Result([""], [Table("stability", ["stepper", "relative difference"], rows)]))


#: In no order: the best is neither first nor last. The cable's are not springs.
GOOD = divergence(
    ("a", 4e-3, "kick_drift", 2e-15),
    ("b", 1e-8, "rk4", 3e-14),
    ("c", 0.24, "pendulum_rk4", 1e-15),
    ("d", 1e-3, "kick_drift", 5e-16),
    ("e", 0.25, "rope_kick_drift", 4e-16),
)


def test_the_first_sentence_has_the_worst_distance_from_a_scheme() -> None:
    """Not the best, and no distance from the true motion."""
    explanation = sentences([GOOD, stability(1e-6)])[0]
    assert numbers(explanation) == [5, 3e-14]
    assert in_order(explanation, "All 5", "to 3.0e-14 m or better")


def test_the_second_sentence_has_the_widest_difference_of_the_limits_that_have_one() -> None:
    """In percent, whatever its sign."""
    assert numbers(sentences([GOOD, stability(1e-6, -4e-4, None)])[1]) == [2, 0.04]


def test_the_third_sentence_goes_from_the_best_to_the_worst_each_with_its_scheme() -> None:
    """Of three settings with two schemes; those with distance constraints apart, by the farthest of them."""
    differences = sentences([GOOD, stability(1e-6)])[2]
    assert numbers(differences) == [3, 2, 10, 4, 2, 0.25]
    assert in_order(differences, "from within 10 nm (rk4)", "to 4 mm (kick_drift)", "as 2 have, up to 0.25 m")


def test_an_engine_that_is_not_explained_is_named() -> None:
    """And is not counted; where none is, that is said. Nor is it the worst of those that are."""
    mixed = divergence(("a", 4e-3, "kick_drift", 2e-15), ("odd", 1e-3, None, 1e-7))
    assert numbers(sentences([mixed])[0]) == [1, 2, 2e-15]
    assert sentences([mixed])[0].endswith("Not explained: odd.")
    assert numbers(sentences([divergence(("odd", 1e-3, None, 1e-7))])[0]) == [1]


def test_what_is_missing_or_failed_is_said() -> None:
    """In each sentence that needs it, with the reason."""
    assert all("is not on this page" in sentence for sentence in sentences([]))
    failed = Section(find("divergence"), failure="timed out: 900 s")
    assert all("(timed out: 900 s)" in sentence for sentence in sentences([failed, stability(0.0)])[::2])
    assert "no limit was both predicted and measured" in sentences([stability(None)])[1]
    only_rods = sentences([divergence(("c", 0.24, "pendulum_rk4", 1e-15))])
    assert "all that ran" in only_rods[-1]


def test_a_page_without_limits_has_no_sentence_about_them() -> None:
    """As the sample is: two sentences, on what is explained and what differs."""
    explanation, differences = sentences([GOOD])
    assert numbers(explanation) == [5, 3e-14]
    assert numbers(differences) == [3, 2, 10, 4, 2, 0.25]


def test_the_experiments_own_tables_are_understood() -> None:
    """Their columns are those the sentences ask for; crashed and missing engines are not among the explained."""
    one, other = explained(Section(find("divergence"), canned_divergence.usual()))
    assert (one.engine, one.scheme) == ("KickDrift", "kick_drift")
    assert (one.error, one.deviation) == (canned_divergence.ERRORS["kick_drift"], canned_divergence.DEVIATION)
    assert other.scheme is None
    assert explained(Section(find("divergence"), canned_divergence.not_installed())) == []
    full = [Section(find("divergence"), canned_divergence.full()), Section(find("stability"), canned_stability.usual())]
    explanation, limits, differences = sentences(full)
    assert numbers(explanation) == [15, 16, 2e-15]
    assert numbers(limits) == [4, 1]
    assert in_order(differences, "12 settings with 5 schemes", "10 nm (rk4) to 5 mm (euler)", "as 3 have, up to 0.25 m")


@pytest.mark.parametrize(
    ("metres", "words"),
    [(0.2414, "0.24 m"), (4.78e-3, "4.8 mm"), (1e-8, "10 nm"), (2.8e-14, "2.8e-14 m"), (3e-17, "3.0e-17 m")],
)
def test_lengths_are_said_in_units_that_suit_them(metres: float, words: str) -> None:
    """To two figures."""
    assert length(metres) == words
