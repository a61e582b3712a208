"""Every engine is what it claims to be on the default string: 10 masses let go horizontally, 500 steps of 1e-3 s."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest

from engines.engine import Engine, precision
from reference.scenes import find as find_scene
from reference.stepper import stepper_named
from tests.conformance.case import Case
from tests.conformance.checks import (
    EXACT_SOLVE,
    check_follows,
    claimed,
    identify_claimed,
    on_rods,
    require,
    tolerance_of,
)
from tests.conformance.runs import expected, outcome_of

DT, STEPS = 1e-3, 500

#: [m], where the string is 1.25 m long. The deviations measured are 4e-16 m to 2.4e-14 m.
WITHIN = 1e-12

SETTINGS: Mapping[str, Mapping[str, float]] = {
    "plain": {},
    "damping 0.05": {"damping": 0.05},
    "damping 0.5": {"damping": 0.5},
    "drag 0.02": {"drag": 0.02},
    "damping 0.05, drag 0.02": {"damping": 0.05, "drag": 0.02},
    "damping 0.5, drag 0.02": {"damping": 0.5, "drag": 0.02},
}

CASES = {name: Case(name, find_scene("string").system(values), DT, STEPS) for name, values in SETTINGS.items()}

#: Three masses on stiff springs, hung almost straight down.
QUIET = Case("quiet", find_scene("string").system({"masses": 3, "stiffness": 2e4, "angle": 89.5}), 5e-4, 5000)


@pytest.mark.rotating(3)
@pytest.mark.parametrize("case", CASES)
def test_the_engine_is_identified_as_it_claims(engine: Engine, case: str) -> None:
    """The claimed scheme is within 1e-12 m of the engine at all times; else the nearest of the catalogue is named.

    max |x_engine - x_scheme| <= 1e-12 m, forty times the largest rounding that was measured over these 500 steps.
    """
    for what in ("2d", *SETTINGS[case]):
        require(engine, what)
    found = identify_claimed(engine, CASES[case], outcome_of(engine, CASES[case]))
    within = max(WITHIN, tolerance_of(engine) * CASES[case].system.size)
    assert claimed(engine, CASES[case]) in [match.scheme for match in found.matches if match.error <= within], str(
        found
    )


@pytest.mark.rotating(2)
@pytest.mark.parametrize("case", [name for name, values in SETTINGS.items() if "damping" in values])
def test_what_an_engine_solves_it_solves_nearly_to_the_end(engine: Engine, case: str) -> None:
    """Its distance from the exact solve, max |x_engine - x_exact|, is at most 1e-6 m.

    A solver stopped at 1e-8 m/s in each of 500 steps of 1e-3 s is off by 5e-9 m if all it leaves adds up, and the
    string swings it up; Bullet's, stopped there, was measured 7e-9 to 7e-8 m off.
    """
    for what in ("2d", *SETTINGS[case]):
        require(engine, what)
    claim = claimed(engine, CASES[case])
    exact = EXACT_SOLVE.get(claim, claim)
    check_follows(engine, CASES[case], outcome_of(engine, CASES[case]), 1e-6 / CASES[case].system.size, exact)


def test_a_blow_up_is_told_and_is_the_schemes_own(engine: Engine) -> None:
    """At twice the largest stable step the string tears, and no safety net of the engine hides it.

    Semi-implicit Euler is stable up to h = 2/w = 0.0101 s here, w being the fastest mode's frequency, and RK4 up to
    sqrt(2) times that. Until a spring is three times its length, the engine must follow its scheme; then both must end
    as diverged. Sweeps that damp swing wildly, and whether a spring has torn by then may be a matter of rounding: of an
    engine in single precision the scheme has to do so in both.
    """
    require(engine, "2d")
    if on_rods(engine):
        pytest.skip("distance constraints do not stretch: no spring can show that it tore")
    case = Case("too large a step", CASES["plain"].system, 0.02, 200)
    if "done" in [expected(scheme, case).ending for scheme in in_its_precision(engine)]:
        pytest.skip("its scheme does not blow up at this step, or by rounding only")
    outcome = outcome_of(engine, case)
    assert outcome.ending == "diverged"
    check_follows(engine, case, outcome)


def in_its_precision(engine: Engine) -> list[str]:
    """The scheme it claims to be, and the same in single precision, where the engine is and the scheme can be."""
    scheme = stepper_named(engine.identified_as["plain"]).scheme
    single = precision(engine) == "single" and "single" in scheme.parameters
    return [engine.identified_as["plain"], *([scheme.with_parameters(single=True).name] if single else [])]


@pytest.mark.rotating(4)
def test_a_quiet_string_is_stepped_to_the_end(engine: Engine) -> None:
    """Over 2.5 s with no mass as fast as 0.04 m/s the engine does not fall asleep, but follows its scheme.

    Bullet, unless told otherwise, stops bodies that were slower than 0.04 m/s for 2 s.
    """
    require(engine, "2d")
    check_follows(engine, QUIET, outcome_of(engine, QUIET))


def test_the_quiet_string_is_quiet_and_moves() -> None:
    """Its fastest mass stays below 0.04 m/s, yet in the last 0.5 s it still moves 0.1 mm."""
    for scheme in ("kick_drift", "pendulum_kick_drift"):
        trajectory = expected(scheme, QUIET).trajectory
        assert trajectory is not None
        assert np.linalg.norm(trajectory.velocities, axis=2).max() < 0.04
        assert np.ptp(trajectory.positions[-1000:], axis=0).max() > 1e-4
