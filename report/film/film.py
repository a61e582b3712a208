"""A comparison as moving pictures: the reference scheme and the engines side by side, at the same times."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from experiments.runs.comparison import Comparison, Run
from experiments.runs.progress import Progress
from reference.errors import InputError
from reference.identification import TOLERANCE
from reference.line import obstacle_in_plane
from reference.outcome import Outcome
from reference.scenes import Setup
from reference.springs.breaking import breaks_of, without_force
from reference.state import Array, Trajectory
from reference.system import BREAK, BoolArray, MassSpringSystem
from report.film.contact_sheet import Shot, contact_sheet
from report.film.drawing import FEW, Look, scale_of
from report.film.obstacle_image import obstacle_image
from report.film.view import View, Window, box_of, outside, view_of, window_around

#: Frames in a second, and how many an animation has at most.
RATE, MOST_FRAMES = 25, 750

#: The scheme the engines are seen beside.
REFERENCE = "heun"


def shots(comparison: Comparison, names: Sequence[str] = ()) -> list[Shot]:
    """The runs to be seen, those with the same motion to rounding as one: of these names, or reference and engines.

    What crashed, timed out or is unsupported has no motion, and is not there.
    """
    wanted = [r for r in comparison.runs if r.outcome.trajectory is not None]
    wanted = [r for r in wanted if r.stepper.name in names] if names else [r for r in wanted if _is_shown(r)]
    near = TOLERANCE * comparison.setup.system.size
    groups: list[list[Run]] = []
    for run in wanted:
        alike = (g for g in groups if _apart(g[0].outcome, run.outcome) <= near)
        group = next(alike, None)
        if group is None:
            groups.append([run])
        else:
            group.append(run)
    return [Shot(tuple(r.stepper.name for r in g), _caption(g[0]), g[0].outcome) for g in groups]


def _is_shown(run: Run) -> bool:
    return run.stepper.kind == "engine" or run.stepper.name == REFERENCE


def _apart(one: Outcome, other: Outcome) -> float:
    """How far two motions are apart at most [m]: infinite where one ends before the other."""
    assert one.trajectory is not None
    assert other.trajectory is not None
    return float(one.trajectory.distance(other.trajectory).max())


def _caption(run: Run) -> str:
    if run.identification.identified_as is not None:
        ties = len(run.identification.ties)
        return f"identified as {run.identification.identified_as}" + (f", or {ties} that do the same" if ties else "")
    nearest = f"; nearest {run.identification.ranking[0].scheme}" if run.identification.ranking else ""
    return f"not identified{nearest}"


def frame_steps(setup: Setup, steps: int, slow: float = 1.0) -> list[int]:
    """Which steps are shown, RATE of them in a second of the film, which is `slow` times as long as the motion.

    Raises:
        InputError: for a `slow` that is not a number > 0, and for more than MOST_FRAMES.
    """
    if not 0 < slow < np.inf:
        raise InputError(f"slow = {slow:g}: expected a finite number > 0")
    count = setup.duration * slow * RATE
    if count > MOST_FRAMES:
        seconds = setup.duration * slow
        raise InputError(
            f"an animation of {seconds:g} s: expected at most {MOST_FRAMES / RATE:g} s; take a shorter --duration, or "
            f"--slow {MOST_FRAMES / RATE / setup.duration:.2g}"
        )
    shown = max(2, round(count) + 1)
    return np.linspace(0, steps, shown).round().astype(int).tolist()


def look_at(system: MassSpringSystem, motions: Sequence[Trajectory], seen: BoolArray | None = None) -> Look:
    """A view, a window and a scale of strain for the first motion: others are seen so far as they go no further.

    Steady, so that a motion that blows up makes nothing of the others.

    Args:
        seen: which springs are drawn of the first motion at which step, shape (m, s); all where left out.
    """
    model = motions[0].positions
    view = view_of(model)
    boxes = [box_of(view.project(motion.positions)[0]) for motion in motions]
    window = window_around(boxes)
    depth = view.project(model)[1]
    depths = (float(depth.min()), float(depth.max()))
    obstacles = [obstacle_in_plane(obstacle) for obstacle in system.obstacles]
    return Look(view, window, scale_of(system, model, seen), depths, obstacle_image(obstacles, view, window))


def leaves(motion: Trajectory, view: View, window: Window) -> float | None:
    """The first time at which a mass is outside of the window, or not finite [s]."""
    gone = outside(view.project(motion.positions)[0], window).any(axis=1)
    return float(motion.times[np.argmax(gone)]) if gone.any() else None


@dataclass(frozen=True, eq=False)
class Film:
    """Panels side by side, at some steps.

    Attributes:
        setup: what moves.
        shots: the panels.
        steps: which are shown.
        look: what the panels have in common.
        true: the true motion, to be seen behind the others; None where it is not known or would be too much.
    """

    setup: Setup
    shots: Sequence[Shot]
    steps: Sequence[int]
    look: Look
    true: Trajectory | None = None

    def positions(self, shot: Shot, step: int) -> Array:
        """Where a panel's masses are at a step [m], shape (n, d); not a number once its motion has ended."""
        motion = shot.motion.positions
        return motion[step] if step < len(motion) else np.full_like(motion[0], np.nan)

    def systems(self, motion: Trajectory) -> list[MassSpringSystem]:
        """The system at every step that is shown, without the springs that are broken then in a motion."""
        return _broken(self.setup, motion).systems_at(self.steps)

    def frames(self, progress: Progress) -> Iterator[Array]:
        """The pictures, each of shape (h, w, 3), of bytes; h and w are even."""
        from matplotlib.backends.backend_agg import FigureCanvasAgg

        behind = "" if self.true is None else "; broad and grey: the true motion"
        sheet = contact_sheet(
            self.setup.system, self.shots, self.look, f"{self.setup.name}, dt = {self.setup.dt:g} s{behind}"
        )
        canvas = FigureCanvasAgg(sheet.figure)
        systems = [self.systems(shot.motion) for shot in self.shots]
        true: list[tuple[Array, MassSpringSystem] | None] = [None] * len(self.steps)
        if self.true is not None:
            true = list(zip(self.true.positions[[*self.steps]], self.systems(self.true), strict=True))
        for i, step in enumerate(self.steps):
            progress(f"{i} of {len(self.steps)} frames")
            time = step * self.setup.dt
            sheet.clock.set_text(f"t = {time:.3f} s")
            for k, (shot, drawing, note) in enumerate(zip(self.shots, sheet.drawings, sheet.notes, strict=True)):
                drawing.show(self.positions(shot, step), systems[k][i], true[i])
                note.set_visible(shot.left is not None and time >= shot.left)
            canvas.draw()
            yield np.asarray(canvas.buffer_rgba())[..., :3].copy()


