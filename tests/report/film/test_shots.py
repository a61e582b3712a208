"""Who is in a film, what is said of them, and what the picture is framed by."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest

from experiments.runs.comparison import Comparison, Run
from reference.changes import Change
from reference.errors import InputError
from reference.identification import TOLERANCE, Identification, Match
from reference.outcome import Outcome
from reference.scenes import Setup, find
from reference.state import Trajectory
from reference.system import MassSpringSystem
from report.film.contact_sheet import ContactSheet, Shot, contact_sheet
from report.film.film import Film, film, film_of, frame_steps, leaves, look_at, shots
from report.film.view import View, box_of, view_of
from tests.experiments.canned.scenes import DURATION, stretched
from tests.experiments.canned.steppers import Named

SYSTEM = find("string").system({"masses": 3})
SETUP = Setup("string", SYSTEM, DURATION / 4, DURATION)
UNKNOWN = Identification("one", (), 1e-12, "none")


def ran(name: str, motion: Trajectory | None, identified: Identification = UNKNOWN, kind: str = "engine") -> Run:
    """One that moved."""
    outcome = Outcome("crashed", "killed") if motion is None else Outcome("done", "", motion)
    return Run(Named(name, kind), outcome, identified, None, None)


def shifted(by: float) -> Trajectory:
    """The motion, and its last mass by so much [m] off at the end."""
    motion = stretched(SYSTEM)
    positions = motion.positions.copy()
    positions[-1, -1, 0] += by
    return replace(motion, positions=positions)


def test_by_default_engines_are_seen_beside_heun_and_by_name_whoever_is_named() -> None:
    """Those without a motion are not."""
    runs = (
        ran("rk4", shifted(0.1), kind="scheme"),
        ran("heun", shifted(0.2), kind="scheme"),
        ran("pymunk_springs", shifted(0.3)),
        ran("Segfaults", None),
    )
    comparison = Comparison(SETUP, None, runs)
    assert [shot.names for shot in shots(comparison)] == [("heun",), ("pymunk_springs",)]
    assert [shot.names for shot in shots(comparison, ["Segfaults", "rk4"])] == [("rk4",)]


def test_motions_the_same_to_rounding_are_one_panel() -> None:
    """As near as schemes are identified: a part of the scene's size. Each to the first of its panel."""
    near = TOLERANCE * SYSTEM.size
    places = {"a": 0, "b": 3, "c": 0.8, "d": 3.5, "e": -1.5, "f": 1.6}
    runs = {
        name: ran(name, shifted(by * near), Identification(name, (Match(name, 1e-15),), 1e-12))
        for name, by in places.items()
    }
    found = shots(Comparison(SETUP, None, tuple(runs.values())))
    assert [shot.names for shot in found] == [("a", "c"), ("b", "d"), ("e",), ("f",)]
    assert [shot.outcome for shot in found] == [runs[name].outcome for name in "abef"]
    assert [shot.caption for shot in found] == [f"identified as {name}" for name in "abef"]


@pytest.mark.parametrize(
    ("errors", "reason", "wanted"),
    [
        ({"heun": 1e-15}, "", "identified as heun"),
        ({"heun": 1e-15, "rk4": 2e-15, "euler": 3e-15}, "", "identified as heun, or 2 that do the same"),
        ({"heun": 1e-3, "rk4": 2e-3}, "far", "not identified; nearest heun"),
        ({}, "nothing to compare", "not identified"),
    ],
)
def test_a_panel_says_which_scheme_it_is(errors: Mapping[str, float], reason: str, wanted: str) -> None:
    """Or which is nearest, if one was compared."""
    ranking = tuple(Match(name, error) for name, error in errors.items())
    comparison = Comparison(
        SETUP, None, (ran("one", stretched(SYSTEM), Identification("one", ranking, 1e-12, reason)),)
    )
    (shot,) = shots(comparison)
    assert shot.caption == wanted


def test_thirty_seconds_are_not_too_long_and_two_frames_not_too_few() -> None:
    """However short, the first and the last step."""
    thirty = Setup("string", SYSTEM, 0.01, 30.0)
    assert len(frame_steps(thirty, 3000)) == 751
    with pytest.raises(InputError, match=r"an animation of 30\.3 s: expected at most 30 s; .* or --slow 0\.99"):
        frame_steps(Setup("string", SYSTEM, 0.01, 30.3), 3030)
    assert frame_steps(Setup("string", SYSTEM, 1e-3, 0.01), 10) == [0, 10]


def moved(*places: tuple[float, float]) -> Trajectory:
    """The last mass at these places [m], one after the other, every 0.1 s; the others at rest."""
    positions = np.repeat(SYSTEM.positions[None], len(places), axis=0)
    positions[:, -1] = places
    return Trajectory(0.1 * np.arange(len(places)), positions, np.zeros_like(positions))


def test_the_first_motion_frames_the_picture_and_tells_the_colours() -> None:
    """Another widens it as far as it goes, a little; how much it stretches springs makes no difference."""
    first = moved((0.0, -0.5), (0.1, -0.5))
    other = moved((0.0, -0.5), (0.2, -9.0))
    alone, both = look_at(SYSTEM, [first]), look_at(SYSTEM, [first, other])
    assert (both.most, both.depths) == (alone.most, alone.depths) == (alone.most, (0, 0))
    assert both.window != alone.window == look_at(SYSTEM, [first, first]).window
    high = np.ptp(box_of(first.positions)[2:])
    assert alone.window[2] - 0.5 * high < both.window[2] < alone.window[2] - 0.25 * high


