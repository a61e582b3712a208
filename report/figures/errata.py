"""Two of the remarks on the lecture's listings: what overwriting the state costs, and what the barrier's rule keeps."""

from __future__ import annotations

import numpy as np

from experiments.experiment import Result
from report.figures import TITLE, Picture, few_ticks, look, new_figure


def draw(result: Result) -> Picture:
    """Errors against dt on the left, the velocity kept around a circle on the right."""
    figure, (left, right) = new_figure(ncols=2, figsize=(11, 4.6))
    orders = result.data["orders"]
    for i, (name, (steps, errors, order)) in enumerate(orders.items()):
        left.loglog(steps, errors, label=f"{name}: order {order:.2f}", **look(i))
    left.set_xlabel("dt [s]")
    left.set_ylabel("error after 0.1 s [m]")
    left.set_title("Advanced link by link, Heun is of first order", loc="left", fontsize=TITLE)
    few_ticks(left)
    left.legend(loc="center left", bbox_to_anchor=(0, 0.42))
    angles, printed, projected = result.data["barrier"]
    right.plot(np.degrees(angles), projected, "-", color=look(2)["color"])
    right.plot(np.degrees(angles), printed, "--", color=look(1)["color"])
    right.axhline(0, color="#888888", linewidth=0.8)
    right.annotate("projected, v = (v.t) t", (0, 1), (4, 6), textcoords="offset points", color=look(2)["color"])
    right.annotate(
        "as printed, v = (v_x t_x, v_y t_y)", (0, -1), (16, -3), textcoords="offset points", color=look(1)["color"]
    )
    right.set_xticks([0, 90, 180, 270, 360], ["right", "top", "left", "bottom", "right"])
    right.set_ylim(-1.3, 1.3)
    right.set_xlabel("place on the circle")
    right.set_ylabel("velocity along it that is kept [m/s of 1 m/s]")
    right.set_title("The barrier's printed rule turns motion round on half the circle", loc="left", fontsize=TITLE)
    found = ", ".join(f"{name} {order:.2f}" for name, (_, _, order) in orders.items())
    return Picture(
        figure,
        f"Left: error against dt, with orders {found}. Right: of 1 m/s along a circle the projection keeps all, the "
        f"printed rule between {printed.min():.2g} and {printed.max():.2g} m/s.",
    )
