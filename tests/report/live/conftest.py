"""What the tests of the live page share: a browser and a server for each file."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from report.live.lab import Lab
from tests.report.live.visit import Visitor, browser, server, visit


@pytest.fixture(scope="module")
def chromium() -> Iterator[Any]:
    """One browser for all tests of a file."""
    with browser() as found:
        yield found


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    """One server for all: every viewer has a simulation of their own."""
    with server() as (found, _):
        yield found


@pytest.fixture
def visitor(chromium: Any, address: str) -> Iterator[Visitor]:
    """A viewer."""
    with visit(chromium, address) as found:
        yield found


@pytest.fixture
def labs() -> Iterator[list[Lab]]:
    """Labs that are ended afterwards."""
    made: list[Lab] = []
    yield made
    for lab in made:
        lab.end()