def test_depths_are_those_of_the_first_motion() -> None:
    """The farthest and the nearest, at any time."""
    system = find("cloth").system({"rows": 3, "columns": 3})
    there = np.stack([system.positions, system.positions + np.array([0.0, 0.0, 0.5])])
    motion = Trajectory(np.array([0.0, 0.1]), there, np.zeros_like(there))
    beyond = replace(motion, positions=3 * there)
    found = look_at(system, [motion, beyond])
    nearer = view_of(there).project(there)[1]
    assert found.depths == (nearer.min(), nearer.max())


def test_a_mass_leaves_when_it_first_is_outside() -> None:
    """Whether or not it comes back; one that is nowhere has left; on the border it has not."""
    view, window = View(np.zeros(2), np.eye(2), np.inf), (-1.0, 1.0, -2.0, 1.0)
    inside, border, outside, nowhere = (0.0, -0.5), (1.0, -2.0), (1.1, 0.0), (np.nan, 0.0)
    assert leaves(moved(inside, border, inside), view, window) is None
    assert leaves(moved(inside, border, outside, inside, outside), view, window) == pytest.approx(0.2)
    assert leaves(moved(inside, nowhere), view, window) == pytest.approx(0.1)


def shot(name: str, motion: Trajectory, ending: str = "done") -> Shot:
    """A panel."""
    return Shot((name,), "", Outcome(ending, "" if ending == "done" else "it blew up", motion))  # type: ignore[arg-type]


def test_a_film_is_framed_by_the_true_motion_or_by_what_did_not_blow_up_or_by_the_start() -> None:
    """In this order, whoever stands first; what goes out of the picture is told with its time, of each panel."""
    still, far = moved((0.0, -0.5), (0.0, -0.5)), moved((0.0, -0.5), (90.0, -0.5))
    wild, calm = shot("wild", far, "diverged"), shot("calm", still)
    small = look_at(SYSTEM, [still]).window
    framed = film_of(SETUP, [wild, calm], None)
    assert framed.look.window == small
    assert [made.left for made in framed.shots] == [pytest.approx(0.1), None]
    assert [made.names for made in framed.shots] == [("wild",), ("calm",)]
    assert film_of(SETUP, [wild], None).look.window == look_at(SYSTEM, [Trajectory.of([SYSTEM.start])]).window
    by_true = film_of(SETUP, [calm], far)
    assert by_true.look.window[1] > 90
    assert film_of(SETUP, [shot("far", far), calm], None).look.window[1] > 90


def test_colours_are_told_by_the_springs_there_are_in_the_first_motion() -> None:
    """What it stretches by once it is broken has no part in them, whoever else is seen; unbroken, it has."""
    system = find("chain").system({"masses": 3, "breaking_force": 0.8})
    setup, there = replace(SETUP, system=system), np.repeat(system.positions[None], 5, axis=0)
    torn = there.copy()
    torn[1:, -1] -= 0.05
    torn[2:, -1] -= 10 * system.size
    breaking, whole = (
        shot(name, Trajectory(SETUP.dt * np.arange(5), x, 0 * x)) for name, x in (("b", torn), ("w", there))
    )
    assert film_of(setup, [breaking, whole], None).look.most < 1 < look_at(system, [breaking.motion]).most


def test_the_true_motion_is_seen_behind_where_masses_are_few() -> None:
    """Thirty at most: of more it would hide the others."""

    def with_true(system: MassSpringSystem) -> Film:
        motion = stretched(system)
        setup = replace(SETUP, system=system)
        return film(Comparison(setup, motion, (ran("one", motion),)))

    few, many = (find("string").system({"masses": n}) for n in (29, 30))  # and one that is held
    assert with_true(few).true is not None
    assert with_true(many).true is None
    assert title(with_true(few)) == "string, dt = 0.1 s; broad and grey: the true motion"
    assert title(with_true(many)) == "string, dt = 0.1 s"


def title(made: Film) -> str:
    """What stands above all."""
    titles = []

    def keep(system: object, shots: object, look: object, title: str) -> None:
        titles.append(title)
        raise NotImplementedError  # nothing need be drawn

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("report.film.film.contact_sheet", keep)
        with pytest.raises(NotImplementedError):
            next(made.frames(lambda _: None))
    return titles[0]


def test_what_has_ended_is_drawn_nowhere() -> None:
    """After its last step; at that it still is."""
    made = film_of(
        SETUP, [shot("one", stretched(SYSTEM)), shot("short", moved((0.0, 0.0), (1.0, 1.0)), "diverged")], None
    )
    assert made.positions(made.shots[1], 1)[-1].tolist() == [1, 1]
    assert np.isnan(made.positions(made.shots[1], 2)).all()
    assert made.positions(made.shots[1], 2).shape == SYSTEM.positions.shape


def test_springs_are_gone_once_they_break_from_panels_and_from_the_true_motion() -> None:
    """From the step on at which the setup says so, in every frame that follows."""
    setup = replace(SETUP, changes=(Change(2 * SETUP.dt, "break", (1.0,)),))
    motion = stretched(SYSTEM)
    made = replace(film_of(setup, [shot("one", motion)], motion), steps=(0, 1, 2, 4))
    sheets, drawn = [], []

    def keep(*arguments: object) -> ContactSheet:
        sheets.append(contact_sheet(*arguments))  # type: ignore[arg-type]
        return sheets[0]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("report.film.film.contact_sheet", keep)
        for _ in made.frames(lambda _: None):
            (drawing,) = sheets[0].drawings
            drawn.append((len(drawing.front.get_segments()), len(drawing._true.get_segments())))
    springs = len(SYSTEM.springs)
    assert drawn == [(springs, springs)] * 3 + [(springs - 1, springs - 1)]
