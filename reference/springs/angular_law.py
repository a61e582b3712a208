"""The law of angular springs, for all of a system at once: they resist bending at a mass.

Of three masses a, b, c the angle at b, from the arm p = x_a - x_b to the arm q = x_c - x_b, is theta (`angles`). With
the stiffness kappa [N m/rad] and the rest angle theta0

    bend      beta = theta - theta0, in the plane to within half a turn
    torque    tau = kappa beta
    energy    V = kappa beta^2 / 2
    force     on a: (tau / |p|) e,    on c: -(tau / |q|) f,    on b: what is left, so that all three add up to nothing

with e and f the unit vectors across the arms, the way theta grows: the gradients of theta are -e/|p| by x_a and f/|q|
by x_c. (The harmonic angle of molecular dynamics: Allen and Tildesley, *Computer Simulation of Liquids* (2017), C.2.)

No momentum and no angular momentum comes of them: the forces have no sum and no torque. Where in the plane a bend
comes to half a turn the torque jumps from one side to the other. In space arms in line that rest bent have no plane to
bend in: their forces are not numbers, as of a spring without direction.
"""

from __future__ import annotations

import numpy as np

from reference.checked_springs import BoolArray
from reference.springs.angles import angles_between, arms_of, sideways
from reference.springs.angular import AngularSprings
from reference.state import Array

#: Nearer to a straight line than this [rad], the bend over its sine is what it is in the limit, to rounding.
NEARLY_STRAIGHT = 1e-6


def bends(springs: AngularSprings, positions: Array) -> Array:
    """How far angles are from their rest angles [rad], with masses at positions (..., n, d): shape (..., k)."""
    beyond = angles_between(*arms_of(positions, springs.masses)) - springs.rest_angles
    within: Array = beyond - 2 * np.pi * np.round(beyond / (2 * np.pi))
    return within


def torques(springs: AngularSprings, positions: Array) -> Array:
    """Of every angular spring [N m], shape (..., k): above zero it would make the angle smaller."""
    torque: Array = springs.stiffness * bends(springs, positions)
    return torque


def bends_and_torques(springs: AngularSprings | None, positions: Array) -> tuple[Array, Array]:
    """Both [rad], [N m]; empty where there are none, shape (..., k)."""
    if springs is None:
        return np.zeros((*positions.shape[:-2], 0)), np.zeros((*positions.shape[:-2], 0))
    return bends(springs, positions), torques(springs, positions)


def energy_of_bends(springs: AngularSprings, positions: Array) -> Array:
    """In every angular spring [J], shape (..., k)."""
    energy: Array = springs.stiffness * bends(springs, positions) ** 2 / 2
    return energy


def forces_on_masses(springs: AngularSprings, positions: Array) -> Array:
    """The forces of all angular springs on the masses [N], with masses at positions (n, d): shape (n, d)."""
    springs = _with_stiffness(springs)
    first, last = arms_of(positions, springs.masses)
    e, f, _ = sideways(first, last)
    torque = np.where(_undirected(springs, positions), np.nan, torques(springs, positions))[:, None]
    on_first = torque * e / np.linalg.norm(first, axis=-1, keepdims=True)
    on_last = -torque * f / np.linalg.norm(last, axis=-1, keepdims=True)
    forces = np.zeros_like(positions)
    for of, force in zip(springs.masses.T, (on_first, -(on_first + on_last), on_last), strict=True):
        np.add.at(forces, of, force)
    return forces


def derivatives(springs: AngularSprings, positions: Array) -> Array:
    """The derivatives of the forces on a and c by the arms p and q [N/m]: shape (k, 2 d, 2 d), symmetric.

    That is -d2V of V(p, q), with u = p/|p|, w = q/|q|, and n the normal of their plane:

        V_pp = kappa e e^T / |p|^2 + tau (u e^T + e u^T) / |p|^2 + tau cot(theta) n n^T / |p|^2
        V_qq = kappa f f^T / |q|^2 - tau (w f^T + f w^T) / |q|^2 + tau cot(theta) n n^T / |q|^2
        V_pq = -kappa e f^T / (|p| |q|) - tau / sin(theta) n n^T / (|p| |q|)

    Where the arms are in line and rest so, tau / sin(theta) is its limit, kappa cos(theta).
    """
    acts, springs = springs.stiffness > 0, _with_stiffness(springs)
    first, last = arms_of(positions, springs.masses)
    e, f, n = sideways(first, last)
    p, q = (np.linalg.norm(arm, axis=-1)[:, None, None] for arm in (first, last))
    u, w = first / p[..., 0], last / q[..., 0]
    angle = angles_between(first, last)
    kappa, tau = springs.stiffness[:, None, None], torques(springs, positions)[:, None, None]
    over_sine, cosine = _over_sine(springs, positions, angle)[:, None, None], np.cos(angle)[:, None, None]
    out_of_plane = over_sine * _outer(n, n)
    pp = kappa * _outer(e, e) + tau * (_outer(u, e) + _outer(e, u)) + cosine * out_of_plane
    qq = kappa * _outer(f, f) - tau * (_outer(w, f) + _outer(f, w)) + cosine * out_of_plane
    pq = -kappa * _outer(e, f) - out_of_plane
    whole: Array = -np.block([[pp / p**2, pq / (p * q)], [pq.transpose(0, 2, 1) / (p * q), qq / q**2]])
    if acts.all():
        return whole
    blocks = np.zeros((len(acts), *whole.shape[1:]))
    blocks[acts] = whole
    return blocks


def _with_stiffness(springs: AngularSprings) -> AngularSprings:
    """Those that have any: the masses of one that went with a broken spring may be in one place, or in line."""
    acts = springs.stiffness > 0
    if acts.all():
        return springs
    return AngularSprings(springs.masses[acts], springs.stiffness[acts], springs.rest_angles[acts])


def _undirected(springs: AngularSprings, positions: Array) -> BoolArray:
    """Which have arms exactly in line in space, and no rest there, shape (k,)."""
    angle = angles_between(*arms_of(positions, springs.masses))
    in_line = (angle == 0) | (angle == np.pi)
    return in_line & (np.abs(bends(springs, positions)) > NEARLY_STRAIGHT) & (positions.shape[-1] == 3)


def _over_sine(springs: AngularSprings, positions: Array, angle: Array) -> Array:
    """Tau / sin(theta) [N m], shape (k,)."""
    sine, bend = np.sin(angle), bends(springs, positions)
    limit = (np.abs(sine) < NEARLY_STRAIGHT) & (np.abs(bend) < 2 * NEARLY_STRAIGHT)
    with np.errstate(divide="ignore", invalid="ignore"):
        torque_over_sine: Array = springs.stiffness * np.where(limit, np.cos(angle), bend / sine)
    return torque_over_sine


def _outer(u: Array, w: Array) -> Array:
    return u[:, :, None] * w[:, None, :]
