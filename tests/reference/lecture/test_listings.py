"""The lecture's listings, executed: which are one and the same, which scheme they are, and their errata."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reference.changes import Change
from reference.identification import candidates, identify_run
from reference.lecture.listings import (
    LectureListing,
    Links,
    StringConstants,
    derivatives,
    force_from_next,
    heun_with_barrier,
    listings,
    why_no_string,
)
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.simulate import simulate
from reference.state import Array, Trajectory
from reference.stepper import SchemeStepper
from reference.system import MassSpringSystem
from reference.theory.equilibrium import hanging_string
from tests.reference.systems import IN_PLACE, label, moving_string, property_test, random_mesh, seeds

LISTINGS = list(listings().values())
LOOPS, ARRAYS, INCORRECT = (listings()[f"lecture_heun_{name}"] for name in ("loops", "arrays", "incorrect"))
DT, STEPS = 1e-3, 500


def positions(listing: LectureListing, system: MassSpringSystem, steps: int = STEPS) -> Array:
    """Where a listing's masses go."""
    outcome = listing.run(system, DT, steps)
    assert outcome.ending == "done"
    assert outcome.trajectory is not None
    return outcome.trajectory.positions


def random_string(seed: int, masses: int) -> MassSpringSystem:
    """A string with masses, springs and lengths of its own, away from the origin, thrown."""
    rng = np.random.default_rng(seed)
    per_item = {
        "mass": rng.uniform(0.01, 0.05, masses).tolist(),
        "rest_length": rng.uniform(0.05, 0.2, masses).tolist(),
        "stiffness": rng.uniform(50, 300, masses).tolist(),
    }
    return moving_string(masses, seed, drag=float(rng.uniform(0, 0.1)), x0=0.3, y0=-0.7, **per_item)


# --- One and the same ---


@pytest.mark.rotating(3, in_turn=True)
@property_test
@given(seed=seeds, masses=st.integers(1, 6))
def test_all_listings_agree_bit_for_bit_on_any_string(seed: int, masses: int) -> None:
    """Loops of slide 7, arrays of slide 8, and slide 11's listing headed incorrect: the arithmetic is the same.

    The incorrect listing's loops read one array and write another, so that fusing them changes nothing.
    """
    system = random_string(seed, masses)
    loops = positions(LOOPS, system, 20).tolist()
    assert positions(ARRAYS, system, 20).tolist() == loops
    assert positions(INCORRECT, system, 20).tolist() == loops


@pytest.mark.rotating(3, in_turn=True)
def test_all_listings_agree_bit_for_bit_over_the_whole_scene() -> None:
    """500 steps of ten links."""
    system = find_scene("string").system({"drag": 0.02})
    assert positions(ARRAYS, system).tolist() == positions(LOOPS, system).tolist()
    assert positions(INCORRECT, system).tolist() == positions(LOOPS, system).tolist()


@pytest.mark.parametrize("scheme", IN_PLACE, ids=label)
def test_truly_overwriting_the_state_is_seen(scheme: object) -> None:
    """What the slide warns of is far from its listing: the comparison above can fail."""
    system = moving_string(10, drag=0.02)
    run = simulate(system, scheme, DT, 0.02)  # type: ignore[arg-type]
    assert np.abs(run.positions - positions(LOOPS, system, 20)).max() > 1e-6


# --- Which scheme they are ---


@cache
def scene(drag: float) -> tuple[MassSpringSystem, dict[str, Trajectory]]:
    """The scene `string` and the catalogue's trajectories of it."""
    system = find_scene("string").system({"drag": drag})
    return system, candidates(system, DT, STEPS)


@pytest.mark.rotating(4)
@pytest.mark.parametrize("drag", [0.0, 0.02])
@pytest.mark.parametrize("listing", LISTINGS, ids=label)
def test_listings_are_heun_with_a_deviation_of_exactly_zero(listing: LectureListing, drag: float) -> None:
    """On the scene as it comes, 500 steps: the listing headed incorrect too."""
    system, trajectories = scene(drag)
    found = identify_run(listing.name, listing.run(system, DT, STEPS), system, trajectories)
    assert found.identified_as == "heun"
    assert found.error == 0.0
    assert [m.scheme for m in found.matches] == ["heun"]


