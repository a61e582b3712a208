"""What has happened since the last thing that no command can say."""

from __future__ import annotations

from reference.scenes import find
from report.live.segment import Segment

SYSTEM = find("spring").system({})


def test_of_a_parameter_the_last_change_at_a_step_counts() -> None:
    """Those at earlier steps stay, and those of other parameters; large values are no steps."""
    segment = Segment("spring", {}, SYSTEM, ("heun",), (SYSTEM.start,), 1e-3).with_change("stiffness", 500.0)
    segment = segment.after(2).after(3).with_change("mass", 3.0).with_change("drag", 0.25)
    segment = segment.with_change("mass", 5.0).with_change("stiffness", 300.0)
    assert segment.changes == ((0, "stiffness", 500.0), (5, "drag", 0.25), (5, "mass", 5.0), (5, "stiffness", 300.0))
    assert segment.steps == 5
    again = segment.after(1).with_change("mass", 7.0)
    assert again.changes == (*segment.changes, (6, "mass", 7.0))


def test_it_is_at_the_start_where_that_has_a_name_and_nothing_has_moved() -> None:
    """A change does not move anything."""
    segment = Segment("spring", {}, SYSTEM, ("heun",), (SYSTEM.start,), 1e-3)
    assert segment.at_start
    assert segment.with_change("mass", 3.0).at_start
    assert not segment.after(1).at_start
    assert not Segment("spring", None, SYSTEM, ("heun",), (SYSTEM.start,), 1e-3).at_start
