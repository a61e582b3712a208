"""What installed packages add: in a new process that finds one, as a user's does."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]

METHOD = '''
from reference.motion import Motion
from reference.schemes.catalogue import scheme
from reference.state import State


@scheme(order=1)
def NAME(motion: Motion, state: State, dt: float) -> State:
    """Euler, by a package of somebody's own."""
    return state + dt * motion.slope(state)
'''

SCENE = '''
from reference.scenes import find, scene
from reference.system import MassSpringSystem


@scene(dt=1e-3, duration=0.1, slides="2")
def their_scene(*, mass: float = 0.02) -> MassSpringSystem:
    """A scene of somebody's own, which hangs there and swings."""
    return find("spring").system({"mass": mass})
'''

ENGINE = '''
from dataclasses import dataclass
from engines.pymunk.springs import PymunkSprings


@dataclass(frozen=True)
class Theirs(PymunkSprings):
    """Somebody's own."""

    name: str = "their_engine"


ENGINES = (Theirs(),)
'''


def installed(folder: Path, name: str) -> dict[str, str]:
    """The environment of a process that finds a package with a scheme of that name, a scene and an engine."""
    package, info = folder / "theirs", folder / "theirs-1.0.dist-info"
    package.mkdir()
    info.mkdir()
    (package / "__init__.py").write_text("")
    (package / "methods.py").write_text(METHOD.replace("NAME", name))
    (package / "scenes.py").write_text(SCENE)
    (package / "engine.py").write_text(ENGINE)
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: theirs\nVersion: 1.0\n")
    points = {"schemes": "methods", "scenes": "scenes", "engines": "engine"}
    lines = [f"[springlab.{kind}]\nany = theirs.{module}\n" for kind, module in points.items()]
    (info / "entry_points.txt").write_text("\n".join(lines))
    return {**os.environ, "PYTHONPATH": f"{ROOT}{os.pathsep}{folder}"}


def springlab(environment: dict[str, str], folder: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """The command line, in a process of its own."""
    command = [sys.executable, "-m", "report.commands.main", *words]
    return subprocess.run(command, env=environment, cwd=folder, capture_output=True, text=True)


@pytest.mark.rotating(5, in_turn=True)
def test_a_package_adds_a_scheme_a_scene_and_an_engine(tmp_path: Path) -> None:
    """All are listed with where they come from, and are run as any other."""
    environment = installed(tmp_path, "their_euler")
    document = json.loads(springlab(environment, tmp_path, "list", "--json").stdout)
    for kind, key, name in (("schemes", "stepper", "their_euler"), ("scenes", "scene", "their_scene")):
        (row,) = (row for row in document[kind] if row[key] == name)
        assert row["what"].endswith("(from theirs)")
    (row,) = (row for row in document["engines"] if row["engine"] == "their_engine")
    assert "theirs" in row["version"] or "not available" in row["version"]
    said = springlab(environment, tmp_path, "identify", "their_euler", "their_scene", "--json")
    assert json.loads(said.stdout)["identified_as"] == "euler"


@pytest.mark.rotating(3, in_turn=True)
@pytest.mark.parametrize("name", ["heun"])
def test_a_name_that_is_taken_is_refused(name: str, tmp_path: Path) -> None:
    """In a line, with who has it."""
    said = springlab(installed(tmp_path, name), tmp_path, "list")
    assert said.returncode == 2
    assert (
        said.stderr.strip() == "springlab: scheme 'heun' is taken by reference.schemes.textbook: expected another name"
    )
