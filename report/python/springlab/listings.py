"""What there is: scenes, schemes, engines, experiments."""

from __future__ import annotations

from report.listings import engine_rows, experiment_rows, scene_rows, stepper_rows
from springlab.table import Table


def scenes() -> Table:
    """All scenes, with their parameters and defaults in SI units, and the lecture's slides they are on.

    >>> import springlab as lab
    >>> "cloth" in lab.scenes()["scene"]
    True
    """
    return Table.of(scene_rows())


def schemes() -> Table:
    """All schemes, right ones, engines' own and deliberately wrong ones, and the lecture's listings.

    >>> import springlab as lab
    >>> [row["what"] for row in lab.schemes() if row["stepper"] == "heun"][0].startswith("Heun")
    True
    """
    return Table.of(stepper_rows())


def engines() -> Table:
    """All engines, with their version or why they are not available, and the schemes they claim to step by.

    >>> import springlab as lab
    >>> "mujoco_tendons" in lab.engines()["engine"]
    True
    """
    return Table.of(engine_rows())


def experiments() -> Table:
    """The questions that `springlab report` answers.

    >>> import springlab as lab
    >>> "divergence" in lab.experiments()["experiment"]
    True
    """
    return Table.of(experiment_rows())
