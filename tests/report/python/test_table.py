"""A table as a list of rows, as columns, as text and as HTML; and the pages that have one."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from springlab.pages import Page
from springlab.table import Table

from report.shown import Shown

STEPS = Table(
    "steps <of> two", ("", "dt [s]", "outcome & why"), (("a<b", 0.00125, "done"), ("c", 0.1, None)), ("it's",)
)


def test_rows_and_columns_are_found_by_number_and_by_heading() -> None:
    """Also from the end; as in any list, and in the order they are in."""
    first, second = STEPS
    assert (len(STEPS), first, second) == (2, STEPS[0], STEPS[-1])
    assert second == {"": "c", "dt [s]": 0.1, "outcome & why": None}
    assert STEPS["dt [s]"] == [0.00125, 0.1]
    assert STEPS.to_pandas().fillna("").to_dict("list") == {
        "": ["a<b", "c"],
        "dt [s]": [0.00125, 0.1],
        "outcome & why": ["done", ""],
    }
    with pytest.raises(KeyError, match=r"'dt': expected one of , dt \[s\], outcome & why"):
        STEPS["dt"]


def test_as_text_cells_stand_below_one_another() -> None:
    """Numbers to three figures, nothing as a dash; the title before it, notes behind it; no title, no line."""
    lines = ["     dt [s]   outcome & why", "a<b  0.00125  done", "c    0.1      -"]
    assert str(STEPS).splitlines() == ["steps <of> two", *lines, "it's"]
    assert str(Table("", STEPS.columns, STEPS.rows)).splitlines() == lines


def test_as_html_it_has_a_caption_and_headings_and_escapes_what_is_in_it() -> None:
    """A column without a heading has none, which screen readers would read; no title, no caption."""
    heads = '<td></td><th scope="col">dt [s]</th><th scope="col">outcome &amp; why</th>'
    rows = "<tr><td>a&lt;b</td><td>0.00125</td><td>done</td></tr><tr><td>c</td><td>0.1</td><td>-</td></tr>"
    table = f"<thead><tr>{heads}</tr></thead><tbody>{rows}</tbody></table>"
    assert STEPS._repr_html_() == f"<table><caption>steps &lt;of&gt; two</caption>{table}<p>it&#x27;s</p>"
    assert Table("", STEPS.columns, STEPS.rows)._repr_html_() == f"<table>{table}"


def test_tables_are_made_of_what_commands_print_and_of_documents() -> None:
    """Title, columns, rows and notes in their places; what a document does not have is nothing."""
    shown = Shown("t", ["a", "b"], [[1, 2], [3, 4]], ["n"])
    assert Table.of(shown) == Table("t", ("a", "b"), ((1, 2), (3, 4)), ("n",))
    documents: list[dict[str, Any]] = [{"b": 1, "a": 2}, {"a": 3, "c": 4}]
    assert Table.of_documents("t", documents) == Table("t", ("b", "a", "c"), ((1, 2, None), (None, 3, 4)))


def test_a_page_says_its_findings_and_links_its_file() -> None:
    """Each a paragraph, in their order, escaped."""
    page = Page(Path("a&b.html"), ("first <", "second"))
    link = '<p><a href="a&amp;b.html">a&amp;b.html</a></p>'
    assert page._repr_html_() == f"<p>first &lt;</p><p>second</p>{link}"


@pytest.mark.parametrize(
    ("places", "origin", "said"),
    [
        (["{home}/reference"], "{home}/reference/__init__.py", ""),
        (["/other/x", "{home}/reference"], None, ""),  # a folder without __init__.py, laid over several places
        (["/other/x", "/other/y"], "/other/x/__init__.py", "'reference', and /other/x is found"),
        (None, "/other/reference.py", "'reference', and /other/reference.py is found"),
        (None, None, "'reference', and nothing is found"),
        ("nowhere", None, "'reference', and nothing is found"),
    ],
)
def test_what_hides_one_of_the_labs_modules_is_named(
    places: Any, origin: str | None, said: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """By its first place; the lab's own may stand beside this module, where it is installed, or in a checkout."""
    from springlab import _rooms

    beside, checkout = (Path(_rooms.__file__).parents[i] for i in (1, 3))
    for home in (beside, checkout):

        def spec(name: str, home: Path = home) -> Any:
            if places == "nowhere":
                return None
            found = places and [place.format(home=home) for place in places]
            return SimpleNamespace(submodule_search_locations=found, origin=origin and origin.format(home=home))

        monkeypatch.setattr(_rooms.importlib.util, "find_spec", spec)
        if not said:
            _rooms.check_rooms()
            continue
        with pytest.raises(ImportError, match=f"^springlab needs its own module {said} in its place"):
            _rooms.check_rooms()
