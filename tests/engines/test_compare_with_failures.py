"""An engine that fails is a row with that outcome; the others still report."""

from __future__ import annotations

import math

from engines.process.isolation import EngineStepper
from experiments.runs.comparison import compare
from reference.scenes import Setup, find
from reference.stepper import Stepper, catalogued
from tests.conformance.doctored import Doctored
from tests.engines.process import misbehaving
from tests.engines.process.misbehaving import Misbehaving

SETUP = Setup("string", find("string").system({"masses": 3}), 1e-3, 0.05)


def test_failing_engines_are_rows_and_the_others_still_report() -> None:
    """One that segfaults, one that hangs, one that goes to NaN, one that raises, among two that are well."""
    steppers: list[Stepper] = [
        EngineStepper(Misbehaving(misbehaving.Segfaults)),
        catalogued()["heun"],
        EngineStepper(Misbehaving(misbehaving.Hangs), time_limit=1.0),
        EngineStepper(Misbehaving(misbehaving.GoesToNan)),
        EngineStepper(Doctored()),
        EngineStepper(Misbehaving(misbehaving.Raises)),
    ]
    rows = compare(SETUP, steppers).document["runs"]
    seen = [(row["stepper"], row["outcome"], row["reason"].split(";")[0][:40], row["identified_as"]) for row in rows]
    assert seen == [
        ("Segfaults", "crashed", "killed by SIGSEGV", None),
        ("heun", "done", "", "heun"),
        ("Hangs", "timed out", "no answer within 1 s", None),
        ("GoesToNan", "diverged", "the position of mass 2 is not a number a", None),
        ("KickDrift", "done", "", "kick_drift"),
        ("Raises", "crashed", "ZeroDivisionError: mass 3 is zero and ca", None),
    ]
    for row in rows:
        measured = row["outcome"] in ("done", "diverged")
        for number in (row["error_m"], row["identification_error_m"]):
            assert number is None or math.isfinite(number)
        assert (row["error_m"] is not None) == (row["outcome"] == "done"), row
        assert measured or row["identification_error_m"] is None
