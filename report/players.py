"""The page of findings on engines of games, `docs/players-springs.md`: made of runs, by `python -m report.players`.

Every number in it is predicted from the matrix of a step, or measured in a run of the engine, or of the scheme that it
is identified as, to the bit or to rounding.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path

import numpy as np

from engines.engine import find as engine_named
from engines.engine import registry
from engines.process.isolation import EngineStepper
from engines.translation.translation import Stepping, translations
from experiments.engine_versions.baseline import read
from experiments.engine_versions.changes import changes
from experiments.engine_versions.conformance import Value
from experiments.translation.free_spring import SPRING, STEPS, told
from experiments.translation.rows import fitting, forward
from reference.outcome import Outcome
from reference.scenes import find
from reference.stepper import stepper_named

PAGE = Path(__file__).parent / "docs" / "players-springs.md"

#: Sub-steps of XPBD in a step of a millisecond; how long the string swings [s].
SUBSTEPS, SWUNG = (1, 5, 20), 0.5

#: Steps of a small cloth [s], and for how long it is watched [s].
CLOTH_STEPS, WATCHED = (0.003, 0.0049, 0.006), 1.5
CLOTH_SCHEMES = (
    "kick_drift",
    "xpbd_jacobi",
    "xpbd_jacobi(iterations=10)",
    "soft_constraints_relaxed",
    "backward_euler",
)

#: Engines that take it: no damping, three dimensions.
CLOTH_ENGINES = (
    "newton_semi_implicit",
    "newton_xpbd",
    "newton_xpbd_10",
    "newton_vbd",
    "jolt_soft_body",
    "rapier_springs",
    "physx_joints",
    "drake_discrete",
)

#: Of which packages no two versions are kept, and why. `pip download --no-deps --only-binary :all: --python-version
#: 3.11 PACKAGE==VERSION` says whether there is a wheel.
NOT_TWO = {
    "box2d": "one: 2.3.2 has no wheel for Python 3.11, and needs SWIG to be built",
    "exudyn": "the lab's own version is tested each day",
    "pyPBD": "one: there is no other",
}


#: What is to be known beside the versions of others.
BESIDE = {
    "box2d-python": "both by Python 3.12, the only one that both have wheels for",
    "pybullet": "3.2.5 has no wheel for Python 3.11 and is compiled, 3.2.6 and 3.2.7 have",
}


def damping_table(measure: bool) -> list[list[str]]:
    """Of each engine and step: frequency [Hz] and damping ratio, predicted and measured."""
    rows = []
    for dt in STEPS:
        for translation in translations().values():
            (row,) = forward(SPRING, fitting(translation, Stepping(dt)), [translation], measure)
            rows.append([f"`{row.engine}`", f"1/{round(1 / dt)}", *_told(row.effective), *_told(row.measured)])
    return rows


def _told(found: tuple[float, float] | None) -> list[str]:
    """A spring's frequency and damping ratio, in words."""
    return ["-", "-"] if found is None else [*told(*found)]


def substep_table() -> list[list[str]]:
    """How far XPBD's string is from the true motion at the end [m], by sub-steps and precision."""
    system = find("string").system({})
    true = stepper_named("rk4").run(system, 1e-4, round(SWUNG / 1e-4)).trajectory
    assert true is not None
    rows = []
    for substeps in SUBSTEPS:
        cells = [str(substeps)]
        for single in (True, False):
            name = f"xpbd_gauss_seidel(substeps={substeps}, single={single})"
            run = stepper_named(name).run(system, 1e-3, round(SWUNG / 1e-3)).trajectory
            assert run is not None
            cells.append(f"{np.linalg.norm(run.positions[-1] - true.positions[-1], axis=1).max():.2g}")
        rows.append(cells)
    return rows


def cloth_table() -> list[list[str]]:
    """Which schemes hold a small cloth, pinned at an edge, at a step: "holds" or when it tears."""
    system = find("cloth").system({"rows": 4, "columns": 5, "pinned": "edge"})
    rows = []
    for name in CLOTH_SCHEMES:
        ends = [stepper_named(name).run(system, dt, round(WATCHED / dt)) for dt in CLOTH_STEPS]
        rows.append([f"`{name}`", *map(_ending, ends)])
    return rows


def _ending(outcome: Outcome) -> str:
    return "holds" if outcome.ending == "done" else "tears"


