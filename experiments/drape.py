"""How much does a fabric drape, the stiffer it is?

The test of textile laboratories (Cusick 1965; BS 5058; ISO 9073-9): a round cloth of 30 cm lies on a disc of 18 cm and
falls into folds around it. Light from above: of the ring of cloth outside the disc the drape coefficient is the part
that the shadow still covers,

    DC = (shadow - disc) / (cloth - disc),

areas all. Stiffness is the bending length c, whose third power is rigidity over weight (`reference.scenes.drape`).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cache
from itertools import pairwise
from math import pi, sqrt
from typing import Any

import numpy as np

from engines.engine import Engine, demands, registry, version
from engines.process.worker import FOR_SCHEMES, import_beforehand
from experiments.experiment import Experiment, Result, Table
from experiments.runs.progress import Progress
from experiments.runs.runner import answer, current
from reference.outcome import Outcome
from reference.scenes import find
from reference.scenes.drape import STANDARD_GRAVITY, disc
from reference.state import Array
from reference.system import IntArray, MassSpringSystem

RADIUS, SUPPORT, DENSITY = 0.15, 0.09, 0.2

#: Bending lengths [m]: rigidities over three decades.
LENGTHS = (0.005, 0.01, 0.017, 0.025, 0.036, 0.05)

#: Spacings of the masses [m]: of all cloths; of some more, to see what it matters; and of those that engines get.
SPACING, OTHERS, COARSE = 0.0075, (0.012,), 0.02

#: The bending lengths [m] of those.
OTHER_LENGTHS, ENGINE_LENGTHS = (0.017,), (0.017,)

#: Pieces that are cut for each bending length.
SAMPLES = 2

#: Of the links [N/m]: a hanging edge stretches them by some thousandths.
STIFFNESS = 30.0

#: Drag over mass [1/s]: a pendulum as long as the overhang comes to rest without swinging.
RATE = 20.0

#: Masses are at rest below this mean speed [m/s], the root of the mean square; looked at as often [s], for no longer
#: than that [s].
AT_REST, LOOK, PATIENCE = 1e-3, 0.25, 1.5

#: A wave of an outline that is smaller [m] is no fold.
FLAT = 1e-3

#: In how many directions an outline is measured.
DIRECTIONS = 720


def cloth(bending_length: float, spacing: float, sample: int) -> tuple[MassSpringSystem, float]:
    """The scene `drape` and a step [s] that is stable for it, four fifths of what its stiffest springs allow."""
    settings = {"radius": RADIUS, "support": SUPPORT, "density": DENSITY, "stiffness": STIFFNESS}
    mass = DENSITY * spacing**2 * sqrt(3) / 2
    system = find("drape").system(
        {**settings, "bending_length": bending_length, "spacing": spacing, "sample": sample, "drag": RATE * mass}
    )
    # by Gershgorin: w^2 <= 2 (sum of k of the springs at a mass) / m
    at_masses = np.bincount(system.springs.ravel(), np.repeat(system.stiffness, 2))
    return system, float(0.8 * 2 / np.sqrt(2 * at_masses.max() / mass))


def hung(bending_length: float, spacing: float, sample: int) -> dict[str, Any]:
    """A cloth that has come to rest, or PATIENCE later: its positions (n, 3) [m], when, how fast still, its shadow."""
    from reference.compiled.kernels import Kernel
    from reference.schemes.catalogue import find as find_scheme

    system, dt = cloth(bending_length, spacing, sample)
    kernel = Kernel(system, find_scheme("kick_drift"))
    return _at_rest(lambda: kernel.advance(dt, round(LOOK / dt)), kernel.state, spacing, sample)


def hung_in(engine: Engine, bending_length: float, spacing: float, sample: int) -> dict[str, Any]:
    """The same in an engine, looked at as often."""
    system, dt = cloth(bending_length, spacing, sample)
    simulation = engine.start(system, dt)

    def advance() -> None:
        for _ in range(round(LOOK / dt)):
            simulation.step()

    return _at_rest(advance, simulation.state, spacing, sample)


def _at_rest(
    advance: Callable[[], object], state: Callable[[], tuple[Array, Array]], spacing: float, sample: int
) -> dict[str, Any]:
    """Advance by LOOK again and again until masses are slower than AT_REST in the mean, or for PATIENCE."""
    time, speed = 0.0, np.inf
    while time < PATIENCE and speed >= AT_REST:
        advance()
        time += LOOK
        speed = float(np.sqrt((state()[1] ** 2).sum(axis=1).mean()))
    positions = state()[0]
    fallen = shadow(positions, disc(RADIUS, spacing, sample).triangles, flat_area(spacing, sample))
    return {"positions": positions, "time": time, "speed": speed, **fallen}


@cache
def flat_area(spacing: float, sample: int) -> float:
    """What a cloth covers before it falls [m^2], however stiff it is."""
    system, _ = cloth(LENGTHS[0], spacing, sample)
    return float(covered(system.positions, disc(RADIUS, spacing, sample).triangles).area)


def shadow(positions: Array, triangles: IntArray, flat: float) -> dict[str, Any]:
    """The drape coefficient, and how far the shadow reaches in each of DIRECTIONS [m].

    Args:
        flat: what the cloth covers before it falls [m^2].
    """
    fallen = covered(positions, triangles)
    inner = pi * SUPPORT**2
    edge = np.concatenate([np.array(part.exterior.coords) for part in getattr(fallen, "geoms", [fallen])])
    angles, reach = np.arctan2(edge[:, 1], edge[:, 0]), np.hypot(edge[:, 0], edge[:, 1])
    order = np.argsort(angles, kind="stable")
    round_about = np.linspace(-pi, pi, DIRECTIONS, endpoint=False)
    outline = np.interp(round_about, angles[order], reach[order], period=2 * pi)
    return {"coefficient": float((fallen.area - inner) / (flat - inner)), "outline": outline}


def covered(positions: Array, triangles: IntArray) -> Any:
    """What triangles cover, seen from above, each place once: a polygon of Shapely's, or several."""
    import shapely

    corners = positions[triangles][:, :, [0, 2]]
    return shapely.union_all(shapely.polygons(corners), grid_size=1e-7)


