"""Why does a string blow up under Euler, where Heun swings on at the same step?

The string's fastest swing is along itself: neighbours against one another, far too small and fast to be seen. A scheme
multiplies it by the same factor at every step. If that is over 1, it is only a matter of time until it is seen. What is
predicted and measured is the factor of this one mode; the growth factor of a step, which its stability limit is about,
is the largest of all modes, and may be another's.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from experiments.experiment import Experiment, Result, Table
from experiments.runs.comparison import finite
from experiments.runs.progress import Progress
from reference.scenes import find
from reference.schemes.catalogue import Scheme
from reference.schemes.catalogue import find as find_scheme
from reference.simulate import simulate
from reference.state import Array, Trajectory
from reference.system import MassSpringSystem
from reference.theory.equilibria import spring_equilibrium
from reference.theory.equilibrium import hanging_string
from reference.theory.exact import exact
from reference.theory.step_map import step_jacobian

SCHEMES = ("euler", "heun")
DT, DURATION, DRAG = 1e-3, 1.2, 0.02

#: When the string is drawn [s].
TIMES = (0.0, 0.15, 0.3, 0.45, 0.6, 0.75, 0.9, 1.05, 1.2)

#: How much the hanging string is perturbed [m], and for how many steps it is watched.
PERTURBATION, PERTURBED_STEPS = 1e-9, 500

#: On the swinging string the fastest mode's growth is fitted between these sizes [m]: it is more by then than what the
#: other modes leak into it, and the string still a string.
GROWING = (1e-5, 2e-2)


@dataclass(frozen=True)
class Fate:
    """What a scheme does to the string.

    Attributes:
        predicted: by what the fastest mode is multiplied in a step.
        undamped: the same, predicted for a string without drag.
        perturbed: the same, measured on the string at rest, perturbed a little.
        swinging: the same, measured on the swinging string; None where the mode never grows so large.
        motion: of the swinging string.
        distance: from the true motion [m], one for each time.
        mode: how large the fastest mode of the difference from the true motion is [m], one for each time.
    """

    scheme: Scheme
    predicted: float
    undamped: float
    perturbed: float
    swinging: float | None
    motion: Trajectory
    distance: Array
    mode: Array


def run(progress: Progress) -> Result:
    """The same string, dt and start under each of the schemes."""
    system = find("string").system({"drag": DRAG})
    progress("true motion")
    true = exact(system, DT, round(DURATION / DT))
    fates = []
    for name in SCHEMES:
        progress(name)
        fates.append(fate(system, find_scheme(name), true))
    return result_of(fates, true)


def result_of(fates: Sequence[Fate], true: Trajectory) -> Result:
    """Fates, and the true motion that they are measured by, as findings and tables."""
    columns = ["scheme", "fastest mode: growth - 1 in a step, predicted [1]"]
    columns += ["measured: hanging, perturbed [1]", "measured: swinging [1]", "predicted without drag [1]"]
    columns += ["predicted: tenfold in [s]", f"distance from the true motion at {DURATION:g} s [m]"]
    rows = [
        [f.scheme.name, *_less_one(f.predicted, f.perturbed, f.swinging, f.undamped), tenfold(f.predicted), last(f)]
        for f in fates
    ]
    tables = [Table("first_order_instability", columns, rows), _over_time(true, fates)]
    return Result(_findings(fates), tables, {"fates": fates, "true": true})


def _less_one(*factors: float | None) -> list[float | None]:
    return [None if factor is None else factor - 1 for factor in factors]


def fate(system: MassSpringSystem, scheme: Scheme, true: Trajectory) -> Fate:
    """What becomes of a string under a scheme, compared with the true motion at the same times."""
    motion = simulate(system, scheme, DT, DURATION)
    mode = mode_sizes(system, motion, true)
    predicted, undamped = (predicted_factor(s, scheme) for s in (system, replace(system, drag=0.0)))
    return Fate(scheme, predicted, undamped, perturbed(system, scheme), _fit(mode), motion, motion.distance(true), mode)


def predicted_factor(system: MassSpringSystem, scheme: Scheme) -> float:
    """By what a scheme of one step multiplies the fastest mode of the hanging string: by theory.

    The mode and its velocity are a plane that the linearised step does not leave: its Jacobian's eigenvalues there.
    """
    jacobian = step_jacobian(scheme, spring_equilibrium(system), DT)
    along = np.zeros((len(system.springs), system.dimension))
    along[:, 1] = fastest_mode(system)[0][1:]
    unit, nothing = along.ravel() / np.linalg.norm(along), np.zeros(along.size)
    mode = np.column_stack([np.concatenate([unit, nothing]), np.concatenate([nothing, unit])])
    return float(np.abs(np.linalg.eigvals(mode.T @ jacobian @ mode)).max())


def perturbed(system: MassSpringSystem, scheme: Scheme) -> float:
    """By what a scheme multiplies a small perturbation of the hanging string, in the shape of its fastest mode."""
    rest = hanging_string(system)
    positions = rest.positions.copy()
    positions[:, 1] += PERTURBATION * fastest_mode(system)[0]
    motion = simulate(replace(system, positions=positions), scheme, DT, PERTURBED_STEPS * DT)
    return _factor(mode_sizes(system, motion, Trajectory.of([rest])))


def fastest_mode(system: MassSpringSystem) -> tuple[Array, float]:
    """Its shape, one number per mass, and its frequency [1/s].

    Along itself a string of n equal masses and springs is a line of them: u_j = sin(j a), a = (2n - 1) pi / (2n + 1),
    with w = 2 sqrt(k/m) sin(a/2). It is the same however the string hangs, as long as it hangs straight.
    """
    n = len(system.springs)
    angle = (2 * n - 1) * np.pi / (2 * n + 1)
    frequency = 2 * np.sqrt(system.stiffness[0] / system.masses[-1]) * np.sin(angle / 2)
    return np.sin(angle * np.arange(n + 1)), float(frequency)


def mode_sizes(system: MassSpringSystem, motion: Trajectory, true: Trajectory) -> Array:
    """How large the fastest mode is in what a motion's springs are longer than they should be [m], at each time.

    The size of a swing u with velocity v is (u^2 + (v/w)^2)^(1/2). A string that swings is not straight: other modes
    leak into this a little.
    """
    shape, frequency = fastest_mode(system)
    longer = np.diff(shape) / (np.diff(shape) ** 2).sum()
    m = len(motion)
    (length, rate), (true_length, true_rate) = (_lengths_and_rates(system, t) for t in (motion, true))
    u, v = (length - true_length[:m]) @ longer, (rate - true_rate[:m]) @ longer
    return np.hypot(u, v / frequency)


def _lengths_and_rates(system: MassSpringSystem, motion: Trajectory) -> tuple[Array, Array]:
    """Of all springs at all times, each of shape (times, springs): [m] and [m/s]."""
    a, b = system.springs.T
    separation, relative = (q[:, b] - q[:, a] for q in (motion.positions, motion.velocities))
    length = np.linalg.norm(separation, axis=2)
    return length, (separation * relative).sum(axis=2) / length


def _fit(sizes: Array) -> float | None:
    """The growth per step between the sizes GROWING; None where there are none."""
    low, high = GROWING
    beyond = np.flatnonzero(sizes > high)
    if not len(beyond):
        return None
    below = np.flatnonzero(sizes[: beyond[0]] < low)
    growing = sizes[below[-1] + 1 : beyond[0]]
    return _factor(growing) if len(growing) > 10 else None


def _factor(sizes: Array) -> float:
    """By what something is multiplied in a step: the slope of a line through its logarithms."""
    return float(np.exp(np.polyfit(np.arange(len(sizes)), np.log(sizes), 1)[0]))


def tenfold(factor: float) -> float | None:
    """In how long a factor per step grows to ten [s]; None where it does not grow."""
    return float(DT * np.log(10) / np.log(factor)) if factor > 1 else None


def last(fate: Fate) -> float | None:
    """How far it is from the true motion at the end [m]; None where that is not finite."""
    return finite(float(fate.distance[-1]))


def _over_time(true: Trajectory, fates: Sequence[Fate]) -> Table:
    measures = {"distance from the true motion": "distance", "its fastest mode": "mode"}
    columns = ["time [s]", *(f"{fate.scheme.name}: {what} [m]" for fate in fates for what in measures)]
    rows = [
        [time, *(finite(float(getattr(f, name)[i])) for f in fates for name in measures.values())]
        for i, time in enumerate(true.times.tolist())
    ]
    return Table("first_order_instability_over_time", columns, rows)


def _findings(fates: Sequence[Fate]) -> list[str]:
    return [*map(_grows, fates), *(_undamped(f) for f in fates if f.predicted <= 1 < f.undamped), _ends(fates)]


def _undamped(fate: Fate) -> str:
    """What joins this page with that of stability limits, whose case without damping this string is not."""
    return (
        f"{fate.scheme.name} is stable here by the drag alone: without drag it is predicted to multiply the same mode "
        f"by {fate.undamped:.5f} in a step, tenfold every {tenfold(fate.undamped):.2g} s; that is the undamped case "
        "of 'Stability limits', which calls it unstable."
    )


def _ends(fates: Sequence[Fate]) -> str:
    ends = [f"{f.scheme.name} {'not a finite number' if last(f) is None else f'{last(f):.2g} m'}" for f in fates]
    return (
        f"With dt = {DT:g} s and a drag of {DRAG:g} N s/m the distances from the true motion after {DURATION:g} s are: "
        f"{', '.join(ends)}."
    )


def _grows(fate: Fate) -> str:
    seconds = tenfold(fate.predicted)
    fortune = "so that it dies away" if seconds is None else f"tenfold every {seconds:.2g} s"
    swinging = "" if fate.swinging is None else f", and {fate.swinging:.4f} on the swinging one"
    return (
        f"{fate.scheme.name} is predicted to multiply the fastest mode by {fate.predicted:.5f} in a step, {fortune}; "
        f"measured: {fate.perturbed:.5f} on the hanging string, perturbed a little{swinging}."
    )


EXPERIMENT = Experiment(
    name="first_order_instability",
    title="First-order instability",
    question="Why does a string blow up under Euler, where Heun swings on at the same step?",
    slides="15",
    run=run,
)
