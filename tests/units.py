"""Units in texts: everything is in SI units without prefixes, and what is not is named by the test that allows it."""

from __future__ import annotations

import re
from collections.abc import Iterable

#: In brackets. 1 has no unit; angles are in degrees.
SI = {"s", "m", "kg", "N", "J", "Hz", "1", "m/s", "m/s^2", "1/s", "N/m", "N s/m", "N m", "deg"}


def others(texts: Iterable[str], *allowed: str) -> set[str]:
    """Texts with a unit in brackets that is neither one of SI's nor of those allowed besides."""
    return {text for text in texts if not {*re.findall(r"\[([^\[\]]+)\]", text)} <= {*SI, *allowed}}