def folds(outline: Array) -> tuple[int, float]:
    """How many waves of an outline are the largest in it, and their amplitude [m]; none below FLAT."""
    amplitudes = np.abs(np.fft.rfft(outline)) * 2 / len(outline)
    count = int(np.argmax(amplitudes[2:])) + 2
    return count if amplitudes[count] > FLAT else 0, float(amplitudes[count])


def able(system: MassSpringSystem) -> list[Engine]:
    """Of each package that is installed the first engine that can do all that a system asks."""
    found: dict[str, Engine] = {}
    for engine in registry().values():
        if set(demands(system)) <= engine.capabilities and version(engine) is not None:
            found.setdefault(engine.package, engine)
    return list(found.values())


def run(progress: Progress) -> Result:
    """All cloths, beside one another as the cores allow."""
    import_beforehand(FOR_SCHEMES)
    cases: list[tuple[Any, ...]] = [(hung, c, SPACING, i) for c in LENGTHS for i in range(SAMPLES)]
    cases += [(hung, c, a, i) for c in OTHER_LENGTHS for a in OTHERS for i in range(SAMPLES)]
    cases += [(hung, c, COARSE, 0) for c in ENGINE_LENGTHS]
    engines = able(cloth(ENGINE_LENGTHS[0], COARSE, 0)[0])
    cases += [(hung_in, engine, c, COARSE, 0) for engine in engines for c in ENGINE_LENGTHS]

    def done(case: tuple[Any, ...]) -> Any:
        progress(" ".join(str(getattr(what, "name", what)) for what in case[1:]))
        return answer(*case)

    with current().threads() as pool:
        answers = list(pool.map(done, cases))
    cloths: list[dict[str, Any]] = []
    failures = []
    for case, found in zip(cases, answers, strict=True):
        *by, c, spacing, sample = case[1:]
        name = by[0].name if by else "kick_drift"
        if isinstance(found, Outcome):
            failures.append(f"{name}, bending length {c:g} m: {found.ending}, {found.reason}")
            continue
        cloths.append({"by": name, "length": c, "spacing": spacing, "sample": sample, **found})
    return result_of(cloths, failures)


def result_of(cloths: Sequence[Mapping[str, Any]], failures: Sequence[str] = ()) -> Result:
    """Cloths, each with what `hung` says of it and what it is, as findings and a table."""
    return Result(_findings(cloths), [_table(cloths)], {"cloths": cloths}, failures)


