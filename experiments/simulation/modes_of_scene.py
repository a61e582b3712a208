"""At which frequencies a scene swings about its rest, what its springs carry there, and what steppers make of both."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from experiments.runs.comparison import finite
from experiments.runs.progress import Progress
from experiments.runs.runner import current
from reference.identification import identify, scheme_of
from reference.scenes import Setup
from reference.springs.angular_law import bends_and_torques
from reference.springs.breaking import tensions
from reference.state import Array
from reference.stepper import SchemeStepper, Stepper
from reference.theory.equilibria import Equilibrium, equilibrium_on_obstacles, spring_equilibrium
from reference.theory.modes import NaturalModes, natural_modes
from reference.theory.oscillators import step_matrices
from reference.theory.rates import rates

#: Up to so many coordinates all modes are computed unless a number is asked for; of larger systems so many.
ALL_UP_TO, LOWEST = 600, 20

#: Damping that acts between modes by no more than this part of itself is rounding.
UNCOUPLED = 1e-9

#: A stepper is identified in so many steps, each such a part of how long the fastest motion lasts.
IDENTIFYING_STEPS, IDENTIFYING_DT = 200, 0.1

#: A measured swing starts so far from rest, as a part of the system's size, and lasts so many steps at most.
START, STEPS = 1e-5, 2_000


@dataclass(frozen=True, eq=False)
class Modes:
    """A scene at rest, and how it swings about that.

    Attributes:
        rest: where it is.
        about: which rest that is, where there are obstacles.
        natural: its modes, slowest first.
        forces: of springs at rest [N], tension positive, shape (s,).
        bends, torques: of angular springs at rest [rad], [N m], shape (k,).
        asked: how many modes there are in all.
    """

    setup: Setup
    rest: Equilibrium
    about: str
    natural: NaturalModes
    forces: Array
    bends: Array
    torques: Array
    asked: int

    @property
    def document(self) -> dict[str, Any]:
        """As the command line's JSON has it."""
        return {
            "scene": self.setup.name,
            "equilibrium_m": self.rest.state.positions.tolist(),
            "frequencies_hz": self.natural.frequencies.tolist(),
            "damping_ratios": [finite(value) for value in self.natural.damping_ratios.tolist()],
            "spring_forces_n": self.forces.tolist(),
            "bends_rad": self.bends.tolist(),
            "torques_n_m": self.torques.tolist(),
            "modes_in_all": self.asked,
            "damping_couples_modes": self.natural.coupled,
            "about": self.about,
        }


@dataclass(frozen=True)
class Swing:
    """What a stepper makes of a mode.

    Attributes:
        frequency: how often it swings [Hz]; NaN where it does not, or is not known.
        damping_ratio: how its swings get smaller.
    """

    frequency: float
    damping_ratio: float

    @property
    def document(self) -> dict[str, float | None]:
        """For JSON."""
        return {"frequency_hz": finite(self.frequency), "damping_ratio": finite(self.damping_ratio)}


UNKNOWN = Swing(np.nan, np.nan)


@dataclass(frozen=True)
class StepperSwing:
    """A mode under one stepper at the scene's dt.

    Attributes:
        mode: its number, from 0.
        predicted: from the step of the scheme, of an engine of the one it is identified as here, of an oscillator with
            this frequency and damping; None where there is none.
        measured: from a run, started in the mode's shape; None where there is none.
        reason: why, where one is missing.
        identified_as: the scheme an engine or own file is predicted as; None of a scheme, and where there is none.
    """

    stepper: str
    mode: int
    predicted: Swing | None
    measured: Swing | None
    reason: str = ""
    identified_as: str | None = None


def modes_of(setup: Setup, lowest: int | None = None) -> Modes:
    """The modes of a scene, about the rest of its system at the start (changes on the fly are not looked at).

    Raises:
        SolverError: if it comes to no rest.
    """
    system = setup.system
    rest, about = equilibrium_on_obstacles(system) if system.obstacles else (spring_equilibrium(system), "")
    assert rest.linear is not None
    count = len(rest.linear.mass)
    kept = lowest if lowest is not None else None if count <= ALL_UP_TO else LOWEST
    forces = tensions(system, rest.state.positions, np.zeros_like(rest.state.positions))
    bent = bends_and_torques(system.angular_springs, rest.state.positions)
    return Modes(setup, rest, about, natural_modes(rest.linear, kept), forces, *bent, count)


