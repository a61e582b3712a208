"""Engines that a page carries: they step there as they do in the lab, to the bit. Run where they are installed."""

from __future__ import annotations

import base64
import gzip
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from engines.jolt.soft_body import PACKAGE
from engines.process.available import how_to_install, interpreter
from engines.process.packages import APART
from experiments.runs.steppers import find_steppers
from reference.changes import Change
from reference.errors import InputError
from reference.scenes import find as find_scene
from report.browser import engines
from report.browser.engines import CARRIED, carried_engines, refusals
from report.browser.lab_page import lab_page
from report.browser.presets import Preset
from tests.report.browser.test_lab_page import opened
from tests.report.chromium import chromium

#: Along a line, in the plane, in space.
SCENES = ("oscillator", "string", "cloth")

STEPS = 40

#: Positions and velocities of the second lane.
STATE = "(({F, at}) => Array.from(F.slice(at.x, at.x + 2 * at.n * at.d)))(lab.lanes[1].world.memory)"


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """Chromium, without graphics."""
    with chromium() as started:
        yield started


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The page with Jolt in it; without Jolt the test is skipped."""
    if interpreter("jolt-physics") is None:
        pytest.skip(how_to_install("jolt-physics"))
    made = tmp_path_factory.mktemp("page") / "lab.html"
    made.write_text(lab_page([Preset(scene) for scene in (*SCENES, "barrier")], tuple(CARRIED)), encoding="utf-8")
    return made


@pytest.mark.rotating(2)
@pytest.mark.parametrize("scene", SCENES)
def test_steps_in_the_page_are_the_lab_s(browser: Any, file: Path, scene: str) -> None:
    """The same program told the same: positions and velocities to the bit, a change on the fly and a way back too."""
    changes = [Change(0.01, "stiffness", 120.0), Change(0.02, "mass", 0.03), Change(0.025, "gravity", 3.7)]
    at = ",".join(f"{change.time}:{change.parameter}:{change.value}" for change in changes)
    shown = opened(browser, file, f"s={scene}&w=kick_drift,jolt_soft_body_once&dt=0.001&at={at}&n={STEPS}")
    setup = find_scene(scene).setup({}, 1e-3, STEPS * 1e-3)
    (stepper,) = find_steppers(["jolt_soft_body_once"])
    run = stepper.run(setup.system, 1e-3, STEPS, changes).trajectory
    assert run is not None
    expected = np.concatenate([run.positions[-1].ravel(), run.velocities[-1].ravel()])
    assert np.array_equal(shown.page.evaluate(STATE), expected)
    assert shown.page.evaluate("lab.lanes[1].engine.version") == APART["jolt-physics"].version
    again = "rewind(1); for (let k = lab.lanes[1].world.steps; k < 40; k++) oneStep();"
    assert shown.page.evaluate(f"{again} lab.lanes[1].world.steps") == STEPS
    assert np.array_equal(shown.page.evaluate(STATE), expected)
    assert not np.array_equal(shown.page.evaluate(STATE.replace("lanes[1]", "lanes[0]")), expected)
    assert (shown.complaints, shown.requests) == ([], [])
    shown.page.close()


def test_what_it_cannot_do_stops_its_lane_by_name(browser: Any, file: Path) -> None:
    """Damping that is set on the fly stops it and is told; at the barrier, which has drag, it is not offered."""
    shown = opened(browser, file, "s=string&w=kick_drift,jolt_soft_body")
    page = shown.page
    page.evaluate("oneStep(); change('damping', 0.1); oneStep(); showAll()")
    assert page.evaluate("lab.lanes.map(lane => lane.world.steps)") == [2, 1]
    assert "damping" in page.inner_text("#said")
    assert "single precision" in page.inner_text("#limits")
    page.evaluate("location.hash = 's=barrier&w=jolt_soft_body'; openHash()")
    assert page.evaluate("[lab.lanes[0].scheme, lab.refused]") == ["kick_drift", ["w=jolt_soft_body"]]
    assert "drag" in page.inner_text("#engines-refused")
    assert shown.violations() == []
    page.close()


def test_engines_that_no_browser_runs_are_refused() -> None:
    """By name, with those that it does; and of a scene what the engine says."""
    with pytest.raises(InputError, match="expected one of jolt_soft_body, jolt_soft_body_once"):
        carried_engines(["pymunk_springs"])
    assert carried_engines([]) == {}
    said = {name: refusals(["jolt_soft_body"], find_scene(name).system({})) for name in ("string", "barrier")}
    assert said["string"] == {"jolt_soft_body": ""}
    assert "drag" in said["barrier"]["jolt_soft_body"]


def test_a_page_carries_the_engines_program_licence_and_what_each_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each once, from the package's folder; without one it is told how to install it."""
    home = tmp_path / Path(PACKAGE).parents[1]
    (home / "dist").mkdir(parents=True)
    (home / "package.json").write_text('{"version": "9.8.7"}', encoding="utf-8")
    (home / "dist" / Path(PACKAGE).name).write_bytes(b"program")
    (home / "LICENSE").write_text("a licence", encoding="utf-8")
    monkeypatch.setattr(engines, "interpreter", lambda package: tmp_path / "bin" / "python")
    carried = carried_engines(["jolt_soft_body_once", "jolt_soft_body", "jolt_soft_body_once"])
    assert gzip.decompress(base64.b64decode(carried["program"])) == b"program"
    assert carried["licence"] == "a licence"
    assert [engine["name"] for engine in carried["engines"]] == ["jolt_soft_body_once", "jolt_soft_body"]
    for told in carried["engines"]:
        engine = CARRIED[told["name"]]
        assert (told["package"], told["version"]) == (engine.package, "9.8.7")
        assert (told["precision"], told["semantics"]) == (engine.precision, engine.semantics)
        assert told["substeps"] == engine.substeps
        assert told["settings"].split(", ") == [f"{name} = {value}" for name, value in engine.settings.items()]
    monkeypatch.setattr(engines, "interpreter", lambda package: None)
    with pytest.raises(InputError, match="jolt-physics"):
        carried_engines(["jolt_soft_body"])
