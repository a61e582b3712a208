"""Bullet on cloth, jello and plane meshes: what has triangles, what gets an apex, and what is refused."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from engines.bullet.mesh import apex_height, bending_apart, mesh_of, side_by_side, sorted_pairs
from engines.bullet.rest_shape import rest_shape
from engines.bullet.softbody import in_space
from engines.capability_cases import for_each_capability
from engines.engine import find, version
from reference.changes import Change
from reference.errors import Unsupported
from reference.obstacles import Plane, Sphere
from reference.scenes import find as find_scene
from reference.system import MassSpringSystem
from tests.conformance.case import Case
from tests.conformance.checks import check_follows
from tests.conformance.runs import outcomes
from tests.engines.meshes import (
    PLACES,
    cloth,
    jello,
    ladder,
    lifted,
    many_sided,
    on_springs,
    random_cases,
    shaken,
    stiff_bends,
    truss,
)

BULLET = find("bullet_softbody")

needs_bullet = pytest.mark.skipif(version(BULLET) is None, reason="pybullet is not installed")


MESHES = {
    "cloth": cloth(),
    "jello": jello(),
    "rough cloth": cloth(7, rough=0.02, drag=0.01),
    "rough jello": jello(3, rough=0.02, drag=0.01),
    "damped cloth": cloth(7, rough=0.02, damping=0.05),
    "damped jello": jello(3, rough=0.02, damping=0.05),
    "cloth, bends in a row": cloth(6, bends=True, damping=0.02),
    "cloth with softer bends": stiff_bends(cloth(6, damping=0.02)),
    "jello with softer bends": stiff_bends(jello(3)),
    "cloth off its rest lengths": shaken(cloth(6, rough=0.02, damping=0.02)),
    "jello off its rest lengths": shaken(jello(3, damping=0.02)),
    "truss": truss(damping=0.05, drag=0.01),
    "truss off its rest lengths": shaken(truss(damping=0.05)),
    "ladder": ladder(damping=0.05),
    "ladder in space": shaken(lifted(ladder())),
    "triangles at a corner": on_springs(
        PLACES, [[0, 1], [1, 2], [2, 0], [2, 3], [3, 4], [4, 2]], [0], velocities=[[0.0, 0.0, 0.0], *PLACES[1:]]
    ),
    # no surface of anything solid: sides of more than two triangles, no inside and outside, solids that share a side
    "ten triangles on a side": many_sided([(0, 1, 2 + i) for i in range(10)], damping=0.02),
    "a strip turned once": many_sided([(i, (i + 1) % 9, (i + 2) % 9) for i in range(9)], damping=0.02),
    "tetrahedra at a side": many_sided([(0, 1, 2), (0, 1, 3), (0, 2, 3), (0, 1, 4), (0, 1, 5), (0, 4, 5)]),
    "every two of six": many_sided([(a, b, c) for a in range(6) for b in range(a) for c in range(b)]),
    "a cloth let go": replace(cloth(5), fixed=np.zeros(25, dtype=bool)),
    # a fixed mass may have any: it is not asked for, and what is free is not as heavy
    "heavy corners": replace(cloth(5, drag=0.01), masses=np.where(cloth(5).fixed, 3.0, 0.01)),
}

#: Far above all of them: the triangles to an apex would reach it.
ABOVE = Sphere((0.3, 0.3, 40.0), 1.0)

MESHES["cloth below a sphere"] = replace(cloth(5, damping=0.02), obstacles=(ABOVE,))

CASES = [Case(name, system, 1e-3, 200) for name, system in MESHES.items()]

CHANGES = [Change(0.05, "stiffness", 80.0), Change(0.1, "damping", 0.1), Change(0.15, "gravity", 1.62)]


@pytest.mark.rotating(4)
@needs_bullet
def test_bullet_steps_meshes_as_claimed() -> None:
    """Over 200 steps max |x_bullet - x_scheme| <= 1e-12 of the size; 8.3e-16 m was measured on the cloth."""
    assert len(MESHES["cloth"].springs) == 161
    assert len(MESHES["jello"].springs) == 279
    cases = [*CASES, *random_cases(16)]
    for case, outcome in zip(cases, outcomes(BULLET, cases), strict=True):
        check_follows(BULLET, case, outcome)


@needs_bullet
def test_parameters_of_a_mesh_change_on_the_fly() -> None:
    """The world is built anew in the midst of the motion, with the rest lengths there were."""
    cases = [Case(name, MESHES[name], 1e-3, 200, CHANGES) for name in ("rough cloth", "rough jello", "truss")]
    for case, outcome in zip(cases, outcomes(BULLET, cases), strict=True):
        check_follows(BULLET, case, outcome)


@needs_bullet
def test_a_spring_too_many_or_a_wrong_rest_length_would_show() -> None:
    """Shown to fail: Bullet's motion of a cloth is not the scheme's of the cloth less a diagonal, nor of one longer."""
    right = MESHES["rough cloth"]
    (outcome,) = outcomes(BULLET, [Case("right", right, 1e-3, 200)])
    fields = ("springs", "rest_lengths", "stiffness", "damping")
    less = replace(right, **{name: getattr(right, name)[:-1] for name in fields})
    longer = replace(right, rest_lengths=right.rest_lengths * (1 + 1e-8))
    for wrong in (less, longer):
        with pytest.raises(AssertionError):
            check_follows(BULLET, Case("wrong", wrong, 1e-3, 200), outcome)


REFUSED = {
    "damping in three dimensions unless triangles of springs, side by side, have all springs for sides: the one "
    "between masses 0 and 1 is not reached": lifted(ladder(damping=0.01)),
    "obstacles in three dimensions unless triangles of springs, side by side, have all springs for sides": replace(
        lifted(ladder()), obstacles=(Plane((0.0, -9.0, 0.0), (0.0, 1.0, 0.0)),)
    ),
    "a sphere": replace(lifted(ladder()), obstacles=(ABOVE,)),
    "several pieces: no springs lead from mass 0 to mass 2": on_springs(PLACES[:5], [[0, 1], [2, 3], [3, 4]], [0]),
    "a system without springs": replace(
        find_scene("spring").system({}),
        springs=np.zeros((0, 2), dtype=int),
        rest_lengths=np.zeros(0),
        stiffness=np.zeros(0),
        damping=np.zeros(0),
    ),
    "masses on no spring: mass 2 is on none": on_springs(PLACES[:3], [[0, 1]], [0]),
    "two springs between the same masses: 0 and 1": on_springs(PLACES[:3], [[0, 1], [1, 2], [1, 0]], [0]),
    "springs off their rest lengths where no shape of the mesh has them all": replace(
        jello(2), rest_lengths=np.array(0.1)
    ),
    "springs off their rest lengths on more than 600 masses": shaken(cloth(25)),
    "springs whose stiffness differs": cloth(3, stiffness=np.arange(1.0, 17.0)),
    "stiffness 0": cloth(3, stiffness=0.0),
}


@needs_bullet
@pytest.mark.parametrize("reason", REFUSED)
def test_what_bullet_has_no_mesh_for_is_refused(reason: str) -> None:
    """With the reason, and the spring or mass it lies in."""
    (outcome,) = outcomes(BULLET, [Case(reason, REFUSED[reason], 1e-3, 2)])
    assert outcome.ending == "unsupported"
    assert f"bullet_softbody cannot do {reason}" in outcome.reason


def check_sides(pairs: list[tuple[int, int]], triangles: list[tuple[int, int, int]], nodes: int) -> None:
    """The pairs are the sides of the triangles, the apex aside; and all triangles hang together side by side."""
    sides = [{tuple(sorted(pair)) for pair in ((a, b), (b, c), (a, c))} for a, b, c in triangles]
    assert {side for three in sides for side in three if side[1] < nodes} == set(pairs)
    together, rest = sides[0], sides[1:]
    while beside := [three for three in rest if three & together]:
        together = together.union(*beside)
        rest = [three for three in rest if three not in beside]
    assert not rest


@pytest.mark.parametrize("name", MESHES)
def test_the_triangles_have_the_springs_for_sides(name: str) -> None:
    """Side by side, as Bullet needs them; and a mesh of triangles or tetrahedra needs no apex."""
    system = MESHES[name]
    mesh, edges = mesh_of(system), bending_apart(system)
    chosen = np.ones(len(system.springs), dtype=bool) if edges is None else edges
    check_sides(sorted_pairs(system, chosen), mesh.triangles, mesh.nodes)
    assert mesh.has_apex == (name in {"ladder", "ladder in space", "triangles at a corner"})


def test_the_check_of_sides_sees_a_spring_too_many_and_triangles_apart() -> None:
    """Shown to fail: a side without a spring, a spring that is not a side, and triangles that touch at a corner."""
    triangle = [(0, 1), (0, 2), (1, 2)]
    check_sides(triangle, [(0, 1, 2)], 3)
    for pairs in (triangle[:2], [*triangle, (2, 3)]):
        with pytest.raises(AssertionError):
            check_sides(pairs, [(0, 1, 2)], 4)
    touching = [*triangle, (2, 3), (2, 4), (3, 4)]
    with pytest.raises(AssertionError):
        check_sides(touching, [(0, 1, 2), (2, 3, 4)], 5)
    assert side_by_side(touching) == ([(0, 1, 2)], {(2, 3), (2, 4), (3, 4)})


@pytest.mark.parametrize("name", MESHES)
def test_no_triangle_is_loaded_without_area(name: str) -> None:
    """Twice the area of a triangle is |(b - a) x (c - a)|; in what is read, as single floats, none is below 1e-3.

    A triangle of three points in a row crashes Bullet.
    """
    lines = [line.split() for line in mesh_of(MESHES[name]).obj().splitlines()]
    points = np.array([line[1:] for line in lines if line[0] == "v"], dtype=np.float32).astype(float)
    a, b, c = (points[np.array([line[i] for line in lines if line[0] == "f"], dtype=int) - 1] for i in (1, 2, 3))
    assert np.linalg.norm(np.cross(b - a, c - a), axis=1).min() > 1e-3


def test_springs_for_bending_are_told_from_edges() -> None:
    """Where they are all pairs two edges apart and no others, whichever kind is the stiffer."""
    flat = cloth(4)
    for stiffness in (5.0, 500.0):
        system = stiff_bends(flat, stiffness)
        edges = bending_apart(system)
        assert edges is not None
        assert edges.tolist() == [True] * len(flat.springs) + [False] * (len(system.springs) - len(flat.springs))
        assert (mesh_of(system).stiffness, mesh_of(system).bending) == (50.0, stiffness)
    lacking = replace(
        system, **{name: getattr(system, name)[:-1] for name in ("springs", "rest_lengths", "stiffness", "damping")}
    )
    assert bending_apart(lacking) is None
    assert bending_apart(for_each_capability()["stiffnesses"]) is None


@pytest.mark.parametrize("name", ["cloth off its rest lengths", "jello off its rest lengths", "ladder in space"])
def test_a_shape_with_the_rest_lengths_is_found(name: str) -> None:
    """Max | |x_b - x_a| - l | <= 1e-14 of the size: rounding."""
    system = MESHES[name]
    a, b = system.springs.T
    shape = rest_shape(system, in_space(system.positions))
    assert np.abs(np.linalg.norm(shape[b] - shape[a], axis=1) - system.rest_lengths).max() <= 1e-14 * system.size
    start = np.linalg.norm(system.positions[b] - system.positions[a], axis=1)
    assert np.abs(start - system.rest_lengths).max() > 1e-4


def test_a_mesh_of_any_size_that_has_its_rest_lengths_is_its_own_shape() -> None:
    """None is looked for, which on so many masses would be refused."""
    cloth = find_scene("cloth").system({"rows": 25, "columns": 25})
    a, b = cloth.springs.T
    at_rest = replace(cloth, rest_lengths=np.linalg.norm(cloth.positions[b] - cloth.positions[a], axis=1))
    guess = in_space(cloth.positions)
    assert rest_shape(at_rest, guess) is guess
    with pytest.raises(Unsupported, match="more than 600 masses"):
        rest_shape(replace(cloth, rest_lengths=1.1 * at_rest.rest_lengths), guess)


def test_a_shape_that_cannot_be_is_not_found() -> None:
    """A triangle with a side longer than the other two together."""
    triangle = on_springs(PLACES[:3], [[0, 1], [1, 2], [0, 2]], [0])
    with pytest.raises(Unsupported, match="no shape"):
        rest_shape(replace(triangle, rest_lengths=np.array([0.1, 0.1, 0.3])), triangle.positions)


@pytest.mark.parametrize(("length", "power"), [(0.25, 79), (0.3, 80), (0.5, 80), (0.51, 81)])
def test_the_apex_is_at_the_next_power_of_two(length: float, power: int) -> None:
    """Above 2^80 times how far the system reaches: here from 0 to its length, and as much as its spring is long."""
    system = MassSpringSystem(
        positions=np.array([[0.0, 0.0], [length, 0.0]]),
        springs=np.array([[0, 1]]),
        masses=np.array(1.0),
        rest_lengths=np.array(length),
        stiffness=np.array(1.0),
        fixed=np.array([True, False]),
    )
    assert apex_height(system) == 2.0**power
