"""A truck that crosses: what joints carry, the influence line by direct stiffness; bridges cambered for their load."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reference.changes import Change, Driven
from reference.errors import InputError
from reference.forces import SpringMotion
from reference.scenes import find as find_scene
from reference.scenes.crossing import Crossing, cambered
from reference.scenes.ground_motion import FrequencySweep, GroundMotion
from reference.scenes.trusses import truss
from reference.schemes.catalogue import find
from reference.simulate import simulate
from reference.state import Array
from reference.system import MassSpringSystem
from reference.theory.modes import squared_frequencies
from tests.reference.scenes.direct_stiffness import deflection
from tests.reference.systems import property_test

#: A stiff, short bridge: it swings fast, so that a slow truck is soon across.
STIFF = {"panels": 4, "axial_stiffness": 2e9, "truck": 500.0}
MIDDLE = 2


class SharesSwapped(Crossing):
    """The joint behind gets what the one ahead should."""

    def loads(self, positions: Array) -> Array:
        """Within each panel the truck goes backwards."""
        panel = self.places[1] - self.places[0]
        back = np.floor(positions / panel) * panel + (panel - positions % panel)
        return super().loads(back)


class NextJointOnly(Crossing):
    """The joint ahead carries all."""

    def loads(self, positions: Array) -> Array:
        """In jumps."""
        panel = self.places[1] - self.places[0]
        return super().loads(np.ceil(positions / panel) * panel)


def driven(settings: dict[str, Any]) -> tuple[MassSpringSystem, Crossing]:
    """The scene's bridge and truck."""
    made = find_scene("crossing").driven(settings)
    (drive,) = made.drives
    assert isinstance(drive, Crossing)
    return made.system, drive


def influence_line(system: MassSpringSystem, drive: Crossing, positions: Array) -> Array:
    """How far the middle sinks under the truck at each position, shape (m,) [m], from K u = M g.

    The truck's weight alone; K of the bridge as it stands; shares by hand: the lever rule.
    """
    panel = drive.places[1] - drive.places[0]
    sunk = []
    for position in positions:
        behind = min(int(position // panel), len(drive.joints) - 2)
        ahead = position / panel - behind
        masses = np.zeros(len(system.masses))
        masses[drive.joints[[behind, behind + 1]]] = drive.truck * (1 - ahead), drive.truck * ahead
        light = replace(system, masses=np.maximum(masses, 1e-12))
        sunk.append(deflection(light)[MIDDLE, 1])
    return np.array(sunk)


def check_influence_line(kind: type[Crossing], truck: float = 500.0) -> None:
    """A truck at a = 0.01 of the speed at which it crosses in half a period sinks the middle as direct stiffness says.

    A load that crosses a beam makes it swing by a of its sag, at most (Fryba, ch. 1: sin(W t) - a sin(w t)); masses
    change each hundredth of a panel, which kinks the line by as much: 2 % of the largest sag in all.
    """
    system, known = driven(STIFF)
    lowest = float(np.sqrt(squared_frequencies(system, system.start)[0]) / (2 * np.pi))
    length = known.places[-1]
    drive = kind(truck, 0.01 * 2 * length * lowest, known.places, known.joints)
    dt, duration = 4e-4, float(length / drive.speed)
    motion = simulate(system, find("velocity_verlet"), dt, duration, drive.changes(system, dt, duration))
    every = slice(None, None, 25)
    sag = motion.positions[every, MIDDLE, 1] - system.positions[MIDDLE, 1]
    expected = influence_line(system, known, np.minimum(drive.position(motion.times[every]), length))
    assert np.abs(sag - expected).max() < 0.02 * np.abs(expected).max()


@pytest.mark.rotating(3, in_turn=True)
def test_a_slow_truck_sinks_the_middle_along_the_influence_line() -> None:
    """All the way."""
    check_influence_line(Crossing)


@pytest.mark.rotating(3, in_turn=True)
@pytest.mark.parametrize("wrong", [SharesSwapped, NextJointOnly])
def test_the_influence_line_fails_on(wrong: type[Crossing]) -> None:
    """A truck that is where it is not."""
    with pytest.raises(AssertionError):
        check_influence_line(wrong)


def test_the_influence_line_fails_on_another_truck() -> None:
    """A twentieth heavier."""
    with pytest.raises(AssertionError):
        check_influence_line(Crossing, truck=525.0)


@property_test
@given(part=st.floats(0.0, 1.0), panels=st.integers(2, 12))
def test_joints_carry_of_a_truck_under_way_what_they_carry_of_one_that_stands(part: float, panels: int) -> None:
    """As `Truss.masses` has it."""
    _, drive = driven({"panels": panels})
    position = part * drive.places[-1]
    built = truss("warren", panels, 3.0, 3.0)
    standing = built.masses(0.0, 0.0, 5000.0, position)[: panels + 1]
    assert drive.loads(np.array([position]))[0] == pytest.approx(standing, abs=1e-9)


def test_masses_change_when_the_truck_has_gone_on_and_are_the_bridges_own_once_it_is_gone() -> None:
    """10 m/s over 12 m: a hundredth of a panel takes 3 ms. After 1.2 s nothing changes any more."""
    system, drive = driven({"panels": 4, "speed": 10.0})
    changes = drive.changes(system, 1e-3, 2.0)
    times = [change.time for change in changes]
    assert times == pytest.approx(3e-3 * np.arange(401))
    for change in changes[:-1]:
        assert np.sum(change.value) == pytest.approx(system.masses.sum() + 5000.0)
    assert changes[-1].value == tuple(system.masses.tolist())
    halfway = changes[100]
    assert np.array(halfway.value)[1] - system.masses[1] == pytest.approx(5000 * (1 - 0.015 / 3))


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"speed": 0.0}, "speed = 0: expected a finite number > 0 [m/s]"),
        ({"truck": -1.0}, "truck = -1: expected a finite number >= 0 [kg]"),
        ({"panels": 101}, "panels = 101: expected a whole number from 1 to 100"),
    ],
)
def test_a_crossing_that_makes_no_sense_is_refused(settings: dict[str, Any], message: str) -> None:
    """In one line."""
    with pytest.raises(InputError) as refused:
        find_scene("crossing").system(settings)
    assert str(refused.value) == message


