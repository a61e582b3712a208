"""Bullet's deformable mass-spring body as a chain of springs in the plane.

Bullet takes its springs from the edges of a mesh of triangles, and a chain has no triangles. So each link of the chain
gets one, with a common third corner: an apex, pinned at a great height above the plane. The springs to the apex stand
upright on the plane and pull on nothing that moves in it.

Bullet's Python functions neither read nor set the velocities of a soft body. The C functions beneath them do (Bullet's
PhysicsClientC_API.h), and the extension module exports them: they are called here through ctypes, one world per run.
"""

from __future__ import annotations

import ctypes
import tempfile
import weakref
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from engines.engine import Unsupported, refuse_beyond
from reference.state import Array
from reference.system import MassSpringSystem

#: Height of the apex over the plane, in lengths of the chain. From 2^27 on, the length of a spring to the apex is the
#: height, whatever mass hangs on it wherever: the rest is lost in rounding. With a power of two for the height, the
#: direction times the length is exact too, and the spring pulls with exactly no force.
APEX = 2.0**40

#: Constants of Bullet's header files (SharedMemoryPublic.h).
RESET_USE_DEFORMABLE_WORLD = 1
DISABLE_SLEEPING = 2


@dataclass(frozen=True)
class BulletSoftbody:
    """A soft body in Bullet's deformable world, its springs integrated explicitly (Bullet's default)."""

    name: str = "bullet_softbody"
    package: str = "pybullet"
    settings: Mapping[str, object] = field(default_factory=lambda: {"world": "deformable", "apex": APEX})
    capabilities: frozenset[str] = frozenset(
        {"rest_lengths", "stretched", "velocities", "damping", "drag", "tilted gravity"}
    )
    identified_as: Mapping[str, str] = field(
        default_factory=lambda: {"plain": "kick_drift", "damping": "kick_drift_truncated_damping", "drag": "kick_drift"}
    )
    semantics: str = (
        "stiffness is k [N/m]; damping is c [N s/m], implicit, solved until the preconditioned residual is below "
        "1e-8 m/s; drag: Bullet has none, dt Cd/m v is taken off the velocities v before each step"
    )

    def start(self, system: MassSpringSystem, dt: float) -> SoftString:
        """The chain as a soft body, ready for its first step.

        Raises:
            Unsupported: for anything but a chain in the plane, and for one without stiffness.
        """
        refuse_beyond(self, system)
        return SoftString(system, dt)


class SoftString:
    """One chain in a Bullet world of its own: a Simulation.

    Args:
        system: a chain in the plane.
        dt: step [s].
    """

    def __init__(self, system: MassSpringSystem, dt: float) -> None:
        self._dt = dt
        self._system = system
        self._world = World()
        self._build(system)

    def step(self) -> None:
        """Let Bullet advance by dt, after taking off what drag costs the velocities."""
        if self._drag:
            velocities = self._world.velocities(self._body)
            self._world.set_velocities(self._body, velocities - self._drag * velocities)
        self._world.step()

    def state(self) -> tuple[Array, Array]:
        """Positions [m] and velocities [m/s], each (n, 2)."""
        return (
            self._world.positions(self._body)[:-1, :2].copy(),
            self._world.velocities(self._body)[:-1, :2].copy(),
        )

    def change(self, parameter: str, value: float) -> None:
        """Set a parameter on the fly.

        Bullet changes gravity while the world runs, but no property of a soft body: for those the world is built anew
        around the positions and velocities there are. A step depends on nothing else, so nothing is lost.

        Raises:
            Unsupported: for stiffness 0.
        """
        system = self._system.with_parameter(parameter, value)
        if parameter == "gravity":
            self._system = system
            self._world.set_gravity(system.gravity)
            return
        positions, velocities = self.state()
        self._build(replace(system, positions=positions, velocities=velocities))

    def _build(self, system: MassSpringSystem) -> None:
        """An empty world, the mesh, its rest lengths, and then the start.

        Bullet measures the rest lengths in its first step, from the positions it finds then.
        """
        if system.stiffness[0] == 0:
            raise Unsupported("bullet_softbody cannot do stiffness 0: Bullet then leaves out the damping too")
        self._system = system
        self._drag = self._dt * system.drag / system.masses[-1]
        self._world.reset(self._dt)
        n = len(system.masses)
        # All nodes of a soft body have the same mass, whatever becomes of the pinned ones.
        total_mass = (n + 1) * system.masses[-1]
        self._body = self._world.load(mesh(n), total_mass, system.stiffness[0], system.damping[0])
        for pinned in (0, n):
            self._world.pin(self._body, pinned)
        apex = np.array([0.0, 0.0, apex_height(system)])
        self._world.set_positions(self._body, np.vstack([rest_positions(system), apex]))
        self._world.step()
        self._world.set_positions(self._body, np.vstack([np.pad(system.positions, ((0, 0), (0, 1))), apex]))
        self._world.set_velocities(self._body, np.pad(system.velocities, ((0, 1), (0, 1))))
        self._world.set_gravity(system.gravity)


