"""`springlab identify`: one stepper against the whole catalogue."""

from __future__ import annotations

import json

import pytest

from engines.process.isolation import EngineStepper
from experiments.runs import steppers
from reference.stepper import Stepper, catalogued, wide_catalogue
from tests.conformance import doctored
from tests.conformance.doctored import Doctored
from tests.report.commands.terminal import springlab


def test_the_json_has_exactly_the_promised_form() -> None:
    """The whole catalogue is ranked, nearest first; Heun is itself, with deviation 0."""
    said = springlab("identify", "heun", "--duration", "0.1", "--json")
    assert said.code == 0
    document = json.loads(said.out)
    more = ["ties", "told_apart_by", "compared_by", "why_not_identified", "same_without"]
    assert list(document) == ["stepper", "identified_as", "error_m", *more, "ranking"]
    assert (document["stepper"], document["identified_as"], document["error_m"]) == ("heun", "heun", 0.0)
    assert all(list(match) == ["scheme", "error_m", "steps"] for match in document["ranking"])
    assert {match["scheme"] for match in document["ranking"]} == {*catalogued(), *wide_catalogue()}
    errors = [match["error_m"] for match in document["ranking"]]
    assert errors == sorted(errors)


@pytest.mark.parametrize("name", ["lecture_heun_loops", "lecture_heun_incorrect", "rk4", "pendulum_rk4"])
def test_the_terminal_says_what_a_stepper_is(name: str) -> None:
    """In a sentence, with a table of the catalogue below it."""
    said = springlab("identify", name, "--duration", "0.1")
    assert said.code == 0
    assert f"{name} is {name.replace('lecture_heun_', 'heun ').split()[0]}, to 0 m" in said.out
    assert "kick_drift" in said.out


def test_schemes_that_cannot_be_told_apart_are_named_too() -> None:
    """Without damping the implicit treatment of damping changes nothing, and the simplest scheme is the one named."""
    said = springlab("identify", "kick_drift_implicit_damping", "--duration", "0.1")
    assert "kick_drift_implicit_damping is kick_drift, to 0 m" in said.out
    assert "On this scene it cannot be told from" in said.out


def test_a_stranger_is_not_identified_and_the_nearest_scheme_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """A kick-drift with springs a millionth too stiff: null in the JSON, and a sentence with the distance."""
    stranger = Doctored(doctored.StifferByAMillionth)

    def known() -> dict[str, Stepper]:
        return {stranger.name: EngineStepper(stranger)}

    monkeypatch.setattr(steppers, "all_steppers", known)
    document = json.loads(springlab("identify", stranger.name, "--json").out)
    assert document["identified_as"] is None
    assert 1e-12 < document["error_m"] < 1e-4
    assert document["ranking"][0]["scheme"] == "kick_drift"
    said = springlab("identify", stranger.name)
    assert f"{stranger.name}: not identified; nearest kick_drift at " in said.out
