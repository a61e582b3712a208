"""The first screen's three sentences: made of the numbers, and of what is not there."""

from __future__ import annotations

import pytest

from experiments.experiment import Result, Table, find
from report.page.overview import explained, length, sentences
from report.page.section import Section
from tests.report.page.canned import engines_that_run, no_engine_installed

COLUMNS = ["stepper", "kind", "outcome", "error [m]", "identified as", "deviation [m]"]


def divergence(*engines: tuple[str, float, str | None, float]) -> Section:
    """The experiment's section, with these engines in its table."""
    rows = [[name, "engine", "done", error, scheme, deviation] for name, error, scheme, deviation in engines]
    return Section(find("divergence"), Result([""], [Table("divergence", COLUMNS, rows)]))


def stability(*differences: float | None) -> Section:
    """The experiment's section, with these relative differences in its table."""
    rows = [[f"s{i}", value] for i, value in enumerate(differences)]
    return Section(find("stability"), Result([""], [Table("stability", ["stepper", "relative difference"], rows)]))


GOOD = divergence(("a", 4e-3, "kick_drift", 2e-15), ("b", 1e-8, "rk4", 3e-14), ("c", 0.24, "pendulum_rk4", 1e-15))


def test_the_sentences_have_the_numbers() -> None:
    """The worst of each, and schemes of springs apart from those of rods."""
    explanation, limits, differences = sentences([GOOD, stability(1e-6, -4e-4, None)])
    assert explanation.startswith("All 3 engine settings are explained")
    assert "30 fm" in explanation
    assert "2 limits" in limits
    assert "0.04 %" in limits
    assert "2 settings with 2 schemes" in differences
    for words in ("10 nm (rk4)", "4 mm (kick_drift)", "as 1 have, up to 0.24 m"):
        assert words in differences


def test_an_engine_that_is_not_explained_is_named() -> None:
    """And is not counted; where none is, that is said."""
    mixed = divergence(("a", 4e-3, "kick_drift", 2e-15), ("odd", 1e-3, None, 1e-7))
    assert sentences([mixed])[0].startswith("1 of 2 engine settings are explained")
    assert sentences([mixed])[0].endswith("Not explained: odd.")
    assert sentences([divergence(("odd", 1e-3, None, 1e-7))])[0].startswith("None of 1")


def test_what_is_missing_or_failed_is_said() -> None:
    """In each sentence that needs it, with the reason."""
    assert all("is not on this page" in sentence for sentence in sentences([]))
    failed = Section(find("divergence"), failure="timed out: 900 s")
    assert all("(timed out: 900 s)" in sentence for sentence in sentences([failed, stability(0.0)])[::2])
    assert "no limit was both predicted and measured" in sentences([stability(None)])[1]
    only_rods = sentences([divergence(("c", 0.24, "pendulum_rk4", 1e-15))])
    assert "all that ran put rods" in only_rods[2]


def test_the_experiment_s_own_table_is_understood() -> None:
    """Its columns are those the sentences ask for; crashed and missing engines are not among the explained."""
    one, other = explained(Section(find("divergence"), engines_that_run()))
    assert (one.engine, one.scheme) == ("KickDrift", "kick_drift")
    assert other.scheme is None
    assert explained(Section(find("divergence"), no_engine_installed())) == []


@pytest.mark.parametrize(
    ("metres", "words"),
    [(0.2414, "0.24 m"), (4.78e-3, "4.8 mm"), (1e-8, "10 nm"), (2.8e-14, "28 fm"), (3e-17, "3e-17 m")],
)
def test_lengths_are_said_in_units_that_suit_them(metres: float, words: str) -> None:
    """To two figures."""
    assert length(metres) == words
