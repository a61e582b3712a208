"""The Jacobian of a step by differences, of any step at all."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from reference.state import Array, State
from reference.theory.layout import Layout


def differences(step: Callable[[State, float], State], layout: Layout, settled: State) -> Array:
    """Central differences of fourth order about a state, over z (`layout`), dense.

    Their truncation goes as the fourth power of the perturbation and their rounding as its inverse; at the fifth root
    of rounding both are about 1e-12.
    """
    small = np.finfo(float).eps ** 0.2 * layout.rest.scale

    def after(z: Array) -> Array:
        return layout.vector(step(layout.state(z, settled), layout.dt))[:, 0]

    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        columns = [8 * (after(z) - after(-z)) - (after(2 * z) - after(-2 * z)) for z in small * np.eye(layout.size)]
    return np.stack(columns, axis=1) / (12 * small)
