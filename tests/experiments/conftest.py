"""A store for the tests of what is kept."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest

from experiments.runs.store import Store


@pytest.fixture
def store_file(tmp_path: Path) -> Path:
    """Where a store is to be."""
    return tmp_path / "new" / "folder" / "store.sqlite"


@pytest.fixture
def store(store_file: Path) -> Iterator[Store]:
    """A store, open."""
    with closing(Store(store_file)) as opened:
        yield opened
