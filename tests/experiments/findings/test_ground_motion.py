"""Ground motion: peaks and sags, predicted and measured, each in its column, and the ranges in the sentences."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from experiments.ground_motion import DT, SPEEDS, peak, result_of
from tests.experiments.canned import ground_motion
from tests.experiments.canned.ground_motion import HIGH, NATURAL, PEAK, sway
from tests.experiments.canned.reading import finding, in_order, numbers, records


def test_the_table_has_frequencies_and_sways_measured_and_predicted() -> None:
    """Hertz are not metres, and predicted is not measured."""
    at, by = peak(sway(PEAK, HIGH))
    for row, frequency, high in zip(records(ground_motion.usual()), (1.29, 1.33), (0.011, 0.012), strict=True):
        assert row["sways most at [Hz]"] == pytest.approx(frequency, abs=0.02)
        assert row["by [m]"] == pytest.approx(high, rel=0.02)
        columns = [value for name, value in row.items() if name in ("predicted [Hz]", "predicted [m]")]
        assert columns == [at, by]
    scheme, engine = records(ground_motion.usual())
    assert (scheme["distance from its scheme [m]"], engine["distance from its scheme [m]"]) == (None, 2e-13)


def test_the_table_of_trucks_has_the_largest_sags() -> None:
    """Measured and of the influence line; how far off, as a part of that."""
    rows = [row for row in records(ground_motion.usual(), "ground_motion_truck") if row["stepper"] == "kick_drift"]
    for row, speed in zip(rows, SPEEDS, strict=True):
        off = 0.05 * speed / 10
        assert row["speed [m/s]"] == speed
        assert row["largest sag [m]"] == pytest.approx(0.08 * (1 + off), rel=0.02)
        assert row["largest sag of the influence line, predicted [m]"] == 0.08
        assert row["off the line, part of its largest sag"] == pytest.approx(off, rel=0.02)


def test_the_table_of_sways_has_each_stepper_s_in_its_column() -> None:
    """At their times and frequencies."""
    rows = records(ground_motion.usual(), "ground_motion_sway")
    motions = {"predicted [m]": sway(PEAK, HIGH), "kick_drift [m]": sway(1.29, 0.011)}
    for row in rows[::50]:
        step = round(row["time [s]"] / 4e-3)
        for column, motion in motions.items():
            assert row[column] == pytest.approx(motion[step])
        assert row["frequency [Hz]"] == pytest.approx(0.8 + 1.2 * row["time [s]"] / 20)


def test_sentences_have_the_range_that_was_measured_then_what_is_predicted() -> None:
    """Of two runs."""
    low, high = sorted(row["sways most at [Hz]"] for row in records(ground_motion.usual()))
    least, most = sorted(1e3 * row["by [m]"] for row in records(ground_motion.usual()))
    at, by = peak(sway(PEAK, HIGH))
    said = finding(ground_motion.usual(), "sways most")
    assert numbers(said) == pytest.approx([low, high, least, most, 2, at, 1e3 * by, NATURAL], abs=0.05)
    assert in_order(said, "measured", "Predicted")


def test_why_the_peak_comes_later_is_said_where_it_does() -> None:
    """Of the natural frequency that the sweep has passed by then; of one that is still to come nothing."""
    usual = ground_motion.usual()
    rows, linear, line = (usual.data[name] for name in ("rows", "linear", "line"))
    for natural, said in (([NATURAL], [NATURAL]), ([1.0, NATURAL], [NATURAL]), ([1.9], [])):
        found = finding(result_of(rows, np.array(natural), linear, line), "sways most")
        assert numbers(found)[7:] == said


def test_the_truck_s_sentence_has_the_most_of_each_speed() -> None:
    """In percent of the largest sag, mujoco_tendons' here."""
    said = numbers(finding(ground_motion.usual(), "A truck"))
    expected = [80]
    for speed in SPEEDS:
        expected += [100 * 0.06 * speed / 10, speed]
    assert said == pytest.approx(expected, abs=0.5)


def test_the_engine_that_goes_farthest_from_its_scheme_is_named() -> None:
    """Of two; and of none there is no sentence."""
    usual = ground_motion.usual()
    far = {"pymunk_springs": ground_motion.ran(1.3, 0.01, 0.0, 3e-9), **usual.data["rows"]}
    predicted = [usual.data[name] for name in ("natural", "linear", "line")]
    said = finding(result_of(far, *predicted), "with the schemes that they are")
    assert (numbers(said), "pymunk_springs goes" in said) == ([2, pytest.approx(3e-9)], True)
    assert ground_motion.nobody().findings == []


def test_sways_are_told_up_to_where_the_first_run_ends() -> None:
    """Of an engine that diverged there are fewer."""
    usual = ground_motion.usual().data
    rows = dict(usual["rows"])
    name, last = [*rows][-1], 35
    rows[name] = replace(rows[name], shaken=rows[name].shaken[: last + 1])
    table = records(result_of(rows, usual["natural"], usual["linear"], usual["line"]), "ground_motion_sway")
    assert [round(row["time [s]"] / DT) for row in table] == [0, 10, 20, 30]
