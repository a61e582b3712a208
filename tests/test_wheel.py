"""The wheel: built, installed into a fresh environment, and used in a folder that has files named as ours."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import sysconfig
import urllib.request
import venv
import zipfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

# What takes long here is run every few days, and with --full.
pytestmark = pytest.mark.rotating(8)

ROOT = Path(__file__).parents[1]

#: The most it may take [bytes]: it is text, but for nothing. And what has no business in it.
LARGEST, NO_BUSINESS = 2_000_000, ("tests/", "report/docs/", "report/pictures/", "report/sample/", "report/python/")


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """It, built by the tools of the lock."""
    folder = tmp_path_factory.mktemp("wheel")
    words = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(folder)]
    subprocess.run(words, cwd=ROOT, check=True, capture_output=True)
    (file,) = folder.glob("*.whl")
    return file


@dataclass(frozen=True)
class Installed:
    """An environment with the wheel, and what it depends on from the one that runs the tests."""

    home: Path
    folder: Path

    def run(self, program: str, *words: str) -> subprocess.CompletedProcess[str]:
        """A program of the environment, called in a folder of a user's."""
        environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
        words = (str(self.home / "bin" / program), *words)
        return subprocess.run(words, capture_output=True, text=True, cwd=self.folder, env=environment)

    def out(self, program: str, *words: str) -> str:
        """What it prints, if it ends well and complains of nothing."""
        done = self.run(program, *words)
        assert (done.returncode, done.stderr) == (0, ""), done.stderr
        return done.stdout


@pytest.fixture(scope="module")
def installed(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Installed:
    """The wheel in an environment of its own; the user's folder has files named as the lab's own modules."""
    home = tmp_path_factory.mktemp("environment")
    venv.create(home, symlinks=True)
    pip = [sys.executable, "-m", "pip", "--python", str(home / "bin" / "python"), "install", "--quiet", "--no-deps"]
    subprocess.run([*pip, "--no-index", "--no-compile", "--disable-pip-version-check", str(wheel)], check=True)
    (packages,) = home.glob("lib/python*/site-packages")
    # as a line of a .pth file: the editable installation's own .pth file there is not read
    (packages / "dependencies.pth").write_text(sysconfig.get_path("purelib") + "\n", encoding="utf-8")
    folder = tmp_path_factory.mktemp("folder")
    for own in ("report.py", "reference.py", "engines/__init__.py"):
        (folder / own).parent.mkdir(exist_ok=True)
        (folder / own).write_text("raise SystemExit('of the user')", encoding="utf-8")
    return Installed(home, folder)


def test_it_holds_the_rooms_and_the_public_module_and_nothing_else(wheel: Path) -> None:
    """Each file once, small, with types and licence."""
    with zipfile.ZipFile(wheel) as opened:
        names = opened.namelist()
    assert len(names) == len(set(names))
    top = {name.partition("/")[0] for name in names}
    assert {name for name in top if not name.endswith(".dist-info")} == {
        *("reference", "engines", "experiments", "report", "springlab")
    }
    assert not [name for name in names if name.startswith(NO_BUSINESS)]
    assert {"springlab/py.typed", "report/templates/page.html.j2"} <= set(names)
    assert any(name.endswith("licenses/LICENSE") for name in names)
    assert wheel.stat().st_size < LARGEST


def test_its_commands_work_beside_files_named_as_ours(installed: Installed) -> None:
    """List, compare with an engine, a page of one experiment, an exercise from beginning to check."""
    listed = json.loads(installed.out("springlab", "list", "--json"))
    assert {row["scene"] for row in listed["scenes"]} >= {"string", "cloth"}
    words = ["compare", "string", "--duration", "0.02", "--stepper", "heun", "--stepper", "mujoco_tendons", "--json"]
    runs = json.loads(installed.out("springlab", *words))["runs"]
    assert [run["identified_as"] for run in runs] == ["heun", "kick_drift"]
    installed.out("springlab", "report", "--only", "errata", "--out", "page")
    assert "<svg" in (installed.folder / "page" / "index.html").read_text(encoding="utf-8")
    installed.out("springlab", "exercise", "start", "1", "own")
    (starter,) = (installed.folder / "own").glob("*.py")
    assert installed.run("springlab", "exercise", "check", str(starter)).returncode == 1


def test_it_is_imported_and_types_are_found(installed: Installed) -> None:
    """In isolation, as `python -I` has it, or `python -P`; with an engine."""
    program = "import springlab as lab; print(lab.identify('mujoco_tendons', masses=3, duration=0.01).identified_as)"
    assert installed.out("python", "-P", "-c", program).strip() == "kick_drift"
    done = installed.run("python", "-c", "import springlab")
    assert "springlab needs its own module" in done.stderr.splitlines()[-1]


@pytest.fixture
def live(installed: Installed) -> Iterator[str]:
    """The address of its live page."""
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    words = [str(installed.home / "bin" / "springlab"), "live", "--no-open", "--port", "0"]
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True, cwd=installed.folder, env=environment) as process:
        assert process.stdout is not None
        said = next(line for line in process.stdout if "http" in line)
        yield re.findall(r"http://\S+", said)[0]
        process.terminate()


def test_its_live_page_is_served(live: str) -> None:
    """Its files come along."""
    with urllib.request.urlopen(live) as answer:
        assert b"<html" in answer.read().lower()