@pytest.mark.parametrize("scheme", IN_PLACE, ids=label)
def test_in_place_variants_are_identified_as_what_they_are(scheme: object) -> None:
    """Never as heun, nor any other right scheme."""
    system, trajectories = scene(0.02)
    found = identify_run("in place", SchemeStepper(scheme).run(system, DT, STEPS), system, trajectories)  # type: ignore[arg-type]
    assert found.identified_as is not None
    assert find(found.identified_as).kind == "in_place"


@property_test
@given(seed=seeds, masses=st.integers(1, 6))
def test_listings_are_heun_on_any_string(seed: int, masses: int) -> None:
    """To rounding where the slides' order of additions differs from ours: 1e-13 of 1 m in 20 steps."""
    system = random_string(seed, masses)
    heun = simulate(system, find("heun"), DT, 20 * DT).positions
    assert np.abs(positions(LOOPS, system, 20) - heun).max() < 1e-13


# --- As steppers ---


@pytest.mark.parametrize("listing", LISTINGS, ids=label)
def test_listings_change_parameters_on_the_fly(listing: LectureListing) -> None:
    """As slide 12 does, at the same steps as every other stepper, to the bit."""
    system = find_scene("string").system({"masses": 4})
    changes = (Change(0.01, "stiffness", 100.0), Change(0.02, "drag", 0.05), Change(0.03, "mass", 0.03))
    outcome = listing.run(system, DT, 40, changes)
    assert outcome.trajectory is not None
    heun = simulate(system, find("heun"), DT, 0.04, changes)
    assert outcome.trajectory.positions.tolist() == heun.positions.tolist()


@pytest.mark.parametrize(
    ("system", "reason"),
    [
        (random_mesh(1, 5, 2), "the lecture's listings step strings only, in 2D and hung at their first mass"),
        (random_mesh(1, 5, 3), "the lecture's listings step strings only, in 2D and hung at their first mass"),
        (moving_string(3, damping=0.1), "the lecture's listings have drag, but no damping along the springs"),
        (
            replace(moving_string(3), gravity=np.array([1.0, -9.0])),
            "the lecture's listings have gravity along the second axis only",
        ),
    ],
)
@pytest.mark.parametrize("listing", LISTINGS, ids=label)
def test_what_the_listings_are_not_of_is_unsupported(
    listing: LectureListing, system: MassSpringSystem, reason: str
) -> None:
    """With the reason."""
    assert why_no_string(system) == reason
    outcome = listing.run(system, DT, 3)
    assert (outcome.ending, outcome.reason, outcome.trajectory) == ("unsupported", reason, None)


def test_a_change_to_what_they_do_not_have_is_unsupported() -> None:
    """Spring damping switched on half-way."""
    outcome = LOOPS.run(find_scene("string").system({"masses": 2}), DT, 10, (Change(0.005, "damping", 0.1),))
    assert outcome.ending == "unsupported"
    assert outcome.reason == "damping = 0.1: the lecture's listings have drag, but no damping along the springs"


@pytest.mark.parametrize("dt", [0.05, 1.0, 1e80])
@pytest.mark.parametrize("listing", LISTINGS, ids=label)
def test_listings_diverge_without_raising_or_warning(listing: LectureListing, dt: float) -> None:
    """Overflow is an outcome."""
    outcome = listing.run(find_scene("string").system({}), dt, 100)
    assert outcome.ending == "diverged"
    assert "\n" not in outcome.reason
    assert outcome.reason


def test_listings_that_meet_a_spring_of_no_length_diverge() -> None:
    """Two links at one place have no direction between them: a division by zero in the loops."""
    apart = find_scene("string").system({"masses": 2, "gravity": 0.0, "stiffness": 0.0})
    # The second link flies onto the first in one step, exactly.
    onto = replace(apart, velocities=np.array([[0.0, 0.0], [0.0, 0.0], [-0.125, 0.0]]))
    for listing in LISTINGS:
        outcome = listing.run(onto, 1.0, 3)
        assert outcome.ending == "diverged", listing.name


# --- Errata ---


