"""The page of engines has all of them, and what each lacks, from the adapters themselves."""

from __future__ import annotations

import re

from engines.engine import CAPABILITIES, precision, registry
from report.site.engines_page import engines_page, refusals


def test_every_engine_is_in_every_table() -> None:
    """Three times as code, and each scheme that it is identified as beside it."""
    page = engines_page()
    for name, engine in registry().items():
        assert page.count(f"`{name}`") == 3
        (row,) = re.findall(rf"^\| `{name}` \| {engine.package} \| {precision(engine)} \| .*$", page, re.MULTILINE)
        assert all(f"`{scheme}`" in row for scheme in engine.identified_as.values())


def test_engines_of_the_same_capabilities_share_a_row_of_what_they_lack() -> None:
    """Each capability is lacked by just those engines of whose row its words are a part."""
    rows = {name: words.split("; ") for names, words in refusals(registry()) for name in re.findall(r"`(.+?)`", names)}
    assert set(rows) == set(registry())
    for name, engine in registry().items():
        lacks = [words for capability, words in CAPABILITIES.items() if capability not in engine.capabilities]
        assert rows[name] == (lacks or ["nothing"])
