"""Random strings, which every engine is given."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
import numpy.typing as npt

from engines.capability_cases import chain, swinging
from reference.system import MassSpringSystem
from tests.conformance.case import Case

#: The steps of a random string. With distance constraints for links, how many there are at most, and the longest time
#: in (l/g)^(1/2), in which a link falls by about its length.
STEPS, CONSTRAINED_STEPS, CONSTRAINED_FALLS = 100, 40, 2.0

#: By how many times its springs' rest lengths a random string is longer than they are, at most, where it hangs at rest.
LONGEST = 2.0


@dataclass(frozen=True)
class Range:
    """Numbers from `low` to `high`, as many small as large ones: drawn evenly by their logarithm."""

    low: float
    high: float

    def draw(self, rng: np.random.Generator) -> float:
        """One of them."""
        return float(np.exp(rng.uniform(np.log(self.low), np.log(self.high))))


STIFFNESS, MASS, LENGTH = Range(10, 1e4), Range(1e-3, 1), Range(0.02, 0.5)


def limit(system: MassSpringSystem, on_rods: bool = False) -> float:
    """A dt [s] up to which semi-implicit Euler is stable on a string, everything that acts on it taken explicitly.

    For a mode of frequency w, its velocity decaying at the rate r, the step v' = (1 - r h) v - h w^2 x, x' = x + h v'
    has determinant 1 - r h and trace 2 - r h - h^2 w^2: it is stable while |trace| < 1 + determinant, which is
    h^2 w^2 + 2 r h < 4. On a string of springs w^2 < 4 k/m and r < 4 c/m + Cd/m; as a pendulum of n links that hangs,
    w^2 < 4 n g/l (a bound on the zeros of the Laguerre polynomial L_n) and r = Cd/m.
    """
    lightest, shortest = system.masses.min(), system.rest_lengths.min()
    rate = system.drag / lightest + (0 if on_rods else 4 * system.damping.max() / lightest)
    pendulum = np.linalg.norm(system.gravity) * len(system.springs) / shortest
    square = 4 * (pendulum if on_rods else system.stiffness.max() / lightest)
    return float((np.sqrt(rate**2 + 4 * square) - rate) / square)


@cache
def random_strings(on_rods: bool, seed: int = 20261121) -> Sequence[Case]:
    """40 strings from a fixed seed; tests/conformance/test_random_strings.py says what is drawn, and why.

    Args:
        on_rods: whether dt and the number of steps are to suit a stepper for which links are distance constraints.
    """
    rng = np.random.default_rng(seed)
    kinds = {"straight": (_straight, 25), "swinging": (_swinging, 5), "moving": (_moving, 6), "uneven": (_uneven, 4)}
    systems = {f"{name} {i}": make(rng) for name, (make, count) in kinds.items() for i in range(count)}
    fractions = rng.uniform(0.05, 0.5, len(systems))
    return [
        _case(name, system, fraction, on_rods)
        for (name, system), fraction in zip(systems.items(), fractions, strict=True)
    ]


def _case(name: str, system: MassSpringSystem, fraction: float, on_rods: bool) -> Case:
    dt = fraction * limit(system, on_rods)
    fall = np.sqrt(system.rest_lengths.min() / np.linalg.norm(system.gravity))
    constrained = min(CONSTRAINED_STEPS, int(np.ceil(CONSTRAINED_FALLS * fall / dt)))
    return Case(name, system, dt, constrained if on_rods else STEPS)


def _straight(rng: np.random.Generator) -> MassSpringSystem:
    """At rest, unstretched and straight, in any direction."""
    n = int(rng.integers(1, 41))
    return chain(np.full(n, rng.uniform(0, 2 * np.pi)), **_parameters(rng, n))


def _swinging(rng: np.random.Generator) -> MassSpringSystem:
    """Unstretched, every link in a direction of its own and turning about its upper end."""
    n = int(rng.integers(1, 41))
    parameters = _parameters(rng, n)
    angles = _bent(rng, n)
    rates = rng.normal(size=n) * np.sqrt(9.81 / parameters["lengths"]) / n
    return chain(angles, velocities=swinging(angles, parameters["lengths"], rates), **parameters)


def _moving(rng: np.random.Generator) -> MassSpringSystem:
    """Every link in a direction of its own and up to 5 % off its rest length, every mass with a velocity of its own.

    Velocities are a twentieth of k^(1/2) m^(-1/2) L, at which a spring stretches by its length.
    """
    n = int(rng.integers(1, 41))
    parameters = _parameters(rng, n)
    speed = 0.05 * parameters["lengths"] * np.sqrt(parameters["stiffness"] / parameters["mass"])
    stretch = 1 + rng.uniform(-0.05, 0.05, n)
    return chain(_bent(rng, n), stretch=stretch, velocities=speed * rng.normal(size=(n, 2)), **parameters)


def _uneven(rng: np.random.Generator) -> MassSpringSystem:
    """At rest, unstretched, and no two masses or springs alike: each up to twice another."""
    n = int(rng.integers(2, 41))
    parameters = _parameters(rng, n)
    for name in ("lengths", "mass", "stiffness", "damping"):
        parameters[name] = parameters[name] * rng.uniform(0.7, 1.4, n)
    return chain(_bent(rng, n), **parameters)


def _bent(rng: np.random.Generator, n: int) -> npt.NDArray[np.float64]:
    """The angles of links [rad] that turn up to 40 degrees off a common direction."""
    return np.asarray(rng.uniform(0, 2 * np.pi) + rng.uniform(-0.7, 0.7, n))


def _parameters(rng: np.random.Generator, n: int) -> dict[str, Any]:
    """Parameters of a string of n masses: every second one is damped, every second one feels drag."""
    while True:
        stiffness, mass, length = STIFFNESS.draw(rng), MASS.draw(rng), LENGTH.draw(rng)
        if n * mass * 9.81 / (2 * stiffness) <= LONGEST * length:
            break
    return {
        "lengths": length,
        "mass": mass,
        "stiffness": stiffness,
        "damping": rng.integers(2) * rng.uniform(0, 1),
        "drag": float(rng.integers(2) * rng.uniform(0, 0.1)),
    }