def mesh(n: int) -> str:
    """A mesh of n nodes and an apex, one triangle per link, in the text format OBJ.

    Where the nodes are does not matter yet, except that Bullet crashes on a triangle without area.
    """
    corners = [f"v {i} 0 0" for i in range(n)] + ["v 0 0 1"]
    triangles = [f"f {i} {i + 1} {n + 1}" for i in range(1, n)]
    return "\n".join(corners + triangles) + "\n"


def rest_positions(system: MassSpringSystem) -> Array:
    """The chain with every spring at its rest length, folded on itself, from the origin: shape (n, 3) [m].

    Folded, because 0, L, 0, L, ... are exactly L apart and 0, L, 2 L, 3 L, ... only to rounding.
    """
    there_and_back = np.where(np.arange(len(system.rest_lengths)) % 2 == 0, 1.0, -1.0)
    positions = np.zeros((len(system.positions), 3))
    positions[1:, 0] = np.cumsum(there_and_back * system.rest_lengths)
    return positions


def apex_height(system: MassSpringSystem) -> float:
    """APEX times a length the chain keeps within, to the next power of two [m]."""
    reach = float(np.abs(system.positions).max() + system.rest_lengths.sum())
    return float(2.0 ** np.ceil(np.log2(APEX * reach)))


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
        self.set_gravity(np.zeros(2))

    def set_gravity(self, gravity: Array) -> None:
        """Gravity [m/s^2], shape (2,)."""
        command = self._bullet.b3InitPhysicsParamCommand(self._client)
        self._bullet.b3PhysicsParamSetGravity(command, gravity[0], gravity[1], 0.0)
        self._send(command)

    def load(self, obj: str, mass: float, stiffness: float, damping: float) -> int:
        """A soft body of this mesh, awake for ever; its number."""
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "chain.obj"
            file.write_text(obj)
            command = self._bullet.b3LoadSoftBodyCommandInit(self._client, bytes(file))
            self._bullet.b3LoadSoftBodySetMass(command, mass)
            self._bullet.b3LoadSoftBodyAddMassSpringForce(command, stiffness, damping)
            # Otherwise there are bending springs: 0.1 N/m between all nodes two links apart, even when switched off.
            self._bullet.b3LoadSoftBodyUseBendingSprings(command, 0, 0.0)
            self._bullet.b3LoadSoftBodyUseAllDirectionDampingSprings(command, 0)
            body = int(self._bullet.b3GetStatusBodyIndex(self._send(command)))
        if body < 0:
            raise RuntimeError("Bullet could not load the chain's mesh")
        command = self._bullet.b3InitChangeDynamicsInfo(self._client)
        self._bullet.b3ChangeDynamicsInfoSetActivationState(command, body, DISABLE_SLEEPING)
        self._send(command)
        return body

    def pin(self, body: int, node: int) -> None:
        """Fix a node where it is."""
        nowhere = (ctypes.c_double * 3)()
        self._send(self._bullet.b3InitCreateSoftBodyAnchorConstraintCommand(self._client, body, node, -1, -1, nowhere))

    def step(self) -> None:
        """Advance by dt."""
        client = self._client
        self._submit(client, self._advance(client))

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


ENGINES = (BulletSoftbody(),)
