"""Engine cards: what each engine is, can and lacks, made of the registry and of what was kept of its crashes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby

from engines.crash_cases import crash_cases
from engines.engine import CAPABILITIES, Engine, absence, installed_version, recorded_settings, registry
from experiments.engine_versions.baseline import read
from report.page.derived_formulas import formulas_of

#: The cases that engines are identified in, as people say them.
CASES = {"plain": "undamped", "damping": "damped springs", "drag": "drag"}


@dataclass(frozen=True)
class EngineCard:
    """One engine setting, in words.

    Attributes:
        settings: what was chosen, and the precision, as "name = value".
        schemes: the scheme it claims to step by, by case.
        here: what this report identified it as, and how closely; empty where it did not.
        derived: the formulas of its step, recovered from the outside, a line each; none where none are known.
        can, lacks: what a system may ask of it, and what not.
        semantics: what its stiffness, damping and drag mean in SI units.
    """

    name: str
    settings: Sequence[str]
    schemes: Mapping[str, str]
    here: str
    derived: Sequence[str]
    can: Sequence[str]
    lacks: Sequence[str]
    semantics: str


@dataclass(frozen=True)
class Package:
    """A package with its engine settings, and what becomes of it when it is mistreated.

    Attributes:
        version: None where it is not installed.
        absence: why it is not; empty where it is.
        crashes: what was done to it, and how that ended.
        no_crashes: why there are none.
    """

    name: str
    version: str | None
    absence: str
    cards: Sequence[EngineCard]
    crashes: Sequence[tuple[str, str]]
    no_crashes: str


def packages(identified: Mapping[str, str]) -> list[Package]:
    """All packages of the registry with their cards.

    Args:
        identified: what this report found each engine to be, in words, by its name.
    """
    engines = sorted(registry().values(), key=lambda engine: engine.package)
    found = []
    for name, some in groupby(engines, key=lambda engine: engine.package):
        version = installed_version(name)
        crashes, why_none = _crashes(name, version)
        settings = list(some)
        cards = [_card(engine, identified.get(engine.name, "")) for engine in settings]
        why = "" if version else absence(settings[0])
        found.append(Package(name, version, why, cards, crashes, why_none))
    return found


def _card(engine: Engine, here: str) -> EngineCard:
    return EngineCard(
        engine.name,
        [f"{name} = {_in_words(value)}" for name, value in recorded_settings(engine).items()],
        {words: engine.identified_as[case] for case, words in CASES.items() if case in engine.identified_as},
        here,
        formulas_of(engine),
        [words for name, words in CAPABILITIES.items() if name in engine.capabilities],
        [words for name, words in CAPABILITIES.items() if name not in engine.capabilities],
        engine.semantics,
    )


def _in_words(value: object) -> str:
    if isinstance(value, list | tuple | set | frozenset):
        return " ".join(map(str, value))
    return f"{value:g}" if isinstance(value, float) else str(value)


def _crashes(package: str, version: str | None) -> tuple[list[tuple[str, str]], str]:
    """What `springlab versions` kept of the crash cases for this version, or why there is nothing."""
    known = crash_cases(package)
    if not known:
        return [], "Nobody has entered a way to break it into the crash list."
    if version is None:
        return [], "It is not installed."
    measured = read(package).get(version, {}).get(package, {})
    ends = [(case.summary, str(measured[_key(name)])) for name, case in known.items() if _key(name) in measured]
    return ends, "" if ends else f"Not tried in this version: springlab versions {package} {version} does."


def _key(name: str) -> str:
    return f"crash list: {name}"