def film(comparison: Comparison, names: Sequence[str] = (), slow: float = 1.0) -> Film:
    """A comparison's film: see `shots` for who is in it, `frame_steps` for its frames.

    What it is framed by is the true motion where that is known, or else the first run that did not blow up.

    Raises:
        InputError: where no run has left a motion.
    """
    return film_of(comparison.setup, shots(comparison, names), comparison.true, slow)


def film_of(setup: Setup, shown: Sequence[Shot], true: Trajectory | None, slow: float = 1.0) -> Film:
    """The film of some panels. Raises InputError where there is none."""
    if not shown:
        raise InputError(f"nothing to show of {setup.name}: no stepper that was asked for has left a motion")
    sane = [shot.motion for shot in shown if shot.outcome.ending == "done"]
    if true is not None:
        sane.insert(0, true)
    sane = sane or [Trajectory.of([setup.system.start])]
    look = look_at(setup.system, sane, _seen(setup, sane[0]))
    shown = [Shot(s.names, s.caption, s.outcome, leaves(s.motion, look.view, look.window)) for s in shown]
    steps = frame_steps(setup, setup.steps, slow)
    return Film(setup, shown, steps, look, true if len(setup.system.masses) <= FEW else None)


def _broken(setup: Setup, motion: Trajectory) -> Setup:
    """The setup, with the springs that broke in a motion of it among its changes."""
    return replace(setup, changes=(*setup.changes, *breaks_of(setup.system, motion, setup.dt, setup.changes)))


def _seen(setup: Setup, motion: Trajectory) -> BoolArray | None:
    """Which springs are there at every step of a motion, shape (m, s); None where all are."""
    broken = _broken(setup, motion)
    if not any(change.parameter == BREAK for change in broken.changes):
        return None
    return np.array([~without_force(system) for system in broken.systems_at(range(len(motion)))])
