"""Schemes of masses on rods: how engines keep distance constraints."""

from __future__ import annotations

from reference.motion import MotionOfRods
from reference.schemes.catalogue import Scheme
from reference.state import State

#: MuJoCo's impedance d of a rod, the largest there is; and R as a part of 1/m_a + 1/m_b, a thousandth of (1 - d)/d.
IMPEDANCE = 0.9999
COMPLIANCE = 1e-3 * (1 - IMPEDANCE) / IMPEDANCE


def rope_kick_drift(motion: MotionOfRods, state: State, dt: float) -> State:
    """Kick-drift of masses on rods that are brought back to their lengths: MuJoCo's soft equality constraints.

    A rod that is r too long asks for -b J v - k r with b = 2 / (d T), k = 1 / (d T^2) and the time constant T = 2 dt.
    With d = 1 that is J v' = -r / (4 dt): no elongation rate is left, and of r three quarters are left after the step.
    To first order it is the rods' true motion: their turning, which `target` leaves out, costs some dt^2 of length.
    (MuJoCo's manual, *Computation*, "Constraint model".)
    """
    rods = motion.rods(state)
    damping, stiffness = 1 / (IMPEDANCE * dt), 1 / (4 * IMPEDANCE * dt**2)
    target = -damping * rods.rates - stiffness * (rods.lengths - motion.rest_lengths)
    return state.kick(dt * motion.constrained(state, rods, target, COMPLIANCE)).drift(dt)


#: On no other equations than a rope's, and so not among the schemes of springs.
ROPE_KICK_DRIFT = Scheme(rope_kick_drift, order=1, kind="engine_scheme", linear=False)
