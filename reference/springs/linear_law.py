"""The law of a spring: force, energy, and how the force answers a little more stretch or speed. All take it from here.

A spring that is stretched by `stretch` [m] beyond its rest length and gets longer at `rate` [m/s] pulls its two masses
together with the force k stretch + c rate (slides 2 and 5; Hooke 1678). The functions below are of numbers or of arrays
of them; the force is compiled from its text here. Another law is another text of this file: the readable forces, the
compiled loops, the Jacobians of implicit schemes and of stability, equilibria and energy all follow.
"""

from __future__ import annotations

from typing import TypeVar

from reference.state import Array

#: A number, or one for each spring.
N = TypeVar("N", float, Array)


def spring_force(stiffness: N, stretch: N, damping: N, rate: N) -> N:
    """The force [N] with which a spring pulls its masses together."""
    return stiffness * stretch + damping * rate


def elastic_energy(stiffness: N, stretch: N) -> N:
    """The energy [J] in a spring at rest: the integral of its force over its stretch."""
    return 0.5 * stiffness * stretch**2


def force_by_stretch(stiffness: N, stretch: N) -> N:
    """The derivative of the force by the stretch [N/m]."""
    return stiffness


def force_by_rate(damping: N) -> N:
    """The derivative of the force by the rate [N s/m]."""
    return damping


def stretch_under(stiffness: N, force: N) -> N:
    """The stretch [m] at which a spring at rest carries a force [N]; stiffness > 0."""
    return force / stiffness
