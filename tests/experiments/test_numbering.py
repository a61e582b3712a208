"""Numbers are names: who sees them, and how Pymunk's rounds forget the springs' order."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from engines.engine import version
from engines.process.isolation import EngineStepper, run_engine
from engines.pymunk.springs import PymunkSprings
from experiments import numbering
from experiments.runs.permutation import CHANGES, permutation_effects, permutations
from reference.forces import SpringMotion
from reference.motion import MotionOfSprings
from reference.outcome import Outcome
from reference.schemes.catalogue import Scheme, find
from reference.schemes.implicit_damping import spring_directions
from reference.state import State
from reference.stepper import SchemeStepper, catalogued
from reference.theory.gauss_seidel import convergence_factor
from tests import wrong
from tests.conformance.doctored import Doctored
from tests.engines.process.misbehaving import Misbehaving, Segfaults
from tests.reference.systems import label, moving_string, random_mesh

MASSES, SPRINGS, ENDS, NONE = frozenset({"masses"}), frozenset({"springs"}), frozenset({"ends"}), frozenset[str]()
NO_PYMUNK = pytest.mark.skipif(version(PymunkSprings()) is None, reason="pymunk is not installed")


def damped_spring_after_spring(motion: MotionOfSprings, state: State, dt: float) -> State:
    """Kick-drift, the springs damped in one round, each looking at what those before it have left."""
    system = motion.system
    kicked = state.kick(dt * motion.acceleration(state, damping=False))
    for (a, b), c, along in zip(system.springs, system.damping, spring_directions(system, state), strict=True):
        v = kicked.velocities
        impulse = dt * c * ((v[b] - v[a]) @ along) * along
        for i, sign in ((a, 1), (b, -1)):
            v[i] += 0.0 if system.fixed[i] else sign * impulse / system.masses[i]
    return kicked.drift(dt)


SPRING_AFTER_SPRING = Scheme(damped_spring_after_spring, 1, "scheme")
ONE_SIDED = wrong.stepped(wrong.one_sided, find("kick_drift"))


def seen(scheme: Scheme) -> frozenset[str]:
    """Whose order shows in 100 steps of a moving, damped string of seven, beyond 1e-12 of its size."""
    system = moving_string(7, damping=1.0)
    run = SchemeStepper(scheme).run
    return permutation_effects(lambda s: run(s, 1e-3, 100), system).depends_on(1e-12 * system.size)


@pytest.mark.rotating(3)
@pytest.mark.parametrize(
    ("scheme", "orders"),
    [
        *((s.scheme, NONE) for s in catalogued().values() if s.kind == "scheme"),
        *((s.scheme, MASSES) for s in catalogued().values() if s.kind == "in_place"),
        (wrong.in_order_of_number, MASSES),
        (wrong.last_mass_forgotten, MASSES),
        (SPRING_AFTER_SPRING, SPRINGS),
        (ONE_SIDED, ENDS),
    ],
    ids=label,
)
def test_each_permutation_shows_in_who_goes_by_that_order_and_in_nobody_else(
    scheme: Scheme, orders: frozenset[str]
) -> None:
    """Numbers are labels, not physics: a right scheme depends on none.

    Each of the doctored ones depends on just the order it goes by.

    The limit is that of identification, 1e-12 of the size: 100 steps round by some 1e-14 of it.
    """
    assert seen(scheme) == orders


@pytest.mark.parametrize("change", CHANGES)
def test_the_permuted_system_is_the_same_system(change: str) -> None:
    """Accelerations of a random mesh with unequal springs are the same, mass for mass, to rounding; mass 0 stays.

    A change that forgets a spring's stiffness on the way is seen: with all stiffnesses shuffled it is another system.
    """
    mesh = random_mesh(3, 8, 3)
    other, order = permutations(mesh)[change]
    expected = SpringMotion(mesh).acceleration(mesh.start)[order]
    assert SpringMotion(other).acceleration(other.start) == pytest.approx(expected, rel=1e-12)
    assert order[0] == 0
    assert not np.array_equal(other.springs, mesh.springs)
    doctored = replace(other, stiffness=np.roll(other.stiffness, 1))
    assert SpringMotion(doctored).acceleration(other.start) != pytest.approx(expected, rel=1e-3)


@NO_PYMUNK
def test_pymunk_sees_the_order_of_its_springs_just_as_the_scheme_it_is() -> None:
    """With 10 rounds, the scheme's number too, to what both round; the difference itself is a thousand times more."""
    engine, scheme = (
        numbering.effects_on(stepper)[0].distances["springs reversed"]
        for stepper in (EngineStepper(PymunkSprings()), catalogued()["drift_kick_sequential_damping"])
    )
    assert engine == pytest.approx(scheme, abs=1e-12)
    assert engine > 1e-9


