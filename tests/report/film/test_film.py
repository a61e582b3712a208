"""Films: what is drawn is what moved, steadily; files are whole or not there."""

from __future__ import annotations

import math
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from engines.process.isolation import EngineStepper
from experiments.runs.comparison import Comparison, compare
from reference.changes import Change
from reference.errors import InputError
from reference.obstacles import Plane, Sphere
from reference.scenes import Setup, find
from reference.springs.breaking import breaks_of
from reference.stepper import catalogued
from reference.system import MassSpringSystem
from report.film.drawing import FAR, Look, colour_map, lines, strain
from report.film.film import RATE, Film, film, frame_steps, leaves, look_at, shots
from report.film.film_file import write_film
from report.film.obstacle_image import obstacle_image
from report.film.view import View, view_of
from tests.conformance.doctored import Doctored, StifferByAMillionth
from tests.engines.process.misbehaving import Misbehaving, Segfaults
from tests.report.commands.terminal import springlab
from tests.report.page.canned import SETUP


def of(*names: str, setup: Setup = SETUP) -> Comparison:
    """Schemes compared."""
    return compare(setup, [catalogued()[name] for name in names])


def quiet(_: str) -> None:
    """Nobody listens."""


def check_shown(made: Film, positions: np.ndarray, names: str, step: int) -> None:
    """A panel's springs at a step are drawn, in two dimensions, exactly where `positions` (n, 2) have them."""
    (shot,) = (s for s in made.shots if names in s.names)
    drawn = lines(made.setup.system, made.positions(shot, step), made.look, colour_map())
    assert np.array_equal(np.sort(drawn.segments, axis=0), np.sort(positions[made.setup.system.springs], axis=0))


def test_every_panel_shows_its_own_trajectory() -> None:
    """At every step of the film, to the last bit; and another stepper's is noticed."""
    comparison = of("heun", "euler")
    made = film(comparison, ["heun", "euler"])
    heun, euler = (run.outcome.trajectory for run in comparison.runs)
    assert heun is not None
    assert euler is not None
    for step in made.steps:
        check_shown(made, heun.positions[step], "heun", step)
        check_shown(made, euler.positions[step], "euler", step)
    with pytest.raises(AssertionError):
        check_shown(made, euler.positions[made.steps[-1]], "heun", made.steps[-1])


def test_the_same_motion_is_one_panel_with_all_names_and_failures_are_none() -> None:
    """Kick-drift and its twin; one that is stiffer by a millionth stands alone; one that crashed is not there."""
    engines = [EngineStepper(e) for e in (Doctored(), Doctored(StifferByAMillionth), Misbehaving(Segfaults))]
    comparison = compare(SETUP, [catalogued()["kick_drift"], catalogued()["heun"], *engines])
    names = [shot.names for shot in shots(comparison, [run.stepper.name for run in comparison.runs])]
    assert names == [("kick_drift", "KickDrift"), ("heun",), ("StifferByAMillionth",)]
    assert [shot.names for shot in shots(comparison)] == [("heun",), ("KickDrift",), ("StifferByAMillionth",)]


@pytest.mark.rotating(3, in_turn=True)
def test_a_gif_has_its_frames_in_one_size(tmp_path: Path) -> None:
    """0.02 s eight times slower at 25 frames a second: five; read back with Pillow."""
    made = film(of("heun"), slow=8)
    frames = list(made.frames(quiet))
    assert len(frames) == len(made.steps) == round(0.02 * 8 * RATE) + 1
    assert all(frame.shape == frames[0].shape and frame.dtype == np.uint8 for frame in frames)
    write_film(tmp_path / "part", tmp_path / "a.gif", iter(frames), RATE)
    with Image.open(tmp_path / "part") as image:
        assert (image.n_frames, image.size) == (5, frames[0].shape[1::-1])  # type: ignore[attr-defined]
        assert image.info["duration"] == 1000 / RATE
        assert image.convert("RGB").getpixel((2, 2)) == (255, 255, 255)


