"""A viewer who keeps what is drawn for them: in place of one with a browser."""

from __future__ import annotations

import asyncio
from types import SimpleNamespace
from typing import Any
from unittest.mock import MagicMock

import numpy as np

#: What viser is asked to draw with.
SHAPES = ("line_segments", "batched_meshes_simple", "label", "mesh_simple", "icosphere", "box", "grid")


class Drawn(SimpleNamespace):
    """A node of the scene as it was asked for, by its name."""

    def __init__(self, name: str, *shape: Any, **how: Any) -> None:
        super().__init__(name=name, shape=shape, removed=False, **{"visible": True, **how})

    def remove(self) -> None:
        """It is there no more."""
        self.removed = True

    def on_drag(self, button: str) -> Any:
        """Who is told of a drag."""

        def keep(function: Any) -> None:
            self.button, self.drag = button, function

        return keep

    def on_click(self, function: Any) -> None:
        """Who is told of a click."""
        self.click = function

    def does(self, what: str, **event: Any) -> None:
        """A drag or a click."""
        asyncio.run(getattr(self, what)(SimpleNamespace(**event)))


def viewer(width: int = 1280, height: int = 720) -> Any:
    """With a screen of this size [px], who keeps all that was drawn last, by its name, in `nodes`."""
    made = MagicMock(nodes={})
    made.camera = SimpleNamespace(
        image_width=width, image_height=height, fov=0.9, position=np.ones(3), look_at=np.zeros(3)
    )

    def draw(name: str, *shape: Any, **how: Any) -> Drawn:
        made.nodes[name] = Drawn(name, *shape, **how)
        return made.nodes[name]

    for shape in SHAPES:
        getattr(made.scene, f"add_{shape}").side_effect = draw
    return made