@NO_PYMUNK
def test_the_difference_falls_by_what_a_round_leaves() -> None:
    """From 30 to 50 rounds at 20 N s/m, within a tenth: the string is not quite straight. Other rounds are not it."""
    system = numbering.string(20.0)
    few, many = (numbering.reversal(EngineStepper(PymunkSprings(rounds=n)), 20.0) for n in (30, 50))
    assert np.log(many / few) / 20 == pytest.approx(np.log(convergence_factor(system, 1e-3)), rel=0.1)
    assert np.log(many / few) / 20 != pytest.approx(np.log(convergence_factor(numbering.string(5.0), 1e-3)), rel=0.1)


def test_an_engine_that_crashes_or_is_not_there_or_takes_strings_only_says_so() -> None:
    """Whatever happens to an engine happens to it alone, and comes with its reason."""
    crashed = numbering.effects_on(EngineStepper(Misbehaving(Segfaults)))
    assert all("SIGSEGV" in reason for effects in crashed for reason in effects.reasons.values())
    absent = numbering.effects_on(EngineStepper(replace(PymunkSprings(), package="no-such-engine")))
    assert absent[0].reasons["ends swapped"] == "unsupported, no-such-engine is not installed"
    strings_only = Doctored(capabilities=frozenset({"2d", "damping"}))
    renamed = permutation_effects(partial(run_engine, strings_only, dt=1e-3, steps=5), numbering.string(0.0))
    assert renamed.permuted == ENDS
    assert "a string hung at its first mass" in renamed.reasons["springs reversed"]


def test_an_engine_of_no_known_scheme_has_no_prediction() -> None:
    """And one that is known has its scheme's."""
    assert numbering.predicted(EngineStepper(Misbehaving(Segfaults)), 5.0) is None
    assert numbering.predicted(EngineStepper(Doctored()), 5.0) == NONE
    assert numbering.predicted(EngineStepper(PymunkSprings()), 5.0) == SPRINGS
    assert numbering.predicted(EngineStepper(PymunkSprings()), 0.0) == NONE


def test_a_run_that_is_not_done_is_compared_with_nothing() -> None:
    """Though it left a trajectory: of the system itself nothing can be said, of a change its reason is."""
    system = moving_string(4)
    done = SchemeStepper(find("heun")).run(system, 1e-3, 5)
    diverged = replace(done, ending="diverged", reason="spring 1 is torn")
    lost = Outcome("done", "no trajectory")
    for original in (diverged, lost):
        answers = iter([original, done, done, done])
        effects = permutation_effects(lambda _, answers=answers: next(answers), system)  # type: ignore[misc]
        assert effects.distances == {}
        assert effects.reasons == dict.fromkeys(CHANGES, f"{original.ending}, {original.reason}")
    for other in (diverged, lost):
        answers = iter([done, other, done, done])
        effects = permutation_effects(lambda _, answers=answers: next(answers), system)  # type: ignore[misc]
        assert list(effects.reasons.items()) == [("masses renumbered", f"{other.ending}, {other.reason}")]
        assert list(effects.distances) == ["springs reversed", "ends swapped"]


def test_what_a_round_leaves_is_fitted_where_it_can_be_seen() -> None:
    """From as many rounds on as there are springs, and as long as it is more than rounding: 0.8 here, by hand."""
    springs = len(numbering.string(5.0).springs)
    many = [1e-3 * 0.8**n if n >= springs else 1.0 for n in numbering.ROUNDS]
    distances = [d if d > numbering.rounding() else 0.0 for d in many]
    assert distances[-1] == 0.0
    found = numbering.convergence(5.0, distances)
    assert found.measured == pytest.approx(0.8)
    assert found.predicted == pytest.approx(convergence_factor(numbering.string(5.0), numbering.DT))
    assert (found.damping, found.distances) == (5.0, distances)
    one = [d if n == springs else np.nan for n, d in zip(numbering.ROUNDS, many, strict=True)]
    assert numbering.convergence(5.0, one).measured is None
