"""What a viewer is sent to see, read from what viser is asked to draw."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any
from unittest.mock import MagicMock

import numpy as np
import pytest

from report.live.lab import Lab
from report.live.stage import Stage
from tests.report.live.labs import open_lab


class Drawn(SimpleNamespace):
    """A node of the scene as it was asked for, by its name."""

    def __init__(self, name: str, *shape: Any, **how: Any) -> None:
        super().__init__(name=name, shape=shape, visible=True, remove=lambda: None, **how)

    def on_drag(self, button: str) -> Any:
        """Nobody drags."""
        return lambda function: function

    def on_click(self, function: Any) -> None:
        """Nor clicks."""


@pytest.fixture
def client() -> Any:
    """A viewer with a screen of 1280 x 720, who keeps what is drawn in `nodes`."""
    made = MagicMock(nodes={})
    made.camera = SimpleNamespace(image_width=1280, image_height=720, fov=0.9, position=np.ones(3), look_at=np.zeros(3))

    def draw(name: str, *shape: Any, **how: Any) -> Drawn:
        return made.nodes.setdefault(name, Drawn(name, *shape, **how))

    for function in ("add_line_segments", "add_batched_meshes_simple", "add_label", "add_mesh_simple"):
        getattr(made.scene, function).side_effect = draw
    return made


def shown(client: Any, lab: Lab) -> dict[str, Drawn]:
    """All that is drawn of a lab as it is."""
    Stage(client, lambda i, place: None, lambda i: None).show(lab.timeline)
    return dict(client.nodes)


@pytest.mark.parametrize(("scene", "behind"), [("string", 0.03), ("jello", 0.0)])
def test_all_is_where_it_is_and_the_true_motion_just_behind_in_the_plane(
    scene: str, behind: float, labs: list[Lab], client: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Up to 3 % of the size, so that neither hides the other. In single precision, as pages take it."""
    lab = open_lab(labs, scene)
    lab.advance(20)
    system, state = lab.timeline.system, lab.timeline.lanes[0].state
    monkeypatch.setattr(lab.timeline, "reference", SimpleNamespace(state=system.start))
    drawn = shown(client, lab)
    places, true = (
        np.pad(positions, ((0, 0), (0, 3 - system.dimension))).astype(np.float32)
        for positions in (state.positions, system.start.positions)
    )
    np.testing.assert_array_equal(drawn["/lane0/springs"].points, places[system.springs])
    np.testing.assert_array_equal(drawn["/lane0/masses"].batched_positions, places)
    offset = drawn["/true"].points - true[system.springs]
    assert not offset[..., :2].any()
    assert (-behind * system.size <= offset[..., 2]).all()
    assert (offset[..., 2] < 0).all() == (behind > 0)
