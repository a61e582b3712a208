"""A name holds at the dt where it was found: a step that changes its rule with dt is told so, with where it does."""

from __future__ import annotations

from typing import Any

import pytest

from engines.own.stepper import stepper_of
from reference.derivation.explanation import DT, Explanation, explain
from reference.derivation.oscillators import runs_of
from reference.derivation.over_dts import DTS, SHORT, UNNAMED, OverDts, over_dts
from reference.scenes import find
from reference.stepper import stepper_named
from report.derived import name_line, sections


def told(rule: Any) -> Explanation:
    """Of Heun where the rule says so at a dt, else Euler."""

    def step(f, y, t, dt):  # type: ignore[no-untyped-def]
        k = f(t, y)
        return y + dt / 2 * (k + f(t + dt, y + dt * k)) if rule(dt) else y + dt * k

    return explain(stepper_of(step))


@pytest.mark.rotating(5)
@pytest.mark.parametrize(
    ("smallest", "largest", "other"),
    [
        (1e-3, 1.0, DTS[:3]),
        (0.0, 1e-2, DTS[3:]),
        (1e-5, 1e-2, (DTS[0], *DTS[3:])),
        (0.0, 0.05, DTS[4:]),
        (0.0, 1.0, ()),
    ],
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
    assert (found.limits == (None, None)) == bool(other)
    assert any(", at dt = " in title for title, _ in sections(found)) == bool(other)
    if other[-1:] == DTS[4:]:
        assert "0.0625 s (there euler)" in name_line(found)
    if 2e-4 in other:
        assert found.held.named_there[other.index(2e-4)] == "euler"


def test_a_step_that_is_off_and_still_named_is_no_other_rule() -> None:
    """Of what iterates with differences rounding grows as h gets smaller: told by how much, without a cause."""
    held = OverDts("newmark", (2e-4,), (2e-5,), ("newmark",), (3e-12,), (2e-6,), iterates=True)
    assert str(held) == (
        "it is newmark at the dt that named it and at 0.0002 s; at 2e-05 s it is so, too, but a step is off by 3e-12, "
        "more than rounding of one step; not told at 2e-06 s, where rounding drowns it"
    )
    assert held.changed == ()
    assert not held.is_another


def test_every_dt_that_was_tried_is_told_of() -> None:
    """RK4 is not told from others in the shortest step: rounding is larger than what they differ by."""
    runs = runs_of(stepper_named("rk4"))
    held = over_dts(runs, "rk4", find("string").system({"masses": 4, "angle": 0.5}), "double", lambda on, dt: None)
    assert held.drowned[0] == DTS[0]
    assert sorted((*held.same, *held.other, *held.drowned, *held.failed)) == sorted(DTS)
    assert "; not told at 2e-06 s, where rounding drowns it" in str(held)
