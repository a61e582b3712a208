"""README's table of engines is what runs of them are identified as, and so are the engines' claims."""

from __future__ import annotations

from dataclasses import dataclass, replace

import pytest

from engines.engine import Engine, registry
from engines.process.isolation import EngineStepper
from experiments.engine_versions.conformance import IDENTIFIED, identified
from reference.errors import InputError
from reference.outcome import Outcome
from report.readme import BEGIN, END, README, engine_row
from tests.conformance import doctored
from tests.conformance.doctored import Doctored


def table() -> list[str]:
    """README's rows of engines."""
    between = README.read_text(encoding="utf-8").partition(BEGIN)[2].partition(END)[0]
    return [line for line in between.splitlines() if line.startswith("| `")]


def check_row(engine: Engine, rows: list[str]) -> None:
    """An engine's row is what it is identified as now; where it does not refuse, its claim is among what it may be.

    On the string some schemes cannot be told apart: drag alone is the same for those that differ in damping only. The
    simplest of them is in the table.
    """
    assert engine_row(engine) in rows, "run `python -m report.readme`"
    for case in IDENTIFIED:
        found = identified(EngineStepper(engine), case)
        if isinstance(found, Outcome):
            assert case not in engine.identified_as
        else:
            assert engine.identified_as[case] in [match.scheme for match in found.matches], str(found)


@pytest.mark.rotating(5)
def test_readme_has_what_runs_of_an_engine_are_identified_as(engine: Engine) -> None:
    """The row of each that is installed, in every case."""
    check_row(engine, table())


def test_readme_has_a_row_for_every_engine() -> None:
    """In the order of the registry."""
    assert [row.split("`")[1] for row in table()] == list(registry())


def test_a_false_claim_is_not_printed_and_fails() -> None:
    """Euler's scheme that claims to be kick-drift: whichever of the two the table has, the check fails."""
    honest, liar = Doctored(), Doctored(doctored.Euler)
    check_row(honest, ["| `KickDrift` | `kick_drift` | `kick_drift` | `kick_drift` |"])
    assert engine_row(liar) == "| `Euler` | `euler` | `euler` | `euler` |"
    claims = "| `Euler` | `kick_drift` | `kick_drift` | `kick_drift` |"
    for rows in ([claims], [engine_row(liar)]):
        with pytest.raises(AssertionError):
            check_row(liar, rows)


def test_refusals_and_strangers_are_no_schemes() -> None:
    """A dash for what is refused, and words for what is no scheme of the catalogue."""
    undamped = Doctored(capabilities=Doctored().capabilities - {"damping"})
    assert engine_row(undamped) == "| `KickDrift` | `kick_drift` | - | `kick_drift` |"
    stranger = engine_row(Doctored(doctored.StifferByAMillionth))
    assert stranger == "| `StifferByAMillionth` | not identified | not identified | not identified |"


@dataclass(frozen=True)
class Swept(Doctored):
    """Honest but for its name: the scheme it claims has a parameter."""

    @property
    def identified_as(self) -> dict[str, str]:
        """A scheme of the catalogue that is another with this parameter."""
        return {"plain": "kick_drift", "damping": "drift_kick_sequential_damping(rounds=3)", "drag": "kick_drift"}


@pytest.mark.rotating(5)
def test_a_claim_with_a_parameter_is_tried() -> None:
    """Pymunk with three rounds is the scheme of three rounds; whoever claims that and is another is not."""
    from engines.pymunk.springs import PymunkSprings

    with pytest.raises(AssertionError):
        check_row(Swept(), [engine_row(Swept())])
    three = PymunkSprings("three", rounds=3)
    if EngineStepper(three).version is None:
        pytest.skip("pymunk is not installed")
    check_row(three, ["| `three` | `drift_kick` | `drift_kick_sequential_damping(rounds=3)` | `drift_kick` |"])


def test_an_engine_that_is_not_installed_has_no_row() -> None:
    """One line: the engine, and the package expected."""
    with pytest.raises(InputError, match="'KickDrift' is not installed: expected no-such-engine"):
        engine_row(replace(Doctored(), package="no-such-engine"))
