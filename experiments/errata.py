"""What do the lecture's listings do, run as they are printed?

The lecture teaches the right things, and most of its listings do what it says. Where one does not, a student who types
it in deserves to know. Each remark here is executed, and carries the number that shows it.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from experiments.experiment import Experiment, Result, Table
from experiments.runs.progress import Progress
from reference.identification import identify
from reference.lecture.listings import Links, StringConstants, derivatives, force_from_next, listings
from reference.lecture.slide_17 import CircleAsMeant, CircleAsPrinted
from reference.limit import Limit
from reference.scenes import find
from reference.schemes import catalogue
from reference.simulate import simulate
from reference.state import Array
from reference.theory.equilibria import spring_equilibrium
from reference.theory.equilibrium import hanging_string
from reference.theory.exact import exact
from reference.theory.limits import stability_limit

#: The step of the order measurement [s], halved twice.
DT, DURATION = 1e-3, 0.1

Remark = tuple[str, str, str, float, str]


def run(progress: Progress) -> Result:
    """Every remark, executed."""
    progress("slide 11")
    orders = _orders(progress)
    barrier = _barrier()
    remarks = [
        *_incorrect_listing(),
        *_in_place_variants(orders, progress),
        *_barrier_remarks(),
        *_next_spring(),
        *_derivative_listing(),
    ]
    return result_of(remarks, orders, barrier)


def result_of(
    remarks: list[Remark],
    orders: Mapping[str, tuple[list[float], list[float], float]],
    barrier: tuple[Array, Array, Array],
) -> Result:
    """Remarks as findings and a table.

    Args:
        orders: what the figure draws on the left: by scheme, steps [s], errors [m], and the order.
        barrier: what it draws on the right: angles [rad], and what printed and projected rule leave of 1 m/s.
    """
    columns = ["slide", "as printed", "measured", "value", "unit"]
    return Result(_findings(remarks), [Table("errata", columns, remarks)], {"orders": orders, "barrier": barrier})


def _findings(remarks: list[Remark]) -> list[str]:
    value = {measured: number for _, _, measured, number, _ in remarks}
    apart = value["distance from slide 7, 500 steps"]
    wrong, right = value["order of heun_link_by_link"], value["order of heun"]
    stable = [value.get(f"largest stable dt, {name}") for name in ("heun_link_by_link", "heun")]
    longer = ""
    if stable[0] and stable[1]:
        longer = f" It is also stable up to {stable[0] / stable[1]:.2f} times the dt: stable is not accurate."
    return [
        f"Slide 11's listing is better than its heading: run as printed it is {apart:g} m from slide 7's. Each of "
        "its loops reads one array and writes another.",
        f"What the slide warns of is real: Heun link by link has order {wrong:.2f} where Heun has {right:.2f}.{longer}",
        "Slide 17 multiplies components where a projection is meant, slide 4's force from the next node has the sign "
        "of D0 turned, and slide 9's function closes after its first spring; each has a one-line remedy.",
    ]


def _incorrect_listing() -> list[Remark]:
    """Slide 11 against slide 7 and against the catalogue."""
    string = find("string")
    system, dt, steps = string.system({"drag": 0.02}), 1e-3, 500
    printed, meant = (listings()[f"lecture_heun_{name}"] for name in ("incorrect", "loops"))
    both = [listing.run(system, dt, steps).trajectory for listing in (printed, meant)]
    assert both[0] is not None
    assert both[1] is not None
    what = "the listing headed incorrect"
    found = identify(printed, system, dt, steps)
    return [
        ("11", what, "distance from slide 7, 500 steps", float(both[0].distance(both[1]).max()), "m"),
        ("11", what, f"distance from the scheme it is identified as, {found.identified_as}", found.error, "m"),
    ]


def _orders(progress: Progress) -> dict[str, tuple[list[float], list[float], float]]:
    """Of right and wrong schemes: steps [s], errors [m], and the order that the two smallest steps show."""
    system = find("string").system({"drag": 0.02})
    true = exact(system, DT, round(DURATION / DT))
    orders = {}
    for name in ("euler", "euler_in_place", "heun", "heun_link_by_link", "heun_aliased"):
        progress(f"order of {name}")
        runs = {f: simulate(system, catalogue.find(name), DT / f, DURATION).positions[::f] for f in (1, 2, 4, 8)}
        errors = [float(np.linalg.norm(x - true.positions, axis=2).max()) for x in runs.values()]
        orders[name] = ([DT / f for f in runs], errors, float(np.log2(errors[-2] / errors[-1])))
    return orders


def _in_place_variants(orders: dict[str, tuple[list[float], list[float], float]], progress: Progress) -> list[Remark]:
    """What is wrong with truly overwriting the state: order, and (at a price) stability."""
    slack = find("string").system({"stiffness": 50.0, "drag": 0.2})
    rest = spring_equilibrium(slack)
    what = "the whole state, not link by link"
    rows: list[Remark] = []
    for name, (_, _, order) in orders.items():
        progress(f"stability of {name}")
        rows.append(("7-11", what, f"order of {name}", order, ""))
        rows.append(("7-11", what, *stability_remark(name, stability_limit(catalogue.find(name), rest))))
    return rows


def stability_remark(name: str, limit: Limit) -> tuple[str, float, str]:
    """What is said of a scheme's limit, its value and unit; where it has none, how much grows in a step."""
    if limit.dt is not None:
        return f"largest stable dt, {name}", limit.dt, "s"
    return f"growth in a step of {name}, {limit.reason}", limit.growth or 0.0, "1"


