"""The registry knows all engines, imports none of them, and says which are not installed."""

from __future__ import annotations

import dataclasses
import pickle
import subprocess
import sys

import pytest

from engines.bullet import softbody
from engines.engine import Engine, find, registry, version
from engines.process.isolation import EngineStepper
from engines.pymunk import springs
from reference.errors import InputError
from reference.scenes import find as find_scene
from tests.engines.process.misbehaving import Misbehaving, Still

HEAVY = ("pymunk", "pybullet", "mujoco", "numba", "scipy", "matplotlib", "rich", "click")


def imported_by(code: str) -> set[str]:
    """Which of HEAVY a new interpreter has imported after running some code."""
    program = f"{code}\nimport sys\nprint(*[name for name in {HEAVY!r} if name in sys.modules])"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    return set(done.stdout.split())


@pytest.mark.parametrize(
    "code",
    [
        "from engines.engine import registry, version; [version(engine) for engine in registry().values()]",
        "import engines.process.isolation",
        "from reference.scenes import find; find('string').system({})",
    ],
)
def test_looking_at_engines_imports_no_engine_and_nothing_heavy(code: str) -> None:
    """So that an engine of another version can run in a bare environment, and every process starts at once."""
    assert imported_by(code) == set()


@pytest.mark.rotating(3)
def test_the_look_at_imports_sees_what_is_imported() -> None:
    """Shown to fail: a file that imports Numba at its top is seen to."""
    assert "numba" in imported_by("import reference.forces")


def test_every_engine_is_registered_under_its_name(engine: Engine) -> None:
    """And travels to other processes as it is."""
    assert registry()[engine.name] is engine
    copy = pickle.loads(pickle.dumps(engine))
    assert (copy, copy.settings, copy.identified_as) == (engine, engine.settings, engine.identified_as)


def test_an_engine_is_frozen(engine: Engine) -> None:
    """Its settings cannot change under a result that was recorded with them."""
    with pytest.raises(dataclasses.FrozenInstanceError):
        engine.package = "another"  # type: ignore[misc]


def test_an_unknown_engine_is_refused_with_a_suggestion() -> None:
    """One line, as for every unknown name."""
    with pytest.raises(InputError, match=r"unknown engine 'pymunk_spring': did you mean 'pymunk_springs'\?"):
        find("pymunk_spring")


def test_an_engine_that_is_not_installed_is_an_unsupported_run() -> None:
    """The reason names the package."""
    missing = Misbehaving(Still, package="no-such-engine")
    assert version(missing) is None
    outcome = EngineStepper(missing).run(find_scene("string").system({}), 1e-3, 10)
    assert (outcome.ending, outcome.reason) == ("unsupported", "no-such-engine is not installed")


def test_a_name_that_is_taken_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """In one line, with the file that has it: the second engine would hide the first."""
    first, second = softbody.ENGINES[0], springs.ENGINES[0]
    monkeypatch.setattr(springs, "ENGINES", (dataclasses.replace(second, name=first.name),))
    with pytest.raises(InputError, match=r"engine 'bullet_softbody' is taken by engines\.bullet\.softbody"):
        registry.__wrapped__()


def test_an_engine_is_what_it_was_in_the_version_it_is_run_in() -> None:
    """Up to the last version that stepped otherwise, versions being numbers; from the next on what it claims now."""
    newton = find("newton_xpbd")
    assert newton.identified_as["plain"] == "xpbd_jacobi(single=True)"
    for version_there, words in (("1.7.0", "accumulated=False, "), ("0.2.0", "accumulated=False, "), ("1.10.0", "")):
        claims = EngineStepper(newton, pinned=version_there).identified_as
        assert claims == dict.fromkeys(("plain", "damping"), f"xpbd_jacobi({words}single=True)")
    assert EngineStepper(find("mujoco_tendons"), pinned="3.2.7").identified_as == find("mujoco_tendons").identified_as
