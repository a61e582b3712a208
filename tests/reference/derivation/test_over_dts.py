"""A name holds at the dt where it was found: a step that changes its rule with dt is told so, with where it does."""

from __future__ import annotations

from typing import Any

import pytest

from engines.own.stepper import stepper_of
from reference.derivation.explanation import DT, Explanation, explain
from reference.derivation.over_dts import DTS, SHORT, UNNAMED
from report.derived import name_line


def told(rule: Any) -> Explanation:
    """Of Heun where the rule says so at a dt, else Euler."""

    def step(f, y, t, dt):  # type: ignore[no-untyped-def]
        k = f(t, y)
        return y + dt / 2 * (k + f(t + dt, y + dt * k)) if rule(dt) else y + dt * k

    return explain(stepper_of(step))


@pytest.mark.parametrize(
    ("smallest", "largest", "other"),
    [(1e-3, 1.0, DTS[:3]), (0.0, 1e-2, DTS[3:]), (1e-5, 1e-2, (DTS[0], DTS[3])), (0.0, 1.0, ())],
)
def test_other_rules_at_other_dt_are_told(smallest: float, largest: float, other: tuple[float, ...]) -> None:
    """Heun between two dt, Euler beside: at which dt of those tried, and as what, where it can be identified there."""
    found = told(lambda dt: smallest <= dt <= largest)
    assert smallest <= DT <= largest
    assert found.identification.identified_as == "heun"
    assert found.held is not None
    assert found.held.other == other
    assert set(found.held.same) == set(DTS) - set(other)
    assert ("not at every dt" in name_line(found)) == bool(other)
    assert (str(found.held) in found.reason) == bool(other)
    unnamed = [dt for dt, name in zip(found.held.other, found.held.named_there, strict=True) if name is None]
    assert str(found.held).count(UNNAMED) == sum(dt < SHORT for dt in unnamed)
    if 2e-4 in other:
        assert found.held.named_there[other.index(2e-4)] == "euler"
