"""What `springlab explain` derives of each engine, kept for its card: `python -m report.page.derived_formulas`.

To derive them takes seconds for every engine; they are kept with the version of the package that they were derived of
and the day, and are shown beside that version only. Engines may be named; what is kept of others, and of those that are
not installed, stays. The tests derive some again.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from datetime import date
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from engines.engine import Engine, registry, version

if TYPE_CHECKING:
    from engines.process.isolation import EngineStepper
    from reference.derivation.step_matrix import StepMatrix

#: Where they are kept, by engine: version, day, rows of the step matrix, the schemes with the same; or why not.
FILE = Path(__file__).with_suffix(".json")

#: Entries of step matrices that are as near as this are the same.
SAME = 1e-9


def formulas_of(engine: Engine) -> Sequence[str]:
    """What is kept of an engine in the version that is installed: two lines and what their letters mean; or nothing."""
    known = _kept().get(engine.name)
    return known.get("lines", ()) if known is not None and known["version"] == version(engine) else ()


def derived_of(engine: Engine) -> dict[str, Any]:
    """The same, derived now: with the claimed schemes that have the same formulas, or why there are none."""
    from engines.process.isolation import EngineStepper
    from reference.derivation.explanation import Explanation
    from reference.derivation.oscillators import runs_of
    from reference.derivation.step_matrix import step_matrix
    from reference.errors import Unsupported
    from reference.identification import Identification
    from reference.identification.scale import precision_of
    from report.derived import matrix_lines

    stepper = EngineStepper(engine)
    kept = {"version": stepper.version, "on": date.today().isoformat()}
    try:
        matrix = step_matrix(runs_of(stepper), precision_of(stepper))
    except Unsupported as error:
        return {**kept, "reason": str(error), **_near(stepper)}
    nameless = Identification(engine.name, (), 0.0)
    lines = matrix_lines(Explanation(engine.name, nameless, matrix=matrix))
    return {**kept, "lines": lines, "same_as": [claim for claim in stepper.claims if _same(matrix, claim)]}


def _near(stepper: EngineStepper) -> dict[str, Any]:
    """How far the step matrices of an engine without formulas are from a claimed scheme's, where they were measured."""
    from reference.derivation.oscillators import FAR_ASIDE, FEW, one_by_one, runs_of, samples
    from reference.errors import Unsupported

    at = samples(False, False, FEW)
    try:
        measured = one_by_one(runs_of(stepper), at, aside=FAR_ASIDE)
    except Unsupported:
        return {}
    known = {claim: _matrix_of(claim) for claim in stepper.claims}
    far = {c: float(abs(measured - m.at(at.a, at.b, at.d)).max()) for c, m in known.items() if m is not None}
    claim = min(far, key=lambda c: far[c], default="")
    return {"near": claim, "within": f"{far[claim]:.1g}"} if claim else {}


def _matrix_of(claim: str) -> StepMatrix | None:
    """Of a claimed scheme, in double precision, as formulas are the same; None where it has none."""
    from reference.derivation.oscillators import runs_of
    from reference.derivation.step_matrix import step_matrix
    from reference.errors import Unsupported
    from reference.schemes import catalogue
    from reference.stepper import stepper_named

    single = "single=" in claim
    stepper = stepper_named(catalogue.find(claim).with_parameters(single=False).name if single else claim)
    try:
        return step_matrix(runs_of(stepper))
    except Unsupported:
        return None


def _same(matrix: StepMatrix, claim: str) -> bool:
    """Whether a claimed scheme has the same formulas, with the kinds of damping that the engine has."""
    same = _matrix_of(claim)
    if same is None:
        return False
    at = same.samples
    b, d = at.b if matrix.damped else 0 * at.b, at.d if matrix.dragged else 0 * at.d
    return bool(abs(matrix.at(at.a, b, d) - same.at(at.a, b, d)).max() < SAME)


@cache
def _kept() -> dict[str, Any]:
    found: dict[str, Any] = json.loads(FILE.read_text(encoding="utf-8"))
    return found


def main(names: Sequence[str]) -> None:
    """Derive them, and keep them. Of no names, of all that are installed."""
    here = [engine for engine in registry().values() if version(engine) is not None]
    derived = {engine.name: derived_of(engine) for engine in here if not names or engine.name in names}
    every = {**_kept(), **derived}
    kept = {name: every[name] for name in registry() if name in every}
    FILE.write_text(json.dumps(kept, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
