"""What each engine is expected to refuse, and why: `refusals.toml`, which the suite is held against both ways.

An engine that refuses what it is not expected to fails, and so does one that takes what it was expected to refuse. An
engine that has no row in the table is expected to refuse what goes beyond its capabilities, and nothing else.

`python -m tests.conformance.refusals [ENGINE...]` runs the engines, all or those named, and renews their rows. What has
changed is then to be seen in the difference.
"""

from __future__ import annotations

import json
import sys
import tomllib
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from pathlib import Path

from engines.engine import CAPABILITIES, Engine, asked_by, demands, find, registry, version
from reference.errors import InputError
from reference.outcome import Outcome
from reference.system import BREAK
from tests.conformance.case import Case
from tests.conformance.cases import GROUPS
from tests.conformance.runs import outcomes

FILE = Path(__file__).with_name("refusals.toml")

HEADER = """\
# What each engine refuses, by group of cases (tests/conformance/cases.py): the reason, and the cases refused for it.
# A reason is a capability that the engine lacks (engines.engine.CAPABILITIES), or the engine's own words.
# Written by `python -m tests.conformance.refusals`.
"""

#: Of an engine: by group of cases, by reason, the names of the cases.
Row = Mapping[str, Mapping[str, Sequence[str]]]


@cache
def read(file: Path = FILE) -> Mapping[str, Row]:
    """The table: a row for each engine."""
    return tomllib.loads(file.read_text(encoding="utf-8"))


def reason_of(engine: Engine, outcome: Outcome) -> str | None:
    """Why a case is refused: the capability that is named, else the reason up to its first colon; None if it is not."""
    if outcome.ending != "unsupported":
        return None
    words = outcome.reason.removeprefix(f"{engine.name} cannot do ")
    named = [name for name, lack in CAPABILITIES.items() if words.partition(", asked for by")[0] == lack]
    return named[0] if named else words.partition(":")[0]


def lacking(engine: Engine, case: Case) -> set[str]:
    """The capabilities that a case asks for, at its start or by a change on the fly, and that an engine lacks."""
    system, asked = case.system, set(demands(case.system))
    for change in case.changes:
        system = system.with_parameter(change.parameter, change.value)
        always = {"breaking"} if change.parameter == BREAK else set()
        asked |= always | set(asked_by(change.parameter)).intersection(demands(system))
    return asked - engine.capabilities


def expected(engine: Engine, group: str, case: Case) -> set[str]:
    """The reasons for which a case may be refused, and then must be for one of them; none where it is to be taken."""
    if engine.name not in read():
        return lacking(engine, case)
    return {reason for reason, names in read()[engine.name].get(group, {}).items() if case.name in names}


def refused_as_expected(engine: Engine, group: str, case: Case, outcome: Outcome) -> bool:
    """Whether an engine refuses a case of a group.

    Raises:
        AssertionError: where it refuses what it is expected to take, takes what it is expected to refuse, or has
            another reason than expected.
    """
    reason, reasons = reason_of(engine, outcome), expected(engine, group, case)
    renew = f"if that is as it should be, renew its row: python -m tests.conformance.refusals {engine.name}"
    said = f"{engine.name}, {case.name}: {outcome.ending}, {outcome.reason}"
    assert (reason is not None) == bool(reasons), f"{said}; expected refusals: {sorted(reasons)}; {renew}"
    assert reason is None or reason in reasons, f"{said}; expected one of {sorted(reasons)}; {renew}"
    return reason is not None


def row_of(engine: Engine) -> dict[str, dict[str, list[str]]]:
    """What an engine refuses now, by running it."""
    row: dict[str, dict[str, list[str]]] = {}
    for group, cases in GROUPS.items():
        short = [Case(c.name, c.system, c.dt, c.steps if c.changes else 1, c.changes) for c in cases.values()]
        for case, outcome in zip(short, outcomes(engine, short), strict=True):
            reason = reason_of(engine, outcome)
            if reason is not None:
                row.setdefault(group, {}).setdefault(reason, []).append(case.name)
    return row


def written(table: Mapping[str, Row]) -> str:
    """The table as TOML, a line for each reason."""
    lines = []
    for engine, row in sorted(table.items()):
        lines += ["", f"[{engine}]"]
        for group, reasons in row.items():
            lines += [f"[{engine}.{group}]"]
            lines += [f"{json.dumps(reason)} = {json.dumps(names)}" for reason, names in reasons.items()]
    return HEADER + "\n".join(lines) + "\n"


def main(names: Iterable[str], file: Path = FILE) -> None:
    """Renew the rows of engines, all where none is named. Those that are not installed keep theirs.

    Raises:
        InputError: for an engine that is not known.
    """
    engines = [find(name) for name in names] or list(registry().values())
    rows = {engine.name: row_of(engine) for engine in engines if version(engine) is not None}
    kept = {name: row for name, row in read(file).items() if name in registry()}
    file.write_text(written({**kept, **rows}), encoding="utf-8")


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except InputError as error:
        print(f"refusals: {error}", file=sys.stderr)
        sys.exit(2)
