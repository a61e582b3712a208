"""What do ground that shakes and a truck that crosses do to a bridge?

Seen from the ground a shaken bridge feels gravity g - a(t). What it should do is predicted by the linear bridge,
M u'' + C u' + K u = -M a(t) (Chopra, *Dynamics of Structures*), solved by the matrix exponential from one sample of the
sweep to the next, and not by any scheme. It sways most some time after the sweep has passed its natural frequency,
where K q = w^2 M q. A truck that crosses slowly sinks the middle along its influence line, K u = F with the truck's
weight wherever it is; a fast one makes it swing.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from engines.process.isolation import EngineStepper
from experiments.experiment import Experiment, Result, Table
from experiments.runs.progress import Progress
from experiments.runs.side_by_side import side_by_side
from experiments.runs.steppers import all_steppers
from reference.changes import Driven, whole_steps
from reference.outcome import Outcome
from reference.scenes import find
from reference.scenes.crossing import Crossing
from reference.scenes.ground_motion import FrequencySweep, GroundMotion
from reference.state import Array, Trajectory
from reference.stepper import Stepper, stepper_named
from reference.system import MassSpringSystem

#: Who is shown: the schemes that the engines are, and the engines.
ENGINES = ("mujoco_tendons", "pymunk_springs")

#: The step of all runs [s].
DT = 4e-3

#: The bridge that is shaken, up and down, and how.
SHAKEN = {"on": "rock", "axis": "y", "damping": 8e4, "panels": 6}
SWEEP = FrequencySweep(0.8, 2.0, 0.1, 20.0, direction=(0.0, 1.0))

#: How fast the truck goes [m/s].
SPEEDS = (2.5, 10.0, 40.0)


@dataclass(frozen=True)
class Ran:
    """A stepper's runs.

    Attributes:
        shaken: how the middle moved up and down while the sweep went on [m], shape (m,).
        crossed: by speed, how far it was down while the truck crossed [m], shape (m,).
        distance: of an engine's runs from its scheme's, the largest [m].
    """

    shaken: Array
    crossed: Mapping[float, Array]
    distance: float | None = None


def run(progress: Progress) -> Result:
    """The schemes that engines are, then the engines, on the same bridges."""
    known = all_steppers()
    engines = [s for s in (known[name] for name in ENGINES) if isinstance(s, EngineStepper)]
    schemes = {name: stepper_named(name) for e in engines for name in claims(e)}
    ends: dict[str, list[Outcome]] = {
        stepper.name: found for stepper, found in side_by_side([*schemes.values(), *engines], outcomes, progress)
    }
    failures = [f"{name}: {o.ending}, {o.reason}" for name, found in ends.items() for o in found if o.ending != "done"]
    rows = {name: _ran(found) for name, found in ends.items() if all(o.trajectory is not None for o in found)}
    for engine in engines:
        if engine.name in rows:
            rows[engine.name] = _with_distance(engine, rows[engine.name], ends)
    return result_of(rows, natural_frequencies(), predicted_sway(), influence_line(), failures)


def result_of(
    rows: Mapping[str, Ran], natural: Array, linear: Array, line: tuple[Array, Array], failures: Sequence[str] = ()
) -> Result:
    """Runs and what is predicted for them as findings and tables.

    Args:
        rows: by stepper.
        natural: natural frequencies [Hz].
        linear: the sway of the linear bridge [m], one for each step of the sweep.
        line: the influence line: positions of the truck [m], and how far the middle is down [m].
    """
    data = {"rows": rows, "natural": natural, "linear": linear, "line": line}
    tables = [_resonance_table(rows, linear), _truck_table(rows, line), _sway_table(rows, linear)]
    return Result(_findings(rows, natural, linear, line), tables, data, failures)


def claims(engine: EngineStepper) -> tuple[str, str]:
    """The schemes that an engine is known to be: with damping, for the shaken bridge, and without, for the truck's."""
    known = engine.engine.identified_as
    return known["damping"], known["plain"]


def shaken_bridge() -> Driven:
    """The bridge on ground that shakes."""
    return Driven(find("earthquake").system(SHAKEN), (GroundMotion(SWEEP),))


def crossed_bridge(speed: float) -> tuple[Driven, Crossing, float]:
    """The bridge with a truck, the truck, and how long it takes [s]: a whole number of steps."""
    driven = find("crossing").driven({"speed": speed})
    (drive,) = driven.drives
    assert isinstance(drive, Crossing)
    return driven, drive, DT * int(drive.places[-1] / speed / DT)


