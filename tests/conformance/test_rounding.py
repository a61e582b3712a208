"""What the checks allow a motion that amplifies rounding: more than 1e-12 of the size only where it blows up."""

from __future__ import annotations

import pytest

from engines.engine import Engine
from reference.identification import TOLERANCE
from reference.scenes import find
from tests.conformance.case import Case
from tests.conformance.checks import check_follows
from tests.conformance.doctored import Doctored, KickDrift
from tests.conformance.runs import expected, rounding

STRING = find("string").system({})
QUIET, TEARS = Case("stable", STRING, 1e-3, 500), Case("too large a step", STRING, 0.02, 200)


@pytest.mark.parametrize("scheme", ["kick_drift", "velocity_verlet", "rk4"])
def test_a_stable_motion_makes_little_of_rounding(scheme: str) -> None:
    """Perturbed by 1e-14 of the size, it is less than 1e-13 off after 0.5 s: the tolerance stays what it is."""
    assert rounding(scheme, QUIET) < 1e-13


def test_a_motion_that_blows_up_makes_much_of_it() -> None:
    """RK4 at 1.4 times its limit multiplies a perturbation by 1e4 to 1e9 before the string tears."""
    assert TOLERANCE < 100 * TOLERANCE < rounding("rk4", TEARS) < 1e-5


@pytest.mark.parametrize("other", ["heun", "velocity_verlet", "euler", "kick_drift"])
def test_schemes_are_still_told_apart_where_they_blow_up(other: str) -> None:
    """Shown to fail: another scheme's trajectory is not RK4's, whatever rounding is allowed there."""
    engine: Engine = Doctored(KickDrift)
    check_follows(engine, TEARS, expected("rk4", TEARS), scheme="rk4")
    with pytest.raises(AssertionError):
        check_follows(engine, TEARS, expected(other, TEARS), scheme="rk4")
