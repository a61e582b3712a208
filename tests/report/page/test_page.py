"""The report: one page that needs nothing else, with every experiment's answer, or why there is none."""

from __future__ import annotations

import base64
import platform
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from importlib import metadata
from itertools import pairwise
from pathlib import Path

import pytest

from experiments.experiment import NAMES, find
from experiments.runs.results import rows
from report.page.inline_svg import inline
from tests.report.commands.terminal import Said, springlab
from tests.report.html import Page, check_self_contained, page_of
from tests.report.page.canned import RESULTS
from tests.report.page.doubles import answering, failing, put

#: The sections after the experiments'.
CLOSING = ["schemes", "engines", "undone", "environment"]

#: The experiments the page is made of here, in the order of the report.
SHOWN = [name for name in NAMES if name in RESULTS]


@dataclass(frozen=True)
class Report:
    """What `springlab report` said and left."""

    said: Said
    folder: Path

    @property
    def html(self) -> str:
        """The page."""
        return (self.folder / "index.html").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def report(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Report]:
    """A report on the experiments that have canned results."""
    folder = tmp_path_factory.mktemp("report") / "new"
    with pytest.MonkeyPatch.context() as patch:
        put(patch, *(answering(name, RESULTS[name]["usual"]()) for name in SHOWN))
        yield Report(springlab("report", *(f"--only={name}" for name in SHOWN), "--out", str(folder)), folder)


@pytest.mark.rotating(5, in_turn=True)
def test_the_report_succeeds_and_says_where_it_is(report: Report) -> None:
    """With the first finding of every experiment."""
    assert (report.said.code, report.said.err) == (0, "")
    assert f"written: {report.folder / 'index.html'}" in report.said.out
    for name in SHOWN:
        assert f"{find(name).title}: " in report.said.out


@pytest.mark.rotating(4, in_turn=True)
def test_the_page_asks_for_nothing(report: Report) -> None:
    """No src, href or url() leads anywhere but into the page."""
    check_self_contained(report.html)


@pytest.mark.rotating(3)
@pytest.mark.parametrize(
    "asks",
    [
        '<img src="https://example.org/a.png">',
        '<a href="other.html">elsewhere</a>',
        '<p style="background: url(a.png)">',
        "<style>@import 'a.css';</style>",
        "<style>p { background: url('//example.org/a.png') }</style>",
        "<script>fetch('https://example.org')</script>",
        '<script src="a.js"></script>',
        '<link rel="stylesheet" href="#">',
        '<svg><image xlink:href="a.png"/></svg>',
        '<svg><path fill="url(a.svg#b)"/></svg>',
        '<meta http-equiv="refresh" content="0">',
    ],
)
def test_a_page_that_asks_for_something_is_caught(report: Report, asks: str) -> None:
    """Shown to fail, on the same page with one thing more."""
    with pytest.raises(AssertionError):
        check_self_contained(report.html.replace("</main>", f"{asks}</main>"))


def test_there_is_a_section_for_every_experiment_with_question_and_findings(report: Report) -> None:
    """In order, and each is linked to at the top of the page."""
    shown = page_of(report.html)
    sections = [attributes["id"] for attributes in shown.of("section")]
    assert sections == ["found", *SHOWN, *CLOSING]
    skip, *contents = [address for address in shown.attributes("href") if address[0] == "#"][: len(sections) + 1]
    assert skip == "#found"
    assert contents == [f"#{name}" for name in sections]
    for name in SHOWN:
        assert find(name).question in shown.words
        assert find(name).title in shown.words


def test_every_figure_has_words_that_stand_for_it_and_a_table_of_its_numbers(report: Report) -> None:
    """At least a sentence with a number, in the label that screen readers read."""
    shown = page_of(report.html)
    pictures = [attributes for attributes in shown.of("svg") if attributes.get("role") == "img"]
    moving = [attributes for attributes in shown.of("figure") if attributes.get("class") == "motion"]
    assert [attributes["data-name"] for attributes in moving] == ["string", "cloth"]
    assert len(pictures) == len(shown.of("figure")) == len(SHOWN) + 1 + len(moving)
    for picture in pictures:
        assert len(picture["aria-label"]) > 40
        assert any(character.isdigit() for character in picture["aria-label"])
    tables = [label for label in shown.attributes("aria-label") if label.startswith("Table: The numbers of")]
    assert len(tables) == len(pictures) - len(moving)


