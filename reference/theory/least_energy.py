"""The stable equilibrium of a mesh: its energy goes downhill by sparse steps, then Newton's method to rounding.

A step s solves (K + mu) s = F with F the forces, K their derivative and mu [N/m] as much as it takes: with little of it
a step is Newton's, with much it is short and straight downhill. (Levenberg, Quart. Appl. Math. 2 (1944); Nocedal and
Wright, *Numerical Optimization* (2006), 4.1 for when to trust it.) Springs in compression would make K indefinite, and
downhill might be up: what they give across themselves is left out of it until no force is above the
mean load of a mass.

Where it ends forces balance; but they balance on a ridge, too. So the eigenvalues of K are counted: if one is negative,
the system is pushed along its eigenvector, to either side, and goes on downhill.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from reference.assembly import assemble, spring_blocks
from reference.errors import SolverError
from reference.forces import SpringMotion
from reference.lengths import divisors, lengths
from reference.springs.angles import arms_of
from reference.springs.angular_law import energy_of_bends
from reference.springs.nonlinear_law import energy_of_springs, secant_stiffness
from reference.state import Array, State
from reference.system import MassSpringSystem
from reference.theory.inertia import negative_eigenvalues
from reference.theory.parts import loads, parts_of

#: Downhill as long as a force is above this part of all forces; a few steps of Newton's do the rest.
NEAR = 1e-6

#: So many steps downhill; a cloth of 4,000 masses takes some hundred.
MOST_STEPS = 2_000

#: The least mu, as a part of weight over size: what no force holds is to stay where it is.
LEAST_MU = 1e-14

#: Up to so many coordinates, where that was not enough, L-BFGS goes on; and of these so many steps are enough to see.
QUASI_NEWTON_UP_TO, MOST_STEPS_OF_SMALL = 600, 150

#: An eigenvalue of K that is this little below zero, as a part of its largest entry, is zero but for rounding.
FLAT = 1e-9

#: How far a system is pushed off a ridge, as a part of its size; and how often.
PUSH, MOST_PUSHES = 1e-3, 40


def least_energy(system: MassSpringSystem) -> State:
    """The state at rest where forces balance and every push comes back, downhill from the start.

    Parts that nothing holds are at rest among themselves, in the frame that falls with them (`parts`).

    Raises:
        SolverError: if it is not reached, and what could be done.
    """
    if system.fixed.all():
        return State(0.0, system.positions, np.zeros_like(system.positions))
    descent = Descent(system, loads(system, parts_of(system)))
    try:
        with np.errstate(over="ignore", invalid="ignore"):
            return descent.at(descent.off_ridges(system.positions[~system.fixed].ravel()))
    except (SolverError, np.linalg.LinAlgError, ValueError) as error:
        if system.nonlinear is None:
            raise
        kinds = ", ".join(system.nonlinear.asked)
        why = f"springs with {kinds} may carry less than what hangs on them"
        raise SolverError(f"{error if isinstance(error, SolverError) else 'no equilibrium'}; {why}") from None


def force_tolerance(system: MassSpringSystem, weight: float) -> float:
    """What may be left of a force in balance [N]: a billionth of the weight, and what positions round by."""
    rounding = np.finfo(float).eps * float(np.abs(system.positions).max(initial=0.0) + system.size)
    return 1e-9 * weight + 8 * rounding * max(float(system.stiffness.max(initial=0.0)), stiffness_across(system))


def stiffness_across(system: MassSpringSystem) -> float:
    """The most that an angular spring resists a move of one of its masses across an arm, at the start [N/m]."""
    angular = system.angular_springs
    if angular is None:
        return 0.0
    shorter = np.min([lengths(arm) for arm in arms_of(system.positions, angular.masses)], axis=0)
    return float((4 * angular.stiffness / shorter**2).max())


class Descent:
    """The way down the energy of a system over its free masses' coordinates q, shape (free masses x d,).

    Attributes:
        system: whose springs give way.
        size: its own [m].
        weight: what forces are small against [N].
        longest: how far a step may lead along any axis [m].
        quasi_newton_up_to: up to how many coordinates L-BFGS goes on.
        most_steps: of larger systems.
    """

    longest = np.inf
    quasi_newton_up_to = QUASI_NEWTON_UP_TO
    most_steps = MOST_STEPS

    def __init__(self, system: MassSpringSystem, carried: Array) -> None:
        """What every mass weighs on the springs [N], shape (n, d)."""
        self.system = system
        self._motion = SpringMotion(replace(system, gravity=np.zeros(system.dimension), pulls=np.zeros(1)))
        self._free = ~system.fixed
        self.size = system.size or 1.0
        self._loads = carried[self._free].ravel()
        still = self.at(system.positions[self._free].ravel())
        tension = np.abs(self._motion.acceleration(still)) * system.masses[:, None]
        # what forces are small against: what is carried, what the start pulls with, a millionth of what springs can
        firm = 1e-6 * float((system.stiffness * system.rest_lengths).max(initial=0.0))
        firm = max(firm, 1e-6 * stiffness_across(system) * system.shortest)
        self.weight = max(float(np.abs(self._loads).sum()), float(tension.sum()), firm) or 1.0

    def at(self, q: Array) -> State:
        """The state at rest there."""
        positions = self.system.positions.copy()
        positions[self._free] = q.reshape(-1, self.system.dimension)
        return State(0.0, positions, np.zeros_like(positions))

    def force(self, q: Array) -> Array:
        """On the free masses [N]."""
        forces = self._motion.acceleration(self.at(q)) * self.system.masses[:, None]
        return np.asarray(forces[self._free].ravel() + self._loads)

    def energy(self, q: Array) -> float:
        """Of the springs, and of what they carry [J]."""
        x = self.at(q).positions
        a, b = self.system.springs.T
        stretch = np.linalg.norm(x[b] - x[a], axis=1) - self.system.rest_lengths
        energy = energy_of_springs(self.system, stretch).sum() - self._loads @ q
        angular = self.system.angular_springs
        return float(energy if angular is None else energy + energy_of_bends(angular, x).sum())

    def off_ridges(self, q: Array) -> Array:
        """Coordinates where forces balance and every push comes back, downhill from those given.

        Raises:
            SolverError: if they are not reached.
        """
        driving = self.weight
        for _ in range(MOST_PUSHES):
            q = self.newton(self.downhill(q, driving))
            if not np.abs(self.force(q)).max(initial=0.0) < force_tolerance(self.system, self.weight):
                raise SolverError("no equilibrium: the forces do not balance anywhere near the start")
            away = self.downwards(q)
            if away is None:
                return q
            q = self.pushed(q, away)
            # where masses differ by powers of ten, what drives a light one off may be far below the whole weight
            driving = min(driving, float(np.abs(self.force(q)).max()))
        raise SolverError(f"no equilibrium: after {MOST_PUSHES} pushes off ridges of the energy it is still on one")

    def downhill(self, q: Array, driving: float | None = None) -> Array:
        """Coordinates where forces nearly balance, with less energy than those given.

        Args:
            driving: how large the forces are that drive it there [N]; the whole weight, if left out.
        """
        driving = self.weight if driving is None else driving
        mu, height = driving / self.size, self.energy(q)
        near = max(NEAR * driving, force_tolerance(self.system, 0.0))
        for _ in range(self.most_steps if len(q) > self.quasi_newton_up_to else MOST_STEPS_OF_SMALL):
            force = self.force(q)
            largest = np.abs(force).max(initial=0.0)
            if largest < near:
                return q
            stiffness = self.stiffness(q, tension_only=largest > self.weight / len(self._free))
            step = _solve(stiffness, mu, force)
            step *= min(1.0, self.longest / (np.abs(step).max(initial=0.0) or 1.0))
            promised = force @ step - step @ (stiffness @ step) / 2
            if abs(promised) < 4 * np.finfo(float).eps * (abs(height) + self.weight * self.size):
                return q  # less than the energy rounds by: what is left is Newton's
            there = self.energy(q + step)
            kept = (height - there) / abs(promised) if promised else 0.0
            if kept > 0.1:
                q, height = q + step, there
            mu = max(mu * (0.25 if kept > 0.5 else 1.0 if kept > 0.1 else 4.0), LEAST_MU * self.weight / self.size)
        if len(q) > self.quasi_newton_up_to:
            raise SolverError(
                f"no equilibrium was reached in {self.most_steps} steps downhill: start the scene nearer to it"
            )
        return self._by_quasi_newton(q)

    def _by_quasi_newton(self, q: Array) -> Array:
        """The same by L-BFGS, which creeps along valleys that are long and curved, as of strips that resist bending."""
        from scipy.optimize import minimize

        scale = self.weight * self.size
        found = minimize(
            lambda q: self.energy(q) / scale,
            q,
            jac=lambda q: -self.force(q) / scale,
            method="L-BFGS-B",
            options={"maxiter": 50_000, "maxfun": 100_000, "ftol": 1e-16, "gtol": 1e-9},
        )
        return np.asarray(found.x)

    def newton(self, q: Array) -> Array:
        """The same to rounding; a trace of mu lets what no force holds stay where it is."""
        for _ in range(30):
            stiffness = self.stiffness(q)
            change = _solve(stiffness, 1e-13 * (abs(stiffness).max() or 1.0), self.force(q))
            q = q + change
            if np.abs(change).max(initial=0.0) < 1e-14 * self.size:
                break
        return q

    def downwards(self, q: Array) -> Array | None:
        """The direction in which the energy falls off a ridge, shape as q; None where all pushes come back."""
        stiffness = self.stiffness(q)
        flat = FLAT * float(abs(stiffness).max() or 1.0)
        shifted = stiffness + flat * _identity(len(q))
        if negative_eigenvalues(shifted) == 0:
            return None
        return _lowest_eigenvector(stiffness)

    def pushed(self, q: Array, away: Array) -> Array:
        """Off the ridge, along the direction and to the side where the energy is less."""
        push = PUSH * self.size * away / np.abs(away).max()
        return min(q + push, q - push, key=self.energy)

    def stiffness(self, q: Array, tension_only: bool = False) -> Any:
        """The derivative of the forces by q, its sign turned [N/m]: sparse."""
        blocks, _ = spring_blocks(self.system, self.at(q))
        if tension_only:
            blocks = replace(blocks, springs=_without_compression(self.system, self.at(q), blocks.springs))
        return -assemble(self.system, blocks, sparse=True)


def _without_compression(system: MassSpringSystem, state: State, springs: Array) -> Array:
    """The springs' blocks less what those shorter than at rest give across themselves: (F / L) (1 - u u^T)."""
    a, b = system.springs.T
    separation = state.positions[b] - state.positions[a]
    length = divisors(np.linalg.norm(separation, axis=1), system.rest_lengths)
    u = separation / length[:, None]
    across = np.eye(system.dimension) - u[:, :, None] * u[:, None, :]
    secant = secant_stiffness(system, length - system.rest_lengths)
    pushing = np.minimum(secant * (1 - system.rest_lengths / length), 0.0)
    return np.asarray(springs - pushing[:, None, None] * across)


def _identity(size: int) -> Any:
    from scipy.sparse import diags_array

    return diags_array(np.ones(size))


def _lowest_eigenvector(matrix: Any) -> Array:
    """Of a sparse symmetric matrix."""
    size, _ = matrix.shape
    if size <= 200:
        return np.asarray(np.linalg.eigh(matrix.toarray())[1][:, 0])
    from scipy.sparse.linalg import eigsh

    start = np.random.default_rng(0).normal(size=size)
    return np.asarray(eigsh(matrix, 1, which="SA", v0=start, tol=1e-3)[1][:, 0])


def _solve(matrix: Any, mu: float, right: Array) -> Array:
    """Raises SolverError for a matrix that is singular in floats."""
    from scipy.sparse.linalg import splu

    # symmetric: a pattern that is kept so fills in less
    whole = (matrix + mu * _identity(len(right))).tocsc()
    try:
        solved = splu(whole, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    except RuntimeError as error:
        raise SolverError(f"no equilibrium: the stiffness of the springs cannot be inverted ({error})") from None
    return np.asarray(solved.solve(right))
