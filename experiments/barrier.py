"""What does a barrier do to the motion, by the lecture's rule and in each engine?

A mass let go at rest on a frictionless circle, at an angle a from its top, slides down and leaves it where
cos(angle) = (2/3) cos(a): there the circle need give no force any more, m v^2/R = m g cos(angle) with
v^2 = 2 g R (cos a - cos angle). From the very top, barely perturbed, that is cos(angle) = 2/3.

A rule that takes velocity inwards only, as the lab's does, leaves to the circle what it may do: give a force outwards.
Slide 17's, even as it is meant, takes all velocity across the circle: outwards too. Semi-implicit Euler, velocities
first (`kick_drift`), moves by h v' with v' = v - h g, so that a mass that slides along comes to
h^2 (v^2/(2 R) - g cos(angle)) from the circle: it is inside, and by slide 17 held, until v^2 = 2 R g cos(angle), where
cos(angle) = (1/2) cos(a), whatever the step. Heun and others of second order move by h v - h^2 g/2, and are inside as
long as they should be: with them both rules are right.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from engines.process.isolation import EngineStepper
from experiments.experiment import Experiment, Result, Table
from experiments.runs.progress import Progress
from experiments.runs.side_by_side import side_by_side
from experiments.runs.steppers import all_steppers, installed_engines
from reference.conserved import energy
from reference.lecture.slide_17 import CircleAsMeant
from reference.obstacles import Circle
from reference.outcome import Outcome
from reference.scenes import find
from reference.state import Trajectory
from reference.stepper import Stepper
from reference.system import MassSpringSystem

#: Where the mass is let go [rad from the top], on a circle of 1 m, and how long it is watched [s].
START, RADIUS, DURATION = 0.1, 1.0, 1.3

#: Steps [s].
STEPS = (4e-3, 2e-3, 1e-3, 5e-4)

#: The circle has given a force in a step that changes the horizontal velocity by more than this part of g dt.
CONTACT = 1e-4

#: A mass that is this near to the circle in the end [m] has not left it.
NEAR = 0.01

#: The stiffness of the spring that makes of the mass a string, which engines ask for [N/m]: its force is below 1e-7 of
#: the weight.
SLACK = 1e-9

#: Schemes that are shown: of second order, and the two that engines are.
SCHEMES = ("heun", "kick_drift", "drift_kick")

#: What becomes of the velocity of a mass inside.
INWARDS, ALONG, PRINTED, OWN = "takes v inwards", "keeps v along", "as printed", "its own"

#: Who is measured by the rule as it is meant on slide 17: where it is right, and where it is not.
MEANT = ("heun", "kick_drift")


@dataclass(frozen=True)
class Slide:
    """What a mass did on the circle.

    Attributes:
        angle: where it left [rad from the top]; None if it did not.
        last: where it was in the end, or when it left [rad].
        depth: the deepest it was inside [m].
        gained: its energy then, less that at the start [J].
    """

    angle: float | None
    last: float
    depth: float
    gained: float


def slope(circle: Circle, start: float = START) -> MassSpringSystem:
    """A mass at rest on a circle, at an angle from its top [rad]; far above it the anchor of a spring without force."""
    centre, anchor = np.array(circle.centre), np.array([0.0, 4 * circle.radius])
    place = circle.radius * np.array([np.sin(start), np.cos(start)])
    return MassSpringSystem(
        positions=centre + np.array([anchor, place]),
        springs=np.array([[0, 1]]),
        masses=np.array(0.02),
        rest_lengths=np.array(np.linalg.norm(place - anchor)),
        stiffness=np.array(SLACK),
        fixed=np.array([True, False]),
        obstacles=(circle,),
    )


def predicted(start: float = START, fraction: float = 2 / 3) -> float:
    """The angle [rad] where cos(angle) is a fraction of the start's."""
    return float(np.arccos(fraction * np.cos(start)))


