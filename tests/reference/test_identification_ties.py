"""Identification where a system's own motion tells no schemes apart: a push does, and what still ties is told."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import pytest

from reference.changes import Change
from reference.identification import Identification, candidates, identify, identify_run
from reference.outcome import Outcome
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find, schemes
from reference.stepper import SchemeStepper, Stepper, catalogued, stepper_named
from reference.system import MassSpringSystem
from reference.theory.equilibria import spring_equilibrium
from tests import wrong
from tests.reference.identified import DT, SAME_AS, WIDE_SAME_AS

STEPS = 30


def weightless() -> MassSpringSystem:
    """A string that is not stretched, and has no weight: it stays where it is."""
    return find_scene("string").system({"masses": 4, "gravity": 0.0})


def hanging() -> MassSpringSystem:
    """The string where it hangs at rest."""
    string = find_scene("string").system({"masses": 4})
    return replace(string, positions=spring_equilibrium(string).state.positions)


def falling() -> MassSpringSystem:
    """The weightless string's masses and springs, let go: it falls freely, and no spring is stretched."""
    return replace(find_scene("string").system({"masses": 4}), fixed=np.zeros(5, dtype=bool))


SYSTEMS = [weightless, hanging, falling]

#: The schemes of whole states that theory tells apart from others on springs.
TOLD_APART = ["euler", "heun", "kick_drift", "drift_kick", "velocity_verlet", "rk4", "backward_euler"]


@dataclass(frozen=True)
class Refusing:
    """A stepper that begins with springs at their lengths only, and at rest only unless it may move."""

    scheme: str
    may_move: bool = False
    name: str = "refusing"
    kind: str = "engine"
    version: str | None = None

    def run(self, system: MassSpringSystem, dt: float, steps: int, changes: Sequence[Change] = ()) -> Outcome:
        """As its scheme does, or unsupported."""
        if system.off_rest_length.any() or (system.velocities.any() and not self.may_move):
            return Outcome("unsupported", "it begins at rest")
        return catalogued()[self.scheme].run(system, dt, steps, changes)


@pytest.mark.rotating(6)
@pytest.mark.parametrize("build", SYSTEMS)
@pytest.mark.parametrize("name", TOLD_APART)
def test_what_its_own_motion_does_not_tell_a_push_does(name: str, build: type) -> None:
    """Every scheme is itself, and it is said that the system was pushed."""
    found = identify(SchemeStepper(find(name)), build(), DT, STEPS)
    assert found.identified_as == name
    assert found.told_apart_by.startswith("a push of its masses")
    assert ", told apart by a push of its masses" in str(found)
    assert all({**SAME_AS["plain"], **WIDE_SAME_AS}.get(tie) == name for tie in found.ties)


@pytest.mark.parametrize("build", [weightless, hanging])
def test_the_motion_alone_would_name_the_first_of_many(build: type) -> None:
    """What this is for: ten schemes and more do the same within the tolerance on the system itself."""
    system = build()
    known = candidates(system, DT, STEPS)
    alone = identify_run("it", SchemeStepper(find("rk4")).run(system, DT, STEPS), system, known)
    assert len(alone.matches) > 10
    assert alone.identified_as != "rk4"


@pytest.mark.parametrize("scheme", [wrong.heun_of_the_wrong_pair, wrong.verlet_with_one_force], ids=["pair", "force"])
def test_a_wrong_scheme_at_rest_is_seen_by_the_push(scheme: object) -> None:
    """It rests as all others do, and pushed it is none of them; the reason says both."""
    found = identify(SchemeStepper(scheme), weightless(), DT, STEPS)  # type: ignore[arg-type]
    assert found.identified_as is None
    assert "schemes do the same here; after a push of its masses" in found.reason
    assert ", nearest " in found.reason


def test_what_begins_in_motion_only_is_pushed_without_stretching() -> None:
    """Rods that turn: the third way to push, for a string."""
    found = identify(Refusing("pendulum_rk4", may_move=True), weightless(), DT, STEPS)
    assert found.identified_as == "pendulum_rk4"


@pytest.mark.parametrize("build", [weightless])
def test_where_it_rests_and_cannot_be_pushed_nothing_is_named(build: type) -> None:
    """Everything ties: no name, the reason, and all the schemes that tie."""
    found = identify(Refusing("rk4"), build(), DT, STEPS)
    assert found.identified_as is None
    assert found.reason == f"all {len(found.ranking)} schemes that can step it do the same here"
    assert {"euler", "rk4", "pendulum_rk4"} <= set(found.ties)
    assert found.remark == ""


def test_uniform_motion_is_every_schemes() -> None:
    """Without forces x + t v is exact for all of them, pushed or not: none is named."""
    mass = MassSpringSystem(
        positions=np.array([[0.0, 0.0]]),
        springs=np.zeros((0, 2), dtype=int),
        masses=np.ones(1),
        rest_lengths=np.zeros(0),
        stiffness=np.zeros(0),
        gravity=np.zeros(2),
        velocities=np.array([[1.0, 2.0]]),
    )
    found = identify(SchemeStepper(find("heun")), mass, DT, STEPS)
    assert found.identified_as is None
    assert "do the same" in found.reason
    assert set(schemes()) - set(found.ties) == set()


def test_schemes_that_are_one_here_say_what_they_differ_in() -> None:
    """Implicit damping is explicit where there is none; drag likewise."""
    found = identify(SchemeStepper(find("kick_drift")), find_scene("string").system({"masses": 4}), DT, STEPS)
    assert found.told_apart_by == ""
    assert found.same_without == {
        "kick_drift_implicit_damping": "damping",
        "kick_drift_implicit_drag": "drag",
        "kick_drift_implicit_damping_and_drag": "damping and drag",
        "kick_drift_truncated_damping": "damping",
        "kick_drift_drag_afterwards": "drag",
        "kick_drift_exponential_drag": "drag",
    }
    assert "kick_drift_exponential_drag (the same without drag)" in found.remark
    damped = find_scene("string").system({"masses": 4, "damping": 0.3})
    assert identify(SchemeStepper(find("kick_drift")), damped, DT, STEPS).ties == (
        "kick_drift_implicit_drag",
        "kick_drift_drag_afterwards",
        "kick_drift_exponential_drag",
    )


def test_ties_are_told_on_large_systems_too() -> None:
    """Of 60 masses only the simplest is followed to the end; the others tie in the first steps."""
    large: Stepper = SchemeStepper(find("kick_drift"))
    found: Identification = identify(large, find_scene("string").system({"masses": 60}), DT, STEPS)
    assert found.identified_as == "kick_drift"
    assert set(found.ties) == {tie for tie, same in SAME_AS["plain"].items() if same == "kick_drift"}
    assert set(found.same_without) == set(found.ties)


def test_a_scheme_is_not_told_beside_itself() -> None:
    """With alpha = 0 it is Newmark's method: one name for it, and its own is not among the others."""
    found = identify(stepper_named("hht(alpha=0.0)"), weightless(), DT, STEPS)
    assert found.identified_as == "newmark"
    assert found.ties == ()
