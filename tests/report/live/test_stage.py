"""What a viewer is sent to see, read from what viser is asked to draw."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from report.live.lab import Lab
from report.live.stage import Stage
from tests.report.live.labs import open_lab
from tests.report.live.viewer import Drawn, viewer


def shown(client: Any, lab: Lab) -> dict[str, Drawn]:
    """All that is drawn of a lab as it is."""
    Stage(client, lambda i, place: None, lambda i: None).show(lab.timeline)
    return dict(client.nodes)


@pytest.mark.parametrize(("scene", "behind"), [("string", 0.03), ("jello", 0.0)])
def test_all_is_where_it_is_and_the_true_motion_just_behind_in_the_plane(
    scene: str, behind: float, labs: list[Lab], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Up to 3 % of the size, so that neither hides the other. In single precision, as pages take it."""
    lab = open_lab(labs, scene)
    lab.advance(20)
    system, state = lab.timeline.system, lab.timeline.lanes[0].state
    monkeypatch.setattr(lab.timeline, "reference", SimpleNamespace(state=system.start))
    drawn = shown(viewer(), lab)
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
