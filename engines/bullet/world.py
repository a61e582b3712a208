"""A Bullet world with soft bodies, by the C functions that Bullet's Python module is made of.

Bullet's Python functions neither read nor set the velocities of a soft body. The C functions beneath them do (Bullet's
PhysicsClientC_API.h), and the extension module exports them: they are called here through ctypes, one world per run.
"""

from __future__ import annotations

import ctypes
import tempfile
import weakref
from collections.abc import Callable
from functools import cache
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from reference.scratch import owner_prefix
from reference.state import Array

#: Constants of Bullet's header files (SharedMemoryPublic.h).
RESET_USE_DEFORMABLE_WORLD = 1
DISABLE_SLEEPING = 2


class MeshData(ctypes.Structure):
    """What Bullet answers about a mesh: how many nodes, and four numbers for each (the last is unused)."""

    _fields_ = [("nodes", ctypes.c_int), ("values", ctypes.c_void_p)]


class World:
    """One empty Bullet world, by the C functions that Bullet's Python module is made of.

    Each function of Bullet's fills in a command; `_send` carries it out.
    """

    def __init__(self) -> None:
        self._bullet = library()
        self._submit = self._bullet.b3SubmitClientCommandAndWaitStatus
        self._advance = self._bullet.b3InitStepSimulationCommand
        self._mesh = MeshData()
        self._mesh_reference = ctypes.byref(self._mesh)
        self._client = self._bullet.b3ConnectPhysicsDirect()
        weakref.finalize(self, self._bullet.b3DisconnectSharedMemory, self._client)

    def reset(self, dt: float) -> None:
        """Empty the world, for soft bodies and steps of dt [s], without gravity."""
        command = self._bullet.b3InitResetSimulationCommand(self._client)
        self._bullet.b3InitResetSimulationSetFlags(command, RESET_USE_DEFORMABLE_WORLD)
        self._send(command)
        command = self._bullet.b3InitPhysicsParamCommand(self._client)
        self._bullet.b3PhysicsParamSetTimeStep(command, dt)
        # A mesh file is otherwise remembered by its name, whatever is in it.
        self._bullet.b3PhysicsParamSetEnableFileCaching(command, 0)
        self._send(command)
        self.set_gravity(np.zeros(3))

    def set_gravity(self, gravity: Array) -> None:
        """Gravity [m/s^2], shape (3,)."""
        command = self._bullet.b3InitPhysicsParamCommand(self._client)
        self._bullet.b3PhysicsParamSetGravity(command, *gravity)
        self._send(command)

    def load(self, obj: str, mass: float, stiffness: float, damping: float, bending: float = 0.0) -> int:
        """A soft body of this mesh, awake for ever; its number.

        Args:
            obj: the mesh, in the text format OBJ.
            mass: of all nodes together [kg].
            stiffness: of the edges [N/m].
            damping: of all springs [N s/m].
            bending: stiffness of springs between all nodes two edges apart [N/m]; 0 for none.
        """
        with tempfile.TemporaryDirectory(prefix=owner_prefix()) as folder:
            file = Path(folder) / "mesh.obj"
            file.write_text(obj)
            command = self._bullet.b3LoadSoftBodyCommandInit(self._client, bytes(file))
            self._bullet.b3LoadSoftBodySetMass(command, mass)
            self._bullet.b3LoadSoftBodyAddMassSpringForce(command, stiffness, damping)
            # Unless told otherwise there are bending springs of 0.1 N/m, even when switched off.
            self._bullet.b3LoadSoftBodyUseBendingSprings(command, bending > 0, bending)
            self._bullet.b3LoadSoftBodyUseAllDirectionDampingSprings(command, 0)
            body = int(self._bullet.b3GetStatusBodyIndex(self._send(command)))
        if body < 0:
            raise RuntimeError("Bullet could not load the mesh")
        command = self._bullet.b3InitChangeDynamicsInfo(self._client)
        self._bullet.b3ChangeDynamicsInfoSetActivationState(command, body, DISABLE_SLEEPING)
        self._send(command)
        return body

    def pin(self, body: int, node: int) -> None:
        """Fix a node where it is."""
        nowhere = (ctypes.c_double * 3)()
        self._send(self._bullet.b3InitCreateSoftBodyAnchorConstraintCommand(self._client, body, node, -1, -1, nowhere))

    def add_sphere(self, centre: Array, radius: float) -> None:
        """A sphere that never moves; centre (3,) [m], radius [m]."""
        command = self._bullet.b3CreateCollisionShapeCommandInit(self._client)
        self._bullet.b3CreateCollisionShapeAddSphere(command, radius)
        self._add_static(command, centre)

    def _add_static(self, shape_command: int, place: Array) -> None:
        """A body without mass or friction, of the shape that a command makes."""
        shape = int(self._bullet.b3GetStatusCollisionShapeUniqueId(self._send(shape_command)))
        command = self._bullet.b3CreateMultiBodyCommandInit(self._client)
        straight, nowhere = _vector(0.0, 0.0, 0.0, 1.0), _vector(0.0, 0.0, 0.0)
        self._bullet.b3CreateMultiBodyBase(command, 0.0, shape, -1, _vector(*place), straight, nowhere, straight)
        body = int(self._bullet.b3GetStatusBodyIndex(self._send(command)))
        command = self._bullet.b3InitChangeDynamicsInfo(self._client)
        self._bullet.b3ChangeDynamicsInfoSetLateralFriction(command, body, -1, 0.0)
        self._send(command)

    def step(self) -> None:
        """Advance by dt."""
        client = self._client
        self._submit(client, self._advance(client))

    def bare_step(self) -> Callable[[], object]:
        """As `step`, for a loop that does nothing else."""
        client, submit, advance = self._client, self._submit, self._advance
        return lambda: submit(client, advance(client))

    def positions(self, body: int) -> Array:
        """Of all nodes [m], shape (nodes, 3)."""
        command = self._bullet.b3GetMeshDataCommandInit(self._client, body, -1)
        return self._mesh_data(command)

    def velocities(self, body: int) -> Array:
        """Of all nodes [m/s], shape (nodes, 3)."""
        command = self._bullet.b3GetMeshDataCommandInit(self._client, body, -1)
        self._bullet.b3MeshDataSimulationMeshVelocity(command)
        return self._mesh_data(command)

    def set_positions(self, body: int, positions: Array) -> None:
        """Put all nodes somewhere [m], shape (nodes, 3)."""
        self._send(self._upload(body, positions))

    def set_velocities(self, body: int, velocities: Array) -> None:
        """Give all nodes velocities [m/s], shape (nodes, 3)."""
        command = self._upload(body, velocities)
        self._bullet.b3MeshDataSimulationMeshVelocity(command)
        self._send(command)

    def _upload(self, body: int, values: Array) -> int:
        values = np.ascontiguousarray(values)
        return int(self._bullet.b3ResetMeshDataCommandInit(self._client, body, len(values), values.ctypes.data))

    def _mesh_data(self, command: int) -> Array:
        # Of the mesh it simulates, not of the copy it would draw.
        self._bullet.b3GetMeshDataSimulationMesh(command)
        self._submit(self._client, command)
        self._bullet.b3GetMeshData(self._client, self._mesh_reference)
        # A copy: the memory is Bullet's, which answers the next question in the same place.
        copy = ctypes.string_at(self._mesh.values, 8 * 4 * self._mesh.nodes)
        return np.frombuffer(copy).reshape(-1, 4)[:, :3]

    def _send(self, command: int) -> int:
        return int(self._submit(self._client, command))


