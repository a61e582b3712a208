"""What stands beside the experiments of the report can be opened: scenes, schemes, exercises that there are."""

from __future__ import annotations

from urllib.parse import parse_qs

from experiments.exercises.exercise import exercises
from experiments.experiment import NAMES
from report.browser.beside import BESIDE, scenes_beside
from report.browser.changes import CHANGES
from report.browser.presets import PRESETS
from report.browser.programs import page_schemes


def test_every_state_names_what_there_is() -> None:
    """A scene among the presets, schemes that the page has, parameters that it can change."""
    scenes = {preset.name or preset.scene for preset in PRESETS}
    assert scenes_beside() <= scenes
    assert BESIDE.keys() <= set(NAMES)
    for beside in BESIDE.values():
        words = parse_qs(beside.state, strict_parsing=True)
        assert words["s"][0] in scenes
        assert set(words["w"][0].split(",")) <= page_schemes().keys()
        for change in words.get("at", []):
            assert change.split(":")[1] in CHANGES


def test_exercises_are_called_by_their_numbers() -> None:
    """And there is one of each."""
    assert {beside.exercise for beside in BESIDE.values()} - {None} <= set(exercises())
