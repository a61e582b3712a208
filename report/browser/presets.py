"""Which scenes the page shows where none is named: the lecture's pictures, each a scene with some parameters set."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from reference.files.setup import is_file, setup_for
from reference.scenes import Setup, find
from report.browser.recordings import Recording, recording_data
from report.browser.system_data import scene_data


@dataclass(frozen=True)
class Preset:
    """A scene as the page shows it.

    Attributes:
        scene: its name, or a file's path.
        settings: parameters set otherwise.
        name: what a link calls it.
        recordings: runs of other steppers to be laid over it.
        magnified: how many times as far from their start masses are drawn, in scenes that hardly move.
    """

    scene: str
    settings: Mapping[str, str] = field(default_factory=dict)
    name: str = ""
    recordings: tuple[Recording, ...] = ()
    magnified: float = 1.0

    @property
    def title(self) -> str:
        """What people call it."""
        words = ", ".join(f"{key} = {value}" for key, value in self.settings.items())
        return f"{self.stem} ({words})" if words else self.stem

    @property
    def stem(self) -> str:
        """The scene's name, or its file's without folder and ending."""
        return Path(self.scene).stem if is_file(self.scene) else self.scene

    @property
    def setup(self) -> Setup:
        """The scene with its parameters. Raises InputError for an unknown scene, or one that makes no sense."""
        return setup_for(self.scene, settings=dict(self.settings))

    def data(self) -> dict[str, Any]:
        """As the page reads it.

        Raises:
            InputError: for an unknown scene, or one that makes no sense.
            Unsupported: for what the page cannot do.
        """
        setup = self.setup
        own = is_file(self.scene)
        summary, slides = ("", "") if own else (find(self.scene).summary, find(self.scene).slides)
        data = scene_data(setup, summary, slides, self.scene)
        data |= {
            "name": self.name or self.stem,
            "scene": self.stem,
            "title": self.title,
            "settings": dict(self.settings),
            "magnified": self.magnified,
        }
        return data | {"recordings": [recording_data(recording, setup) for recording in self.recordings]}


#: The lecture's scenes.
PRESETS: Sequence[Preset] = (
    Preset("spring"),
    Preset("oscillator"),
    Preset("string"),
    Preset("string", {"masses": "40"}, name="string_40"),
    Preset("string", {"tension_only": "1"}, name="string_of_ropes"),
    Preset("chain"),
    Preset("slinky"),
    Preset("barrier"),
    Preset("cloth"),
    Preset("cloth", {"rows": "30", "columns": "30", "rest_length": "0.02"}, name="cloth_30"),
    Preset("cloth", {"breaking_stretch": "0.03"}, name="cloth_tears"),
    Preset("falling_cloth"),
    Preset("tablecloth"),
    Preset("flag"),
    Preset("strip"),
    Preset("jello"),
    Preset("drop"),
    Preset("drape"),
    Preset("bridge"),
    Preset("soil"),
    Preset("crossing", magnified=10.0),
    Preset("earthquake", magnified=30.0),
)
