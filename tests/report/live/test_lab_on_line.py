"""The live lab along a line: what can be done in the plane can be done there, and it is drawn upwards."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from reference.obstacles import Plane
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.simulate import simulate
from report.live.lab import Lab
from report.live.stage import _places
from tests.report.live.commands import ends
from tests.report.live.labs import ROUNDING, apart, go_on, move_at_random, open_lab


def test_sliders_do_what_a_plain_run_does(labs: list[Lab]) -> None:
    """To the last bit, gravity among them; in an engine to rounding of what its scheme does."""
    lab = open_lab(labs, "chain", ["kick_drift", "mujoco_tendons"])
    made = move_at_random(lab, 1)
    steps, dt = lab.timeline.segment.steps, lab.timeline.dt
    right = simulate(find_scene("chain").system({}), find("kick_drift"), dt, steps * dt, made).states()[-1]
    scheme, engine = lab.timeline.lanes
    assert apart(scheme.state, right) == 0
    assert apart(engine.state, right) <= ROUNDING
    assert scheme.state.positions.shape == (11, 1)


def test_a_mass_hangs_on_the_cursor_and_the_command_comes_to_the_same(labs: list[Lab], tmp_path: Path) -> None:
    """Above it by the spring's rest length; let go and another pinned, it moves on as the command says."""
    lab = open_lab(labs, "chain", ["heun", "pymunk_springs"])
    lab.advance(50)
    lab.grab(5, np.array([-0.3]))
    assert lab.timeline.lanes[0].state.positions[-1, 0] > -0.3
    lab.advance(50)
    lab.release()
    lab.toggle_pin(3)
    lab.set_parameter("gravity", 1.62)
    lab.advance(100)
    last = ends(lab.reproduction(), tmp_path)
    for lane, name in zip(lab.timeline.lanes, ("heun", "pymunk_springs"), strict=True):
        assert lane.notice == ""
        assert apart(lane.state, last[name]) <= ROUNDING


def test_what_is_in_the_way_is_a_floor(labs: list[Lab]) -> None:
    """Below the lowest mass by a fifth of the size; and nothing falls through it."""
    lab = open_lab(labs, "oscillator", ["heun"])
    lab.open("oscillator", {"velocity": "-5"}, barrier=True)
    size = lab.timeline.system.size
    (floor,) = lab.timeline.system.obstacles
    assert floor == Plane((-0.135 - 0.2 * size,), (1.0,))
    go_on(lab, 40)
    lowest = min(lane.state.positions.min() for lane in lab.timeline.lanes)
    assert lowest >= floor.point[0] - 1e-15


def test_masses_are_drawn_upwards() -> None:
    """At (0, y, 0), in single precision."""
    system = find_scene("chain").system({})
    places = _places(system, system.start)
    assert places.dtype == np.float32
    assert np.array_equal(places, np.pad(system.positions, ((0, 0), (1, 1))).astype(np.float32))
