"""Engine cards: all of the registry, with what is known of each."""

from __future__ import annotations

import pytest

from engines.engine import CAPABILITIES, installed_version, registry
from report.page.engine_cards import packages


def test_there_is_a_card_for_every_engine_under_its_package() -> None:
    """With its schemes, its meaning in SI units, and every capability either there or lacking."""
    found = packages({"mujoco_tendons": "kick_drift, to 4e-16 m"})
    assert [package.name for package in found] == sorted({engine.package for engine in registry().values()})
    cards = {card.name: card for package in found for card in package.cards}
    assert cards.keys() == registry().keys()
    for name, card in cards.items():
        engine = registry()[name]
        assert [*card.schemes.values()] == [*engine.identified_as.values()]
        assert card.semantics == engine.semantics
        assert len(card.can) + len(card.lacks) == len(CAPABILITIES)
        assert card.here == ("kick_drift, to 4e-16 m" if name == "mujoco_tendons" else "")


def test_crashes_are_those_kept_of_the_installed_version() -> None:
    """Bullet 3.2.7 dies on bad meshes, Pymunk 7.3.1 aborts without rounds: see tests/engines/test_crash_cases.py."""
    found = {package.name: package for package in packages({})}
    if installed_version("pybullet") == "3.2.7":
        assert ("Load a triangle that has a corner twice.", "SIGSEGV") in found["pybullet"].crashes
    if installed_version("pymunk") == "7.3.1":
        assert ("Let the solver go round no times.", "SIGABRT") in found["pymunk"].crashes
    for package in found.values():
        assert bool(package.crashes) != bool(package.no_crashes)


def test_a_version_nobody_tried_is_said_to_be_one(monkeypatch: pytest.MonkeyPatch) -> None:
    """With the command that does; and where the package is missing, that."""
    monkeypatch.setattr("report.page.engine_cards.installed_version", lambda name: "99.0" if name == "pymunk" else None)
    found = {package.name: package for package in packages({})}
    assert found["pymunk"].no_crashes == "Not tried in this version: springlab versions pymunk 99.0 does."
    assert found["mujoco"].no_crashes == "It is not installed."
