"""Every engine is what it claims to be on random strings.

Drawn from a fixed seed: 1 to 40 masses; stiffness 10 to 1e4 N/m, mass 1e-3 to 1 kg and length 0.02 to 0.5 m, evenly in
their logarithms; every second string with damping up to 1 N s/m, every second with drag up to 0.1 N s/m; dt from a
twentieth to a half of the largest stable step (`limit`); 100 steps. 25 of them start straight, unstretched and at rest,
in any direction; 15 swing, are stretched and in motion, or have no two masses and springs alike. Each engine gets those
that its capabilities allow.

Two choices keep rounding, which every motion amplifies, below the tolerance of 1e-12 of the string's size:

- A string that would hang at more than three times its length is drawn again. Left alone it falls freely, hundreds of
  its lengths within the run, and rounding goes with the distance while the tolerance goes with the length.
- A chain of distance constraints swings chaotically: rounding grows e-fold in about (l/g)^(1/2), and MuJoCo's own, on
  tens of joints, begins a hundred times above the reference's (against 80-bit arithmetic: 2e-14 after 5 steps, the
  reference 4e-16). So they run for two such times, and at most 40 steps.

Measured with eight other seeds, 320 strings: the largest deviation is 1.5e-13 of the size with springs,
6.7e-13 with distance constraints.
"""

from __future__ import annotations

import pytest

from engines.engine import Engine
from tests.conformance.checks import check_follows, on_rods, supported
from tests.conformance.runs import outcomes
from tests.conformance.strings import random_strings


@pytest.mark.rotating(4)
def test_every_random_string_is_stepped_as_claimed(engine: Engine) -> None:
    """On all strings within its capabilities, max |x_engine - x_scheme| <= 1e-12 of the string's size."""
    cases = supported(engine, random_strings(on_rods(engine)))
    if not cases:
        pytest.skip(f"{engine.name} can do none of the random strings")
    for case, outcome in zip(cases, outcomes(engine, cases), strict=True):
        check_follows(engine, case, outcome)


def test_at_least_25_random_strings_fit_every_engine(engine: Engine) -> None:
    """Straight strings at rest ask for damping and drag at most, and every engine gets at least 25 strings."""
    if not {"damping", "drag"} <= engine.capabilities:
        pytest.skip(f"{engine.name} lacks damping or drag")
    assert len(supported(engine, random_strings(on_rods(engine)))) >= 25
