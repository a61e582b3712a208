"""Ways to break Bullet: meshes that are no meshes."""

from __future__ import annotations

from pathlib import Path

from engines.crash_cases import crash_case, numbers


def _bullet_mesh(vertices: str, faces: str) -> str:
    """A soft body of this mesh in a deformable world, and a step."""
    import pybullet

    client = pybullet.connect(pybullet.DIRECT)
    pybullet.resetSimulation(pybullet.RESET_USE_DEFORMABLE_WORLD, physicsClientId=client)
    Path("mesh.obj").write_text("".join(f"v {v}\n" for v in vertices.split(", ")) + faces)
    body = pybullet.loadSoftBody("mesh.obj", mass=1.0, useMassSpring=1, springElasticStiffness=100.0)
    pybullet.stepSimulation(physicsClientId=client)
    return numbers(pybullet.getMeshData(body, -1, flags=pybullet.MESH_DATA_SIMULATION_MESH)[1])


@crash_case("pybullet")
def a_repeated_index() -> str:
    """Load a triangle that has a corner twice."""
    return _bullet_mesh("0 0 0, 1 0 0, 0 1 0", "f 1 2 2\n")


@crash_case("pybullet")
def a_triangle_without_area() -> str:
    """Load a triangle that has its corners in a row, and nothing else."""
    return _bullet_mesh("0 0 0, 1 0 0, 2 0 0", "f 1 2 3\n")


@crash_case("pybullet")
def an_index_out_of_range() -> str:
    """Load a triangle with a fourth corner of three."""
    return _bullet_mesh("0 0 0, 1 0 0, 0 1 0", "f 1 2 4\n")


@crash_case("pybullet")
def a_corner_that_is_not_finite() -> str:
    """Load a triangle with a corner at NaN."""
    return _bullet_mesh("0 0 0, nan 0 0, 0 1 0", "f 1 2 3\n")


@crash_case("pybullet")
def triangles_that_touch_at_a_corner_only() -> str:
    """Load two triangles without a side in common."""
    return _bullet_mesh("0 0 0, 1 0 0, 0 1 0, -1 0 0, 0 -1 0", "f 1 2 3\nf 1 4 5\n")


@crash_case("pybullet")
def no_triangles() -> str:
    """Load a mesh that has corners only."""
    return _bullet_mesh("0 0 0, 1 0 0, 0 1 0", "")
