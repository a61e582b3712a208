"""Identification on large systems: few schemes are followed to the end, and the answers are the same."""

from __future__ import annotations

import pytest

import reference.identification.search
from reference.changes import Change
from reference.identification import (
    candidates_for,
    identify,
)
from reference.outcome import Outcome
from reference.schemes import catalogue
from reference.schemes.catalogue import Scheme, find, schemes
from reference.stepper import SchemeStepper
from tests import wrong
from tests.reference.identified import DT, PARAMETERS, SAME_AS, STEPS, Recorded, known, shifted
from tests.reference.systems import label


@pytest.fixture
def all_are_large(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every system counts as large, so that small ones can be identified both ways."""
    monkeypatch.setattr(reference.identification.search, "LARGE", 0)


@pytest.mark.rotating(6)
@pytest.mark.usefixtures("all_are_large")
@pytest.mark.parametrize("case", PARAMETERS)
@pytest.mark.parametrize("scheme", [s for s in schemes().values() if s.step.__module__ in catalogue.FIRST], ids=label)
def test_on_large_systems_schemes_are_identified_as_on_small_ones(scheme: Scheme, case: str) -> None:
    """As itself or as the one that theory says is the same there, though few are followed to the end."""
    system, _ = known(case)
    recorded = Recorded(SchemeStepper(scheme).run(system, DT, STEPS))
    found = identify(recorded, system, DT, STEPS)
    assert found.identified_as == SAME_AS[case].get(scheme.name, scheme.name)
    assert found.error <= 1e-12 * system.size


@pytest.mark.usefixtures("all_are_large")
def test_on_large_systems_only_what_a_run_can_be_is_followed() -> None:
    """Of a run by Heun, that is Heun; the catalogue's own run is not run again, and is itself."""
    system, _ = known("plain")
    stepper = SchemeStepper(find("heun"))
    outcome = stepper.run(system, DT, STEPS)
    assert list(candidates_for([(Recorded(outcome), outcome)], system, DT, STEPS).whole) == ["heun"]
    own = candidates_for([(stepper, outcome)], system, DT, STEPS).whole
    assert own["heun"] is outcome.trajectory


@pytest.mark.usefixtures("all_are_large")
def test_who_only_has_a_schemes_name_is_not_taken_at_its_word() -> None:
    """A run by rk4 whose stepper calls itself Heun is rk4."""
    system, _ = known("plain")
    outcome = SchemeStepper(find("rk4")).run(system, DT, STEPS)
    assert identify(Recorded(outcome, name="heun"), system, DT, STEPS).identified_as == "rk4"


@pytest.mark.usefixtures("all_are_large")
def test_on_large_systems_a_stranger_gets_the_nearest() -> None:
    """Wrong by a part in 1e9: not identified, and Heun is the nearest."""
    system, _ = known("both")
    stranger = SchemeStepper(wrong.stepped(wrong.slightly_stronger, find("heun")))
    found = identify(stranger, system, DT, STEPS)
    assert found.identified_as is None
    assert found.ranking[0].scheme == "heun"


@pytest.mark.usefixtures("all_are_large")
def test_on_large_systems_what_shows_late_is_still_seen() -> None:
    """Damping that is switched on after 50 steps: until then two schemes are the same, and the search goes on."""
    system, _ = known("plain")
    changes = (Change(0.05, "damping", 0.3),)
    stepper = SchemeStepper(find("kick_drift_implicit_damping"))
    recorded = Recorded(stepper.run(system, DT, STEPS, changes))
    assert identify(recorded, system, DT, STEPS, changes).identified_as == "kick_drift_implicit_damping"


@pytest.mark.usefixtures("all_are_large")
def test_on_large_systems_what_left_nothing_or_blew_up_at_once_is_not_identified() -> None:
    """As on small ones."""
    system, _ = known("plain")
    for outcome in (Outcome("crashed", "killed"), Outcome("diverged", "gone", shifted(system, 1e9))):
        assert identify(Recorded(outcome), system, DT, STEPS).ranking == ()
