"""What all tests share: which engines the conformance suite runs, and what it does where one is missing."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from engines.engine import Engine, find, registry, version
from reference.errors import InputError


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add --engine and --full."""
    parser.addoption(
        "--engine",
        action="append",
        default=[],
        metavar="NAME",
        help="Run the conformance suite for these engines only.",
    )
    parser.addoption(
        "--full",
        action="store_true",
        help="Run the soak tests, the fuzz test and the live page in full: 2,000 runs, 20 kills; 1,000 files.",
    )


def pytest_configure(config: pytest.Config) -> None:
    """Refuse an unknown engine before anything runs."""
    for name in config.getoption("--engine"):
        try:
            find(name)
        except InputError as error:
            raise pytest.UsageError(f"--engine: {error}") from None


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Give every test that asks for an `engine` each engine of the registry in turn."""
    if "engine" in metafunc.fixturenames:
        names = metafunc.config.getoption("--engine") or list(registry())
        metafunc.parametrize("engine", names, indirect=True)


@pytest.fixture(autouse=True, scope="session")
def store_of_the_tests(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """Where commands keep results unless told otherwise: not where whoever runs the tests keeps theirs."""
    with pytest.MonkeyPatch.context() as patch:
        file = tmp_path_factory.mktemp("store") / "store.sqlite"
        patch.setenv("SPRINGLAB_STORE", str(file))
        yield file


@pytest.fixture
def engine(request: pytest.FixtureRequest) -> Engine:
    """One engine; the test is skipped where it is not installed."""
    found = find(request.param)
    if version(found) is None:
        pytest.skip(f"{found.package} is not installed")
    return found
