"""Rapier, Godot, Newton and XPBD itself: solvers of constraints, most of them in single precision."""

from __future__ import annotations

from dataclasses import replace

from engines.translation.program import ELONGATION, written
from engines.translation.translation import Settings, Spring, Stepping, Translation, newtons
from reference.system import MassSpringSystem


def rapier(system: MassSpringSystem, stepping: Stepping, steps: int, settings: list[Settings]) -> str:
    """A world with a body for each mass, by the package rapier3d."""
    return (
        "import rapier3d\n\n"
        + written(system, stepping.dt, steps, settings)
        + f"""
world = rapier3d.PhysicsWorld(gravity=tuple(gravity))
world.integration_parameters.dt = dt
world.integration_parameters.num_solver_iterations = {stepping.substeps or 4}
world.integration_parameters.num_internal_pgs_iterations = {stepping.iterations or 1}
bodies = []
for place, mass in zip(positions, masses):
    body = (rapier3d.RigidBody.fixed() if mass is None else rapier3d.RigidBody.dynamic()).translation(tuple(place))
    if mass is not None:
        body = body.additional_mass(mass).can_sleep(False).locked_axes(rapier3d.LockedAxes.ROTATION_LOCKED)
    bodies.append(world.add_body(body.build()))
for (a, b), rest, k, c in zip(springs, rest_lengths, stiffness, damping):
    world.impulse_joints.insert(bodies[a], bodies[b], rapier3d.SpringJointBuilder(rest, k, c).build(), True)


def place(i):
    return tuple(world.rigid_bodies.get(bodies[i]).translation)

"""
        + ELONGATION
        + """

elongations = [elongation(place)]
for _ in range(steps):
    world.step()
    elongations.append(elongation(place))
"""
    )


def newton(solver: str) -> object:
    """The snippet for one of Newton's solvers."""

    def snippet(system: MassSpringSystem, stepping: Stepping, steps: int, settings: list[Settings]) -> str:
        count = {"SolverXPBD": 2, "SolverVBD": 10}.get(solver)
        options = f", iterations={stepping.iterations or count}" if count else ""
        colour = "builder.color()\n" if solver == "SolverVBD" else ""
        return (
            "import newton\n\n"
            + written(system, stepping.dt, steps, settings)
            + f"""
builder = newton.ModelBuilder(up_axis=newton.Axis.Y, gravity=tuple(gravity))
for place, mass in zip(positions, masses):  # a mass of 0 is fixed; the default radius of 0.1 m makes them collide
    builder.add_particle(pos=tuple(place), vel=(0, 0, 0), mass=mass or 0.0, radius=1e-3 * min(rest_lengths))
for (a, b), k, c in zip(springs, spring_ke, spring_kd):
    builder.add_spring(a, b, k, c, 0.0)
builder.spring_rest_length = rest_lengths
{colour}model = builder.finalize(device="cpu")
solver = newton.solvers.{solver}(model{options})
now, then = model.state(), model.state()


def place(i):
    return now.particle_q.numpy()[i].astype(float)

"""
            + ELONGATION
            + """

elongations = [elongation(place)]
for _ in range(steps):
    now.clear_forces()
    solver.step(now, then, None, None, dt)
    now, then = then, now
    elongations.append(elongation(place))
"""
        )

    return snippet


def xpbd(system: MassSpringSystem, stepping: Stepping, steps: int, settings: list[Settings]) -> str:
    """XPBD itself, in Python without anything else."""
    return (
        written(system, stepping.dt, steps, settings)
        + f"""
substeps, sweeps = {stepping.substeps or 1}, {stepping.iterations or 1}
h, w = dt / substeps, [0.0 if m is None else 1 / m for m in masses]
x, v = [list(p) for p in positions], [[0.0] * 3 for _ in positions]


def substep():
    start = [list(p) for p in x]
    for i in range(len(x)):
        for k in range(3):
            v[i][k] += h * gravity[k] * (w[i] > 0)
            x[i][k] += h * v[i][k]
    sums = [0.0] * len(springs)
    for _ in range(sweeps):
        for j, (a, b) in enumerate(springs):
            gap = [q - p for p, q in zip(x[a], x[b])]
            length = sum(g * g for g in gap) ** 0.5
            e = [g / length for g in gap]
            moved = sum(e[k] * (x[b][k] - start[b][k] - x[a][k] + start[a][k]) for k in range(3))
            alpha, gamma = compliance[j] / h**2, compliance[j] * damping[j] / h
            wanted = length - rest_lengths[j] + alpha * sums[j] + gamma * moved
            change = -wanted / ((1 + gamma) * (w[a] + w[b]) + alpha)
            sums[j] += change
            for k in range(3):
                x[a][k] -= w[a] * change * e[k]
                x[b][k] += w[b] * change * e[k]
    for i in range(len(x)):
        v[i] = [(p - q) / h for p, q in zip(x[i], start[i])]

"""
        + ELONGATION
        + """

elongations = [elongation(lambda i: x[i])]
for _ in range(steps):
    for _ in range(substeps):
        substep()
    elongations.append(elongation(lambda i: x[i]))
"""
    )


