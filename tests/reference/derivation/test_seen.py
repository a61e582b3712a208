"""What is seen of a stepper that asks for no slopes: nothing, and nothing is said of it."""

from __future__ import annotations

from reference.derivation.seen import NOTHING, Seen, slopes_of
from reference.schemes.catalogue import find
from reference.stepper import catalogued


def test_of_what_was_not_looked_at_nothing_is_seen() -> None:
    """Neither that it iterates nor that it adapts its steps; a scheme that asks twice in a step does neither, too."""
    assert not NOTHING.iterates
    assert not NOTHING.adapts
    assert Seen(None, None, None, (), (), False, False, None) == NOTHING
    asked = slopes_of(catalogued()[find("heun").name], [])
    assert (asked.iterates, asked.adapts) == (False, False)
