"""Environments of other versions: whole or not there at all, made once, and of the lab they see two rooms."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from engines.process import environments
from engines.process.environments import UNFINISHED, environment, kept
from reference.errors import InputError
from tests.engines.process.index import environment_or_skip

ROOT = Path(__file__).parents[3]

Make = Callable[[Path, str, str], None]


def pretend(home: Path, package: str, version: str) -> None:
    """What making an environment leaves, without an index: a Python, and a link to the lab."""
    packages = home / "lib" / "python3" / "site-packages"
    packages.mkdir(parents=True)
    (packages / "engines").symlink_to(ROOT / "engines")
    (home / "bin").mkdir()
    (home / "bin" / "python").symlink_to(sys.executable)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty cache, in which environments are pretended."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setattr(environments, "_make", pretend)
    return tmp_path / "springlab" / "environments"


def folders(folder: Path) -> list[str]:
    """The folders of a cache: what is there, finished or not."""
    return [found.name for found in folder.iterdir() if found.is_dir()]


def test_an_environment_is_made_once_and_used_again(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The second time nothing is made; another version is another environment."""
    first = environment("spring", "1.0")
    assert first.exists()
    assert environment("spring", "1.1") != first
    monkeypatch.setattr(environments, "_make", None)
    assert environment("spring", "1.0") == first


def test_many_at_once_make_it_once(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The others wait."""
    made = []

    def slowly(home: Path, package: str, version: str) -> None:
        made.append(home)
        time.sleep(0.2)
        pretend(home, package, version)

    monkeypatch.setattr(environments, "_make", slowly)
    with ThreadPoolExecutor(4) as pool:
        found = set(pool.map(lambda _: environment("spring", "1.0"), range(4)))
    assert len(made) == len(found) == 1
    assert len(folders(folder)) == 1


def test_what_fails_leaves_nothing(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Half of an environment is removed, and the next time it is made."""

    def fail(home: Path, package: str, version: str) -> None:
        pretend(home, package, version)
        raise InputError("spring==1.0 cannot be installed: it broke")

    monkeypatch.setattr(environments, "_make", fail)
    with pytest.raises(InputError, match="it broke"):
        environment("spring", "1.0")
    assert folders(folder) == []
    monkeypatch.setattr(environments, "_make", pretend)
    assert environment("spring", "1.0").exists()


KILLED = """
import sys, time
from pathlib import Path
from engines.process import environments

def never_done(home, package, version):
    (home / "bin").mkdir()
    print("begun", flush=True)
    time.sleep(60)

environments._make = never_done
environments.environment("spring", "1.0")
"""


def test_who_is_killed_at_it_leaves_nothing_that_is_used(folder: Path) -> None:
    """What it left is not taken for an environment, and is removed by the next one at work on the same."""
    with subprocess.Popen([sys.executable, "-c", KILLED], stdout=subprocess.PIPE, cwd=ROOT) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == b"begun\n"
        process.send_signal(signal.SIGKILL)
    assert any(UNFINISHED in name for name in folders(folder))
    python = environment("spring", "1.0")
    assert folders(folder) == [python.parents[1].name]


def test_the_environment_of_a_lab_that_is_gone_is_removed(folder: Path, tmp_path: Path) -> None:
    """Its link to that lab leads nowhere; those that are of use stay."""
    kept = environment("spring", "1.0").parents[1]
    dead = environment("spring", "1.1").parents[1]
    link = next(dead.glob("lib/*/*/engines"))
    link.unlink()
    link.symlink_to(tmp_path / "gone")
    environment("spring", "1.2")
    assert not dead.exists()
    assert kept.exists()


@pytest.mark.parametrize("version", ["", "latest", "../1.0", "-r", "1.0; rm", "1.0 2.0"])
def test_what_is_no_version_is_refused(folder: Path, version: str) -> None:
    """Before anything is run with it."""
    with pytest.raises(InputError, match="expected one such as"):
        environment("spring", version)


@pytest.mark.parametrize(
    ("said", "meant"),
    [
        (
            "error: No solution found when resolving dependencies\n  cause: Because there is no version of spring==9"
            " and you require\n      spring==9, we can conclude that your requirements are unsatisfiable.\n",
            "there is no version of spring==9",
        ),
        (
            "ERROR: Could not find a version that satisfies the requirement spring==9 (from versions: 1, 2)\n"
            "ERROR: No matching distribution found for spring==9\n",
            "No matching distribution found for spring==9",
        ),
        ("x" * 1000 + "\nno space left on device", "no space left on device"),
    ],
)
def test_the_index_is_quoted_in_short(said: str, meant: str) -> None:
    """What uv and pip say, in a line."""
    reason = environments._reason(said)
    assert reason.endswith(meant)
    assert len(reason) <= 200


def test_a_real_one_sees_two_rooms_and_nothing_else_of_the_lab() -> None:
    """NumPy, the engine and the rooms can be imported there; the lab's other rooms and packages cannot.

    Of a version that other tests have made an environment of, if they have, as that takes seconds.
    """
    version = next((v for v in ("6.8.1", "7.3.1") if kept("pymunk", v)), "7.3.1")
    python = environment_or_skip("pymunk", version)
    there = ["numpy", "pymunk", "engines.process.worker", "reference.measured_stability"]
    program = (
        f"import importlib.util as u; [__import__(n) for n in {there}]; import pymunk, engines; "
        "print(pymunk.version, engines.__path__[0], [n for n in ('scipy', 'numba', 'experiments') if u.find_spec(n)])"
    )
    plain = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    done = subprocess.run([python, "-c", program], capture_output=True, text=True, cwd=python.parent, env=plain)
    assert done.returncode == 0, done.stderr
    assert re.match(rf"{re.escape(version)} \S+engines \[\]$", done.stdout)


def test_the_file_of_a_wheel_is_a_version(folder: Path, tmp_path: Path) -> None:
    """One that is built again is another; one that is not there, or of another package, is refused."""
    wheel = tmp_path / "spring-1.2.0-py3-none-any.whl"
    wheel.write_bytes(b"one")
    first = environment("spring", str(wheel))
    assert "spring-1.2.0-" in str(first)
    assert environment("spring", str(wheel)) == first
    wheel.write_bytes(b"another")
    assert environment("spring", str(wheel)) != first
    with pytest.raises(InputError, match="expected a file that is there"):
        environment("spring", str(tmp_path / "spring-9-py3-none-any.whl"))
    with pytest.raises(InputError, match="expected a wheel of rope"):
        environment("rope", str(wheel))


def test_what_cannot_be_installed_is_told_in_the_installers_words() -> None:
    """The last of them, in one line, with what was wanted."""
    program = "import sys; print('at first'); sys.exit('no such\\nversion')"
    with pytest.raises(InputError, match=r"^pymunk==0\.1 cannot be installed: no such version$"):
        environments._call("pymunk==0.1", sys.executable, "-c", program)
    environments._call("pymunk==0.1", sys.executable, "-c", "")