@pytest.mark.skipif(find_spec("imageio_ffmpeg") is None, reason="imageio-ffmpeg is not installed")
def test_an_mp4_has_its_frames_too(tmp_path: Path) -> None:
    """Counted by ffmpeg itself."""
    import imageio_ffmpeg

    frames = list(film(of("heun"), slow=8).frames(quiet))
    write_film(tmp_path / "a.mp4", tmp_path / "a.mp4", iter(frames), RATE)
    assert imageio_ffmpeg.count_frames_and_secs(tmp_path / "a.mp4")[0] == len(frames)


def test_frames_are_in_real_time_or_slower_and_not_too_many() -> None:
    """The first and the last step are there."""
    setup = Setup("string", find("string").system({}), 1e-3, 2.0)
    assert frame_steps(setup, 2000) == list(range(0, 2001, 40))
    assert frame_steps(setup, 2000, slow=0.5) == list(range(0, 2001, 80))
    for slow in (0.0, -1.0, math.nan, math.inf):
        with pytest.raises(InputError, match="slow"):
            frame_steps(setup, 2000, slow)
    with pytest.raises(InputError, match="an animation of 200 s: expected at most 30 s"):
        frame_steps(setup, 2000, slow=100)


@pytest.mark.rotating(3, in_turn=True)
def test_what_blows_up_leaves_the_picture_and_changes_nothing_for_the_others() -> None:
    """Euler on a stiff string: the window is that of the true motion; the note says when the first mass is out."""
    setup = Setup("stiff", find("string").system({"masses": 3, "stiffness": 2e4}), 1e-3, 0.3)
    comparison = of("rk4", "euler", setup=setup)
    assert comparison.runs[1].outcome.ending == "diverged"
    made = film(comparison, ["rk4", "euler"])
    assert made.look.window == film(comparison, ["rk4"]).look.window
    good, bad = made.shots
    assert good.left is None
    assert bad.left is not None
    x = bad.motion.positions[round(bad.left / setup.dt)]
    left, right, bottom, top = made.look.window
    assert not ((x[:, 0] >= left) & (x[:, 0] <= right) & (x[:, 1] >= bottom) & (x[:, 1] <= top)).all()
    assert leaves(bad.motion, made.look.view, (-1e300, 1e300, -1e300, 1e300)) != bad.left
    assert len(list(made.frames(quiet))) == len(made.steps)


@pytest.mark.rotating(3, in_turn=True)
def test_a_spring_that_is_broken_is_drawn_no_more() -> None:
    """From the step after it broke on, in its own panel; what it would be stretched by has no part in the colours."""
    setup = find("chain").setup({"masses": 5, "breaking_force": 0.8}, duration=0.25)
    breaking, soft = (catalogued()[name] for name in ("kick_drift", "euler"))
    made = film(compare(setup, [breaking, soft]), ["kick_drift", "euler"])
    times = []
    for shot in made.shots:
        drawn = [
            len(lines(system, made.positions(shot, step), made.look, colour_map()).segments)
            for step, system in zip(made.steps, made.systems(shot.motion), strict=True)
        ]
        broke = [change.step(setup.dt) for change in breaks_of(setup.system, shot.motion, setup.dt)]
        assert drawn == [5 - sum(step > at for at in broke) for step in made.steps]
        times.append(broke)
    assert times[0][0] > 0
    assert times[0] != times[1]
    assert made.look.most < 0.5
    assert look_at(setup.system, [made.shots[0].motion]).most > 1  # without the breaks


def test_strain_is_length_over_rest_length_less_one() -> None:
    """A spring of 0.125 m stretched by 0.01 m: 8 %. One whose rest length changes on the fly is measured by the new."""
    setup = Setup("spring", find("spring").system({}), 1e-3, 0.01, (Change(0.005, "rest_length", 0.1),))
    before, after = setup.systems_at([5, 6])
    x = setup.system.positions
    assert strain(before, x) == pytest.approx([0.01 / 0.125], rel=1e-12)
    assert strain(after, x) == pytest.approx([0.035 / 0.1], rel=1e-12)


