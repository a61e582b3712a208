"""Engines in single precision are what they claim to be: to the last bit, or by single steps at a dt that tells."""

from __future__ import annotations

import pytest

from engines.engine import Engine, precision
from engines.process.isolation import EngineStepper
from reference.identification import identify
from reference.identification.bits import BITS
from reference.scenes import find as find_scene
from tests.conformance.checks import require


@pytest.mark.parametrize("damping", [0.0, 0.5])
def test_an_engine_in_single_precision_is_identified(engine: Engine, damping: float) -> None:
    """On the default string for 500 steps of 1 ms: every bit where a scheme in single precision is claimed.

    Others are named by single steps, as whole runs in double precision would name the wrong one.
    """
    if precision(engine) == "double":
        pytest.skip("it is identified by its runs")
    for what in ("2d", *(["damping"] if damping else [])):
        require(engine, what)
    claim = engine.identified_as["damping" if damping else "plain"]
    system = find_scene("string").system({"damping": damping})
    found = identify(EngineStepper(engine), system, 1e-3, 500 if "single=True" in claim else 40)
    assert found.identified_as, str(found)
    assert claim in [match.scheme for match in found.matches]
    assert (found.compared == BITS) == ("single=True" in claim)
