"""The live page in headless Chromium: what people do with it, and what they see. With `--full`.

Chromium draws WebGL by the processor alone here: that takes minutes.
"""

from __future__ import annotations

import re
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from report.live.scenes import names
from tests.report.live.commands import ends_of
from tests.report.live.visit import ROOT, Visitor, browser, server

#: What viser's own page has to say against itself when something is dragged; nothing comes of it.
THEIRS = ("Unable to preventDefault inside passive event listener invocation.",)

#: Opened by the ordinary tests; the others with --full.
FEW = ("cloth", "barrier")


@pytest.fixture(scope="module", autouse=True)
def _in_full(request: pytest.FixtureRequest) -> None:
    """Not in the ordinary tests."""
    if not request.config.getoption("--full"):
        pytest.skip("--full drives the live page in a browser")


@pytest.fixture(scope="module")
def chromium(_in_full: None) -> Iterator[Any]:
    """One browser for all."""
    with browser() as found:
        yield found


@pytest.fixture(scope="module")
def address(_in_full: None) -> Iterator[str]:
    """One server for all: every viewer has a simulation of their own."""
    with server() as (found, _):
        yield found


@pytest.fixture
def visitor(chromium: Any, address: str) -> Iterator[Visitor]:
    """A viewer, who asked for nothing from elsewhere and had no error when they leave."""
    found = Visitor(chromium, address)
    yield found
    port = address.rpartition(":")[2]
    elsewhere = [url for url in found.asked if not re.match(rf"(blob:)?http://localhost:{port}/|data:", url)]
    found.page.close()
    assert (elsewhere, [error for error in found.errors if error not in THEIRS]) == ([], [])


def test_past_the_limit_the_banner_comes_and_below_it_does_not(visitor: Visitor) -> None:
    """Then stiffness is changed while it runs: the motion goes on, and the limit falls as one over the root of it."""
    limit = visitor.limit()
    visitor.type("dt [ms]", 1.07 * limit)
    visitor.alert.wait_for()
    assert "1.07 times the predicted largest stable dt" in visitor.alert.inner_text()
    visitor.press("Start again with dt")
    visitor.wait_until(0.3)
    before = visitor.time
    visitor.type("stiffness [N/m]", 150)
    visitor.wait_until(before + 0.5)
    assert visitor.limit() == pytest.approx(limit * (200 / 150) ** 0.5, rel=1e-3)
    assert not visitor.alert.is_visible()


def test_a_stepper_takes_over_and_the_command_comes_to_the_same_state(
    visitor: Visitor, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The file of the state where it took over is downloaded; the command runs on it; it ends where the page is."""
    visitor.wait_until(0.2)
    visitor.choose("world 1", "rk4")
    visitor.wait_until(0.4)
    visitor.press("Pause")
    with visitor.page.expect_download() as download:
        line = visitor.command()
    download.value.save_as(tmp_path / download.value.suggested_filename)
    assert "--stepper=rk4" in line
    (state,) = ends_of(line, tmp_path).values()
    assert state.time > 0.1
    monkeypatch.chdir(tmp_path)
    done = subprocess.run(
        [sys.executable, "-m", "experiments.command_line", *line.split()[1:]],
        env={"PYTHONPATH": str(ROOT), "PATH": "", "HOME": str(tmp_path)},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr


def test_a_mass_is_dragged(visitor: Visitor) -> None:
    """By its last mass, with the mouse, while nothing else moves: then it is no run that a command can say whole."""
    visitor.press("Pause")
    visitor.press("Reset")
    visitor.page.wait_for_timeout(1500)
    assert "string-live" not in visitor.command()
    x, y = visitor.rightmost_mass()
    visitor.page.mouse.move(x, y)
    visitor.page.wait_for_timeout(300)
    visitor.page.mouse.down()
    for i in range(1, 9):
        visitor.page.mouse.move(x - 8 * i, y - 8 * i)
        visitor.page.wait_for_timeout(60)
    visitor.page.mouse.up()
    visitor.page.wait_for_timeout(700)
    visitor.press("Copy command")
    visitor.page.wait_for_function(
        "() => document.querySelector('textarea[aria-label=command]').value.includes('string-live')"
    )


@pytest.mark.parametrize("scene", names())
def test_every_scene_opens_and_moves(visitor: Visitor, request: pytest.FixtureRequest, scene: str) -> None:
    """Some of them here; all with --full."""
    if scene not in FEW and not request.config.getoption("--full"):
        pytest.skip("only with --full")
    visitor.choose("scene", scene)
    visitor.page.wait_for_timeout(800)
    visitor.wait_until(0.05)
    assert not visitor.alert.is_visible()


def test_a_port_in_use_is_one_line() -> None:
    """And exit code 2; so is a scene nobody has."""
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        for words, said in (
            ([f"--port={port}"], f"port {port} at 127.0.0.1 cannot be had"),
            (["strin"], "unknown scene"),
        ):
            command = [sys.executable, "-m", "experiments.command_line", "live", "--no-open", *words]
            done = subprocess.run(command, capture_output=True, text=True, cwd=ROOT)
            assert done.returncode == 2
            assert said in done.stderr
            assert len(done.stderr.splitlines()) == 1
