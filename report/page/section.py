"""One section of the report: an experiment's answer with its figure and tables, or why there is none."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from experiments.experiment import Experiment, Result


@dataclass(frozen=True)
class Section:
    """One experiment on the page: its answer, or why there is none.

    Attributes:
        experiment: what was asked.
        result: the answer; None where it failed.
        svg: the figure.
        alt: the words that stand for the figure where it cannot be seen.
        downloads: names of files, each with a link that carries the file.
        failure: why there is no answer; empty where there is one.
        full: whether it was run in full.
        made_by: its command, where that is not the experiment's own.
        motions: its animations, as HTML.
    """

    experiment: Experiment
    result: Result | None = None
    svg: str = ""
    alt: str = ""
    downloads: Sequence[tuple[str, str]] = ()
    failure: str = ""
    full: bool = False
    made_by: str = ""
    motions: str = ""

    @property
    def command(self) -> str:
        """What makes its figure and tables."""
        if self.made_by:
            return self.made_by
        name = self.experiment.name
        return f"springlab report --only {name} --full" if self.full else f"springlab run {name}"
