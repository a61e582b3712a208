"""What the panel of controls asks of the page that it is on."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from report.live.lab import Lab
from report.live.stage import Stage


class Host(Protocol):
    """A page with a lab, as its controls know it.

    Attributes:
        lab: what is shown and moved.
        stage: where it is shown.
    """

    lab: Lab
    stage: Stage

    def do(self, action: Callable[[], None]) -> None:
        """Have something done between two frames; what it refuses with an InputError is said to the viewer."""

    def scene_names(self) -> list[str]:
        """The scenes that can be chosen."""

    def open(self, scene: str, settings: dict[str, str] | None = None, barrier: bool | None = None) -> None:
        """Another scene, or the same with other parameters."""

    def preset(self, slide: str) -> None:
        """One of the lecture's pictures."""

    def start_again_with(self, dt: float) -> None:
        """From the start, with another step [s]."""

    def say(self, text: str) -> None:
        """A sentence, for a while."""

    def download(self, name: str, content: bytes) -> None:
        """A file for the viewer."""

    def csv(self) -> None:
        """What was measured since the last reset, as a file for the viewer."""

    def picture(self) -> None:
        """What is seen, as a file for the viewer."""