def outcomes(stepper: Stepper) -> list[Outcome]:
    """How all runs of a stepper end: the sweep, then each speed."""
    cases = [(shaken_bridge(), SWEEP.duration)]
    cases += [(driven, duration) for driven, _, duration in map(crossed_bridge, SPEEDS)]
    return [stepper.run(c.system, DT, whole_steps(DT, time), c.changes(DT, time)) for c, time in cases]


def middle(system: MassSpringSystem) -> int:
    """The number of the joint in the middle of the deck, whose joints come first."""
    along = system.positions[:, 0]
    on_the_deck = system.positions[:, 1] == 0
    return int(np.argmin(np.where(on_the_deck, np.abs(along - along.max() / 2), np.inf)))


def _down(system: MassSpringSystem, trajectory: Trajectory) -> Array:
    i = middle(system)
    return np.asarray(system.positions[i, 1] - trajectory.positions[:, i, 1])


def _ran(found: list[Outcome]) -> Ran:
    shaken, *crossed = [o.trajectory for o in found if o.trajectory is not None]
    bridges = (crossed_bridge(speed)[0].system for speed in SPEEDS)
    sags = {v: _down(s, t) for v, s, t in zip(SPEEDS, bridges, crossed, strict=True)}
    return Ran(-_down(shaken_bridge().system, shaken), sags)


def _with_distance(engine: EngineStepper, ran: Ran, ends: Mapping[str, list[Outcome]]) -> Ran:
    damped, plain = claims(engine)
    schemes = [ends[damped][0], *ends[plain][1:]]
    pairs = zip(ends[engine.name], schemes, strict=True)
    distances = [a.trajectory.distance(b.trajectory).max() for a, b in pairs if a.trajectory and b.trajectory]
    return Ran(ran.shaken, ran.crossed, float(max(distances)))


def matrices(system: MassSpringSystem) -> tuple[Array, Array, Array]:
    """K [N/m], C [N s/m] and the masses [kg] of all free coordinates, about the start, at which all is at rest."""
    from reference.assembly import assemble, spring_blocks

    k, c = (-assemble(system, blocks, sparse=False) for blocks in spring_blocks(system, system.start))
    return k, c, np.repeat(system.masses[~system.fixed], system.dimension)


def _coordinate(system: MassSpringSystem) -> int:
    """Which free coordinate is the height of the middle."""
    return int((~system.fixed[: middle(system)]).sum()) * system.dimension + 1


def natural_frequencies() -> Array:
    """Those that the sweep passes [Hz]."""
    from reference.theory.modes import squared_frequencies

    system = shaken_bridge().system
    own = np.sqrt(squared_frequencies(system, system.start)) / (2 * np.pi)
    return np.asarray(own[(own > SWEEP.from_frequency) & (own < SWEEP.to_frequency)])


