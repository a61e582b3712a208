"""The law of a spring: its parts belong together, and everything takes it from its one file."""

from __future__ import annotations

import io
import json
import os
import shutil
import subprocess
import sys
from contextlib import redirect_stdout
from pathlib import Path
from unittest import mock

import numpy as np
import pytest

from reference.springs import linear_law

ROOT = Path(__file__).parents[3]

#: Another law, with a hardening term: force k (s + B s^3) + c rate, and all that follows from it.
HARDENING = '''"""A law for a test: a spring that hardens."""

import numpy as np

B = 2000.0


def spring_force(stiffness, stretch, damping, rate):
    return stiffness * (stretch + 2000.0 * stretch * stretch * stretch) + damping * rate


def elastic_energy(stiffness, stretch):
    return stiffness * (stretch**2 / 2 + B * stretch**4 / 4)


def force_by_stretch(stiffness, stretch):
    return stiffness * (1 + 3 * B * stretch**2)


def force_by_rate(damping):
    return damping


def stretch_under(stiffness, force):
    # Cardano: the one real root of s^3 + s / B - F / (k B)
    half, third = force / (2 * stiffness * B), 1 / (3 * B)
    root = np.sqrt(half**2 + third**3)
    return np.cbrt(half + root) + np.cbrt(half - root)
'''

#: What must hold under any law, as a program of its own: it prints how far apart things are that should be equal, those
#: that are named or all.
PROGRAM = """
import json
import sys
import numpy as np
from reference.springs import linear_law
from reference.assembly import assemble, spring_blocks
from reference.compiled.kernels import advance
from reference.compiled.sweep import sweep
from reference.conserved import energy
from reference.forces import SpringMotion
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.simulate import simulate
from reference.state import State
from reference.theory.equilibrium import equilibrium
from reference.theory.exact import exact

system = find_scene("string").system({"masses": 3, "angle": 60.0})
rk4, heun = find("rk4"), find("heun")
run = simulate(system, heun, 1e-3, 0.2)
bits = lambda x: bool((x == run.positions[-1]).all())
energies = lambda: [energy(system, state) for state in simulate(system, rk4, 2e-4, 0.2).states()[::100]]
state = run.states()[100]
motion, jacobian = SpringMotion(system), assemble(system, spring_blocks(system, state)[0], sparse=False)
free = ~system.fixed

def force(z):
    x = state.positions.copy()
    x[free] += z.reshape(-1, 2)
    return (motion.acceleration(State(0.0, x, state.velocities)) * system.masses[:, None])[free].ravel()

h = 1e-6
differences = np.stack([(force(h * e) - force(-h * e)) / (2 * h) for e in np.eye(6)], axis=1)
rest, slack = equilibrium(system), find_scene("cloth").system({"rows": 3, "columns": 3})
asked = {
    "kernel": lambda: bits(advance(system, heun, 1e-3, 200).positions),
    "sweep": lambda: bits(sweep(system, heun, np.full(2, 1e-3), 200, threads=1).positions[1]),
    "energy": lambda: float(np.ptp(energies())) / 0.1,
    "jacobian": lambda: float(np.abs(jacobian - differences).max() / np.abs(differences).max()),
    "string at rest": lambda: float(np.abs(motion.acceleration(rest)).max()) / 9.81,
    "cloth at rest": lambda: float(np.abs(SpringMotion(slack).acceleration(equilibrium(slack))).max()) / 9.81,
    "end": lambda: run.positions[-1].tolist(),
    "exact": lambda: exact(system, 1e-3, 50).positions[-1].tolist(),
    "file": lambda: linear_law.__doc__,
}
print(json.dumps({name: asked[name]() for name in sys.argv[1:] or asked}))
"""


def answers(folder: Path, *names: str) -> dict[str, object]:
    """What the program prints with the reference in a folder: what is named, or all."""
    environment = {**os.environ, "PYTHONPATH": str(folder)}
    words = [sys.executable, "-c", PROGRAM, *names]
    done = subprocess.run(words, capture_output=True, text=True, env=environment, cwd=folder, check=False)
    assert done.returncode == 0, done.stderr[-2000:]
    found: dict[str, object] = json.loads(done.stdout)
    return found


