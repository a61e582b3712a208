"""What systems ask of engines: each case just what it is named after, and a change on the fly what is new."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from engines.capability_cases import for_each_capability, swinging
from engines.engine import CAPABILITIES, LAWS, _differ, asked_by, changed, demands, refuse_beyond
from reference.errors import Unsupported
from reference.lengths import lengths_and_rates
from reference.scenes import find as find_scene

CASES = for_each_capability()

#: What a case asks for beside the plane and what it is named after.
BESIDES = {
    "dampings": {"damping"},
    "no fixed mass": {"mesh"},
    "no rest length": {"stretched"},
    "restitution": {"collisions"},
    **{law: {"velocities"} for law in LAWS},
}


@pytest.mark.parametrize("name", CAPABILITIES)
def test_a_case_asks_for_what_it_is_named_after(name: str) -> None:
    """And for no more than it has to: along a line and in space there is no plane."""
    plane = set() if name in ("1d", "3d", "sphere", "cylinder") else {"2d"}
    space = {"3d"} if name in ("sphere", "cylinder") else set()
    assert set(demands(CASES[name])) == {name} | plane | space | BESIDES.get(name, set())


def test_what_stays_on_a_vertical_line_asks_for_no_plane() -> None:
    """And equal numbers, to rounding, are no different ones; of fixed masses nobody asks."""
    assert demands(find_scene("string").system({"angle": 90})) == []
    string = find_scene("string").system({"masses": 3})
    heavy = replace(string, masses=np.where(string.fixed, 7.0, string.masses))
    assert demands(heavy) == ["2d"]
    one, third = 0.1 + 0.2, 0.3
    assert one != third
    assert not _differ(np.array([one, third, third]))
    assert _differ(np.array([third, third * (1 + 1e-14), third]))
    assert not _differ(np.zeros(0))
    assert not _differ(np.zeros(3))


def test_swinging_stretches_no_spring() -> None:
    """Each link turns at its rate about the mass before it."""
    system = CASES["velocities"]
    _, rates = lengths_and_rates(system.positions, system.velocities, system.springs, np.ones(5, dtype=bool))
    assert np.abs(rates).max() < 1e-15
    velocities = swinging(np.array([0.0, np.pi / 2]), [2.0, 3.0], [5.0, -1.0])
    assert velocities == pytest.approx(np.array([[0.0, 10.0], [3.0, 10.0]]), abs=1e-14)


def engine(*capabilities: str) -> Any:
    """One with these."""
    return SimpleNamespace(name="mine", capabilities=frozenset(capabilities))


def test_what_is_beyond_an_engine_is_refused_by_name() -> None:
    """The first demand that it cannot do."""
    refuse_beyond(engine("2d", "damping"), CASES["damping"])
    with pytest.raises(Unsupported, match="mine cannot do"):
        refuse_beyond(engine("2d"), CASES["damping"])


def test_a_change_asks_for_what_the_system_did_not() -> None:
    """Damping where there was none; but not where there was some already; a spring that breaks always asks."""
    plain, damped = CASES["2d"], CASES["damping"]
    assert changed(engine(), damped, "damping", 0.3).damping[0] == 0.3
    assert changed(engine("damping"), plain, "damping", 0.3).damping[0] == 0.3
    assert changed(engine(), plain, "damping", 0.0) is not plain
    for parameter, value in (("damping", 0.3), ("drag", 0.1), ("gravity", (1.0, -9.81)), ("break", (2.0,))):
        with pytest.raises(Unsupported, match=f"mine cannot do .*, asked for by a change of {parameter}"):
            changed(engine(), plain, parameter, value)
    with pytest.raises(Unsupported, match=r"asked for by a change of pull\.2\.x"):
        changed(engine(), plain, "pull.2.x", 1.0)
    assert changed(engine("breaking"), plain, "break", (2.0,)).broken.tolist().count(True) == 1
    assert asked_by("pull.2.x") == ("pulls",)
