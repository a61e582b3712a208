"""Results made for the purpose, so that figures and pages can be made of them at once."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np

from engines.process.isolation import EngineStepper
from experiments import divergence, drape, scenes
from experiments.experiment import Result, Table
from experiments.runs.comparison import compare
from reference.identification import Identification
from reference.outcome import Outcome
from reference.scenes import Setup, find
from reference.scenes.drape import disc
from reference.stepper import Stepper, catalogued
from tests.conformance.doctored import Doctored, StifferByAMillionth
from tests.engines.process.misbehaving import Misbehaving, Segfaults, Still

SETUP = Setup("string", find("string").system({"masses": 3}), 1e-3, 0.02)


def of(*steppers: Stepper) -> Result:
    """The divergence experiment's answer for some steppers."""
    return divergence.result_of(compare(SETUP, steppers))


def engines_that_run() -> Result:
    """One identified, one not, one that crashed."""
    return of(*(EngineStepper(e) for e in (Doctored(), Doctored(StifferByAMillionth), Misbehaving(Segfaults))))


def no_engine_installed() -> Result:
    """All unsupported."""
    return of(*(EngineStepper(Misbehaving(kind, package="no-such-engine")) for kind in (Still, Segfaults)))


def stiff_limit(cable: float | None) -> Result:
    """Distances as they should be, with or without the engine's."""
    rows = [[k, 100 / k, None if cable is None else cable / k] for k in (2e2, 2e3, 2e4, 2e5, 2e6)]
    table = Table("stiff_limit", ["stiffness [N/m]", "string to pendulum [m]", "string to cable [m]"], rows)
    return Result(["It falls as 1/k."], [table], {"rows": rows, "slope": -1.0, "cable_error": cable})


def errata() -> Result:
    """Orders and the barrier's two rules."""
    steps = [1e-3, 5e-4]
    orders = {"heun": (steps, [4e-6, 1e-6], 2.0), "heun_aliased": (steps, [2e-3, 1e-3], 1.0)}
    angles = np.linspace(0, 2 * math.pi, 9)
    table = Table("errata", ["slide", "order"], [["7", 2.0], ["11", 1.0]])
    return Result(["One < two."], [table], {"orders": orders, "barrier": (angles, -np.cos(2 * angles), np.ones(9))})


def all_scenes(*names: str) -> Result:
    """Some scenes with a crash, and how they move."""
    found = {name: find(name) for name in names}
    systems = {name: scene.system({}) for name, scene in found.items()}
    stepper = EngineStepper(Misbehaving(Segfaults))
    nothing, crash = Identification("Segfaults", (), 1e-12, "it crashed"), Outcome("crashed", "killed by SIGSEGV")
    runs = [scenes.Run(found[name], systems[name], stepper, crash, nothing, 200) for name in names]
    motions = {}
    for name, system in systems.items():
        outcome = catalogued()["heun"].run(system, found[name].dt, 20)
        motions[name] = (system, outcome.trajectory)
    return scenes.result_of(runs, motions)  # type: ignore[arg-type]


def draped(engine: bool) -> Result:
    """Flat cloths with six folds in their shadows, one of them in an engine or not."""
    turn = np.linspace(-math.pi, math.pi, drape.DIRECTIONS, endpoint=False)
    cases = [("kick_drift", c, drape.SPACING) for c in drape.LENGTHS]
    cases += [("kick_drift", 0.017, drape.COARSE)] + [("an_engine", 0.017, drape.COARSE)] * engine
    cloths = [
        {"by": by, "length": c, "spacing": spacing, "sample": 0, "coefficient": 10 * c, "time": 1.0}
        | {"positions": disc(drape.RADIUS, spacing).positions, "outline": 0.12 + 0.01 * np.cos(6 * turn)}
        for by, c, spacing in cases
    ]
    return Result(["Stiffer cloth drapes less."], [drape._table(cloths)], {"cloths": cloths})


#: By experiment, results to draw: as usual, and with what is missing.
RESULTS: Mapping[str, Mapping[str, Callable[[], Result]]] = {
    "divergence": {"usual": engines_that_run, "no engine": no_engine_installed, "nobody": lambda: of()},
    "stiff_limit": {"usual": lambda: stiff_limit(100.0), "no engine": lambda: stiff_limit(None)},
    "errata": {"usual": errata},
    "scenes": {"usual": lambda: all_scenes("string", "barrier", "cloth"), "no scene": lambda: all_scenes()},
    "drape": {"usual": lambda: draped(True), "no engine": lambda: draped(False)},
}