def test_pictures_on_one_page_share_no_ids(report: Report) -> None:
    """Or clips and marks of one would be taken for the other's; and whatever is referred to is there."""
    shown = page_of(report.html)
    ids = shown.attributes("id")
    assert len(ids) == len(set(ids))
    clips = [a.partition("#")[2][:-1] for a in shown.attributes("clip-path")]
    assert set(clips) <= set(ids)
    for name in ("href", "xlink:href"):
        assert {a[1:] for a in shown.attributes(name) if a.startswith("#")} <= set(ids)
    assert {*shown.attributes("aria-labelledby")} <= set(ids)


def test_the_page_is_in_a_language_and_has_headings_in_order(report: Report) -> None:
    """One h1, then no heading more than one level below the one before; tables have headed columns or rows."""
    shown = page_of(report.html)
    assert shown.of("html") == [{"lang": "en"}]
    levels = [int(name[1]) for name, _ in shown.elements if name in ("h1", "h2", "h3", "h4", "h5", "h6")]
    assert levels[0] == 1
    assert levels.count(1) == 1
    assert levels.count(2) == len(SHOWN) + 1 + len(CLOSING)
    assert all(after <= before + 1 for before, after in pairwise(levels))
    assert {attributes["scope"] for attributes in shown.of("th")} == {"col", "row"}


@pytest.mark.rotating(5, in_turn=True)
def test_two_findings_are_shown_and_the_rest_is_folded(report: Report) -> None:
    """All of them are on the page."""
    for name in SHOWN:
        for finding in RESULTS[name]["usual"]().findings:
            assert finding in page_of(report.html).words


def test_what_failed_or_was_skipped_is_in_one_place(report: Report) -> None:
    """With its reason, and its experiment's section leads there."""
    (failure,) = RESULTS["divergence"]["usual"]().failures
    section = report.html[report.html.index('<section id="undone"') :]
    assert failure in Page(section[: section.index("</section>")]).words
    assert "#undone-divergence" in page_of(report.html).attributes("href")


@pytest.mark.rotating(2)
def test_the_same_numbers_make_the_same_page(monkeypatch: pytest.MonkeyPatch, tmp_path: Path, report: Report) -> None:
    """Byte for byte, but for the date; and others make another."""
    put(monkeypatch, *(answering(name, RESULTS[name]["usual"]()) for name in SHOWN))
    only = [f"--only={name}" for name in SHOWN]
    springlab("report", *only, "--out", str(tmp_path / "again"))
    undated = [re.sub(r"\d{4}-\d\d-\d\d \d\d:\d\d UTC", "", html) for html in (report.html, _page(tmp_path / "again"))]
    assert undated[0] == undated[1]
    put(monkeypatch, answering("stiff_limit", RESULTS["stiff_limit"]["no engine"]()))
    springlab("report", *only, "--out", str(tmp_path / "other"))
    assert undated[0] != re.sub(r"\d{4}-\d\d-\d\d \d\d:\d\d UTC", "", _page(tmp_path / "other"))


def _page(folder: Path) -> str:
    return (folder / "index.html").read_text(encoding="utf-8")


