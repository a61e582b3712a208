"""The live lab without a page: whatever is moved, each lane does what a plain run with the same changes does."""

from __future__ import annotations

import os
import signal
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from reference.errors import InputError
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.simulate import simulate
from report.live import stepping
from report.live.lab import Lab
from report.live.parameters import PRESETS
from report.live.status import suggestion
from report.live.stepping import EngineStepping
from tests.report.live.commands import ends
from tests.report.live.labs import ROUNDING, apart, go_on, move_at_random, open_lab


@pytest.mark.rotating(3, in_turn=True)
@pytest.mark.usefixtures("by_loops")
@pytest.mark.parametrize(
    ("scene", "name"),
    [("string", "kick_drift"), ("barrier", "heun"), ("string", "heun_aliased"), ("string", "implicit_midpoint")],
)
def test_a_scheme_does_what_a_plain_run_does(labs: list[Lab], scene: str, name: str) -> None:
    """To the last bit, though compiled loops take over if they can. A change one step late is seen: shown to fail."""
    lab = open_lab(labs, scene, [name])
    made = move_at_random(lab, 1)
    system, steps = find_scene(scene).system({}), lab.timeline.segment.steps
    (lane,), dt = lab.timeline.lanes, lab.timeline.dt
    assert apart(lane.state, simulate(system, find(name), dt, steps * dt, made).states()[-1]) == 0
    late = [replace(change, time=change.time + dt) for change in made]
    assert apart(lane.state, simulate(system, find(name), dt, steps * dt, late).states()[-1]) > 1e-6


def test_loops_are_compiled_meanwhile_where_there_are_any() -> None:
    """They are not waited for, and are there in the end; of a scheme that cannot be compiled nothing is begun."""
    string, compiled = find_scene("string").system({}), stepping._Compiled()
    assert not compiled.ready(find("implicit_midpoint"), string)
    assert compiled._ready == {}
    assert not compiled.ready(find("kick_drift"), string)
    deadline = time.monotonic() + 600
    while not compiled.ready(find("kick_drift"), string):
        assert time.monotonic() < deadline
        time.sleep(0.01)


@pytest.mark.rotating(3, in_turn=True)
def test_a_change_goes_on_from_where_it_is(labs: list[Lab]) -> None:
    """No reset: between the last frame and the next the state has not moved, in schemes and engines."""
    lab = open_lab(labs, "string", ["heun", "pymunk_springs"])
    lab.advance(50)
    before = [lane.state for lane in lab.timeline.lanes]
    lab.set_parameter("stiffness", 120.0)
    lab.set_dt(1.3e-3)
    for lane, state in zip(lab.timeline.lanes, before, strict=True):
        assert apart(lane.state, state) == 0
    lab.set_steppers(["rk4", "mujoco_tendons"])
    for lane, state in zip(lab.timeline.lanes, before, strict=True):
        assert apart(lane.state, state) == 0
    assert lab.timeline.time == pytest.approx(0.05)


@pytest.mark.rotating(3, in_turn=True)
def test_the_past_can_be_gone_back_to(labs: list[Lab], tmp_path: Path) -> None:
    """Going on from there gives what came before again; the parameters of then are back, and the command knows."""
    lab = open_lab(labs, "string", ["heun", "pymunk_springs"])
    seen = []
    for i in range(60):
        if i == 30:
            lab.set_parameter("stiffness", 100.0)
        lab.advance(16)
        seen.append((lab.timeline.time, [lane.state for lane in lab.timeline.lanes]))
    lab.rewind(lab.timeline.time - seen[20][0])
    at = next(i for i, (time, _) in enumerate(seen) if time == lab.timeline.time)
    assert at == 20
    assert lab.timeline.system.stiffness[0] == 200.0
    lab.advance(16)
    assert lab.timeline.time == seen[at + 1][0]
    for lane, state in zip(lab.timeline.lanes, seen[at + 1][1], strict=True):
        assert apart(lane.state, state) <= ROUNDING
    last = ends(lab.reproduction(), tmp_path)
    assert apart(lab.timeline.lanes[0].state, last["heun"]) <= ROUNDING


