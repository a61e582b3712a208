"""Pictures of natural modes: each panel has the frequency of its mode and the shape of it."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.collections import LineCollection

from experiments.simulation.modes_of_scene import modes_of
from reference.files.setup import setup_for
from report.figures.modes import AMPLITUDE, MOST, draw, swinging
from report.film.view import view_of
from tests.report.figures.artists import cut_off, laid_out, odd_measures, overlaps, unlabelled


def test_every_panel_has_its_mode() -> None:
    """The rest in grey, the shape moved by AMPLITUDE of the size, with frequency and damping ratio above."""
    modes = modes_of(setup_for("string", settings={"masses": "3", "drag": "0.05"}))
    panels = draw(modes).figure.axes
    springs, rest = modes.setup.system.springs, modes.rest.state.positions
    for i, panel in enumerate(panels[: len(modes.natural.frequencies)]):
        still, moved = (c for c in panel.collections if isinstance(c, LineCollection))
        np.testing.assert_allclose(np.array(still.get_segments()), rest[springs])
        far = AMPLITUDE * modes.setup.system.scale * modes.natural.shapes[i]
        np.testing.assert_allclose(np.array(moved.get_segments()), (rest + far)[springs])
        number, told = panel.get_title().split(": ")
        assert int(number) == i + 1
        assert float(told.split(" Hz")[0]) == pytest.approx(modes.natural.frequencies[i], rel=1e-3)
        assert f"damping ratio {modes.natural.damping_ratios[i]:.3g}" in told
    assert (panels[0].get_xlabel(), panels[0].get_ylabel()) == ("x [m]", "y [m]")


def test_one_mode_is_one_panel_and_without_damping_none_is_told() -> None:
    """Of one mass on a line: what is along it is drawn across."""
    modes = modes_of(setup_for("chain", settings={"masses": "1"}))
    (panel,) = draw(modes).figure.axes
    assert panel.get_title() == f"1: {modes.natural.frequencies[0]:.4g} Hz"
    still, moved = (c for c in panel.collections if isinstance(c, LineCollection))
    rest, far = modes.rest.state.positions[1, 0], AMPLITUDE * modes.setup.system.scale * modes.natural.shapes[0][1, 0]
    assert np.array(still.get_segments())[0].tolist() == [[0, 0], [0, rest]]
    np.testing.assert_allclose(np.array(moved.get_segments())[0], [[0, 0], [far, rest]])


def test_in_space_shapes_are_seen_as_in_films() -> None:
    """Each mass where the view of the rest has it; without axes, which would be none of the scene's."""
    modes = modes_of(setup_for("cloth", settings={"rows": "3", "columns": "3"}), 2)
    rest, springs = modes.rest.state.positions, modes.setup.system.springs
    view = view_of(rest)
    for i, panel in enumerate(draw(modes).figure.axes):
        still, moved = (c for c in panel.collections if isinstance(c, LineCollection))
        far = AMPLITUDE * modes.setup.system.scale * modes.natural.shapes[i]
        np.testing.assert_allclose(np.array(still.get_segments()), view.project(rest)[0][springs])
        np.testing.assert_allclose(np.array(moved.get_segments()), view.project(rest + far)[0][springs])
        assert not panel.axison


@pytest.mark.parametrize(("most", "shown"), [(1, 1), (2, 2), (3, 2)])
def test_a_film_has_so_many_modes_as_there_are(most: int, shown: int) -> None:
    """Or as are asked for, the slowest."""
    modes = modes_of(setup_for("chain", settings={"masses": "2"}))
    film = swinging(modes, most, 4)
    assert [shot.names[0].partition(":")[0] for shot in film.shots] == [str(i + 1) for i in range(shown)]
    assert film.setup.name == "chain, modes"
    assert film.shots[0].motion.times.tolist() == [0, 0.25, 0.5, 0.75, 1]


def test_more_modes_than_there_is_room_for_are_said_to_be() -> None:
    """The slowest MOST of them."""
    modes = modes_of(setup_for("cloth"), 12)
    figure = draw(modes).figure
    assert f"the slowest {MOST} of {modes.asked}" in figure.get_suptitle()
    assert len(figure.axes) == MOST


@pytest.mark.rotating(4)
@pytest.mark.parametrize("scene", ["string", "bridge", "jello", "chain"])
def test_all_of_it_can_be_read(scene: str) -> None:
    """In the plane, in space, along a line: axes with units, nothing over anything else."""
    figure = laid_out(draw(modes_of(setup_for(scene), 6)).figure)
    assert unlabelled(figure) == overlaps(figure) == odd_measures(figure) == cut_off(figure) == []


def test_a_film_goes_through_one_swing() -> None:
    """From one side to the other and back, about the rest."""
    modes = modes_of(setup_for("chain", settings={"masses": "2"}))
    film = swinging(modes, 2, 24)
    for i, shot in enumerate(film.shots):
        x = shot.motion.positions - modes.rest.state.positions
        far = AMPLITUDE * modes.setup.system.scale * modes.natural.shapes[i]
        np.testing.assert_allclose(x[[0, 12, 24]], [far, -far, far], atol=1e-12)