def swings(modes: Modes, steppers: Sequence[Stepper], progress: Progress) -> list[StepperSwing]:
    """What steppers make of the modes at the scene's dt, predicted and measured."""
    found = []
    with current().threads() as pool:
        for stepper in steppers:
            progress(stepper.name)
            scheme, unknown = _scheme_of(stepper, modes)
            predicted = _predicted(scheme, modes) if scheme is not None else unknown
            name = None if scheme is None or scheme is stepper else scheme.name
            which = range(len(modes.natural.frequencies))
            measured = list(pool.map(lambda i, stepper=stepper: _measured(stepper, modes, i), which))
            for i, (swing, why_not) in enumerate(measured):
                known = None if isinstance(predicted, str) else predicted[i]
                reason = _reason(predicted if isinstance(predicted, str) else "", why_not)
                found.append(StepperSwing(stepper.name, i, known, swing, reason, name))
    return found


def _reason(predicted: str, measured: str) -> str:
    """Why there is no prediction, and no measurement; what is the reason of both is said once."""
    if measured and predicted.endswith(measured):
        return predicted
    told = {"not predicted": predicted, "not measured": measured}
    return "; ".join(f"{what}: {why}" for what, why in told.items() if why)


def _scheme_of(stepper: Stepper, modes: Modes) -> tuple[SchemeStepper | None, str]:
    """A scheme is itself; an engine, an own file what it is identified as in short steps; or why it is none."""
    if isinstance(stepper, SchemeStepper):
        return stepper, ""
    dt = IDENTIFYING_DT / (rates(modes.rest).fastest or 1.0)
    found = identify(stepper, modes.setup.system, dt, IDENTIFYING_STEPS)
    return scheme_of(stepper, found), f"not identified; {found.reason}"


def _predicted(stepper: SchemeStepper, modes: Modes) -> list[Swing] | str:
    """By the eigenvalues l of the scheme's step: its swing is arg l / dt, and ln |l| tells how it decays.

    Where the matrix of one oscillator's step does not tell that, why.
    """
    if modes.natural.coupled > UNCOUPLED:
        return "damping acts between modes, and what is measured is no mode's alone"
    scheme, dt = stepper.scheme, modes.setup.dt
    if stepper.on_rods:
        return "it has rods in place of springs"
    if not scheme.linear or not scheme.one_step or scheme.iterated:
        return f"a step of {scheme.name} is no matrix"
    if scheme.needs == "accelerations of one mass":
        return f"{scheme.name} steps mass after mass, and so modes not by themselves"
    natural = modes.natural
    squares = (2 * np.pi * natural.frequencies) ** 2
    matrices = step_matrices(scheme, dt, np.ones_like(squares), squares, natural.rates)
    return [_swing(np.linalg.eigvals(matrix), dt) for matrix in matrices]


def _swing(values: Any, dt: float) -> Swing:
    """Of the eigenvalues of a step of an oscillator; the slower decay where it does not swing."""
    value = complex(max(values, key=abs))
    if value == 0:
        return UNKNOWN
    exponent = np.log(value) / dt
    ratio = -exponent.real / abs(exponent) if exponent else 0.0
    return Swing(abs(exponent.imag) / (2 * np.pi) if abs(value.imag) > 1e-12 * abs(value) else np.nan, float(ratio))


def _measured(stepper: Stepper, modes: Modes, i: int) -> tuple[Swing | None, str]:
    """From a run started in the shape of the mode: x_(n+1) = p x_n + q x_(n-1), with the roots a step multiplies by."""
    system, rest, natural, dt = modes.setup.system, modes.rest, modes.natural, modes.setup.dt
    if natural.frequencies[i] == 0:
        return None, "nothing brings it back"
    if system.obstacles:
        return None, "with obstacles it is not measured"
    shape, at_rest = natural.shapes[i], rest.state.positions
    moved_a_little = at_rest + START * system.scale * shape
    started = replace(system, positions=moved_a_little, velocities=np.zeros_like(at_rest))
    steps = int(min(STEPS, max(8, 3 / (natural.frequencies[i] * dt))))
    outcome = stepper.run(started, dt, steps)
    if outcome.trajectory is None or outcome.ending != "done":
        return None, outcome.reason
    weights = (system.masses * ~system.fixed)[:, None] * shape
    moved = ((outcome.trajectory.positions - at_rest) * weights).sum(axis=(1, 2))
    pairs = np.stack([moved[1:-1], moved[:-2]], axis=1)
    (p, q), *_ = np.linalg.lstsq(pairs, moved[2:], rcond=None)
    return _swing(np.roots([1.0, -p, -q]), dt), ""
