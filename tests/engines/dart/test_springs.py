"""DART steps a chain along a line by backward Euler, and refuses the plane."""

from __future__ import annotations

import pytest

from engines.dart.springs import DartSprings
from engines.engine import version
from engines.process.isolation import EngineStepper
from reference.identification import identify
from reference.scenes import find
from tests.conformance.doctored import Doctored, KickDrift

DART = DartSprings()


def test_it_is_told_without_dart_that_it_cannot_do_the_plane() -> None:
    """As the lack of a capability, which a string that swings asks for, and one that hangs straight down does not."""
    from engines.engine import demands

    assert "2d" not in DART.capabilities
    assert "2d" in demands(find("string").system({}))
    assert "2d" not in demands(find("chain").system({}))


@pytest.mark.skipif(version(DART) is None, reason="dartpy is not installed")
@pytest.mark.parametrize("damping", [0.0, 0.05, 0.5])
def test_a_chain_is_stepped_by_backward_euler(damping: float) -> None:
    """Over 500 steps of 1 ms, max |x - x_scheme| <= 1e-12 of the size; along a line no spring turns."""
    found = identify(EngineStepper(DART), find("chain").system({"damping": damping}), 1e-3, 500)
    assert found.identified_as == "backward_euler", str(found)


def test_another_scheme_is_seen() -> None:
    """Shown to fail: an engine that kicks, then drifts."""
    found = identify(EngineStepper(Doctored(KickDrift)), find("chain").system({}), 1e-3, 100)
    assert found.identified_as != "backward_euler"