def _vector(*numbers: float) -> ctypes.Array[ctypes.c_double]:
    return (ctypes.c_double * len(numbers))(*numbers)


@cache
def library() -> ctypes.CDLL:
    """Bullet's library with the types of the functions used here.

    Raises:
        ModuleNotFoundError: where pybullet is not installed.
    """
    found = find_spec("pybullet")
    if found is None or found.origin is None:
        raise ModuleNotFoundError("No module named 'pybullet'", name="pybullet")
    bullet = ctypes.CDLL(found.origin)
    handle, number, real, text = ctypes.c_void_p, ctypes.c_int, ctypes.c_double, ctypes.c_char_p
    for name, result, *arguments in (
        ("b3ConnectPhysicsDirect", handle),
        ("b3DisconnectSharedMemory", None, handle),
        ("b3SubmitClientCommandAndWaitStatus", handle, handle, handle),
        ("b3InitResetSimulationCommand", handle, handle),
        ("b3InitResetSimulationSetFlags", number, handle, number),
        ("b3InitPhysicsParamCommand", handle, handle),
        ("b3PhysicsParamSetTimeStep", number, handle, real),
        ("b3PhysicsParamSetGravity", number, handle, real, real, real),
        ("b3PhysicsParamSetEnableFileCaching", number, handle, number),
        ("b3LoadSoftBodyCommandInit", handle, handle, text),
        ("b3LoadSoftBodySetMass", number, handle, real),
        ("b3LoadSoftBodyAddMassSpringForce", number, handle, real, real),
        ("b3LoadSoftBodyUseBendingSprings", number, handle, number, real),
        ("b3LoadSoftBodyUseAllDirectionDampingSprings", number, handle, number),
        ("b3GetStatusBodyIndex", number, handle),
        ("b3InitChangeDynamicsInfo", handle, handle),
        ("b3ChangeDynamicsInfoSetActivationState", number, handle, number, number),
        ("b3InitCreateSoftBodyAnchorConstraintCommand", handle, handle, number, number, number, number, handle),
        ("b3CreateCollisionShapeCommandInit", handle, handle),
        ("b3CreateCollisionShapeAddSphere", number, handle, real),
        ("b3GetStatusCollisionShapeUniqueId", number, handle),
        ("b3CreateMultiBodyCommandInit", handle, handle),
        ("b3CreateMultiBodyBase", number, handle, real, number, number, handle, handle, handle, handle),
        ("b3ChangeDynamicsInfoSetLateralFriction", number, handle, number, number, real),
        ("b3InitStepSimulationCommand", handle, handle),
        ("b3GetMeshDataCommandInit", handle, handle, number, number),
        ("b3GetMeshDataSimulationMesh", None, handle),
        ("b3MeshDataSimulationMeshVelocity", None, handle),
        ("b3GetMeshData", None, handle, handle),
        ("b3ResetMeshDataCommandInit", handle, handle, number, number, handle),
    ):
        function = getattr(bullet, name)
        function.restype, function.argtypes = result, arguments
    return bullet