def test_a_lane_that_is_added_leaves_the_past_as_it_was(labs: list[Lab]) -> None:
    """After a blow-up, too: one goes back to before it, to the lanes there were then, and on from there with these."""
    lab = open_lab(labs, "string", ["kick_drift"])
    seen = []
    for _ in range(20):
        lab.advance(10)
        seen.append(lab.timeline.lanes[0].state)
    lab.set_dt(0.02)
    while not lab.timeline.lanes[0].stopped:
        lab.advance(10)
    lab.set_steppers(["kick_drift", "rk4"])
    times, numbers = lab.timeline.recorder.last(100.0, 10_000)
    assert numbers.shape[:2] == (len(times), 2)
    assert len(times) > 20
    assert np.isnan(numbers[:-1, 1]).all()
    assert np.isfinite(lab.timeline.recorder.begin[1, 0])
    lab.rewind(lab.timeline.time - 0.1)
    assert lab.timeline.steppers == ("kick_drift",)
    assert apart(lab.timeline.lanes[0].state, seen[9]) == 0
    lab.rewind(0.0)
    assert lab.timeline.steppers == ("kick_drift", "rk4")
    lab.rewind(lab.timeline.time - 0.1)
    lab.advance(10)
    assert [lane.name for lane in lab.timeline.lanes] == ["kick_drift"]
    assert lab.timeline.recorder.names == ("kick_drift",)


@pytest.mark.rotating(5, in_turn=True)
def test_what_the_scene_changes_itself_it_changes_again_after_going_back(labs: list[Lab]) -> None:
    """A truck crosses: from half-way, it crosses the second half twice, to the last bit the same."""
    lab = open_lab(labs, "crossing")
    for _ in range(40):
        lab.advance(10)
    half = lab.timeline.time
    for _ in range(40):
        lab.advance(10)
    end = lab.timeline.lanes[0].state
    lab.rewind(lab.timeline.time - half)
    assert lab.timeline.time == pytest.approx(0.4)
    lab.advance(400)
    assert apart(lab.timeline.lanes[0].state, end) == 0


@pytest.mark.rotating(3, in_turn=True)
@pytest.mark.parametrize("seconds", [0.0, 0.01, 0.5])
def test_a_mass_may_be_held_now_or_in_the_past(labs: list[Lab], seconds: float) -> None:
    """Whenever one goes back to: what is done there is done to what was held then, and played on, nothing is."""
    lab = open_lab(labs, "string", ["heun", "rk4"])
    for held in (False, True, False, True):
        if held:
            lab.grab(5, np.array([0.6, 0.2]))
        for _ in range(30):
            lab.advance(2)
        if not held:
            continue
        lab.rewind(seconds)
        lab.toggle_pin(3)
        assert lab.timeline.grabbed is None
        lab.advance(2)
        assert {len(lane.state.positions) for lane in lab.timeline.lanes} == {11}
        lab.grab(5, np.array([0.6, 0.1]))
        lab.advance(20)
        lab.rewind(1e-3)
        lab.play()
        assert lab.timeline.grabbed is None
        lab.advance(2)


def test_a_limit_is_that_of_the_scene_that_is_open(labs: list[Lab]) -> None:
    """Of the one before it nothing is said, while the new one is not known yet."""
    lab = open_lab(labs, "spring")
    lab.wait_for_predictions()
    before = lab.predictions["kick_drift"].limit
    lab.open("string")
    known = lab.predictions.get("kick_drift")
    assert known is None or known.limit != before
    lab.wait_for_predictions()
    assert lab.predictions["kick_drift"].limit == pytest.approx(10.11e-3, rel=1e-3)


@pytest.mark.rotating(3, in_turn=True)
@pytest.mark.parametrize("scene", ["string", "cloth"])
def test_past_the_predicted_limit_it_blows_up_and_below_it_stays(labs: list[Lab], scene: str) -> None:
    """A dt over the limit by 7 % pauses with a reason that has both numbers; a tenth below the limit it goes on."""
    lab = open_lab(labs, scene, ["kick_drift"])
    lab.wait_for_predictions()
    limit = lab.predictions["kick_drift"].limit
    assert limit is not None
    lab.set_dt(1.07 * limit)
    lab.wait_for_predictions()
    lab.play()
    go_on(lab, 4000)
    assert not lab.playing
    assert "blew up" in lab.notice
    assert "is 1.07 times the predicted largest stable dt" in lab.notice
    assert "The fastest mode grows" in lab.notice
    lab.reset()
    lab.set_dt(0.9 * limit)
    lab.play()
    go_on(lab, 600)
    assert lab.playing
    assert lab.notice == ""


