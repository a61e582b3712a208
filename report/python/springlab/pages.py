"""The report as a page: of the lab's questions, or of a scene of one's own."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import closing
from dataclasses import dataclass
from html import escape
from pathlib import Path


@dataclass(frozen=True)
class Page:
    """A page that was written.

    Attributes:
        path: its file, which needs no other.
        findings: what it says first.
    """

    path: Path
    findings: tuple[str, ...]

    def _repr_html_(self) -> str:
        said = "".join(f"<p>{escape(finding)}</p>" for finding in self.findings)
        return f'{said}<p><a href="{escape(str(self.path))}">{escape(str(self.path))}</a></p>'


def report(
    scene: str | Path | None = None,
    *,
    only: Sequence[str] = (),
    out: str | Path = "results/report",
    fresh: bool = False,
) -> Page:
    """Write a page: which dt to use for a scene in each engine; or without a scene, what experiments found.

    What was run before is taken from the store beside the page's folder, as `springlab report` does.

    Args:
        scene: a name or a TOML file.
        only: names of experiments; all that belong in the report where left out, which takes minutes.
        out: the folder.
        fresh: whether to start over; nothing is deleted.

    Raises:
        InputError: naming what makes no sense, and what was expected.
        OSError: where it cannot be written.
    """
    from experiments.runs.runner import LocalExecutor, Runner, using
    from experiments.runs.store import Store
    from report.page.written import write_page, write_scene_page

    folder = Path(out)
    store = folder.parent / "store.sqlite"
    with closing(Store(store)) as kept, using(Runner(LocalExecutor(), kept, fresh)):
        if scene is not None:
            written = write_scene_page(str(scene), folder, _silent)
        else:
            written = write_page(only, folder, store, _silent, fresh=fresh)
    findings = (finding for section in written.sections if section.result for finding in section.result.findings[:1])
    return Page(written.file, tuple(findings))


def _silent(_: str) -> None:
    """Progress is told nobody."""
