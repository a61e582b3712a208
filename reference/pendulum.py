"""The n-fold point-mass pendulum: what a string becomes as its stiffness goes to infinity.

Masses on massless rods. With the angles th_i of the rods from straight down and l_i their lengths, mass i is at
anchor + sum over k <= i of l_k (sin th_k, -cos th_k). With mu_i = m_i + m_{i+1} + ... the mass hanging below rod i,
Lagrange's equations are, for every rod i,

    sum_k l_i l_k mu_max(i,k) [ cos(th_i - th_k) th_k'' + sin(th_i - th_k) th_k'^2 ] = -mu_i g l_i sin th_i - drag.

Goldstein, *Classical Mechanics*, 1.4 and 1.6. The same schemes that step a string step the pendulum in its angles.
"""

from __future__ import annotations

import numpy as np

from reference.errors import InputError
from reference.state import Array, Slope, State, Trajectory
from reference.system import MassSpringSystem


class PendulumMotion:
    """Equations of motion of a string whose springs have become rods.

    Args:
        system: a chain in 2D hung at its first mass, every spring at its rest length, moving as rods can.

    Raises:
        InputError: for any other system.
    """

    def __init__(self, system: MassSpringSystem) -> None:
        reason = why_no_pendulum(system)
        if reason:
            raise InputError(f"no pendulum: {reason}")
        self.system = system
        self._anchor = system.positions[0]
        self._lengths = system.rest_lengths
        masses = system.masses[1:]
        self._weight = masses[:, None] * system.gravity
        hanging = np.cumsum(masses[::-1])[::-1]
        longest = np.maximum.outer(np.arange(len(hanging)), np.arange(len(hanging)))
        self._inertia = np.outer(self._lengths, self._lengths) * hanging[longest]
        self.start = self.state_of(system.start)

    def acceleration(self, state: State) -> Array:
        """Angular accelerations [rad/s^2], shape (n,)."""
        angles, rates = state.positions, state.velocities
        difference = angles[:, None] - angles[None, :]
        torque = np.asarray(-(self._inertia * np.sin(difference)) @ rates**2)
        load = self._weight
        if self.system.drag:
            load = load - self.system.drag * self._mass_velocities(angles, rates)
        # Every mass loads all the rods above it: rod i feels the sum over the masses i, i+1, ...
        below = np.cumsum(load[::-1], axis=0)[::-1]
        torque = torque + self._lengths * (below[:, 0] * np.cos(angles) + below[:, 1] * np.sin(angles))
        return np.asarray(np.linalg.solve(self._inertia * np.cos(difference), torque))

    def derivatives_at_rest(self, state: State) -> tuple[Array, Array]:
        """Of the angular accelerations about a rest, by the angles [1/s^2] and by their rates [1/s], shapes (n, n).

        With all torques in balance the inertia's own derivative drops out, and with all rates zero what is of their
        second power does:

            sum_k l_i l_k cos(th_i - th_k) [ mu_max(i,k) dth_k'' + drag n_max(i,k) dth_k' ] = -l_i (W_i . r_i) dth_i,

        with r_i along rod i, W_i the weight of all the masses below it, and n_i their number.
        """
        angles = state.positions
        alike = np.cos(angles[:, None] - angles[None, :])
        below = np.cumsum(self._weight[::-1], axis=0)[::-1]
        along = below[:, 0] * np.sin(angles) - below[:, 1] * np.cos(angles)
        number = len(angles) - np.maximum.outer(np.arange(len(angles)), np.arange(len(angles)))
        slowing = self.system.drag * np.outer(self._lengths, self._lengths) * number * alike
        to_acceleration = -np.linalg.inv(self._inertia * alike)
        return np.asarray(to_acceleration * (self._lengths * along)), np.asarray(to_acceleration @ slowing)

    def slope(self, state: State) -> Slope:
        """The rate of change of the whole state: angular velocities and accelerations."""
        return Slope(1.0, state.velocities, self.acceleration(state))

    def state_of(self, state: State) -> State:
        """The angles [rad] and their rates [rad/s], from masses on their rods."""
        separation = np.diff(state.positions, axis=0)
        angles = np.arctan2(separation[:, 0], -separation[:, 1])
        across = np.stack([np.cos(angles), np.sin(angles)], axis=1)
        rates = (np.diff(state.velocities, axis=0) * across).sum(axis=1) / self._lengths
        return State(state.time, angles, rates)

    def trajectory(self, states: list[State]) -> Trajectory:
        """Positions and velocities of the masses, the anchor first, from the angles."""
        angles, rates = np.array([s.positions for s in states]), np.array([s.velocities for s in states])
        positions = np.zeros((len(states), *self.system.positions.shape))
        velocities = np.zeros_like(positions)
        rods = np.stack([np.sin(angles), -np.cos(angles)], axis=2)
        positions[:, 0] = self._anchor
        positions[:, 1:] = self._anchor + np.cumsum(self._lengths[:, None] * rods, axis=1)
        velocities[:, 1:] = self._mass_velocities(angles, rates)
        return Trajectory(np.array([s.time for s in states]), positions, velocities)

    def _mass_velocities(self, angles: Array, rates: Array) -> Array:
        """Of the masses but the anchor [m/s], shape (n, 2), or (m, n, 2) of many states at once."""
        across = np.empty((*angles.shape, 2))
        across[..., 0], across[..., 1] = np.cos(angles), np.sin(angles)
        velocities: Array = np.cumsum((self._lengths * rates)[..., None] * across, axis=-2)
        return velocities


def why_no_pendulum(system: MassSpringSystem) -> str | None:
    """Why a system's stiff limit is not a pendulum hung at its first mass, or None if it is."""
    if system.dimension == 1:
        return "along a line rods leave nothing that could move, expected a string in 2D"
    if system.dimension != 2 or not system.is_string:
        return "expected a string in 2D, fixed at its first mass only"
    if system.collisions is not None:
        return "expected masses that do not collide"
    if not system.rest_lengths.all():
        return "expected rest lengths > 0: a rod of none is no rod"
    if system.pulls.any():
        return "expected no force that pulls on a mass: its equations know none"
    if system.nonlinear is not None:
        return f"expected linear springs: rods have no {', '.join(system.nonlinear.asked)}"
    if system.angular_springs is not None:
        return "expected no springs that resist bending: its equations know none"
    if system.obstacles:
        return "expected no obstacles: a pendulum that meets one is something else"
    separation = np.diff(system.positions, axis=0)
    length = np.linalg.norm(separation, axis=1)
    if system.off_rest_length.any():
        return "expected every spring to start at its rest length"
    stretching = (separation * np.diff(system.velocities, axis=0)).sum(axis=1) / length
    if (np.abs(stretching) > 1e-12 * np.abs(system.velocities).max()).any():
        return "expected velocities that do not stretch any spring"
    return None
