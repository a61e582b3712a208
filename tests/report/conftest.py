"""What tests of pages share: the lab in a browser, which hangs on nothing of the page that it stands beside."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import pytest

from report.browser.lab_page import lab_page
from report.browser.presets import Preset
from report.page import written


@pytest.fixture(autouse=True, scope="session")
def lab_beside_pages() -> Iterator[None]:
    """It is made once for all pages, as their scenes' equilibria take most of a page's time."""
    made: dict[str, str] = {}

    def once(presets: Sequence[Preset]) -> str:
        key = repr(presets)
        if key not in made:
            made[key] = lab_page(presets)
        return made[key]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(written, "lab_page", once)
        yield