def compliant(spring: Spring, stepping: Stepping) -> Settings:
    """1/k [m/N], and c."""
    return {"compliance": 1 / spring.stiffness, "damping": spring.damping}


def of_compliance(typed: Settings, masses: Spring, stepping: Stepping) -> Spring:
    """K = 1/compliance."""
    return replace(masses, stiffness=1 / typed["compliance"], damping=typed.get("damping", 0.0))


def godot(system: MassSpringSystem, stepping: Stepping, steps: int, settings: list[Settings]) -> str:
    """The fields, in GDScript; its lengths are pixels, which stiffness in N/m does not ask about."""
    typed = settings[0]
    return (
        f"# GDScript; physics/common/physics_ticks_per_second = {1 / stepping.dt:g}\n"
        "var spring = DampedSpringJoint2D.new()\n"
        f"spring.rest_length = {float(system.rest_lengths[0])!r}  # in the scene's units of length\n"
        f"spring.stiffness = {typed['stiffness']!r}\nspring.damping = {typed['damping']!r}\n"
        "spring.node_a = first.get_path()\nspring.node_b = second.get_path()\n"
        "for body in [first, second]:\n\tbody.linear_damp_mode = RigidBody2D.DAMP_MODE_REPLACE\n"
        "\tbody.linear_damp = 0.0  # the project's default is 0.1/s\n\tbody.lock_rotation = true\n"
    )


_NEWTON = {
    "fields": {"spring_ke": None, "spring_kd": 0.0},
    "package": "newton",
    **newtons("spring_ke", "spring_kd"),
}

_NEWTONS = {"fields": {"stiffness": None, "damping": 0.0}, **newtons()}

TRANSLATIONS = (
    Translation(
        "rapier",
        "Rapier: spring joint",
        scheme=lambda s: f"soft_constraints_cold(substeps={s.substeps or 4}, sweeps={s.iterations or 1})",
        snippet=rapier,
        package="rapier3d",
        substeps=True,
        iterations=True,
        note="many stiff springs together blow up at a long step: one sweep does not solve them",
        **_NEWTONS,  # type: ignore[arg-type]
    ),
    Translation(
        "godot",
        "Godot: DampedSpringJoint2D",
        scheme=lambda stepping: "drift_kick_sequential_damping(rounds=16)",
        snippet=godot,
        dimensions=frozenset({2}),
        note="its own 2D physics, which is Chipmunk's spring: positions move after the velocities, at the same limit",
        **_NEWTONS,  # type: ignore[arg-type]
    ),
    Translation(
        "xpbd",
        "XPBD by Gauss-Seidel, as published",
        {"compliance": None, "damping": 0.0},
        compliant,
        of_compliance,
        scheme=lambda s: f"xpbd_gauss_seidel(substeps={s.substeps or 1}, sweeps={s.iterations or 1})",
        snippet=xpbd,
        package="",
        substeps=True,
        iterations=True,
    ),
    Translation(
        "newton_xpbd",
        "Newton: SolverXPBD",
        scheme=lambda s: f"xpbd_jacobi(iterations={s.iterations or 2})",
        snippet=newton("SolverXPBD"),  # type: ignore[arg-type]
        iterations=True,
        note="where many springs meet it blows up: corrections are summed",
        **_NEWTON,  # type: ignore[arg-type]
    ),
    Translation(
        "newton_semi_implicit",
        "Newton: SolverSemiImplicit",
        scheme=lambda stepping: "kick_drift",
        snippet=newton("SolverSemiImplicit"),  # type: ignore[arg-type]
        **_NEWTON,  # type: ignore[arg-type]
    ),
    Translation(
        "newton_vbd",
        "Newton: SolverVBD",
        scheme=lambda s: f"vertex_block_descent(iterations={s.iterations or 10})",
        snippet=newton("SolverVBD"),  # type: ignore[arg-type]
        iterations=True,
        **_NEWTON,  # type: ignore[arg-type]
    ),
)