def _barrier() -> tuple[Array, Array, Array]:
    """Around a circle: the angle [rad], and what printed and projected rule leave of 1 m/s along it."""
    printed_circle, circle = CircleAsPrinted((0.0, 0.0), 1.0), CircleAsMeant((0.0, 0.0), 1.0)
    angles = np.radians(np.arange(0, 361, 5.0))
    normal = np.column_stack([np.cos(angles), np.sin(angles)])
    sliding = np.column_stack([-np.sin(angles), np.cos(angles)])
    _, printed = printed_circle.projected(0.9 * normal, sliding)
    _, projected = circle.projected(0.9 * normal, sliding)
    return angles, (printed * sliding).sum(axis=1), (projected * sliding).sum(axis=1)


def _barrier_remarks() -> list[Remark]:
    """Slide 17's rule on masses that slide along a circle, and so should keep their velocity."""
    _, printed, projected = _barrier()
    what = "v_x *= t_x, v_y *= t_y keeps the tangential velocity"
    places = {"at the right": printed[0], "half-way up": printed[9], "at the top": printed[18]}
    rows = [("17", what, f"of 1 m/s along the circle, left {place}", float(v), "m/s") for place, v in places.items()]
    return [*rows, ("17", "meant: v = (v.t) t", "of 1 m/s, left anywhere", float(projected.min()), "m/s")]


def _next_spring() -> list[Remark]:
    """Slide 4's force from the next node, on a string at its rest lengths, where all forces are zero."""
    k, length = 200.0, 0.125
    y = [0.0, -length, -2 * length]
    what = "F = k (Y_next - Y - D0)"
    return [
        ("4", what, "force at rest", force_from_next(y, 1, k, length, printed=True), "N"),
        (
            "4",
            "meant: F = k (Y_next - Y + D0)",
            "force at rest, repaired",
            force_from_next(y, 1, k, length, printed=False),
            "N",
        ),
    ]


def _derivative_listing() -> list[Remark]:
    """Slide 9's function as far as its first closing brace, on a string that hangs at rest."""
    system = find("string").system({"angle": 90})
    rest = hanging_string(system)
    links = Links(*rest.positions[1:].T.tolist(), *rest.velocities[1:].T.tolist())
    string = StringConstants.of(system)
    cut, whole = (derivatives(links, 0, string, next_spring=both)[3] for both in (False, True))
    return [
        (
            "9",
            "the function closes after the first spring",
            "acceleration of the top link, hanging at rest",
            cut,
            "m/s^2",
        ),
        ("9-10", "meant: both springs in one function", "acceleration of the top link, repaired", whole, "m/s^2"),
    ]


EXPERIMENT = Experiment(
    name="errata",
    title="The lecture's listings, executed",
    question="What do the lecture's listings do, run as they are printed?",
    slides="4, 7-11, 17",
    run=run,
)