def measure(system: MassSpringSystem, motion: Trajectory) -> Slide:
    """Where the mass leaves: after the last step in which the circle changed its horizontal velocity.

    Nothing else does: gravity is vertical.
    """
    (circle,) = system.obstacles
    assert isinstance(circle, Circle)
    distances = circle.signed_distances(motion.positions[:, 1])[0][:, 0]
    dt = motion.times[1]
    in_contact = np.flatnonzero(np.abs(np.diff(motion.velocities[:, 1, 0])) > CONTACT * -system.gravity[1] * dt)
    left = len(in_contact) > 0 and distances[-1] > NEAR
    last = int(in_contact[-1]) + 1 if left else len(motion) - 1
    x, y = motion.positions[last, 1] - np.array(circle.centre)
    angle = float(np.arctan2(x, y))
    states = motion.states()
    gained = energy(system, states[last]) - energy(system, states[0])
    return Slide(angle if left else None, angle, float(max(0.0, -distances[: last + 1].min())), gained)


def run(progress: Progress) -> Result:
    """The mass on the circle for all, at every step; then the string of the scene `barrier`."""
    system = slope(Circle((0.0, 0.0), RADIUS))
    slides: dict[tuple[str, str], list[Slide | None]] = {}
    failures: list[str] = []
    for (name, rule), outcomes in _slides(system, progress):
        slides[name, rule] = [None if o.trajectory is None else measure(system, o.trajectory) for o in outcomes]
        failures += [f"{name}: {o.ending}, {o.reason}" for o in outcomes if o.ending != "done"][:1]
    scene = find("barrier")
    string = scene.system({})
    motions = dict(_strings(string, scene.dt, round(scene.duration / scene.dt), progress))
    strings = {name: o.trajectory for name, o in motions.items() if o.trajectory is not None}
    failures += [f"{name}, string: {o.ending}, {o.reason}" for name, o in motions.items() if o.ending != "done"]
    return result_of(slides, string, strings, failures)


def result_of(
    slides: dict[tuple[str, str], list[Slide | None]],
    string: MassSpringSystem,
    strings: dict[str, Trajectory],
    failures: Sequence[str] = (),
) -> Result:
    """Slides and strings as findings and tables.

    Args:
        slides: by stepper and rule, one for each of STEPS; None where there was no motion.
        string: the scene with its circle.
        strings: by stepper, its motion.
    """
    tables = [_slide_table(slides), _string_table(string, strings)]
    data = {"slides": slides, "strings": strings, "circle": string.obstacles[0]}
    return Result(_findings(slides), tables, data, failures)


def _slides(system: MassSpringSystem, progress: Progress) -> Iterator[tuple[tuple[str, str], list[Outcome]]]:
    def task(stepper: Stepper) -> list[Outcome]:
        return [stepper.run(system, dt, round(DURATION / dt)) for dt in STEPS]

    known = all_steppers()
    as_meant = replace(system, obstacles=(CircleAsMeant((0.0, 0.0), RADIUS),))
    for name in SCHEMES:
        yield (name, INWARDS), task(known[name])
    for name in MEANT:
        yield (name, ALONG), [known[name].run(as_meant, dt, round(DURATION / dt)) for dt in STEPS]
    yield ("lecture_barrier", PRINTED), task(known["lecture_barrier"])
    for stepper, outcomes in side_by_side(able(), task, progress):
        yield (stepper.name, OWN), outcomes


def able() -> list[EngineStepper]:
    """The engines that take a circle."""
    return [s for s in installed_engines() if "circle" in s.engine.capabilities]


def _strings(system: MassSpringSystem, dt: float, steps: int, progress: Progress) -> Iterator[tuple[str, Outcome]]:
    known = all_steppers()
    steppers: list[Stepper] = [*(known[name] for name in (*SCHEMES, "lecture_barrier")), *able()]
    for stepper, outcome in side_by_side(steppers, lambda s: s.run(system, dt, steps), progress):
        yield stepper.name, outcome


