"""What a scene means where one is asked for, with settings and changes of one's own; and keys that no table has."""

from __future__ import annotations

from pathlib import Path

import pytest

from reference.changes import Change
from reference.drives import Sine
from reference.errors import InputError
from reference.files.scene_file import load
from reference.files.setup import is_file, setup_for

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
SYSTEM = "[system]\npositions = [[0, 0], [1, 0], [2, 1]]\nsprings = [[0, 1], [1, 2]]\nmasses = 1\nstiffness = 10\n"


def file(folder: Path, text: str) -> Path:
    """A scene file, a mesh beside it."""
    (folder / "mesh.obj").write_text(TRIANGLE)
    (folder / "hill.toml").write_text(text)
    return folder / "hill.toml"


@pytest.mark.parametrize(
    ("before", "table"),
    [
        ("", SYSTEM),
        ("", '[mesh]\nfile = "mesh.obj"\ntotal_mass = 1\nstiffness = 1\n'),
        (SYSTEM, '[[changes]]\ntime = 0.1\nparameter = "drag"\nvalue = 1\n'),
        (SYSTEM, '[[ramps]]\nparameter = "drag"\nbegin = 0.1\nend = 0.2\nvalue = 1\n'),
        (SYSTEM, '[[sines]]\nparameter = "drag"\namplitude = 0.1\nfrequency = 2\n'),
        (SYSTEM, "[[pulls]]\nmass = 1\nforce = [0, 1]\n"),
        (SYSTEM, "[[angular_springs]]\nmasses = [0, 1, 2]\nstiffness = 1\n"),
        (SYSTEM, "[ground_motion]\nfrom_frequency = 2\nto_frequency = 4\namplitude = 1\nduration = 0.05\n"),
    ],
    ids=lambda text: text.partition("]")[0].strip("["),
)
def test_a_key_that_a_table_has_not_is_refused_by_name(tmp_path: Path, before: str, table: str) -> None:
    """In every table, with its line; without it the file is read."""
    head = "dt = 0.01\nduration = 0.5\n" + before
    if "[[sines]]" not in table:  # drag cannot be less than zero
        load(file(tmp_path, head + table), {})
    with pytest.raises(InputError) as refused:
        load(file(tmp_path, f"{head}{table}colour = 1\n"), {})
    line = (head + table).count("\n") + 1
    assert f"hill.toml, line {line}: " in str(refused.value)
    assert "unknown key 'colour'" in str(refused.value)


def test_a_mesh_has_no_diagonals_and_springs_push_and_pull_unless_that_is_said(tmp_path: Path) -> None:
    """Two triangles' square has four sides and no more; its springs are linear."""
    (tmp_path / "square.obj").write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n")
    text = '[mesh]\nfile = "square.obj"\ntotal_mass = 1\nstiffness = 1\n'
    system = load(file(tmp_path, text), {}).system
    assert (len(system.springs), system.nonlinear) == (4, None)
    assert len(load(file(tmp_path, text + "diagonals = true\n"), {}).system.springs) == 6


def test_a_name_and_a_file_are_told_apart(tmp_path: Path) -> None:
    """By the ending, or by there being one."""
    written = file(tmp_path, 'scene = "string"\n[parameters]\nmasses = 3\n')
    assert [is_file(str(written)), is_file(str(tmp_path / "none.toml")), is_file("string")] == [True, True, False]
    assert is_file(str(tmp_path / "mesh.obj"))
    by_file = setup_for(str(written), dt=2e-3, duration=0.1, settings={"drag": "0.5"})
    by_name = setup_for("string", dt=2e-3, duration=0.1, settings={"masses": "3", "drag": "0.5"})
    for setup in (by_file, by_name):
        assert (setup.dt, setup.duration, len(setup.system.masses), setup.system.drag) == (2e-3, 0.1, 4, 0.5)
        assert setup.changes == ()
    assert setup_for("string").system.drag == 0.0


def test_what_is_driven_cannot_be_changed_besides() -> None:
    """By one's own changes or the scene's; another parameter can."""
    sway = Sine("stiffness", 0.0, 10.0, 2.0)
    drag, stiffness = Change(0.01, "drag", 0.5), Change(0.02, "stiffness", 100.0)
    both = setup_for("string", duration=0.05, changes=(drag,), drives=(sway,)).changes
    assert both[0] == drag
    assert {change.parameter for change in both[1:]} == {"stiffness"}
    with pytest.raises(InputError, match=r"^stiffness is driven, and changed besides: expected one of the two$"):
        setup_for("string", changes=(drag, stiffness), drives=(sway,))
    with pytest.raises(InputError, match=r"^gravity is driven, and changed besides"):
        setup_for("earthquake", drives=(Sine("gravity", 0.0, 1.0, 2.0),))


def test_of_several_that_are_driven_and_changed_the_first_by_name_is_told(tmp_path: Path) -> None:
    """In a scene file."""
    text = "dt = 0.01\nduration = 0.5\n" + SYSTEM
    for name in ("stiffness", "drag"):
        text += f'[[ramps]]\nparameter = "{name}"\nbegin = 0.1\nend = 0.2\nvalue = 20\n'
        text += f'[[changes]]\ntime = 0.3\nparameter = "{name}"\nvalue = 30\n'
    with pytest.raises(InputError, match="drag is driven, and changed besides: expected one of the two"):
        load(file(tmp_path, text), {})


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("mass = true", "parameters.mass = True: expected a number or a list of numbers"),
        ("tension_only = [true]", "parameters.tension_only = [True]: expected a number or a list of numbers"),
        ('tension_only = "yes"', "parameters.tension_only = 'yes': expected a number or a list of numbers"),
        ("radii = true", "parameters.radii = True: expected a number or a list of numbers"),
    ],
)
def test_yes_and_no_are_words_of_what_pulls_or_pushes_only(tmp_path: Path, line: str, said: str) -> None:
    """One for all springs."""
    with pytest.raises(InputError) as refused:
        load(file(tmp_path, f'scene = "string"\n[parameters]\n{line}\n'), {})
    assert str(refused.value).endswith(f", line 3: {said}")