# --- Camber ---


def check_at_rest(system: MassSpringSystem) -> None:
    """Forces at the start balance to 1e-10 of the weights: eps times the condition of K, some 1e5."""
    forces = SpringMotion(system).acceleration(system.start) * system.masses[:, None]
    assert np.abs(forces).max() < 1e-10 * system.masses.max() * 9.81


@pytest.mark.parametrize("kind", ["warren", "pratt", "howe"])
@pytest.mark.parametrize("scene", ["bridge", "soil"])
def test_a_cambered_bridge_stands_at_rest(scene: str, kind: str) -> None:
    """Where it was; and not without camber."""
    plain = find_scene(scene).system({"kind": kind})
    bridge = cambered(plain)
    check_at_rest(bridge)
    assert bridge.positions.tolist() == plain.positions.tolist()
    with pytest.raises(AssertionError):
        check_at_rest(plain)


def test_what_cannot_carry_its_weight_is_not_cambered() -> None:
    """A string let go horizontally."""
    with pytest.raises(InputError, match="cannot carry the weight where they are"):
        cambered(find_scene("string").system({}))


# --- Scenes that something drives ---


@pytest.mark.parametrize("name", ["crossing", "earthquake"])
def test_a_driven_scenes_changes_suit_the_step_and_the_duration(name: str) -> None:
    """Whatever they are."""
    for dt, duration in ((1e-3, 0.1), (5e-3, 0.3)):
        setup = find_scene(name).setup({}, dt, duration)
        setup.check()
        assert (setup.dt, setup.duration) == (dt, duration)
        assert 0 < len(setup.changes) <= round(duration / dt)
        assert max(change.time for change in setup.changes) < duration


def test_too_many_steps_for_a_drive_are_refused() -> None:
    """At once."""
    with pytest.raises(
        InputError, match=r"expected at most 100,000 steps of dt = 1e-06 s where the ground or the load"
    ):
        find_scene("earthquake").setup({}, 1e-6, 1.0)


def test_one_parameter_is_driven_once() -> None:
    """Else the one would undo what the other does."""
    shaking = GroundMotion(FrequencySweep(1.0, 2.0, 1.0, 1.0))
    with pytest.raises(InputError, match=r"^gravity is driven 2 times: expected once$"):
        Driven(find_scene("string").system({}), (shaking, shaking))


def test_a_change_keeps_many_numbers_as_a_tuple() -> None:
    """So that it is one thing to compare and to hash."""
    assert Change(0.1, "gravity", np.array([1.0, -9.0])) == Change(0.1, "gravity", (1.0, -9.0))  # type: ignore[arg-type]
    assert hash(Change(0.1, "gravity", [1.0, -9.0])) == hash(Change(0.1, "gravity", (1.0, -9.0)))