def two_planes() -> MassSpringSystem:
    """Eight springs in the plane nearer to the eye, and then eight in the one behind; no two of the same stretch."""
    x, z = np.meshgrid(np.arange(9.0), [1.0, 0.0])
    j = np.arange(8)
    return MassSpringSystem(
        positions=np.column_stack([x.ravel(), np.zeros(18), z.ravel()]),
        springs=np.concatenate([np.column_stack([j, j + 1]), np.column_stack([j + 9, j + 10])]),
        masses=np.array(0.02),
        rest_lengths=1.0 + 0.01 * np.arange(16),
        stiffness=np.array(200.0),
    )


def test_the_farther_is_drawn_before_the_nearer_and_what_is_as_far_in_its_order() -> None:
    """Which of two springs is on top must not depend on how a machine sorts; their colours go with them."""
    system = two_planes()
    view = View(np.zeros(3), np.eye(3), 100.0)
    look = Look(view, (-1.0, 9.0, -1.0, 1.0), 0.2, (0.0, 1.0), None)
    drawn = lines(system, system.positions, look, colour_map())
    order = [*range(8, 16), *range(8)]
    places = view.project(system.positions)[0]
    assert drawn.segments.tolist() == places[system.springs[order]].tolist()
    shades = colour_map()(0.5 + strain(system, system.positions)[order] / 0.4)
    assert drawn.colours[:, :3].tolist() == shades[:, :3].tolist()
    assert drawn.colours[:, 3].tolist() == [FAR] * 8 + [1.0] * 8
    assert not drawn.hidden.any()


def test_perspective_is_that_of_a_pinhole() -> None:
    """A length across the view, seen from distance d, is larger by d / (d - nearer); behind the eye is no place."""
    view = View(np.zeros(3), np.eye(3), 4.0)
    places, nearer = view.project(np.array([[0.1, 0.2, 0.0], [0.1, 0.2, 2.0], [0.1, 0.2, 5.0]]))
    assert places[:2] == pytest.approx(np.array([[0.1, 0.2], [0.2, 0.4]]))
    assert np.isnan(places[2]).all()
    assert nearer.tolist() == [0, 2, 5]
    cloth = view_of(find("cloth").system({}).positions)
    assert cloth.axes @ cloth.axes.T == pytest.approx(np.eye(3), abs=1e-15)
    assert np.linalg.det(cloth.axes) == pytest.approx(1)


@pytest.mark.rotating(3, in_turn=True)
def test_a_sphere_is_seen_as_large_as_it_is_and_hides_what_is_behind() -> None:
    """From distance d a sphere of radius r covers a disc of radius r d / sqrt(d^2 - r^2); to a pixel and a half."""
    view, window = View(np.zeros(3), np.eye(3), 4.0), (-2.0, 2.0, -2.0, 2.0)
    seen = obstacle_image([Sphere((0.0, 0.0, 0.0), 1.0)], view, window)
    assert seen is not None
    pixel = 4.0 / len(seen.image)
    radius = math.sqrt((seen.image[..., 3] > 0).sum() * pixel**2 / math.pi)
    assert radius == pytest.approx(4 / math.sqrt(15), abs=1.5 * pixel)
    places = np.array([[0.0, 0.0], [0.0, 0.0], [1.5, 0.0], [np.nan, 0.0]])
    assert seen.hides(places, np.array([0.5, 1.2, -3.0, 0.0]), 0.01).tolist() == [True, False, False, False]
    assert seen.depth.max() == pytest.approx(1, abs=1e-3)


