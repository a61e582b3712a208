"""Springs that resist bending in the page: runs, what breaks, when they blow up, and limits, against the reference."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from reference.changes import Change
from reference.outcome import first_blown_up_frame
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.simulate import simulate
from reference.springs.bending import with_bending
from reference.system import MassSpringSystem
from reference.theory.equilibria import spring_equilibrium
from report.browser.changes import changes_data
from report.browser.lab_page import physics
from report.browser.programs import page_schemes
from report.browser.system_data import system_data
from tests.report.browser.node import ask, doubles
from tests.report.browser.systems import random_system
from tests.report.browser.test_bits import FEW_STEPS, NEAR, of_reference
from tests.report.browser.test_limits import agrees, asked_of_page

#: Random systems in the plane and in space that have springs which meet.
BENT = (0, 6, 8, 10)


def bent(seed: int) -> MassSpringSystem:
    """A random system with what resists bending wherever two springs meet."""
    return with_bending(random_system(seed)[0], 0.3)


def apart(seeds: Sequence[int], text: str = "", names: Sequence[str] = tuple(page_schemes())) -> float:
    """By how much the page is off at most, as a part of the largest number of the run: angles are no exact bits."""
    asked, expected = [], []
    for seed in seeds:
        for name in names:
            question = {"ask": "run", "system": system_data(bent(seed)), "scheme": name, "dt": 5e-3}
            asked.append({**question, "steps": FEW_STEPS})
            expected.append(of_reference(bent(seed), name, 5e-3, steps=FEW_STEPS))
    answers = [doubles(answer).reshape(FEW_STEPS, -1) for answer in ask(asked, text)]
    return max(float(np.abs(a - e).max() / np.abs(e).max()) for a, e in zip(answers, expected, strict=True))


@pytest.mark.rotating(5, in_turn=True)
def test_all_schemes_agree_to_rounding() -> None:
    """Also those that write in place, which have no loops here; shown to fail without the forces."""
    assert {bent(seed).dimension for seed in BENT} == {2, 3}
    assert apart(BENT) < NEAR
    forces = "I[at.fixed + i] ? 0 : forces[e] / F[at.masses + i]"
    assert forces in physics()
    assert apart(BENT[:1], physics().replace(forces, "0"), ("rk4", "heun_aliased")) > 1e6 * NEAR


def test_what_bends_between_broken_springs_is_gone() -> None:
    """A string of four that breaks in the middle: the bends at both ends of the spring are gone with it."""
    system = find_scene("string").system({"masses": 4, "angular_stiffness": 0.2})
    changes = [Change(0.01, "break", (2.0,))]
    question = {"ask": "run", "system": system_data(system), "scheme": "heun", "dt": 1e-3, "steps": 60}
    (answer,) = ask([{**question, "changes": changes_data(changes)}])
    expected = of_reference(system, "heun", 1e-3, changes, 60)
    assert np.abs(doubles(answer).reshape(60, -1) - expected).max() < NEAR
    (kept,) = ask([{**question, "changes": changes_data(changes)}], physics().replace("angular.stiffness[k] = 0;", ";"))
    assert np.abs(doubles(kept).reshape(60, -1) - expected).max() > 1e6 * NEAR


def test_it_blows_up_at_the_reference_s_step() -> None:
    """A string too stiff against bending for its dt: the energy of bends counts there and here."""
    system = find_scene("string").system({"masses": 4, "angular_stiffness": 20.0})
    run = simulate(system, find("kick_drift"), 5e-3, 1.0)
    frame = first_blown_up_frame(system, run)
    assert frame < 200
    question = {"ask": "blown", "system": system_data(system), "scheme": "kick_drift", "dt": 5e-3, "steps": 200}
    (answer,) = ask([{**question, "at_once": 200}])
    assert answer["steps"] == frame


@pytest.mark.rotating(3, in_turn=True)
def test_limits_are_those_of_the_theory_room() -> None:
    """Of a string whose bends are stiffer than its springs; shown to fail where they are left out of the stiffness."""
    system = find_scene("string").system({"masses": 4, "angular_stiffness": 20.0, "damping": 0.1})
    names = ("heun", "kick_drift", "rk4", "backward_euler", "kick_drift_implicit_damping", "velocity_verlet")
    rest = spring_equilibrium(system)
    question = asked_of_page(system, ask="limits", schemes=list(names))
    (answer,) = ask([question])
    assert all(agrees(answer["limits"][name], name, rest) for name in names), answer
    bends = "if (angles && across)"
    assert bends in physics()
    (other,) = ask([question], physics().replace(bends, "if (false)"))
    assert not agrees(other["limits"]["kick_drift"], "kick_drift", rest)
    plain = spring_equilibrium(replace(system, angular_springs=None))
    assert not agrees(answer["limits"]["kick_drift"], "kick_drift", plain)
