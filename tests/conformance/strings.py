"""The systems every engine is given: random strings, and one system for each thing a system may ask for."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
import numpy.typing as npt

from reference.changes import Change
from reference.scenes import find
from reference.system import MassSpringSystem

#: A random string is run for so many steps. With rods for links, for so many at most, and no longer than so many times
#: (l/g)^(1/2), in which a link falls by about its length.
STEPS, ROD_STEPS, ROD_FALLS = 100, 40, 2.0

#: A random string hangs, at rest, longer than its springs' rest lengths by at most so many times their length.
LONGEST = 2.0


@dataclass(frozen=True, eq=False)
class Case:
    """A run without its stepper."""

    name: str
    system: MassSpringSystem
    dt: float
    steps: int
    changes: Sequence[Change] = ()


@dataclass(frozen=True)
class Range:
    """Numbers from `low` to `high`, as many small as large ones: drawn evenly by their logarithm."""

    low: float
    high: float

    def draw(self, rng: np.random.Generator) -> float:
        """One of them."""
        return float(np.exp(rng.uniform(np.log(self.low), np.log(self.high))))


STIFFNESS, MASS, LENGTH = Range(10, 1e4), Range(1e-3, 1), Range(0.02, 0.5)


def chain(
    angles: npt.ArrayLike,
    lengths: npt.ArrayLike,
    *,
    mass: npt.ArrayLike = 0.02,
    stiffness: npt.ArrayLike = 200.0,
    damping: npt.ArrayLike = 0.0,
    drag: float = 0.0,
    gravity: npt.ArrayLike = 9.81,
    stretch: npt.ArrayLike = 1.0,
    velocities: npt.ArrayLike = 0.0,
) -> MassSpringSystem:
    """A string in the plane, hung at its first mass.

    Args:
        angles: of the links from the first axis [rad], shape (n,).
        lengths: rest lengths [m], one or (n,).
        mass: of the masses after the first [kg], one or (n,).
        stretch: length at the start in rest lengths, one or (n,).
        velocities: of the masses after the first [m/s], one or (n, 2).
    """
    directions = np.column_stack([np.cos(angles), np.sin(angles)])
    n = len(directions)
    reach = np.vstack([np.zeros(2), np.cumsum(directions * np.reshape(np.multiply(lengths, stretch), (-1, 1)), axis=0)])
    masses = np.broadcast_to(mass, n)
    return MassSpringSystem(
        positions=reach,
        velocities=np.vstack([np.zeros(2), np.broadcast_to(velocities, (n, 2))]),
        springs=np.column_stack([np.arange(n), np.arange(1, n + 1)]),
        masses=np.concatenate([masses[:1], masses]),
        rest_lengths=np.asarray(lengths, dtype=float),
        stiffness=np.asarray(stiffness, dtype=float),
        damping=np.asarray(damping, dtype=float),
        drag=drag,
        gravity=np.asarray(gravity, dtype=float),
        fixed=np.arange(n + 1) == 0,
    )


def swinging(angles: npt.NDArray[np.float64], lengths: npt.ArrayLike, rates: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """The velocities [m/s] of masses whose links turn at these rates [rad/s]: they stretch no spring. Shape (n, 2)."""
    across = np.column_stack([-np.sin(angles), np.cos(angles)])
    return np.cumsum(across * np.reshape(np.multiply(lengths, rates), (-1, 1)), axis=0)


def limit(system: MassSpringSystem, rods: bool = False) -> float:
    """A dt [s] up to which semi-implicit Euler is stable on a string, everything that acts on it taken explicitly.

    A mode of frequency w, its velocity decaying at the rate r, asks for h^2 w^2 + 2 r h < 4 (engine-facts.md, with
    r = gamma). On a string of springs w^2 < 4 k/m and r < 4 c/m + Cd/m; as a pendulum of n rods that hangs,
    w^2 < 4 n g/l (a bound on the zeros of the Laguerre polynomial L_n) and r = Cd/m.
    """
    lightest, shortest = system.masses.min(), system.rest_lengths.min()
    rate = system.drag / lightest + (0 if rods else 4 * system.damping.max() / lightest)
    pendulum = np.linalg.norm(system.gravity) * len(system.springs) / shortest
    square = 4 * (pendulum if rods else system.stiffness.max() / lightest)
    return float((np.sqrt(rate**2 + 4 * square) - rate) / square)


@cache
def random_strings(rods: bool, seed: int = 20261121) -> Sequence[Case]:
    """40 strings from a fixed seed; tests/conformance/test_random_strings.py says what is drawn, and why.

    Args:
        rods: whether dt and the number of steps are to suit a stepper for which links are rods.
    """
    rng = np.random.default_rng(seed)
    kinds = {"straight": (_straight, 25), "swinging": (_swinging, 5), "moving": (_moving, 6), "uneven": (_uneven, 4)}
    systems = {f"{name} {i}": make(rng) for name, (make, count) in kinds.items() for i in range(count)}
    fractions = rng.uniform(0.05, 0.5, len(systems))
    return [
        _case(name, system, fraction, rods) for (name, system), fraction in zip(systems.items(), fractions, strict=True)
    ]


def _case(name: str, system: MassSpringSystem, fraction: float, rods: bool) -> Case:
    dt = fraction * limit(system, rods)
    fall = np.sqrt(system.rest_lengths.min() / np.linalg.norm(system.gravity))
    return Case(name, system, dt, min(ROD_STEPS, int(np.ceil(ROD_FALLS * fall / dt))) if rods else STEPS)


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


def for_each_capability() -> Mapping[str, MassSpringSystem]:
    """By each name of engines.engine.CAPABILITIES, a system that asks for it, and for little else."""
    string = find("string").system
    plain, bent = string({}), np.linspace(-0.3, 0.3, 5)
    off_the_plane = np.outer(0.125 * np.arange(11), [0.6, 0.0, 0.8])
    triangles = MassSpringSystem(
        positions=0.125 * np.array([[0, 0], [1, 0], [0.5, -(3**0.5) / 2], [1.5, -(3**0.5) / 2]]),
        springs=np.array([[0, 1], [0, 2], [1, 2], [1, 3], [2, 3]]),
        masses=np.array(0.02),
        rest_lengths=np.array(0.125),
        stiffness=np.array(200.0),
        fixed=np.array([True, False, False, False]),
    )
    return {
        "3d": replace(plain, positions=off_the_plane, velocities=np.zeros(1), gravity=np.array(9.81)),
        "mesh": triangles,
        "masses": string({"masses": 3, "mass": "0.02,0.01,0.03"}),
        "rest_lengths": string({"masses": 3, "rest_length": "0.1,0.15,0.125"}),
        "stiffnesses": string({"masses": 3, "stiffness": "200,150,250"}),
        "dampings": string({"masses": 3, "damping": "0.1,0,0.2"}),
        "stretched": chain(bent, 0.125, stretch=[1.02, 0.99, 1.05, 0.97, 1.0]),
        "velocities": chain(bent, 0.125, velocities=swinging(bent, 0.125, [1.0, -2.0, 0.5, 0.0, 3.0])),
        "damping": string({"damping": 0.1}),
        "drag": string({"drag": 0.02}),
        "tilted gravity": replace(plain, gravity=np.array([3.0, -9.0])),
        "no fixed mass": replace(triangles, fixed=np.zeros(4, dtype=bool)),
    }
