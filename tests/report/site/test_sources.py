"""Pages that people write, laid together for the site: links lead where they led."""

from __future__ import annotations

from pathlib import Path, PurePosixPath

import pytest

from reference.errors import InputError
from report.site.sources import ROOT, moved, with_all, write_sources

PLACES = {
    ROOT / "README.md": PurePosixPath("readme.md"),
    ROOT / "report" / "docs" / "start.md": PurePosixPath("start.md"),
    ROOT / "report" / "docs" / "notebooks" / "first-look.ipynb": PurePosixPath("notebooks/first-look.ipynb"),
    ROOT / "report" / "pictures" / "found.svg": PurePosixPath("pictures/found.svg"),
}


@pytest.mark.parametrize(
    ("source", "text", "expected"),
    [
        ("README.md", "[a](report/docs/start.md#install)", "[a](start.md#install)"),
        ("README.md", "![a\nb](report/pictures/found.svg)", "![a\nb](pictures/found.svg)"),
        ("report/docs/start.md", "[a](../../README.md)", "[a](readme.md)"),
        ("report/docs/start.md", "[a](api.md)", "[a](api.md)"),
        ("report/docs/notebooks/first-look.ipynb", "[a](../start.md)", "[a](../start.md)"),
        ("README.md", "[the law](reference/springs/linear_law.py)", "the law (`reference/springs/linear_law.py`)"),
        ("README.md", "[a](#here) and [b](https://example.org)", "[a](#here) and [b](https://example.org)"),
    ],
)
def test_links_lead_where_they_led(source: str, text: str, expected: str) -> None:
    """To pages, pictures, pages that are made; what is no page is named."""
    file = ROOT / source
    assert moved(text, file, PLACES.get(file, PurePosixPath("other.md")), PLACES) == expected


def test_a_link_that_leads_nowhere_is_refused() -> None:
    """By the page it stands on."""
    with pytest.raises(InputError, match=r"^README.md: \(report/docs/strat.md\): expected a file that is there$"):
        moved("[a](report/docs/strat.md)", ROOT / "README.md", PurePosixPath("readme.md"), PLACES)


def test_a_page_that_nobody_lists_is_listed() -> None:
    """Behind the others of the reference; those that are listed, and notebooks, stay as they are."""
    places = [PurePosixPath(name) for name in ("index.md", "new.md", "start.md", "notebooks/x.md", "a.svg")]
    assert with_all("start\n\na-million-runs\n```", places) == "start\n\na-million-runs\nnew\n```"


def test_every_page_of_the_docs_is_on_the_site(tmp_path: Path) -> None:
    """And the project's own papers."""
    write_sources(tmp_path)
    pages = {file.name for file in (ROOT / "report" / "docs").rglob("*") if file.suffix in (".md", ".ipynb")}
    assert pages <= {file.name for file in tmp_path.rglob("*")}
    assert {"readme.md", "contributing.md", "changelog.md", "security.md"} <= {file.name for file in tmp_path.iterdir()}
