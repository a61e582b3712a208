"""What `springlab explain` derives of each engine, kept for its card: `python -m report.page.derived_formulas`.

To derive them takes seconds for every engine; they are kept with the version of the package that they were derived of,
and are shown beside that version only. The tests derive some again.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Any

from engines.engine import Engine, registry, version

#: Where they are kept, by engine: version, rows of the step matrix, the schemes with the same.
FILE = Path(__file__).with_suffix(".json")


def formulas_of(engine: Engine) -> Sequence[str]:
    """What is kept of an engine in the version that is installed: two lines and what their letters mean; or nothing."""
    known = _kept().get(engine.name)
    return known["lines"] if known is not None and known["version"] == version(engine) else ()


def derived_of(engine: Engine) -> dict[str, Any] | None:
    """The same, derived now: with the claimed schemes that have the same formulas. None where there are none."""
    from engines.process.isolation import EngineStepper
    from reference.derivation.explanation import Explanation
    from reference.derivation.oscillators import runs_of
    from reference.derivation.step_matrix import step_matrix
    from reference.errors import Unsupported
    from reference.identification import Identification
    from reference.stepper import stepper_named
    from report.derived import matrix_lines

    stepper = EngineStepper(engine)
    try:
        matrix = step_matrix(runs_of(stepper))
    except Unsupported:
        return None
    agree = []
    for claim in stepper.claims:
        try:
            same = step_matrix(runs_of(stepper_named(claim)))
        except Unsupported:
            continue
        at = same.samples
        b, d = at.b if matrix.damped else 0 * at.b, at.d if matrix.dragged else 0 * at.d
        off = abs(matrix.at(at.a, b, d) - same.at(at.a, b, d)).max()
        agree += [claim] if off < 1e-9 else []
    nameless = Identification(engine.name, (), 0.0)
    return {
        "version": stepper.version,
        "lines": matrix_lines(Explanation(engine.name, nameless, matrix=matrix)),
        "same_as": agree,
    }


@cache
def _kept() -> dict[str, Any]:
    found: dict[str, Any] = json.loads(FILE.read_text(encoding="utf-8"))
    return found


def main() -> None:
    """Derive them all, and keep them."""
    derived = {engine.name: derived_of(engine) for engine in registry().values() if version(engine) is not None}
    kept = {name: found for name, found in derived.items() if found is not None}
    FILE.write_text(json.dumps(kept, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
