"""Axes are in SI units without prefixes, but where all of a kind are in another that suits what is shown."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

from tests.experiments.canned.results import RESULTS
from tests.report.figures.shown import shown
from tests.units import others

#: Sags of a bridge and lengths of a cloth in millimetres, the wait for a million runs in hours.
OTHERS: Mapping[str, tuple[str, ...]] = {
    "drape": ("mm",),
    "ground_motion": ("mm",),
    "million_runs": ("h",),
    "errata": ("m/s of 1 m/s",),
}


def labels(name: str) -> set[str]:
    """Of all axes, in all cases."""
    panels = [axes for case in RESULTS[name] for axes in shown(name, case).figure.get_axes()]
    return {label for axes in panels for label in (axes.get_xlabel(), axes.get_ylabel())}


@pytest.mark.parametrize("name", RESULTS)
def test_axes_are_in_si_units(name: str) -> None:
    """Or in the other that is allowed; which there is, then."""
    found = labels(name)
    assert others(found, *OTHERS.get(name, ())) == set()
    assert len(others(found)) > 0 or name not in OTHERS


def test_lengths_in_millimetres_are_those_of_small_things() -> None:
    """A cloth's, and how far a bridge gives way; where its truck stands is in metres."""
    assert {label for label in labels("drape") if "[mm]" in label} == {"x [mm]", "z [mm]", "bending length [mm]"}
    assert {label.partition(" [m]")[0] for label in labels("ground_motion") if "[m]" in label} == {
        "position of the truck"
    }