def test_slide_4s_force_from_the_next_mass_vanishes_at_rest_with_the_sign_turned() -> None:
    """At rest length below, F = k (Y_next - Y + D0) = 0; printed, with -D0, it is -2 k D0."""
    y = [0.0, -0.125, -0.25]
    assert force_from_next(y, 1, 200.0, 0.125, printed=False) == 0.0
    assert force_from_next(y, 1, 200.0, 0.125, printed=True) == -2 * 200.0 * 0.125
    # Stretched by 0.05 m the spring below pulls down with k * 0.05 N, as on slide 5.
    assert force_from_next([0.0, -0.125, -0.3], 1, 200.0, 0.125, printed=False) == pytest.approx(-10.0, rel=1e-13)


def test_slide_9s_function_closed_early_forgets_the_spring_below() -> None:
    """Hanging at rest all links are at rest; without the spring below, the top one is pulled up by all the others.

    a = (m_2 + ... + m_n) g / m = 9 g: what the first spring carries, less its own link. It rounds by k eps L/m = 3e-13.
    """
    system = find_scene("string").system({"angle": 90.0})
    rest = hanging_string(system)
    links = Links(*rest.positions[1:].T.tolist(), *rest.velocities[1:].T.tolist())
    string = StringConstants.of(system)
    assert derivatives(links, 0, string)[3] == pytest.approx(0.0, abs=1e-10)
    assert derivatives(links, 0, string, next_spring=False)[3] == pytest.approx(9 * 9.81, rel=1e-11)
    # The last link has no spring below to forget.
    assert derivatives(links, 9, string) == derivatives(links, 9, string, next_spring=False)


def test_derivatives_are_the_force_law_of_slides_9_and_10() -> None:
    """One link by hand: k (L - D0) along the spring above, the weight, the drag, over the mass."""
    string = StringConstants(0.0, 0.0, [100.0], [0.4], [0.5], 10.0, 0.2)
    links = Links([0.3], [-0.4], [1.0], [2.0])
    # L = 0.5 m, so 10 N towards (-0.6, 0.8).
    expected = (1.0, 2.0, (-6.0 - 0.2) / 0.5, (8.0 - 5.0 - 0.4) / 0.5)
    assert derivatives(links, 0, string) == pytest.approx(expected, rel=1e-14)


def test_the_circle_as_it_is_printed_by_hand() -> None:
    """Of three links the middle one is inside: put out along the normal, its velocity's components are multiplied.

    Without forces a step moves nothing but those: at (0.6, 0.8) from the centre, times 1/2, of a circle of 1 m about
    (3, 4); (v_x, v_y) becomes (0.8 v_x, -0.6 v_y).
    """
    system = StringConstants(0.0, 0.0, [0.0] * 3, [1.0] * 3, [1.0] * 3, 0.0, 0.0, [(3.0, 4.0, 1.0), (50.0, 0.0, 1.0)])
    links = Links([1.0, 3.3, 9.0], [2.0, 4.4, 8.0], [5.0, 0.1, 7.0], [6.0, 0.2, 8.0])
    heun_with_barrier(links, system, 0.0)
    assert links.x == pytest.approx([1.0, 3.6, 9.0], rel=1e-14)
    assert links.y == pytest.approx([2.0, 4.8, 8.0], rel=1e-14)
    assert links.vx == pytest.approx([5.0, 0.08, 7.0], rel=1e-14)
    assert links.vy == pytest.approx([6.0, -0.12, 8.0], rel=1e-14)


def test_links_copied_are_links_of_their_own() -> None:
    """The temporary of slide 7 is not the state."""
    links = Links([1.0], [2.0], [3.0], [4.0])
    guess = links.copy()
    guess.x[0] = 9.0
    assert links.x == [1.0]


def test_listings_say_what_they_are() -> None:
    """Slide and heading, in a sentence; the kind is the lecture's."""
    assert list(listings()) == [
        "lecture_heun_loops",
        "lecture_heun_arrays",
        "lecture_heun_incorrect",
        "lecture_barrier",
    ]
    assert [listing.name for listing in LISTINGS] == list(listings())
    assert [listing.kind for listing in LISTINGS] == ["lecture"] * 4
    assert "headed incorrect" in INCORRECT.summary
    assert LOOPS.version is None
