"""Obstacles in scene files: the tables [[obstacles]]."""

from __future__ import annotations

from pathlib import Path

import pytest

from reference.errors import InputError
from reference.files.scene_file import load
from reference.obstacles import Circle, Plane, Sphere

CIRCLE = '[[obstacles]]\nkind = "circle"\ncentre = [0.5, -0.6]\nradius = 0.3\n'
FLOOR = '[[obstacles]]\nkind = "plane"\npoint = [0, -2]\nnormal = [0, 2]\n'


def written(folder: Path, text: str) -> Path:
    """A scene file."""
    file = folder / "scene.toml"
    file.write_text(text, encoding="utf-8")
    return file


def test_obstacles_are_added_to_a_scene(tmp_path: Path) -> None:
    """In their order, after the scene's own; the scene's parameters may be set otherwise."""
    string = load(written(tmp_path, f'scene = "string"\n{CIRCLE}{FLOOR}'), {"masses": 5}).system
    assert string.obstacles == (Circle((0.5, -0.6), 0.3), Plane((0.0, -2.0), (0.0, 1.0)))
    assert len(string.masses) == 6
    barrier = load(written(tmp_path, f'scene = "barrier"\n{FLOOR}'), {}).system
    assert [made.kind for made in barrier.obstacles] == ["circle", "plane"]


def test_obstacles_are_added_to_a_system_written_out(tmp_path: Path) -> None:
    """In space too."""
    system = "[system]\npositions = [[0, 0, 0], [1, 0, 0]]\nsprings = [[0, 1]]\nmasses = 1\nstiffness = 1\n"
    sphere = '[[obstacles]]\nkind = "sphere"\ncentre = [0, -2, 0]\nradius = 1\n'
    assert load(written(tmp_path, system + sphere), {}).system.obstacles == (Sphere((0.0, -2.0, 0.0), 1.0),)


@pytest.mark.parametrize(
    ("table", "message"),
    [
        ('kind = "circel"', "obstacles[0]: unknown kind 'circel': did you mean 'circle'?"),
        ("radius = 1", "obstacles[0].kind is missing: expected one of circle, sphere, cylinder, plane, box"),
        ("kind = 3", "obstacles[0].kind = 3: expected one of circle, sphere, cylinder, plane, box"),
        ('kind = "circle"\ncentre = [0, -1]', "obstacles[0].radius is missing: a circle has centre, radius"),
        (
            'kind = "circle"\ncentre = [0, -1]\nradius = -1',
            "line 5: obstacles[0].radius = -1: expected a finite number > 0 [m]",
        ),
        (
            'kind = "circle"\ncentre = "here"\nradius = 1',
            "line 4: obstacles[0].centre = 'here': expected 2 finite numbers [m]",
        ),
        (
            'kind = "circle"\ncentre = [0, 1979-05-27]\nradius = 1',
            "line 4: obstacles[0].centre = [0, datetime.date(1979, 5, 27)]: expected 2 finite numbers [m]",
        ),
        (
            'kind = "sphere"\ncentre = [0, -2, 0]\nradius = 1',
            "obstacles[0] is a sphere in 3D: expected one in 2D",
        ),
        (
            'kind = "plane"\npoint = [0, 1]\nnormal = [0, 1]',
            "positions[1] = [0.125, 0.0]: expected a start outside the plane obstacles[0], it is 1 m inside",
        ),
    ],
)
def test_a_bad_obstacle_is_refused_in_one_line(tmp_path: Path, table: str, message: str) -> None:
    """With the file, the table, what it has and what was expected."""
    with pytest.raises(InputError) as caught:
        load(written(tmp_path, f'scene = "string"\n[[obstacles]]\n{table}\n'), {})
    assert str(caught.value).startswith(f"scene file {tmp_path / 'scene.toml'}")
    assert str(caught.value).endswith(message)
    assert "\n" not in str(caught.value)