def answers_here() -> dict[str, object]:
    """What the program prints in this process, under the law that there is."""
    said = io.StringIO()
    with mock.patch.object(sys, "argv", ["program"]), redirect_stdout(said):
        exec(compile(PROGRAM, "program", "exec"), {})
    found: dict[str, object] = json.loads(said.getvalue())
    return found


def copy_with(law: str, folder: Path) -> Path:
    """A copy of the reference with another law of a spring."""
    shutil.copytree(ROOT / "reference", folder / "reference", ignore=shutil.ignore_patterns("__pycache__"))
    (folder / "reference" / "springs" / "linear_law.py").write_text(law, encoding="utf-8")
    return folder


def check_follows(found: dict[str, object]) -> None:
    """Loops to the bit; energy and Jacobian as differences, to their truncation; rest to a millionth of the weight."""
    assert [name for name in ("kernel", "sweep") if found.get(name) is False] == []
    limits = {"energy": 1e-7, "jacobian": 1e-7, "string at rest": 1e-6, "cloth at rest": 1e-6}
    asked = limits.keys() & found.keys()
    assert asked
    beyond = {name: found[name] for name in asked if not float(found[name]) < limits[name]}  # type: ignore[arg-type]
    assert not beyond


@pytest.mark.rotating(4)
def test_another_law_in_its_one_file_is_followed_everywhere(tmp_path: Path) -> None:
    """Functions, compiled loops, sweeps, Jacobians, equilibria, energy and the exact motion: on a copy, seen to move.

    The hardening term moves masses by more than 0.01 mm in 0.05 s. Kernels of the law before are on this machine's
    disk, and are not taken.
    """
    before = answers_here()
    after = answers(copy_with(HARDENING, tmp_path / "hardening"))
    for found in (before, after):
        assert {"kernel", "sweep", "energy", "jacobian", "string at rest", "cloth at rest"} <= found.keys()
        check_follows(found)
    assert after["file"] == "A law for a test: a spring that hardens."
    moved = {name: np.abs(np.array(before[name]) - np.array(after[name])).max() for name in ("end", "exact")}
    assert min(moved.values()) > 1e-5, moved


@pytest.mark.rotating(5)
@pytest.mark.parametrize(
    ("part", "wrong", "seen"),
    [
        ("stretch**4 / 4", "stretch**4 / 3", "energy"),
        ("1 + 3 * B", "1 + 2 * B", "jacobian"),
        ("third = force / (2 * stiffness * B), 1", "third = force / (2 * stiffness * B), 2", "string at rest"),
    ],
)
def test_a_law_whose_parts_do_not_belong_together_is_seen(tmp_path: Path, part: str, wrong: str, seen: str) -> None:
    """Each of its formulas is used by what is checked: a wrong one is found there."""
    assert part in HARDENING
    with pytest.raises(AssertionError, match=seen):
        check_follows(answers(copy_with(HARDENING.replace(part, wrong), tmp_path), seen))


def test_the_parts_of_the_law_belong_together() -> None:
    """F = dE/ds and its derivatives by differences, which of a linear force and a square are exact to rounding."""
    k, c, s, h = np.array([200.0, 3.0]), np.array([0.5, 2.0]), np.array([-0.02, 0.7]), 1e-4
    energy, force, none = linear_law.elastic_energy, linear_law.spring_force, np.zeros(2)
    slope = (energy(k, s + h) - energy(k, s - h)) / (2 * h)
    assert force(k, s, c, none) == pytest.approx(slope, rel=1e-10)
    by_stretch = (force(k, s + h, c, none) - force(k, s - h, c, none)) / (2 * h)
    assert linear_law.force_by_stretch(k, s) == pytest.approx(by_stretch, rel=1e-10)
    by_rate = (force(k, s, c, none + h) - force(k, s, c, none - h)) / (2 * h)
    assert linear_law.force_by_rate(c) == pytest.approx(by_rate, rel=1e-10)
    assert force(k, linear_law.stretch_under(k, np.array([2.0, 5.0])), c, none) == pytest.approx([2.0, 5.0])