def test_a_stable_step_is_offered_only_where_there_is_one(labs: list[Lab]) -> None:
    """Not for Euler without damping, which grows at any dt; for kick-drift a tenth below 10.11 ms, in two figures."""
    for name, dt, wanted in (("euler", 9e-3, None), ("kick_drift", 10.8e-3, 9.1e-3)):
        lab = open_lab(labs, "string", [name])
        lab.set_dt(dt)
        lab.wait_for_predictions()
        go_on(lab, 3000)
        assert lab.timeline.lanes[0].blown_up
        assert suggestion(lab) == wanted


@pytest.mark.rotating(3, in_turn=True)
def test_after_a_blow_up_what_is_changed_is_tried(labs: list[Lab]) -> None:
    """A shorter step gives a torn string no second life, but the lane that was well goes on with it."""
    lab = open_lab(labs, "string", ["euler", "rk4"])
    lab.set_dt(9e-3)
    go_on(lab, 3000)
    assert lab.notice
    steps = lab.timeline.segment.steps
    lab.set_dt(1e-3)
    assert lab.notice == ""
    lab.advance(10)
    assert lab.timeline.segment.steps == 10 != steps
    assert lab.timeline.lanes[1].stopped is None


@pytest.mark.rotating(3, in_turn=True)
def test_the_first_blow_up_is_left_behind_by_playing_again(labs: list[Lab]) -> None:
    """Play starts again, and the other lanes were not harmed."""
    lab = open_lab(labs, "string", ["euler", "kick_drift"])
    lab.set_dt(9e-3)
    lab.play()
    go_on(lab, 3000)
    assert lab.timeline.lanes[0].blown_up
    assert lab.timeline.lanes[1].stopped is None
    lab.play()
    assert (lab.timeline.time, lab.notice, lab.playing) == (0.0, "", True)


def test_an_engine_that_is_killed_is_one_lane_less(labs: list[Lab]) -> None:
    """With its reason; the others go on, and it begins again with a reset."""
    lab = open_lab(labs, "string", ["mujoco_tendons", "heun"])
    lab.advance(5)
    stepping = lab.timeline.lanes[0]._stepping
    assert isinstance(stepping, EngineStepping)
    pid = stepping._session.pid
    assert pid is not None
    os.kill(pid, signal.SIGKILL)
    lab.advance(5)
    assert lab.timeline.lanes[0].stopped == "crashed: killed by SIGKILL"
    assert "mujoco_tendons stopped: crashed: killed by SIGKILL" in lab.notice
    assert lab.timeline.lanes[1].stopped is None
    lab.reset()
    lab.advance(5)
    assert [lane.stopped for lane in lab.timeline.lanes] == [None, None]


def test_numbers_that_are_none_are_a_blow_up(labs: list[Lab]) -> None:
    """Pymunk goes to NaN in silence: the lane keeps its last good state and says so."""
    lab = open_lab(labs, "string", ["pymunk_springs"])
    lab.set_dt(0.1)
    go_on(lab, 1000)
    assert lab.timeline.lanes[0].blown_up
    assert np.isfinite(lab.timeline.lanes[0].state.positions).all()


def test_an_engine_that_cannot_says_why(labs: list[Lab]) -> None:
    """Pymunk is flat; the lane beside it swings."""
    lab = open_lab(labs, "cloth", ["kick_drift", "pymunk_springs"])
    swinging, flat = lab.timeline.lanes
    assert flat.stopped == "unsupported: pymunk_springs cannot do motion in three dimensions"
    assert (swinging.stopped, lab.notice) == (None, flat.notice)
    lab.advance(20)
    assert (swinging.state.time, flat.state.time) == (pytest.approx(0.02), 0)