def markdown(columns: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A table."""
    lines = [columns, ["---"] * len(columns), *rows]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in lines) + "\n"


def engines_table(measure: bool) -> list[list[str]]:
    """The same of engines themselves, each in its version; of one that is not here nothing is known."""
    system = find("cloth").system({"rows": 4, "columns": 5, "pinned": "edge"})
    rows = []
    for name in CLOTH_ENGINES:
        stepper = EngineStepper(engine_named(name))
        if measure and stepper.version:
            ends = [_ending(stepper.run(system, dt, round(WATCHED / dt))) for dt in CLOTH_STEPS]
        else:
            ends = ["-"] * len(CLOTH_STEPS)
        rows.append([f"`{name}`", f"{stepper.engine.package} {stepper.version or '-'}", *ends])
    return rows


def versions_table() -> list[list[str]]:
    """Of each package the versions that are kept, and where an engine of it came to step otherwise."""
    rows = []
    for package in sorted({engine.package for engine in registry().values()}, key=str.lower):
        kept = read(package)
        told = [
            f"{new}: `{change.engine}`, {_case(change.measure)}: {_claim(change.before)}, then {_claim(change.after)}"
            for old, new in pairwise(kept)
            for change in changes(kept[old], kept[new])
            if change.measure.startswith(("identified", "runs", "4 Hz"))
        ]
        same = "the same scheme in all" if len(kept) > 1 else NOT_TWO[package]
        beside = [BESIDE[package]] if package in BESIDE else []
        rows.append([package, ", ".join(kept) or "-", "; ".join([*(told or [same]), *beside])])
    return rows


def _case(measure: str) -> str:
    """Of what it was identified on."""
    return (
        "whether it runs"
        if measure == "runs"
        else measure.removeprefix("identified, ").replace("plain", "undamped").replace("damping", "damped")
    )


def _claim(value: Value | None) -> str:
    """A scheme's name, or how a run ended, in a word."""
    words = str(value)
    if ": " in words or words == "yes":
        return words.partition(":")[0]
    return words if " Hz" in words else f"`{words}`"


def page(measure: bool) -> str:
    """The whole of it."""
    damping = markdown(
        ["engine", "dt [s]", "Hz, predicted", "damping ratio", "Hz, measured", "damping ratio"], damping_table(measure)
    )
    by_substeps, by_scheme = substep_table(), cloth_table()
    steps = [f"dt = {1000 * dt:g} ms" for dt in CLOTH_STEPS]
    return f"""# What a million players' springs do

Written by `python -m report.players` from runs; nothing here is typed by hand. Versions are those that
`springlab versions PACKAGE --install` makes, and those of the lab. `springlab versions --check` measures the first
table again in every version that is kept, and holds that the engines of the other tables still are their schemes.

## How much each engine damps by itself

1 kg on a spring of {SPRING.stiffness:.1f} N/m: 4 Hz, and no damping is asked for. `springlab translate --stiffness
{SPRING.stiffness:.6g} --mass 1 --dt 0.0166667` has what to type. What is not run here is predicted only.

{damping}
## Sub-steps and precision

The lecture's string after {SWUNG} s, by XPBD of one sweep in each sub-step, as Jolt's soft bodies do it: off the true
motion. In single precision velocities, (x - x0)/h, are as coarse as the last digit of a position over h.
{of_substeps(by_substeps)}

{markdown(["sub-steps of 1 ms", "off, single precision [m]", "off, double [m]"], by_substeps)}
## A small cloth

A cloth of 4 x 5 masses, pinned at an edge, watched for {WATCHED} s, by schemes. `xpbd_jacobi` is Newton's SolverXPBD to
the last bit; it sums the corrections of all springs at a mass. {of_cloth(by_scheme)}

{markdown(["scheme", *steps], by_scheme)}
Engines themselves, on the same cloth:

{markdown(["engine", "version", *steps], engines_table(measure))}
## What versions changed

The versions whose measurements are kept, and where an engine came to step otherwise. `springlab versions PACKAGE` has
the whole tables.

{markdown(["package", "versions", "scheme"], versions_table())}"""


def of_substeps(rows: Sequence[Sequence[str]]) -> str:
    """What more sub-steps did, in a sentence."""
    single, double = ([float(row[column]) for row in rows] for column in (1, 2))
    words = ["nearer to" if off[-1] < off[0] else "farther from" for off in (single, double)]
    return (
        f"With {SUBSTEPS[-1]} sub-steps in place of {SUBSTEPS[0]} it comes out {words[0]} the true motion in single "
        f"precision, and {words[1]} it in double."
    )


def of_cloth(rows: Sequence[Sequence[str]]) -> str:
    """Which schemes outlive which, in a sentence."""
    longest = {row[0]: sum(cell == "holds" for cell in row[1:]) for row in rows}
    explicit = longest["`kick_drift`"]
    torn = [name for name, held in longest.items() if held < explicit]
    if not torn:
        return "None of them tears where the explicit step holds."
    return f"The explicit step holds longer steps than {', '.join(torn)}."


if __name__ == "__main__":
    PAGE.write_text(page(measure=True), encoding="utf-8")
