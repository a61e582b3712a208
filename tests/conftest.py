"""What all tests share: which engines the conformance suite runs, and which part of long lists is checked."""

from __future__ import annotations

import gc
from collections.abc import Generator, Iterator
from pathlib import Path
from typing import Any

import hypothesis
import pytest

from engines.engine import Engine, find, registry, version
from engines.process.packages import APART
from engines.process.worker import FOR_SCHEMES, import_beforehand
from reference.errors import InputError
from tests.parts import LONGEST, PARTS, Turns, part, todays

# How long an example takes is a matter of what else the machine does.
hypothesis.settings.register_profile("lab", deadline=None, suppress_health_check=[hypothesis.HealthCheck.too_slow])
hypothesis.settings.load_profile("lab")

# One server forks the processes of all tests.
import_beforehand(FOR_SCHEMES)


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
    parser.addoption(
        "--all-cases",
        action="store_true",
        help="Run the cases marked `rotating` of all days; what --full makes larger stays as small.",
    )
    parser.addoption(
        "--part",
        type=int,
        metavar="N",
        help="Check this part of long lists (students' programs, cases marked `rotating`), "
        f"0 to {PARTS - 1}; today's if left out, all with --full.",
    )


def pytest_configure(config: pytest.Config) -> None:
    """Refuse an unknown engine or part before anything runs; workers are given the part that was chosen here."""
    config.addinivalue_line(
        "markers",
        "rotating(n, in_turn=False): it, or each of its cases, is run on every n-th day; with in_turn the tests of a "
        "file that are marked so take turns, and every day runs some of them",
    )
    if config.option.part is None:
        config.option.part = todays()
    if not 0 <= config.option.part < PARTS:
        raise pytest.UsageError(f"--part {config.option.part}: expected a number from 0 to {PARTS - 1}")
    for name in config.getoption("--engine"):
        try:
            find(name)
        except InputError as error:
            raise pytest.UsageError(f"--engine: {error}") from None


@pytest.hookimpl(optionalhook=True, tryfirst=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    """Which worker runs what; of anything else than `--dist loadfile` xdist knows it."""
    if config.getvalue("dist") != "loadfile":
        return None
    from tests.worker_queue import ByFile

    return ByFile(config, log)


def pytest_report_header(config: pytest.Config) -> str:
    """Which part of long lists is checked, and how to check it again."""
    chosen = "all" if config.option.full else f"--part {config.option.part} of 0 to {PARTS - 1}"
    return f"students' programs, and cases that rotate: {chosen}"


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Generator[None, object, object]:
    """What is imported and collected is there to stay: the garbage collector need not go through it, now or later."""
    gc.disable()
    try:
        return (yield)
    finally:
        gc.freeze()
        gc.enable()


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave out the `rotating` tests and cases whose day it is not; none with --full, --all-cases, or named by `::`.

    What takes longest comes first.
    """
    items.sort(key=lambda item: not item.nodeid.startswith(LONGEST))
    if config.option.full or config.option.all_cases or any("::" in argument for argument in config.args):
        return
    turns = Turns(config.option.part)
    left_out = []
    for item in items:
        marker = item.get_closest_marker("rotating")
        if marker is not None:
            _require_that_it_comes_round(item, marker.args[0])
            if not turns.keep(item.nodeid, marker.args[0], marker.kwargs.get("in_turn", False)):
                left_out.append(item)
    config.hook.pytest_deselected(items=left_out)
    gone = set(left_out)
    items[:] = [item for item in items if item not in gone]


def _require_that_it_comes_round(item: pytest.Item, every: int) -> None:
    """Raises UsageError for a test that has parts already, some of which would be on no day of its own; and days."""
    if every > PARTS or "corpus_part" in getattr(item, "fixturenames", ()):
        raise pytest.UsageError(f"{item.nodeid}: rotating({every}): expected at most {PARTS}, and no `corpus_part`")


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Give every test that asks for an `engine` each engine of the registry in turn; and the chosen `corpus_part`."""
    if "corpus_part" in metafunc.fixturenames:
        option = metafunc.config.option
        chosen, name = (slice(None), "all") if option.full else (part(option.part), f"part_{option.part}")
        metafunc.parametrize("corpus_part", [chosen], ids=[name])
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
    asked = request.config.option.full or found.name in request.config.getoption("--engine")
    if found.package in APART and not asked:
        pytest.skip(f"{found.name} has an environment of its own: tested with --full, or --engine {found.name}")
    return found
