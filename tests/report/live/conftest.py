"""What the tests of the live page share: a browser and a server for each file, and steps without compiled loops."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import count
from typing import Any

import pytest

from reference.compiled.kernels import loops_for
from reference.errors import Unsupported
from reference.schemes.catalogue import Scheme
from reference.system import MassSpringSystem
from report.live import stepping
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


@pytest.fixture(autouse=True)
def as_written(monkeypatch: pytest.MonkeyPatch) -> None:
    """Schemes of labs in this process step as they are written: nothing is compiled meanwhile, nothing takes over."""
    monkeypatch.setattr(stepping._COMPILED, "ready", lambda scheme, system: False)


@pytest.fixture
def by_loops(as_written: None, monkeypatch: pytest.MonkeyPatch) -> None:
    """Loops take over from the third time on that they are asked for, however long it takes to compile them."""
    asked = count()

    def ready(scheme: Scheme, system: MassSpringSystem) -> bool:
        try:
            loops_for(scheme, system)
        except Unsupported:
            return False
        return next(asked) > 1

    monkeypatch.setattr(stepping._COMPILED, "ready", ready)


@pytest.fixture
def labs() -> Iterator[list[Lab]]:
    """Labs that are ended afterwards."""
    made: list[Lab] = []
    yield made
    for lab in made:
        lab.end()
