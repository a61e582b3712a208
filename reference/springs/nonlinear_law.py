"""The law of springs that are not linear, for all springs of a system at once; of linear ones it is `linear_law` alone.

What a spring carries at rest is still (a stiffness) times (its stretch), of a stiffness that depends on the stretch:
the secant stiffness. With the stretch s, k [N/m] and k3 [N/m^3]

    hardening           F = k s + k3 s^3, as of Duffing's oscillator (Nayfeh and Mook, *Nonlinear Oscillations*, ch. 2)
    largest force       F = k s up to that size, and that size beyond: elastic, it comes back the way it went
    tension only        F = 0 where s < 0: a rope, which goes slack
    compression only    F = 0 where s > 0: a strut that nothing fastens, which opens
    breaking            F = 0 for good, from the end of a step on in which there was too much of it (`breaking`)

A spring that is slack has no damping either; one that is not has all of its own.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from reference.errors import SolverError
from reference.lengths import spring_lengths
from reference.springs.kinds import NonlinearSprings
from reference.springs.linear_law import elastic_energy, force_by_stretch
from reference.state import Array, State
from reference.system import BoolArray, MassSpringSystem

#: Nearer to the stretch where its force has a corner than this part of its rest length, a spring is at the corner.
AT_CORNER = 1e-9


def stretches(system: MassSpringSystem, positions: Array) -> Array:
    """How far springs are stretched beyond their rest lengths [m], at positions (..., n, d): shape (..., s)."""
    return spring_lengths(positions, system.springs) - system.rest_lengths


def secant_stiffness(system: MassSpringSystem, stretch: Array) -> Array:
    """The stiffness [N/m] that, times the stretch, is the force of every spring at rest, shape (..., s)."""
    law = system.nonlinear
    if law is None:
        return system.stiffness
    secant = system.stiffness + law.hardening * stretch**2
    size = np.abs(stretch)
    with np.errstate(divide="ignore", invalid="ignore"):
        yields = system.stiffness * size > law.largest_force
        secant = np.where(yields, law.largest_force / size, secant)
    return np.where(_slack(law, stretch), 0.0, secant)


def tangent_stiffness(system: MassSpringSystem, stretch: Array) -> Array:
    """The derivative of every spring's force at rest by its stretch [N/m], shape (..., s)."""
    law = system.nonlinear
    if law is None:
        return force_by_stretch(system.stiffness, stretch)
    tangent = force_by_stretch(system.stiffness, stretch) + 3 * law.hardening * stretch**2
    flat = _slack(law, stretch) | (system.stiffness * np.abs(stretch) > law.largest_force)
    return np.where(flat, 0.0, tangent)


def damping_at(system: MassSpringSystem, stretch: Array) -> Array:
    """The damping [N s/m] of every spring at a stretch: none of one that is slack. Shape (..., s)."""
    law = system.nonlinear
    if law is None:
        return system.damping
    return np.where(_slack(law, stretch), 0.0, system.damping)


def energy_of_springs(system: MassSpringSystem, stretch: Array) -> Array:
    """The energy [J] in every spring, the integral of its force at rest, shape (..., s)."""
    law = system.nonlinear
    if law is None:
        return elastic_energy(system.stiffness, stretch)
    energy = elastic_energy(system.stiffness, stretch) + law.hardening * stretch**4 / 4
    size = np.abs(stretch)
    with np.errstate(divide="ignore", invalid="ignore"):
        yielding = law.largest_force / system.stiffness
        beyond = elastic_energy(system.stiffness, yielding) + law.largest_force * (size - yielding)
        energy = np.where(system.stiffness * size > law.largest_force, beyond, energy)
    return np.where(_slack(law, stretch), 0.0, energy)


def tangent_system(system: MassSpringSystem, state: State) -> MassSpringSystem:
    """The system with linear springs that pull, at a state at rest, with the same forces, and the same derivatives.

    With the tangent stiffness k and the force F of a spring of length L that is k, at the rest length L - F / k. So
    what swings a little about that state swings alike, whichever springs are slack in it: theory is asked about that.

    Raises:
        SolverError: where no linear spring does the same: at the very stretch where a spring goes slack or yields, or
            beyond that, where its force stays as it is.
    """
    if system.nonlinear is None:
        return system
    law, stretch = system.nonlinear, stretches(system, state.positions)
    secant, tangent = secant_stiffness(system, stretch), tangent_stiffness(system, stretch)
    one_sided = (law.tension_only | law.compression_only) & (system.stiffness > 0)
    near = AT_CORNER * system.rest_lengths
    _refuse_corner(one_sided & (np.abs(stretch) <= near), "at its rest length, where it goes slack")
    yields = np.abs(system.stiffness * np.abs(stretch) - law.largest_force) <= system.stiffness * near
    _refuse_corner(yields & np.isfinite(law.largest_force), "at its largest force")
    _refuse_corner((tangent == 0) & (secant != 0), "beyond its largest force, which stays as it is")
    with np.errstate(divide="ignore", invalid="ignore"):
        moved = np.where(tangent == secant, 0.0, stretch - secant * stretch / tangent)
    return replace(
        system,
        rest_lengths=system.rest_lengths + moved,
        stiffness=tangent,
        damping=damping_at(system, stretch),
        nonlinear=None,
    )


def _refuse_corner(bad: BoolArray, where: str) -> None:
    if bad.any():
        raise SolverError(f"no linear motion about this rest: spring {np.argmax(bad)} is {where}")


def _slack(law: NonlinearSprings, stretch: Array) -> BoolArray:
    """Which springs carry nothing as they are too short to pull, or too long to push, shape (..., s)."""
    slack: BoolArray = (law.tension_only & (stretch < 0)) | (law.compression_only & (stretch > 0))
    return slack