def _slide_table(slides: dict[tuple[str, str], list[Slide | None]]) -> Table:
    columns = ["stepper", "rule", "dt [s]", "leaves at [deg]", "predicted [deg]", "is at, in the end or then [deg]"]
    columns += ["deepest inside [m]", "energy gained by then [J]"]
    rows = []
    for (name, rule), found in slides.items():
        for dt, slide in zip(STEPS, found, strict=True):
            if slide is None:
                continue
            angle = None if slide.angle is None else float(np.degrees(slide.angle))
            last = float(np.degrees(slide.last))
            rows.append([name, rule, dt, angle, float(np.degrees(predicted())), last, slide.depth, slide.gained])
    return Table("barrier", columns, rows)


def _string_table(system: MassSpringSystem, strings: dict[str, Trajectory]) -> Table:
    """The scene: how deep any mass was, and the most energy there ever was above that at the start."""
    columns = ["stepper", "deepest inside [m]", "energy gained at most [J]", "energy lost in the end [J]"]
    (circle,) = system.obstacles
    rows = []
    for name, motion in strings.items():
        energies = np.array([energy(system, state) for state in motion.states()])
        depth = max(0.0, -float(circle.signed_distances(motion.positions[:, ~system.fixed])[0].min()))
        rows.append([name, depth, float(energies.max() - energies[0]), float(energies[0] - energies[-1])])
    return Table("barrier_string", columns, rows)


def _findings(slides: dict[tuple[str, str], list[Slide | None]]) -> list[str]:
    finest = {key: found[-1] for key, found in slides.items() if found[-1] is not None}
    leaves = {key: float(np.degrees(s.angle)) for key, s in finest.items() if s.angle is not None}
    right, held = (float(np.degrees(predicted(fraction=f))) for f in (2 / 3, 1 / 2))
    sentences = [
        f"A mass let go at rest {np.degrees(START):.1f} degrees from the top of a frictionless circle should leave it "
        f"at {right:.1f} degrees, where cos(angle) is 2/3 of the cosine it began with. With steps of {STEPS[-1]:g} s "
        + _said(leaves, [("heun", INWARDS), ("kick_drift", INWARDS)])
        + "."
    ]
    sentences.append(
        f"Slide 17's rule as it is meant takes velocity outwards too. With kick-drift that holds the mass on, to where "
        f"cos(angle) is 1/2 of that cosine whatever the step: predicted {held:.1f} degrees, measured "
        + (
            f"{leaves['kick_drift', ALONG]:.1f}."
            if ("kick_drift", ALONG) in leaves
            else f"none, it does not leave in {DURATION:g} s."
        )
    )
    printed = finest.get(("lecture_barrier", PRINTED))
    if printed is not None and printed.angle is None:
        ends = f"in {DURATION:g} s it comes to {np.degrees(printed.last):.1f} degrees"
        sentences.append(
            f"By the rule as it is printed the mass stays on: {ends} from the top, from {np.degrees(START):.1f}."
        )
    engines = {key: slide for key, slide in finest.items() if key[1] == OWN}
    if engines:
        furthest = max(engines, key=lambda key: abs(leaves.get(key, np.inf) - right))
        deepest = max(engines, key=lambda key: engines[key].depth)
        where = f"at {leaves[furthest]:.1f} degrees" if furthest in leaves else f"not in {DURATION:g} s"
        sentences.append(
            f"Of {len(engines)} engine settings the one furthest from the true angle, {furthest[0]}, leaves {where}; "
            f"the deepest inside, {deepest[0]}, is by {engines[deepest].depth:.1e} m."
        )
    return sentences


def _said(leaves: dict[tuple[str, str], float], keys: Sequence[tuple[str, str]]) -> str:
    return " and ".join(
        f"{name}, a rule that {rule}, "
        + (f"does at {leaves[name, rule]:.1f}" if (name, rule) in leaves else f"does not in {DURATION:g} s")
        for name, rule in keys
    )


EXPERIMENT = Experiment(
    name="barrier",
    title="A physical barrier",
    question="What does a circle do to a mass that slides on it, by the lecture's rule and in each engine?",
    slides="16-17",
    run=run,
)
