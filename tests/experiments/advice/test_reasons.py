"""How much stiffer springs could be at a dt, by a limit that is made up: 2 (m/k)^(1/2), as kick-drift's of one mass."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from experiments.advice import reasons
from experiments.advice.reasons import MOST_MASSES, PRECISION, SOFTEST, STIFFEST, largest_stiffness, reasons_of
from reference.errors import SolverError
from reference.limit import Limit
from reference.scenes import find
from reference.schemes.catalogue import find as find_scheme
from reference.system import MassSpringSystem

SYSTEM = find("string").system({"masses": 1, "stiffness": 100.0, "mass": 0.04})
HEUN = find_scheme("heun")

#: The limit of the springs as they are [s].
NOW = 2 * (0.04 / 100) ** 0.5


@pytest.fixture(autouse=True)
def made_up(monkeypatch: pytest.MonkeyPatch) -> None:
    """A rest is its system."""
    monkeypatch.setattr(reasons, "spring_equilibrium", lambda system: system)
    monkeypatch.setattr(
        reasons, "stability_limit", lambda _, s: Limit(float(2 * (s.masses[-1] / s.stiffness[0]) ** 0.5))
    )


@pytest.mark.parametrize("part", [0.1, 0.5, 2.0])
def test_springs_could_be_as_much_stiffer_as_the_limit_squared_allows(part: float) -> None:
    """To PRECISION of itself; softer, where dt is too long."""
    assert largest_stiffness(HEUN, SYSTEM, part * NOW) == pytest.approx(part**-2, rel=PRECISION)


def test_any_could_or_none_could() -> None:
    """Beyond what is tried; or where there is no limit, as none is stable, or all are."""
    assert largest_stiffness(HEUN, SYSTEM, 0.9 * NOW / STIFFEST**0.5) == np.inf
    assert largest_stiffness(HEUN, SYSTEM, 1.1 * NOW / SOFTEST**0.5) == 0.0


@pytest.mark.parametrize(("limit", "factor"), [(Limit(None, "never", 0.1), 0.0), (Limit(None, "at any"), np.inf)])
def test_without_a_limit_it_is_growth_that_counts(limit: Limit, factor: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """Unstable at any dt, or stable at any."""
    monkeypatch.setattr(reasons, "stability_limit", lambda *_: limit)
    assert largest_stiffness(HEUN, SYSTEM, 1e-3) == factor


def test_where_there_is_no_rest_nothing_is_known(monkeypatch: pytest.MonkeyPatch) -> None:
    """None, and no traceback."""

    def fails(_: MassSpringSystem) -> None:
        raise SolverError("no rest")

    monkeypatch.setattr(reasons, "spring_equilibrium", fails)
    assert largest_stiffness(HEUN, SYSTEM, 1e-3) is None


@pytest.mark.parametrize(
    ("masses", "springs", "dt", "linear", "mode", "stiffest"),
    [
        (MOST_MASSES, 1, 0.1, "linear", True, True),
        (MOST_MASSES + 1, 1, 0.1, "linear", True, False),
        (2, 0, 0.1, "linear", False, False),
        (2, 1, None, "linear", False, True),
        (2, 1, 0.1, None, False, True),
    ],
)
def test_a_mode_needs_a_limit_and_springs_and_small_systems_are_tried_stiffer(
    masses: int, springs: int, dt: float | None, linear: str | None, mode: bool, stiffest: bool,
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    """Each alone may be missing."""
    monkeypatch.setattr(reasons, "critical_mode", lambda scheme, linear, dt: ("mode", linear, dt))
    monkeypatch.setattr(reasons, "largest_stiffness", lambda scheme, system, dt: ("stiffest", dt))
    system = SimpleNamespace(masses=range(masses), springs=range(springs))
    known = cast(Any, SimpleNamespace(system=system, rest=SimpleNamespace(linear=linear)))
    found = reasons_of(HEUN, known, Limit(dt), 0.5)
    assert found.mode == (("mode", "linear", 0.1) if mode else None)
    assert found.stiffest == (("stiffest", 0.5) if stiffest else None)
    assert found.system is system
