"""The report written to a folder, by whichever runner is at work: of experiments, or of a user's own scene."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from experiments.experiment import NAMES, Experiment, find
from experiments.runs.progress import Progress
from experiments.runs.runner import current
from reference.files.setup import setup_for
from report.browser.beside import BESIDE, scenes_beside
from report.browser.lab_page import lab_page
from report.browser.presets import PRESETS
from report.page.page import page, scene_page
from report.page.section import Section
from report.page.sections import all_sections, scene_sections

#: The lab in a browser, beside the page.
LAB = "lab.html"


@dataclass(frozen=True)
class Written:
    """A page, its file, and what is on it."""

    file: Path
    sections: Sequence[Section]


def write_page(
    names: Sequence[str], folder: Path, store: Path, progress: Progress, *, fresh: bool = False, full: bool = False
) -> Written:
    """The page of experiments, and the lab in a browser beside it, in states that show them.

    Args:
        names: of which; without any those that belong in the report, in full all.
        fresh: whether sections that are in the store are made again.
        full: finer maps and more numbers, where an experiment has them.

    Raises:
        InputError: for an unknown name. OSError, StoreError: where results cannot be kept.
    """
    wanted = _wanted(names, full)
    folder.mkdir(parents=True, exist_ok=True)
    lab = LAB if any(experiment.name in BESIDE for experiment in wanted) else ""
    with current().threads(1) as beside:
        written = beside.submit(_write_lab, folder / lab) if lab else None
        sections = all_sections(wanted, folder, progress, store, fresh=fresh, full=full)
        if written is not None:
            written.result()
    return _written(folder, page(sections, lab), sections)


def _write_lab(file: Path) -> None:
    """The lab in a browser, in states that show the experiments; while these run in processes of their own."""
    presets = [preset for preset in PRESETS if (preset.name or preset.scene) in scenes_beside()]
    file.write_text(lab_page(presets), encoding="utf-8")


def write_scene_page(scene: str, folder: Path, progress: Progress) -> Written:
    """The page of a scene, by name or TOML file: which dt to use. Raises InputError as `setup_for` does, OSError."""
    setup = setup_for(scene)
    folder.mkdir(parents=True, exist_ok=True)
    sections = scene_sections(setup, f"springlab report {scene}", folder, progress)
    return _written(folder, scene_page(setup.name, sections), sections)


def _wanted(names: Sequence[str], full: bool) -> list[Experiment]:
    wanted = [find(name) for name in dict.fromkeys(names or NAMES)]
    return wanted if names or full else [experiment for experiment in wanted if experiment.in_report]


def _written(folder: Path, html: str, sections: Sequence[Section]) -> Written:
    file = folder / "index.html"
    file.write_text(html, encoding="utf-8")
    return Written(file, sections)
