"""Obstacles behind the masses, pixel by pixel against closed forms: where they are, how near, how bright."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from reference.obstacles import Circle, Obstacle, Plane, Sphere
from reference.state import Array
from report.film.obstacle_image import LIGHT_FROM, ObstacleImage, obstacle_image
from report.film.view import View, Window

#: Looked at from the side and from above, at what is not the origin.
TURNED = View(
    np.array([1.0, 2.0, 3.0]), np.array([[0.8, 0.0, -0.6], [-0.36, 0.8, -0.48], [0.48, 0.6, 0.64]]), distance=5.0
)
STRAIGHT = View(np.zeros(3), np.eye(3), distance=5.0)
FLAT = View(np.zeros(2), np.eye(2), np.inf)


@pytest.fixture(autouse=True)
def few_pixels(monkeypatch: pytest.MonkeyPatch) -> None:
    """Eighty on the longer side do for all but their number."""
    monkeypatch.setattr("report.film.obstacle_image.PIXELS", 80)


def seen(obstacles: Sequence[Obstacle], view: View, window: Window) -> ObstacleImage:
    """The image; there is one."""
    image = obstacle_image(obstacles, view, window)
    assert image is not None
    return image


def centres(image: ObstacleImage) -> Array:
    """The middles of its pixels, shape (h, w, 2) [m]."""
    (left, right, bottom, top), (high, wide, _) = image.window, image.image.shape
    x = left + (right - left) * (np.arange(wide) + 0.5) / wide
    y = bottom + (top - bottom) * (np.arange(high) + 0.5) / high
    return np.stack(np.meshgrid(x, y), axis=-1)


def test_pixels_are_square_and_as_fine_as_a_screen(monkeypatch: pytest.MonkeyPatch) -> None:
    """Some 560 along the longer side, whichever that is; nothing is drawn of no obstacle."""
    monkeypatch.undo()
    below = Plane((0.0, 0.0), (0.0, 1.0))
    assert seen([below], FLAT, (-1.0, 3.0, 0.0, 2.0)).image.shape == (280, 560, 4)
    assert seen([below], FLAT, (1.0, 2.0, -3.0, 1.0)).image.shape == (560, 140, 4)
    assert obstacle_image([], FLAT, (0.0, 1.0, 0.0, 1.0)) is None


@pytest.mark.parametrize("height", [0.9, 1.13, 2.5])
def test_a_pixel_is_covered_by_as_much_as_a_floor_covers_of_it(height: float) -> None:
    """The part of it that is below; in one grey; nothing is behind what is in the plane."""
    image = seen([Plane((5.0, height), (0.0, 1.0))], FLAT, (-1.0, 3.0, 1.0, 3.0))
    pixel = 4.0 / 80
    bottoms = 1.0 + pixel * np.arange(40)
    covered = np.clip((height - bottoms) / pixel, 0, 1)
    assert image.image[..., 3] == pytest.approx(np.tile(covered[:, None], (1, 80)), abs=1e-9)
    shades = np.unique(image.image[..., :3])
    assert len(shades) == 1
    assert 0.5 < shades[0] < 1
    assert (image.depth == -np.inf).all()


def test_two_circles_are_seen_where_each_is() -> None:
    """Each as if the other were not there, as they do not touch; its middle of mass is its centre."""
    left, right = Circle((0.5, 0.5), 0.3), Circle((2.0, 1.2), 0.5)
    window = (0.0, 4.0, 0.0, 2.0)
    alone = [seen([circle], FLAT, window) for circle in (left, right)]
    both = seen([left, right], FLAT, window)
    assert both.image[..., 3] == pytest.approx(np.maximum(*(image.image[..., 3] for image in alone)))
    for circle, image in zip((left, right), alone, strict=True):
        covers = image.image[..., 3]
        middle = (centres(image) * covers[..., None]).sum(axis=(0, 1)) / covers.sum()
        assert middle == pytest.approx(circle.centre, abs=0.01)
        assert covers.sum() * 0.05**2 == pytest.approx(np.pi * circle.radius**2, rel=0.02)


def hits(sphere: Sphere, view: View, places: Array) -> tuple[Array, Array, Array]:
    """Rays on a sphere by the quadratic formula: how far inside of its outline [m^2], where it is hit, the normal."""
    eye, rays = view.rays(places)
    off = eye - np.array(sphere.centre)
    along = (rays * off).sum(axis=-1)
    root = along**2 - (off**2).sum() + sphere.radius**2
    points = eye + (-along - np.sqrt(np.maximum(root, 0)))[..., None] * rays
    return root, points, (points - np.array(sphere.centre)) / sphere.radius


@pytest.mark.parametrize("view", [STRAIGHT, TURNED], ids=["straight", "turned"])
def test_a_sphere_is_as_near_and_as_bright_as_it_is_in_every_pixel(view: View) -> None:
    """Light falls from the viewer's upper left: brightest where it comes straight, no darker than in the shade."""
    sphere = Sphere(tuple((view.middle + np.array([0.3, 0.2, -0.4])).tolist()), 0.8)
    image = seen([sphere], view, (-1.5, 1.5, -1.0, 1.5))
    root, points, normals = hits(sphere, view, centres(image))
    inside, beyond = root > 0.02, root < -0.02
    towards = view.axes[2]
    assert image.depth[inside] == pytest.approx((points - view.middle)[inside] @ towards, abs=0.01)
    assert (image.depth[beyond] == -np.inf).all()
    assert (image.image[beyond, 3] == 0).all()
    assert np.unique(image.image[inside, 3]).size == 1
    assert 0.8 < image.image[inside, 3].min() < 1
    lit = np.clip(normals @ (view.axes.T @ np.array(LIGHT_FROM)), 0, 1)
    shade, light = image.image[inside].min(), image.image[inside, 0].max()
    assert 0.5 < shade < 0.7 < 0.9 < light < 1
    assert image.image[inside, 0] == pytest.approx(shade + (light - shade) * (lit / lit.max())[inside], abs=0.01)
    assert (image.image[..., 0] == image.image[..., 2]).all()


