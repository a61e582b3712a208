"""Which eigenvalues of a step are motion that nothing resists."""

from __future__ import annotations

import numpy as np
import pytest

from reference.scenes import find as find_scene
from reference.schemes.catalogue import find, schemes, wide_schemes
from reference.theory.differences import differences
from reference.theory.equilibria import spring_equilibrium
from reference.theory.layout import layout_of
from reference.theory.step_map import resisted, step_jacobian


@pytest.mark.parametrize(
    ("off", "unit", "kept"),
    [(2e-6, 1.0, 1), (1e-5, 1.0, 3), (2e-5, 10.0, 1), (1e-4, 10.0, 3), (2e-6, 1e-3, 1)],
)
def test_a_pair_that_rounding_tears_apart_is_left_out_and_growth_of_one_in_a_hundred_thousand_is_not(
    off: float, unit: float, kept: int
) -> None:
    """A double eigenvalue 1 moves by the root of rounding, 1e-8, times what its vectors are worth; at most 3e-6.

    In steps longer than 1/w, by so many times more.
    """
    values = np.array([0.5, 1 + off, 1 - off], dtype=complex)
    found = resisted(values, 2, unit)
    assert len(found) == kept
    assert 0.5 in found


def test_no_more_are_left_out_than_nothing_resists() -> None:
    """The others near 1 are slow motion."""
    assert len(resisted(np.array([1, 1, 1 + 1e-7, 0.5], dtype=complex), 2, 1.0)) == 2


#: Those of one step: what others remember is laid out elsewhere.
LINEAR = [name for name, one in {**schemes(), **wide_schemes()}.items() if one.linear and one.one_step]


@pytest.mark.parametrize("name", LINEAR)
def test_a_scheme_that_says_it_is_linear_steps_many_states_at_once(name: str) -> None:
    """The whole step map at one go is that by differences: with masses, damping and drag all different.

    Differences of fourth order are good to 1e-9 of what is of size 1.
    """
    system = find_scene("string").system({"masses": 3, "mass": [0.02, 0.03, 0.05], "damping": 0.1, "drag": 0.1})
    rest = spring_equilibrium(system)
    scheme, dt = find(name), 4e-3
    layout, settled = layout_of(scheme, rest, dt)
    by_differences = differences(scheme.on(rest.motion), layout, settled)
    assert np.abs(step_jacobian(scheme, rest, dt) - by_differences).max() < 1e-7
