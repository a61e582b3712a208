"""A barrier: who leaves where, who is deepest inside, and what strings gain and lose."""

from __future__ import annotations

import numpy as np
import pytest

from experiments.barrier import DURATION, INWARDS, START, STEPS, Slide, predicted, result_of
from reference.conserved import energy
from reference.scenes import find
from tests.experiments.canned import barrier
from tests.experiments.canned.barrier import ENGINES, FOUND
from tests.experiments.canned.reading import finding, in_order, numbers, records


def test_the_table_has_each_number_in_its_column_by_step() -> None:
    """Degrees and metres; who stays on does not leave; what did not run is not there."""
    table = records(barrier.usual())
    finest = {(row["stepper"], row["rule"]): row for row in table if row["dt [s]"] == STEPS[-1]}
    for key, (degrees, depth) in FOUND.items():
        row = finest[key]
        assert row["is at, in the end or then [deg]"] == pytest.approx(degrees)
        assert row["leaves at [deg]"] == (None if key[0] == "lecture_barrier" else pytest.approx(degrees))
        assert row["predicted [deg]"] == pytest.approx(np.degrees(predicted()))
        assert row["deepest inside [m]"] == depth
        assert row["energy gained by then [J]"] == pytest.approx(1e-3 * STEPS[-1])
    assert [row["dt [s]"] for row in table if row["stepper"] == "pymunk_springs"] == list(STEPS[1:])


def test_the_table_of_strings_has_their_depths_and_energies() -> None:
    """Gained at most is against the start; so is what is lost in the end."""
    system = find("barrier").system({})
    (circle,) = system.obstacles
    for row in records(barrier.usual(), "barrier_string"):
        motion = barrier.strings()[row["stepper"]]
        energies = np.array([energy(system, state) for state in motion.states()])
        distance = np.linalg.norm(motion.positions[:, 1:] - np.array(circle.centre), axis=2) - circle.radius
        assert row["deepest inside [m]"] == pytest.approx(-distance.min())
        assert row["energy gained at most [J]"] == pytest.approx(energies.max() - energies[0])
        assert row["energy lost in the end [J]"] == pytest.approx(energies[0] - energies[-1])


def test_the_first_sentence_has_the_true_angle_and_who_leaves_where() -> None:
    """By the smallest step."""
    said = finding(barrier.usual(), "let go at rest")
    right = float(np.degrees(predicted()))
    assert numbers(said) == pytest.approx([np.degrees(START), right, 2, 3, STEPS[-1], 48.4, 48.4], abs=0.05)
    assert in_order(said, "heun", "48.4", "kick_drift", "48.4")


def test_what_holds_on_is_predicted_then_measured() -> None:
    """Where cos is half; and the printed rule stays on."""
    held = float(np.degrees(predicted(fraction=1 / 2)))
    assert numbers(finding(barrier.usual(), "holds the mass on"))[-2:] == pytest.approx([held, 60.1], abs=0.05)
    printed = numbers(finding(barrier.usual(), "stays on: "))
    assert printed == pytest.approx([DURATION, 5.9, np.degrees(START)], abs=0.05)


def test_engines_have_their_farthest_and_their_deepest() -> None:
    """Who is 2.2 degrees off, and who is 10 µm inside."""
    said = finding(barrier.usual(), "engine settings")
    assert numbers(said) == pytest.approx([len(ENGINES), 46.0, 1e-5])
    assert in_order(said, "pymunk_springs", "46.0", "mujoco_flex", "1.0e-05")


def test_who_does_not_leave_is_said_to() -> None:
    """In the sentence of the true angle, of what is held on, and of the engines; nobody, of no engine."""
    stays = Slide(None, 1.5, 0.0, 0.0)
    slides = {key: [stays] * len(STEPS) for key in FOUND}
    string = find("barrier").system({})
    result = result_of(slides, string, {})
    assert finding(result, "let go at rest").count("does not") == 2
    assert "does not leave" in finding(result, "Slide 17's rule")
    assert f"leaves not in {DURATION:g} s" in finding(result, "engine settings")
    nobody = result_of({("heun", INWARDS): [stays] * len(STEPS)}, string, {})
    assert not [said for said in nobody.findings if "engine settings" in said or "printed" in said]
