"""What the soak tests share: how much there is of everything, and the store that nobody disturbed."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import pytest

from tests.soak.children import run_sweep


@dataclass(frozen=True)
class Size:
    """How much there is of everything.

    Attributes:
        runs: in a sweep.
        kills: of the program that runs it.
    """

    runs: int
    kills: int


@pytest.fixture(scope="session")
def size(request: pytest.FixtureRequest) -> Size:
    """A small form, or with --full all of it."""
    return Size(2_000, 20) if request.config.getoption("--full") else Size(60, 3)


@pytest.fixture(scope="session")
def undisturbed(size: Size, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The store of the sweep, run through without any interruption."""
    store = tmp_path_factory.mktemp("undisturbed") / "store.sqlite"
    run_sweep(store, size.runs)
    return store