@pytest.mark.rotating(3, in_turn=True)
def test_schemes_are_found_by_alias_and_with_parameters(labs: list[Lab], tmp_path: Path) -> None:
    """An alias is the scheme; more rounds are another motion, which the command comes to, too."""
    words = [
        "semi_implicit_euler",
        "drift_kick_sequential_damping(rounds=1)",
        "drift_kick_sequential_damping(rounds=3)",
    ]
    lab = open_lab(labs, "string", words, damping="0.5")
    assert lab.timeline.steppers == ("kick_drift", *words[1:])
    lab.advance(50)
    alias, one, three = lab.timeline.lanes
    system = find_scene("string").system({"damping": 0.5})
    for lane, scheme in ((alias, find(words[0])), (one, find(words[1])), (three, find(words[2]))):
        assert apart(lane.state, simulate(system, scheme, lab.timeline.dt, 0.05).states()[-1]) == 0
    assert apart(one.state, three.state) > 1e-6
    last = ends(lab.reproduction(), tmp_path)
    assert apart(three.state, last[words[2]]) == 0
    lab.wait_for_predictions()
    assert lab.predictions[words[2]].scheme == words[2]


@pytest.mark.rotating(3, in_turn=True)
@pytest.mark.parametrize("slide", PRESETS)
def test_the_lectures_pictures(labs: list[Lab], slide: str) -> None:
    """On slide 15 Euler explodes within 1.5 s, and Heun does not; the others go on."""
    preset = PRESETS[slide]
    lab = open_lab(labs, preset.scene, preset.steppers)
    lab.set_dt(preset.dt)
    for name, number in preset.parameters.items():
        lab.set_parameter(name, number)
    go_on(lab, 1500)
    stopped = {lane.name for lane in lab.timeline.lanes if lane.stopped}
    assert stopped == ({"euler"} if slide == "15" else set())


def test_the_true_motion_is_followed(labs: list[Lab]) -> None:
    """Dormand-Prince, frame by frame with changes: rk4 with small steps is as near as its own error, 5e-9 m."""
    lab = open_lab(labs, "string", ["rk4"])
    lab.set_dt(2.5e-4)
    for i in range(20):
        if i == 8:
            lab.set_parameter("stiffness", 150.0)
        lab.advance(64)
    _, numbers = lab.timeline.recorder.last(100.0, 100)
    if lab.timeline.reference.state is not None:  # else the machine is too busy to follow it
        assert numbers[-1, 0, 2] < 5e-8
    head = lab.timeline.recorder.csv().splitlines()[0]
    assert head == "time [s],rk4 energy [J],rk4 momentum off [kg m/s],rk4 distance [m]"


@pytest.mark.parametrize(
    ("what", "said"),
    [
        (lambda lab: lab.set_dt(0.0), "dt = 0: expected a number from 1e-12 to 1000"),
        (lambda lab: lab.set_dt(float("nan")), "dt = nan"),
        (lambda lab: lab.set_parameter("mass", -1.0), "mass = -1: expected a number > 0"),
        (lambda lab: lab.set_steppers(["huen"]), "unknown stepper 'huen': did you mean 'heun'?"),
        (lambda lab: lab.set_steppers(["kick_drift(rounds=3)"]), "scheme 'kick_drift' has no parameters"),
        (lambda lab: lab.set_steppers(["drift_kick_sequential_damping(rounds=many)"]), "rounds = 'many': expected int"),
        (lambda lab: lab.set_steppers(["heun(x"]), "scheme 'heun\\(x': expected a name, or a name with parameters"),
        (lambda lab: lab.set_steppers(["heun"] * 5), "5 lanes: expected from 1 to 4"),
        (lambda lab: lab.open("strin"), "unknown scene 'strin': did you mean 'string'?"),
        (lambda lab: lab.open("cloth", {"rows": "900"}), "cloth has 9,000 masses: expected at most 5,000"),
    ],
)
def test_what_makes_no_sense_changes_nothing(labs: list[Lab], what: object, said: str) -> None:
    """One line, and the lab goes on as it was."""
    lab = open_lab(labs)
    lab.advance(10)
    with pytest.raises(InputError, match="^" + said.replace("?", r"\?")):
        what(lab)  # type: ignore[operator]
    lab.advance(10)
    assert lab.timeline.segment.steps == 20
    assert lab.timeline.lanes[0].stopped is None