def test_a_circle_in_the_plane_is_as_large_as_it_is() -> None:
    """The barrier's, by its area, to a hundredth; a floor fills what is below it."""
    system = find("barrier").system({})
    look = look_at(system, [of("heun", setup=Setup("barrier", system, 1e-3, 0.5)).runs[0].outcome.trajectory])  # type: ignore[list-item]
    assert look.obstacles is not None
    covered = look.obstacles.image[..., 3]
    left, right, bottom, top = look.window
    circle = system.obstacles[0]
    inside = (right - left) * (top - bottom) * covered.mean()
    assert inside <= math.pi * circle.radius**2 * 1.01  # type: ignore[attr-defined]
    flat = replace(system, obstacles=(Plane((0.0, -2.0), (0.0, 1.0)),))
    seen = obstacle_image(flat.obstacles, look.view, (-1.0, 1.0, -3.0, -1.0))
    assert seen is not None
    assert seen.image[..., 3].mean() == pytest.approx(0.5, abs=0.01)


def test_nothing_to_show_is_said() -> None:
    """Where no stepper has left a motion."""
    comparison = compare(SETUP, [EngineStepper(Misbehaving(Segfaults))])
    with pytest.raises(InputError, match="nothing to show of string"):
        film(comparison)


WORDS = ("compare", "string", "--stepper", "heun", "--duration", "0.04")


@pytest.mark.rotating(3, in_turn=True)
def test_compare_animates_beside_its_table(tmp_path: Path) -> None:
    """A file of its own name, or the scene's in OUT; standard output stays JSON; nothing else is left."""
    said = springlab(*WORDS, "--json", "--animate", str(tmp_path / "new" / "a.gif"))
    assert (said.code, said.err) == (0, f"written: {tmp_path / 'new' / 'a.gif'}\n")
    assert said.out.startswith("{")
    assert [file.name for file in (tmp_path / "new").iterdir()] == ["a.gif"]
    said = springlab(*WORDS, "--out", str(tmp_path / "out"), "--animate")
    assert said.code == 0
    assert {file.suffix for file in (tmp_path / "out").iterdir()} == {".csv", ".json", ".gif"}
    assert (tmp_path / "out" / "string.gif").stat().st_size > 1000


def check_refused(path: Path, text: str, *words: str) -> None:
    """One line that says it, exit code 2, nothing on standard output: nothing was run."""
    said = springlab(*WORDS, "--animate", str(path), *words)
    assert (said.code, said.out, said.err.count("\n")) == (2, "", 1)
    assert text in said.err


def test_what_cannot_be_written_is_said_before_anything_is_run(tmp_path: Path) -> None:
    """Unknown ending, folder, a file in place of a folder, too long; and nothing is left behind."""
    (tmp_path / "file").write_text("")
    (tmp_path / "folder.gif").mkdir()
    check_refused(tmp_path / "a.mpg", "expected a file name that ends in .gif or .mp4")
    check_refused(tmp_path / "folder.gif", "expected a file, this is a folder")
    check_refused(tmp_path / "file" / "a.gif", f"springlab: {tmp_path / 'file' / 'a.gif'}: ")
    check_refused(tmp_path / "a.gif", "expected at most 30 s", "--slow", "1e4")
    check_refused(tmp_path / "a.gif", "slow = -1: expected a finite number > 0", "--slow", "-1")
    assert {file.name for file in tmp_path.iterdir()} == {"file", "folder.gif"}


@pytest.mark.skipif(find_spec("imageio_ffmpeg") is not None, reason="imageio-ffmpeg is installed")
def test_mp4_without_its_package_says_what_to_install(tmp_path: Path) -> None:
    """And what does without."""
    check_refused(tmp_path / "a.mp4", "pip install 'springlab[video]', or a name that ends in .gif")


def test_a_disk_that_is_full_is_told_of_the_file_that_was_asked_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The old file stays as it was."""
    (tmp_path / "a.gif").write_text("old")

    def full(self: Image.Image, *_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Image.Image, "save", full)
    said = springlab(*WORDS, "--json", "--animate", str(tmp_path / "a.gif"))
    assert (said.code, said.err) == (2, f"springlab: {tmp_path / 'a.gif'}: No space left on device\n")
    assert [(file.name, file.read_text()) for file in tmp_path.iterdir()] == [("a.gif", "old")]
