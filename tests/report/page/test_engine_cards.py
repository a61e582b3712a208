"""Engine cards: all of the registry, with what is known of each."""

from __future__ import annotations

import pytest

from engines.engine import CAPABILITIES, installed_version, recorded_settings, registry
from report.page.engine_cards import packages


def test_there_is_a_card_for_every_engine_under_its_package() -> None:
    """With its claims, settings and precision, its meaning in SI units, and every capability there or lacking."""
    here = {"mujoco_tendons": "kick_drift, to 4e-16 m"}
    found = packages(here)
    assert [package.name for package in found] == sorted({engine.package for engine in registry().values()})
    cards = {card.name: card for package in found for card in package.cards}
    assert cards.keys() == registry().keys()
    for name, card in cards.items():
        engine = registry()[name]
        assert [*card.schemes.values()] == [*engine.identified_as.values()]
        assert [setting.partition(" = ")[0] for setting in card.settings] == [*recorded_settings(engine)]
        assert card.semantics == engine.semantics
        assert len(card.can) + len(card.lacks) == len(CAPABILITIES)
        assert card.here == here.get(name, "")


#: What becomes of some versions.
CRASHES = [
    ("pybullet", "3.2.7", "Load a triangle that has a corner twice.", "SIGSEGV"),
    ("pymunk", "7.3.1", "Let the solver go round no times.", "SIGABRT"),
]


@pytest.mark.parametrize(("package", "version", "done_to_it", "ending"), CRASHES)
def test_crashes_are_those_kept_of_the_installed_version(
    package: str, version: str, done_to_it: str, ending: str
) -> None:
    """Bullet dies on bad meshes; Pymunk aborts without rounds."""
    if installed_version(package) != version:
        pytest.skip(f"{package} {version} is not installed")
    found = {card.name: card for card in packages({})}
    assert (done_to_it, ending) in found[package].crashes


def test_there_are_crashes_or_why_there_are_none() -> None:
    """Never both."""
    for package in packages({}):
        assert bool(package.crashes) != bool(package.no_crashes)


def test_a_version_nobody_tried_is_said_to_be_one(monkeypatch: pytest.MonkeyPatch) -> None:
    """With the command that does; and where the package is missing, that."""
    monkeypatch.setattr("report.page.engine_cards.installed_version", {"pymunk": "99.0"}.get)
    found = {package.name: package for package in packages({})}
    assert found["pymunk"].no_crashes == "Not tried in this version: springlab versions pymunk 99.0 does."
    assert found["mujoco"].no_crashes == "It is not installed."