def test_light_comes_from_the_left_and_above_and_a_little_from_the_eye() -> None:
    """A unit vector: to the right, upwards, towards the eye."""
    right, up, towards = LIGHT_FROM
    assert np.linalg.norm(LIGHT_FROM) == pytest.approx(1)
    assert right < 0 < towards < up


def test_of_two_spheres_the_nearer_is_in_front() -> None:
    """With its depth and its shading, as if the other were not there; whichever is named first."""
    near, far = Sphere((0.2, 0.0, 1.0), 0.4), Sphere((0.0, 0.1, -1.0), 0.9)
    window = (-1.0, 1.0, -1.0, 1.0)
    one, other = (seen([sphere], STRAIGHT, window) for sphere in (near, far))
    in_front = one.depth > -np.inf
    for obstacles in ([near, far], [far, near]):
        both = seen(obstacles, STRAIGHT, window)
        assert both.depth[in_front] == pytest.approx(one.depth[in_front], abs=0.01)
        assert np.mean(np.abs(both.image[in_front] - one.image[in_front]).max(axis=-1) < 1e-6) > 0.98
        beside = hits(near, STRAIGHT, centres(both))[0] < -0.05
        clear = beside & (other.depth > -np.inf)
        assert np.array_equal(both.depth[beside] > -np.inf, other.depth[beside] > -np.inf)
        assert both.image[clear] == pytest.approx(other.image[clear], abs=0.01)


def test_a_floor_fades_away_from_the_middle() -> None:
    """As it is from 0.45 of the eye's distance inwards, nothing from 0.9 outwards, in between as the distance."""
    view = View(np.zeros(3), np.array([[1.0, 0.0, 0.0], [0.0, 0.8, -0.6], [0.0, 0.6, 0.8]]), distance=4.0)
    image = seen([Plane((0.0, -0.1, 0.0), (0.0, 1.0, 0.0))], view, (-4.0, 4.0, -4.0, 4.0))
    eye, rays = view.rays(centres(image))
    far = (-0.1 - eye[1]) / rays[..., 1]
    points = eye + far[..., None] * rays
    away = np.linalg.norm(points, axis=-1) / 4.0
    wanted = np.where(far > 0, np.clip((0.9 - away) / 0.45, 0, 1), 0)
    covers = image.image[..., 3]
    assert covers / covers.max() == pytest.approx(wanted, abs=0.01)
    assert np.array_equal(image.depth > -np.inf, covers > 0)
    assert image.depth[covers > 0] == pytest.approx((points @ view.axes[2])[covers > 0], abs=0.01)


def test_a_place_is_hidden_by_the_pixel_it_is_in() -> None:
    """By more than the slack; on the lower and left border too, but nothing beyond any border, nor what is nowhere."""
    depth = np.array([[1.0, 2.0, 3.0], [4.0, 5.0, -np.inf]])
    image = ObstacleImage((10.0, 13.0, 20.0, 22.0), np.zeros((2, 3, 4)), depth)
    x, y = np.meshgrid([10.5, 11.5, 12.5], [20.5, 21.5])
    places = np.column_stack([x.ravel(), y.ravel()])
    assert image.hides(places, depth.ravel() - 0.2, slack=0.1).tolist() == [True] * 5 + [False]
    assert not image.hides(places, depth.ravel() - 0.1, slack=0.1).any()
    edges = np.array(
        [[10.0, 20.0], [13.0, 20.5], [12.5, 22.0], [9.9, 20.5], [10.5, 19.9], [np.nan, 20.5], [10.5, np.nan]]
    )
    assert image.hides(edges, np.full(7, -9.0), slack=0.0).tolist() == [True] + [False] * 6