def predicted_sway() -> Array:
    """How the middle of the linear bridge moves up and down at every step of the sweep [m], shape (m,).

    Its rates are z' = A z + B a with z = (u, u'); with a held at its value in the middle of each step, the exponential
    of (A B; 0 0) dt leads exactly from one step to the next.
    """
    from scipy.linalg import expm

    system = shaken_bridge().system
    k, c, masses = matrices(system)
    n, nothing = len(masses), np.zeros_like(k)
    a = np.block([[nothing, np.eye(n)], [-k / masses[:, None], -c / masses[:, None]]])
    up = np.concatenate([np.zeros(n), np.tile([0.0, -1.0], n // 2)])
    step = expm(DT * np.block([[a, up[:, None]], [np.zeros((1, 2 * n + 1))]]))
    times: Array = DT * (np.arange(whole_steps(DT, SWEEP.duration), dtype=np.float64) + 0.5)
    z, sways = np.zeros(2 * n), [0.0]
    for shake in SWEEP.acceleration(times)[:, 1]:
        z = step[:-1, :-1] @ z + step[:-1, -1] * shake
        sways.append(float(z[_coordinate(system)]))
    return np.array(sways)


def influence_line() -> tuple[Array, Array]:
    """Positions of the truck [m], and how far the middle is down [m] while it stands there."""
    driven, drive, _ = crossed_bridge(SPEEDS[0])
    system = driven.system
    positions = np.linspace(drive.places[0], drive.places[-1], 241)
    weight = np.zeros((len(positions), *system.positions.shape))
    weight[:, drive.joints] = drive.loads(positions)[:, :, None] * system.gravity
    force = weight[:, ~system.fixed].reshape(len(positions), -1)
    return positions, -np.linalg.solve(matrices(system)[0], force.T)[_coordinate(system)]


def peak(shaken: Array) -> tuple[float, float]:
    """The frequency of the sweep [Hz] when the middle is furthest from rest, and how far that is [m]."""
    at = int(np.argmax(np.abs(shaken)))
    return float(SWEEP.frequency(np.array(at * DT))), float(np.abs(shaken[at]))


def off_the_line(sag: Array, speed: float, line: tuple[Array, Array]) -> float:
    """How far the middle is from the influence line at most, as a part of that line's largest sag."""
    expected = np.interp(speed * DT * np.arange(len(sag)), *line)
    return float(np.abs(sag - expected).max() / line[1].max())


def _resonance_table(rows: Mapping[str, Ran], linear: Array) -> Table:
    columns = ["stepper", "sways most at [Hz]", "predicted [Hz]", "by [m]", "predicted [m]"]
    columns += ["distance from its scheme [m]"]
    at, by = peak(linear)
    found = {name: peak(ran.shaken) for name, ran in rows.items()}
    body = [[name, found[name][0], at, found[name][1], by, ran.distance] for name, ran in rows.items()]
    return Table("ground_motion", columns, body)


def _truck_table(rows: Mapping[str, Ran], line: tuple[Array, Array]) -> Table:
    columns = ["stepper", "speed [m/s]", "largest sag [m]", "largest sag of the influence line, predicted [m]"]
    columns += ["off the line, part of its largest sag"]
    body = [
        [name, speed, float(sag.max()), float(line[1].max()), off_the_line(sag, speed, line)]
        for name, ran in rows.items()
        for speed, sag in ran.crossed.items()
    ]
    return Table("ground_motion_truck", columns, body)


def _sway_table(rows: Mapping[str, Ran], linear: Array) -> Table:
    every = 10
    body = [
        [
            i * DT,
            float(SWEEP.frequency(np.array(i * DT))),
            float(linear[i]),
            *(float(r.shaken[i]) for r in rows.values()),
        ]
        for i in range(0, len(linear), every)
        if all(i < len(r.shaken) for r in rows.values())
    ]
    columns = ["time [s]", "frequency [Hz]", "predicted [m]", *(f"{name} [m]" for name in rows)]
    return Table("ground_motion_sway", columns, body)


def _findings(rows: Mapping[str, Ran], natural: Array, linear: Array, line: tuple[Array, Array]) -> list[str]:
    return [*_of_the_ground(rows, natural, linear), *_of_the_truck(rows, line), *_of_engines(rows)]


def _of_the_ground(rows: Mapping[str, Ran], natural: Array, linear: Array) -> Iterator[str]:
    peaks = [peak(ran.shaken) for ran in rows.values()]
    if not peaks:
        return
    (low, high), (least, most) = ((min(q), max(q)) for q in zip(*peaks, strict=True))
    at, by = peak(linear)
    yield (
        "Shaken up and down, ever faster, the bridge sways most while the ground shakes at "
        f"{_span(low, high, '.2f')} Hz, by {_span(1e3 * least, 1e3 * most, '.1f')} mm, measured in {len(peaks)} runs. "
        f"Predicted by the linear bridge: {at:.2f} Hz, {1e3 * by:.1f} mm.{_why_later(natural, at)}"
    )


def _why_later(natural: Array, at: float) -> str:
    """Why the largest sway does not come at a natural frequency but after it; nothing where it does not."""
    before = natural[natural < at]
    if not len(before):
        return ""
    return (
        f" Shaken at one frequency for long it would sway most near its natural frequency, predicted {before[-1]:.2f} "
        "Hz; in a sweep it takes some swings to build up, and meanwhile the frequency goes on."
    )


def _span(low: float, high: float, form: str) -> str:
    return " to ".join(dict.fromkeys([f"{low:{form}}", f"{high:{form}}"]))


def _of_the_truck(rows: Mapping[str, Ran], line: tuple[Array, Array]) -> Iterator[str]:
    if not rows:
        return
    off = {speed: max(off_the_line(r.crossed[speed], speed, line) for r in rows.values()) for speed in SPEEDS}
    sentences = " ".join(f"{100 * off[speed]:.0f} % at {speed:g} m/s," for speed in SPEEDS).rstrip(",")
    yield (
        f"A truck that stands in the middle sinks it by {1e3 * line[1].max():.0f} mm, predicted. One that crosses "
        f"takes the middle off its influence line by at most {sentences} of that."
    )


def _of_engines(rows: Mapping[str, Ran]) -> Iterator[str]:
    distances = {name: ran.distance for name, ran in rows.items() if ran.distance is not None}
    if distances:
        furthest = max(distances, key=lambda name: distances[name])
        yield (
            f"With gravity or masses that change all the time, {len(distances)} engines go with the schemes that they "
            f"are: {furthest} goes furthest, {distances[furthest]:.1e} m."
        )


EXPERIMENT = Experiment(
    name="ground_motion",
    title="Ground that shakes, and a truck",
    question="What do ground that shakes and a truck that crosses do to a bridge?",
    slides="28-29",
    run=run,
)
