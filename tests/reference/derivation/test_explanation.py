"""All that is told of a stepper, against the catalogue and what engines claim."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from engines.engine import registry
from engines.process.isolation import EngineStepper
from engines.process.packages import APART
from reference.derivation.explanation import OF_ONE_MASS, explain
from reference.derivation.near import nearest_known
from reference.derivation.nonlinear_order import (
    END_OF_ONE,
    END_OF_TWO,
    nonlinear_order,
    order_of_two_masses,
    swinging,
    true_end,
    two_swinging,
)
from reference.derivation.of_schemes import tableau_of_scheme
from reference.derivation.oscillators import runs_of
from reference.derivation.pasts import pasts
from reference.derivation.step_matrix import step_matrix
from reference.motion import Motion
from reference.outcome import Outcome, outcome_of
from reference.schemes.catalogue import Scheme, find, schemes
from reference.state import State
from reference.stepper import SchemeStepper, catalogued, stepper_named
from reference.system import MassSpringSystem
from tests import wrong
from tests.reference.systems import label

#: The engines' own names for what they do with damping and drag at once; Bullet is slow to start, and has a case below.
ENGINES = [
    n
    for n, e in registry().items()
    if {"1d", "stretched", "velocities"} <= e.capabilities and e.package not in {"pybullet", *APART}
]


@pytest.mark.rotating(5)
@pytest.mark.parametrize("name", ENGINES)
def test_an_engines_formulas_are_those_of_a_scheme_it_claims(name: str) -> None:
    """Derived from the engine's own steps, and from the scheme's: the same fractions."""
    stepper = EngineStepper(registry()[name])
    if stepper.version is None:
        pytest.skip(f"{stepper.engine.package} is not installed")
    found = step_matrix(runs_of(stepper))
    keep = [entry.numerator.keys() for entry in found.entries]
    claimed = [step_matrix(runs_of(stepper_named(claim))).text() for claim in stepper.claims]
    if found.dragged and (found.damped or found.of_swings):
        assert found.text() in claimed
    else:
        assert not any(monomial[1] or monomial[2] for entry in keep for monomial in entry)
    assert found.exact or found.of_swings  # a rod's compliance is no fraction


@dataclass(frozen=True)
class Tampered:
    """Kick-drift with something added to the velocity of every step: what `extra` makes of the number of the step."""

    random: bool
    name: str = "tampered"
    kind: str = "own"
    version: str | None = None

    def run(self, system: MassSpringSystem, dt: float, steps: int, changes: object = ()) -> Outcome:
        """See Stepper."""
        run = catalogued()["kick_drift"].run(system, dt, steps).trajectory
        assert run is not None
        added = np.random.default_rng().normal(size=steps + 1) if self.random else np.arange(steps + 1.0) - 1
        added = 1e-3 * np.where(np.arange(steps + 1) > 1, added, 0.0)[:, None, None]
        velocities = run.velocities + np.where(system.fixed[:, None], 0.0, added)
        return outcome_of(system, type(run)(run.times, run.positions, velocities))


def test_who_remembers_is_found_and_who_is_random() -> None:
    """By the same step with another past, and by the same step twice."""
    honest = pasts(runs_of(catalogued()["heun"]), "double", True, True)
    assert (honest.one_step, honest.deterministic) == (True, True)
    counts = pasts(runs_of(Tampered(random=False)), "double", True, True)
    assert (counts.one_step, counts.deterministic) == (False, True)
    chance = pasts(runs_of(Tampered(random=True)), "double", True, True)
    assert (chance.one_step, chance.deterministic) == (None, False)


@pytest.mark.parametrize("scheme", [s for s in schemes().values() if s.kind != "in_place"], ids=label)
def test_the_order_seen_on_a_spring_that_turns(scheme: Scheme) -> None:
    """Error ~ h^p: two steps of which one is half the other tell p to 0.3."""
    assert nonlinear_order(runs_of(SchemeStepper(scheme)), True, True) == scheme.order


def test_the_order_of_a_wrong_one_is_not_what_it_claims() -> None:
    """The same check, seen to fail."""
    assert nonlinear_order(runs_of(SchemeStepper(wrong.rk4_equally_weighted)), True, True) == 2


def test_true_ends_that_are_kept_are_solved_for_again() -> None:
    """To the solver's 1e-11."""
    np.testing.assert_allclose(true_end(swinging(False, False)), END_OF_ONE, atol=1e-11)
    np.testing.assert_allclose(true_end(two_swinging()), END_OF_TWO, atol=1e-11)
    assert np.abs(true_end(swinging(True, False)) - END_OF_ONE).max() > 0.01


@pytest.mark.rotating(2)
@pytest.mark.parametrize("name", ["heun", "kick_drift", "implicit_midpoint", "drift_kick_exponential_damping"])
def test_a_scheme_is_explained_as_itself(name: str) -> None:
    """What the catalogue says of it is what was found from the outside."""
    found, scheme = explain(catalogued()[name]), schemes()[name]
    document = found.document
    assert document["identified_as"] == name
    assert document["order"] == scheme.order
    assert document["one_step"] is document["deterministic"] is True
    assert document["reason"] == ""
    if scheme.needs == "accelerations":
        assert document["explicit"] is not scheme.implicit


def lopsided(motion: Motion, state: State, dt: float) -> State:
    """Heun with slopes weighted 2/3 and 1/3."""
    here = motion.slope(state)
    return state + dt / 3 * (2 * here + motion.slope(state + dt * here))


def test_a_stranger_is_held_against_the_nearest() -> None:
    """Heun with slopes weighted 2/3 and 1/3 has no name, and the numbers that differ are told."""
    tableau = tableau_of_scheme(Scheme(lopsided, 2))
    assert nearest_known(tableau, None, None) == "b1 is 2/3 where heun has 1/2, b2 is 1/3 where heun has 1/2"


@pytest.mark.parametrize(("name", "order"), [("heun_aliased", 1), ("heun_link_by_link", 1), ("velocity_verlet", 2)])
def test_two_masses_show_the_order_that_the_catalogue_has(name: str, order: int) -> None:
    """One mass shows Heun's order of both in-place ones; a whole number is taken within 0.3 at steps of 1/64 s."""
    stepper = SchemeStepper(find(name))
    assert order_of_two_masses(runs_of(stepper)) == order == find(name).order
    assert nonlinear_order(runs_of(stepper), False, False) == 2


def test_an_order_that_only_one_mass_has_is_not_the_order() -> None:
    """Of heun_aliased its tableau, seen on one mass, has order 2; what is told is 1."""
    found = explain(SchemeStepper(find("heun_aliased")))
    assert found.tableau is not None
    assert (found.tableau.order, found.order_of_one_mass, found.order, found.lower_among_masses) == (2, 2, 1, True)
    assert OF_ONE_MASS in found.reason
