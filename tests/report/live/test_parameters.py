"""The sliders of the live page: each goes from somewhere above zero, so that it can go by powers."""

from __future__ import annotations

import pytest

from reference.scenes import find, scenes
from report.live.parameters import sliders


@pytest.mark.parametrize("scene", sorted(scenes()))
def test_every_scene_s_sliders_can_go_by_powers(scene: str) -> None:
    """From low > 0 to high > low, with the value between; zero only where the left end may mean it."""
    for slider in sliders(find(scene).system({})):
        assert 0 < slider.low < slider.high
        assert slider.low <= slider.value <= slider.high or (slider.value == 0 and slider.zero)
