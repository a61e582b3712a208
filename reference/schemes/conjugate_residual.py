"""A linear system of equations solved by conjugate residuals, stopped early: what Bullet does with damping.

Saad, *Iterative Methods for Sparse Linear Systems* (2003), section 6.8, with a preconditioner. Bullet's variant, in its
btConjugateResidual.h, stops by the largest component of the preconditioned residual. Needs NumPy only.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from reference.state import Array

Linear = Callable[[Array], Array]


def conjugate_residual(
    apply: Linear, right_hand_side: Array, precondition: Linear, tolerance: float = 1e-8, iterations: int = 300
) -> Array:
    """An x with A x = b as nearly as the tolerance asks, from x = 0 on.

    Each iteration moves x along a direction p to where the residual b - A x is smallest, measured by P, then chooses
    the next p so that it spoils none of the directions before. Written here for r = P (b - A x).

    Args:
        apply: x -> A x, with A symmetric and positive definite.
        right_hand_side: b, any shape.
        precondition: r -> P r, near to A^-1 r, with P symmetric too.
        tolerance: x is good enough once no component of r exceeds this; r has the unit of x.
        iterations: at most this many; then the best x there was.

    Returns:
        x, in the shape of b: zero, if the first r is within the tolerance already.
    """
    x = np.zeros_like(right_hand_side)
    r = precondition(right_hand_side)
    best, least = x, np.inf
    if _largest(r) <= tolerance:
        return x
    p = r
    a_p = a_r = apply(r)
    r_a_r = _dot(r, a_r)
    for _ in range(iterations):
        p_a_p = precondition(a_p)
        alpha = r_a_r / _dot(a_p, p_a_p)
        x = x + alpha * p
        r = r - alpha * p_a_p
        if _largest(r) < least:
            best, least = x, _largest(r)
            if least <= tolerance:
                break
        a_r = apply(r)
        before, r_a_r = r_a_r, _dot(r, a_r)
        beta = r_a_r / before
        p = r + beta * p
        a_p = a_r + beta * a_p
    return best


def _largest(values: Array) -> float:
    return float(np.abs(values).max(initial=0.0))


def _dot(a: Array, b: Array) -> float:
    return float(np.vdot(a, b))