@pytest.mark.rotating(3, in_turn=True)
def test_open_shows_the_page_and_full_runs_in_full(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """What has a fuller form is run in that; what is opened is the page that was written."""
    shown: list[str] = []
    monkeypatch.setattr("click.launch", shown.append)
    usual, fuller = (RESULTS["stiff_limit"][case]() for case in ("usual", "no engine"))
    experiment = replace(answering("stiff_limit", usual), run_in_full=lambda _: replace(fuller, findings=["In full."]))
    put(monkeypatch, experiment)
    said = springlab("report", "--only", "stiff_limit", "--full", "--open", "--out", str(tmp_path))
    assert said.code == 0
    assert "In full." in said.out
    assert "Made by springlab report --only stiff_limit --full" in Page(_page(tmp_path)).words
    assert shown == [str(tmp_path / "index.html")]


def test_the_environment_is_told_with_versions(report: Report) -> None:
    """Everything a number depends on: packages, Python, the machine, the lock."""
    words = page_of(report.html).words
    for package in ("numpy", "numba", "scipy", "matplotlib"):
        assert f"{package}{metadata.version(package)}" in "".join(words.split())
    assert platform.python_version() in words
    assert platform.machine() in words
    assert "requirements.lock" in words


def test_the_tables_can_be_taken_from_the_page_itself(report: Report) -> None:
    """Every CSV file beside the page is in the page, byte for byte."""
    files = {f.name: f.read_bytes() for name in SHOWN for f in (report.folder / name).glob("*.csv")}
    links = {a["download"]: a["href"] for a in page_of(report.html).of("a") if "download" in a}
    assert files
    assert {name: base64.b64decode(link.partition("base64,")[2]) for name, link in links.items()} == files


def test_the_figures_are_beside_the_page_too(report: Report) -> None:
    """As SVG, the same as in the page but for ids and colours."""
    for name in SHOWN:
        svg = (report.folder / name / f"{name}.svg").read_text(encoding="utf-8")
        assert svg.startswith("<svg")
        assert inline(svg, name, "").partition("xmlns")[2] in report.html


def test_an_experiment_that_raises_is_a_failure_in_its_place(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """The page still comes, with the other experiments; exit code 1; the reason is text, not markup."""
    put(monkeypatch, failing("errata", ArithmeticError("mass < 0 & <b>not</b> > 0")))
    put(monkeypatch, answering("stiff_limit", RESULTS["stiff_limit"]["usual"]()))
    said = springlab("report", "--only", "errata", "--only", "stiff_limit", "--out", str(tmp_path))
    assert said.code == 1
    assert "Traceback" not in said.err
    html = (tmp_path / "index.html").read_text(encoding="utf-8")
    check_self_contained(html)
    shown = page_of(html)
    assert [attributes["id"] for attributes in shown.of("section")] == ["found", "errata", "stiff_limit", *CLOSING]
    assert "ArithmeticError: mass < 0 & <b>not</b> > 0" in shown.words
    assert len(shown.of("figure")) == 1
    assert find("stiff_limit").question in shown.words


@pytest.mark.parametrize("command", [("run", "errata"), ("report", "--only", "errata")])
def test_a_store_that_cannot_be_used_is_said_before_anything_is_run(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, command: tuple[str, ...]
) -> None:
    """Exit code 2, in one line."""
    put(monkeypatch, failing("errata", AssertionError("it was run")))
    store = tmp_path / "notes.txt"
    store.write_text("no store " * 100)
    said = springlab(*command, "--out", str(tmp_path / "out"), "--store", str(store))
    line = f"springlab: store {store}: is damaged, or no store of springlab's (file is not a database); "
    assert (said.code, said.out, said.err.count("\n")) == (2, "", 1)
    assert said.err.startswith(line)


@pytest.mark.rotating(3, in_turn=True)
def test_run_and_report_leave_a_store_where_they_are_told(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Made where there is none."""
    put(monkeypatch, answering("stiff_limit", RESULTS["stiff_limit"]["usual"]()))
    for number, command in enumerate((("run", "stiff_limit"), ("report", "--only", "stiff_limit", "--fresh"))):
        store = tmp_path / str(number) / "store.sqlite"
        assert springlab(*command, "--out", str(tmp_path / "out"), "--store", str(store)).code == 0
        assert rows(store, {}) == []


@pytest.mark.rotating(3, in_turn=True)
def test_without_names_the_report_has_a_section_for_every_experiment_that_belongs_in_it(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Here all raise: nothing to draw, nothing to download, and still a page with a section for each."""
    put(monkeypatch, *(failing(name, ArithmeticError(f"no {name}")) for name in NAMES))
    said = springlab("report", "--out", str(tmp_path))
    assert said.code == 1
    html = (tmp_path / "index.html").read_text(encoding="utf-8")
    check_self_contained(html)
    wanted = [name for name in NAMES if find(name).in_report]
    assert len(wanted) >= 3
    assert [attributes["id"] for attributes in page_of(html).of("section")] == ["found", *wanted, *CLOSING]
    assert all(f"did not come to its end: ArithmeticError: no {name}" in page_of(html).words for name in wanted)