def rows_of(cloths: Sequence[Mapping[str, Any]], spacing: float) -> list[tuple[float, float, float]]:
    """By bending length [m]: the mean drape coefficient of the reference's samples, and half their spread."""
    rows = []
    for c in sorted({one["length"] for one in cloths}):
        found = [
            one["coefficient"]
            for one in cloths
            if (one["by"], one["length"], one["spacing"]) == ("kick_drift", c, spacing)
        ]
        if found:
            rows.append((c, float(np.mean(found)), float(np.ptp(found)) / 2))
    return rows


def _table(cloths: Sequence[Mapping[str, Any]]) -> Table:
    columns = ["stepper", "bending length [m]", "rigidity [N m]", "spacing [m]", "sample", "drape coefficient [1]"]
    columns += ["folds", "their amplitude [m]", "looked at after [s]", "mean speed then [m/s]"]
    rows = []
    for one in cloths:
        rigidity = DENSITY * STANDARD_GRAVITY * one["length"] ** 3
        known = [one["by"], one["length"], rigidity, one["spacing"], one["sample"], one["coefficient"]]
        rows.append([*known, *folds(one["outline"]), one["time"], one["speed"]])
    return Table("drape", columns, rows)


def _findings(cloths: Sequence[Mapping[str, Any]]) -> list[str]:
    rows = rows_of(cloths, SPACING)
    if not rows:
        return [f"No cloth of {1e3 * SPACING:g} mm between masses came to an end."]
    (limp, low, _), (stiff, high, _) = rows[0], rows[-1]
    falls = sum(after < before for (_, before, _), (_, after, _) in pairwise(rows))
    scatter = max(spread for _, _, spread in rows)
    always = "at every step between" if not falls else f"but for {falls} of {len(rows) - 1} steps between"
    sentences = [
        f"The drape coefficient rises from {low:.2f} to {high:.2f} as the bending length does from {1e3 * limp:g} to "
        f"{1e3 * stiff:g} mm, {always}; pieces cut of the same cloth differ by up to {2 * scatter:.2f}."
    ]
    sentences.append(_of_folds([folds(one["outline"])[0] for one in cloths if one["spacing"] == SPACING]))
    moving = [one for one in cloths if one["speed"] >= AT_REST]
    if moving:
        sentences.append(
            f"{len(moving)} of {len(cloths)} cloths still move after {PATIENCE:g} s, the most at "
            f"{1e3 * max(one['speed'] for one in moving):.2g} mm/s in the mean; a cloth counts as at rest below "
            f"{1e3 * AT_REST:g} mm/s."
        )
    for c in OTHER_LENGTHS:
        means = {a: {row[0]: row[1] for row in rows_of(cloths, a)}.get(c) for a in (*OTHERS, SPACING)}
        said = ", ".join(f"{mean:.2f} at {1e3 * a:g} mm" for a, mean in sorted(means.items()) if mean is not None)
        sentences.append(f"The mesh matters: at a bending length of {1e3 * c:g} mm it is {said} between masses.")
    own = {
        one["length"]: one["coefficient"] for one in cloths if one["spacing"] == COARSE and one["by"] == "kick_drift"
    }
    apart: dict[str, float] = {}
    for one in cloths:
        if one["by"] != "kick_drift" and one["length"] in own:
            by = one["by"]
            apart[by] = max(apart.get(by, 0.0), abs(one["coefficient"] - own[one["length"]]))
    if apart:
        said = ", ".join(f"{name} by {distance:.1e}" for name, distance in apart.items())
        sentences.append(f"Engines on the same cloths of {1e3 * COARSE:g} mm differ from the reference: {said}.")
    return sentences


def _of_folds(counts: Sequence[int]) -> str:
    """How many folds there are, and on how many cloths there are none."""
    flat, folded = counts.count(0), sorted(set(counts) - {0})
    amount = f"{folded[0]} to {folded[-1]} folds" if folded else "no folds"
    but = f", and none on {flat} of {len(counts)} cloths, whose waves are all below {1e3 * FLAT:g} mm" if flat else ""
    return f"There are {amount} by the largest wave in the outline of the shadow{but if folded else ''}."


EXPERIMENT = Experiment(
    name="drape",
    title="The drape of a fabric",
    question="How much does a round cloth on a smaller disc drape, the stiffer it is?",
    slides="18-22",
    run=run,
)
