"""The stiff limit: distances fall with stiffness, from the first to the last, by the power that is fitted."""

from __future__ import annotations

import pytest

from tests.experiments.canned import stiff_limit
from tests.experiments.canned.reading import finding, numbers, records
from tests.experiments.canned.stiff_limit import STIFFNESSES


def test_the_table_has_each_distance_in_its_column() -> None:
    """100/k from the pendulum, 80/k from the cable."""
    for row, k in zip(records(stiff_limit.usual()), STIFFNESSES, strict=True):
        assert row["stiffness [N/m]"] == k
        assert row["string to pendulum [m]"] == pytest.approx(100 / k)
        assert row["string to MuJoCo cable [m]"] == pytest.approx(80 / k)


@pytest.mark.parametrize("power", [-1.0, -0.5])
def test_the_sentence_has_both_ends_and_the_fitted_power(power: float) -> None:
    """Beside the predicted one."""
    said = numbers(finding(stiff_limit.usual(power=power), "to the power"))
    ends = [100 * k**power for k in (STIFFNESSES[0], STIFFNESSES[-1])]
    assert said == pytest.approx([STIFFNESSES[0], STIFFNESSES[-1], *ends, STIFFNESSES[2], power, -1], rel=0.05)


def test_the_cable_is_as_far_from_the_pendulum_as_was_measured() -> None:
    """And without it there is a failure, and no word."""
    assert numbers(finding(stiff_limit.usual(), "cable"))[0] == pytest.approx(3e-9)
    without = stiff_limit.usual(None)
    assert not [said for said in without.findings if "cable" in said]
    assert len(without.failures) == 1
