"""Limits of Runge-Kutta methods on large systems, from below: from the joint numerical range of stiffness and damping.

Every mode q, with m = q*Mq = 1, has a point (q* K q, q* (C + D) q) = (w^2, g), and its rates are the roots of
mu^2 + g mu + w^2 = 0. The points of all q lie in a convex set, and that lies in the polygon that its supporting lines
in a few directions enclose: so the shortest limit in the polygon is at most that of any mode (Horn and Johnson,
*Topics in Matrix Analysis* (1991), 1.2 and 1.5).
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np

from reference.state import Array
from reference.theory.linearisation import Linearisation
from reference.theory.rates import top
from reference.theory.runge_kutta import first_limits_along

#: Directions of supporting lines, and points along each edge of the polygon and inwards at which limits are looked at.
DIRECTIONS, POINTS = 9, 24


def limit_from_below(polynomial: tuple[float, ...], linear: Linearisation) -> float:
    """A dt [s] up to which no mode grows; 0 where it cannot be told."""
    corners = polygon(linear)
    weights = np.linspace(0.0, 1.0, POINTS)
    edges = [
        (1 - t) * a + t * b for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True) for t in weights[:-1]
    ]
    middle = corners.mean(axis=0)
    points = np.array([middle + inwards * (point - middle) for point in edges for inwards in weights[1:]])
    return float(_limits(polynomial, points).min())


def _limits(polynomial: tuple[float, ...], points: Array) -> Array:
    """Of oscillators with (w^2, g), shape (p, 2): both rates' where they do not swing."""
    square, damping = np.maximum(points, 0.0).T
    apart = np.sqrt(damping.astype(complex) ** 2 - 4 * square)
    fast = -(damping + apart) / 2
    slow = np.divide(square, fast, out=np.zeros_like(fast), where=fast != 0)
    rates = np.concatenate([fast, slow])
    rates = rates[np.abs(rates) > 0]
    return first_limits_along(polynomial, np.abs(np.angle(rates))) / np.abs(rates)


@lru_cache(maxsize=1)
def polygon(linear: Linearisation) -> Array:
    """Corners (w^2 [1/s^2], g [1/s]) around the points of all modes, counter-clockwise, shape (corners, 2)."""
    system = linear.system
    drag = linear.scaled(linear.on_masses(np.full(len(system.masses), system.drag)))
    slowed, stiff = linear.scaled(linear.damping) + drag, linear.scaled_stiffness
    stiffest, fastest, least = _top(stiff), _top(slowed), float(drag.diagonal().min(initial=np.inf))
    corners = np.array([[0.0, least], [stiffest, least], [stiffest, fastest], [0.0, fastest]])
    for angle in np.linspace(0, np.pi / 2, DIRECTIONS)[1:-1]:
        normal = np.array([np.cos(angle) / (stiffest or 1.0), np.sin(angle) / (fastest or 1.0)])
        corners = _clipped(corners, normal, _top(normal[0] * stiff + normal[1] * slowed))
    return corners


def _clipped(corners: Array, normal: Array, most: float) -> Array:
    """A convex polygon cut along a line (Sutherland and Hodgman, Comm. ACM 17 (1974)): where normal . p <= most."""
    heights = corners @ normal - most
    kept = []
    for a, b, over_a, over_b in zip(corners, np.roll(corners, -1, axis=0), heights, np.roll(heights, -1), strict=True):
        if over_a <= 0:
            kept.append(a)
        if (over_a < 0 < over_b) or (over_b < 0 < over_a):
            kept.append(a + over_a / (over_a - over_b) * (b - a))
    return np.array(kept) if kept else corners


def _top(matrix: Any) -> float:
    """The largest eigenvalue of a symmetric matrix, a trace above."""
    if not matrix.nnz or not abs(matrix).max():
        return 0.0
    return top(matrix)[0] * (1 + 2e-6)
