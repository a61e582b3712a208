"""What engines say of their numbers: in SI units without prefixes."""

from __future__ import annotations

from engines.engine import registry
from tests.units import others


def test_meanings_are_in_si_units() -> None:
    """Stiffness and damping have theirs."""
    said = {name: engine.semantics for name, engine in registry().items()}
    assert others(said.values()) == set()
    stiff = [text for text in said.values() if "stiffness is k" in text]
    assert stiff
    assert all("[N/m]" in text for text in stiff)
    assert all("c [N s/m]" in text for text in stiff if "damping c" in text)
