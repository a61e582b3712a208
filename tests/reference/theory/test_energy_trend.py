"""What schemes are predicted to do to energy: by |R(iz)| in closed form, and not what others do."""

from __future__ import annotations

import numpy as np
import pytest

from reference.scenes import find as find_scene
from reference.schemes.catalogue import Scheme, find
from reference.theory.energy_trend import predicted_energy_trend
from reference.theory.equilibria import spring_equilibrium
from tests import wrong
from tests.reference.systems import label

#: One step multiplies a mode by R(i z), z = dt w: R of Euler is 1 + iz, of Heun 1 + iz - z^2/2, of RK4 the series of
#: the exponential to z^4, of backward Euler 1 / (1 - iz). Symplectic steps have eigenvalues on the unit circle.
TRENDS = {
    "euler": "growing",
    "heun": "growing",
    "rk4": "decaying",
    "backward_euler": "decaying",
    "implicit_midpoint": "bounded",
    "kick_drift": "bounded",
    "drift_kick": "bounded",
    "velocity_verlet": "bounded",
}


def check_trend(scheme: Scheme, trend: str) -> None:
    """On the hanging string of three, with dt w from 0.02 to 0.2."""
    rest = spring_equilibrium(find_scene("string").system({"masses": 3, "stiffness": 10}))
    assert predicted_energy_trend(scheme, rest, 5e-3) == trend


@pytest.mark.parametrize("name", TRENDS)
def test_trends_are_those_of_the_stability_functions(name: str) -> None:
    """|R(iz)|^2: Euler 1 + z^2, Heun 1 + z^4/4, RK4 1 - z^6/72 + z^8/576, backward Euler 1/(1 + z^2)."""
    check_trend(find(name), TRENDS[name])
    z = np.linspace(0.02, 0.2, 10)
    closed = {
        "euler": 1 + z**2,
        "heun": 1 + z**4 / 4,
        "rk4": 1 - z**6 / 72 + z**8 / 576,
        "backward_euler": 1 / (1 + z**2),
    }
    if name in closed:
        assert np.all((closed[name] > 1) if TRENDS[name] == "growing" else (closed[name] < 1))


@pytest.mark.parametrize(
    ("scheme", "trend"),
    [
        (wrong.kick_drift_gaining_energy, "bounded"),
        (wrong.verlet_with_one_force, "bounded"),
        (wrong.explicit_in_place_of_backward, "growing"),
        (wrong.heun_without_half, "decaying"),
    ],
    ids=label,
)
def test_the_trend_fails_on_wrong_schemes(scheme: Scheme, trend: str) -> None:
    """Even growth by a part in a million a step is told from none."""
    with pytest.raises(AssertionError):
        check_trend(scheme, trend)
