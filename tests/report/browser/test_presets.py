"""Scenes as the page shows them: what hardly moves is drawn as many times as far from its start as can be seen."""

from __future__ import annotations

import numpy as np
import pytest

from reference.stepper import catalogued
from report.browser.presets import PRESETS, Preset

MAGNIFIED = [preset for preset in PRESETS if preset.magnified != 1.0]


def moves(preset: Preset) -> float:
    """How far the mass that moves most gets from its start, as a part of the system's size."""
    setup = preset.setup
    run = catalogued()["kick_drift"].run(setup.system, setup.dt, setup.steps, setup.changes).trajectory
    assert run is not None
    return float(np.abs(run.positions - run.positions[0]).max()) / setup.system.size


@pytest.mark.parametrize("preset", MAGNIFIED, ids=lambda preset: preset.stem)
def test_what_is_drawn_magnified_hardly_moves_and_is_seen_to_move(preset: Preset) -> None:
    """By less than a hundredth of the size, drawn as 3 to 10 of them, the way that it moves: not mirrored."""
    part = moves(preset)
    assert part < 0.01
    assert 0.03 < part * preset.magnified < 0.1


def test_others_are_drawn_as_they_are() -> None:
    """A string swings by a quarter of its length and more: it needs no magnifying."""
    assert {preset.scene for preset in MAGNIFIED} == {"crossing", "earthquake"}
    assert moves(Preset("string")) > 0.1
