"""Bad input: one clear line on standard error, exit code 2, nothing on standard output, never a traceback."""

from __future__ import annotations

from pathlib import Path

import pytest

from reference.scenes import scenes
from report.commands.main import COMMANDS
from tests.report.commands.terminal import Said, python, springlab

#: Words after `springlab`, and what the line must say.
LINES = [
    # Unknown names, with a suggestion.
    ("comapre", "unknown command 'comapre': did you mean 'compare'?"),
    ("compare strin", "unknown scene 'strin': did you mean 'string'?"),
    ("identify heun sprig", "unknown scene 'sprig': did you mean 'spring'?"),
    ("compare --stepper huen", "unknown stepper 'huen': did you mean 'heun'?"),
    ("compare --stepper pymunk_string", "unknown stepper 'pymunk_string': did you mean 'pymunk_springs'?"),
    ("identify mujoco_tendon", "unknown stepper 'mujoco_tendon': did you mean 'mujoco_tendons'?"),
    ("compare --set stifness=3", "'stifness': did you mean 'stiffness'?"),
    ("compare --change 0.1:grvity=3", "unknown parameter 'grvity': did you mean 'gravity'?"),
    ("run divergense", "unknown experiment 'divergense': did you mean 'divergence'?"),
    ("report --only erata", "unknown experiment 'erata': did you mean 'errata'?"),
    ("compare --steper heun", "No such option '--steper'"),
    # A name like no other: all there are.
    ("compare xyz", f"unknown scene 'xyz': expected one of {', '.join(sorted(scenes()))}"),
    # Negative, zero, NaN, infinite.
    ("compare --set mass=-1", "mass = -1: expected a number > 0 [kg]"),
    ("compare --set mass=0", "mass = 0: expected a number > 0 [kg]"),
    ("compare --set mass=nan", "mass = nan: expected a finite number [kg]"),
    ("compare --set mass=0.02,-1,0.02 --set masses=3", "mass = -1: expected a number > 0 [kg]"),
    ("compare --set stiffness=-200", "stiffness = -200: expected a number >= 0 [N/m]"),
    ("compare --set stiffness=nan", "stiffness = nan: expected a finite number [N/m]"),
    ("compare --set damping=-0.1", "damping = -0.1: expected a number >= 0 [N s/m]"),
    ("compare --set drag=inf", "drag = inf: expected a finite number [N s/m]"),
    ("compare --set rest_length=0", "rest_length = 0: expected a number > 0 [m]"),
    # What does work is said.
    ("compare --set rest_length=0", "; --change 0:rest_length=0 makes it 0 from the start"),
    ("compare --set masses=0", "masses = 0: expected a whole number from 1 to 10,000,000"),
    ("compare --dt -1e-3", "dt = -0.001: expected a finite number > 0 [s]"),
    ("compare --dt 0", "dt = 0: expected a finite number > 0 [s]"),
    ("compare --dt nan", "dt = nan: expected a finite number > 0 [s]"),
    ("identify heun --dt nan", "dt = nan: expected a finite number > 0 [s]"),
    ("compare --duration -1", "duration = -1: expected a finite number > 0 [s]"),
    ("compare --duration 1e-6", "duration = 1e-06: expected at least one step of dt = 0.001 s"),
    ("compare --change -1:drag=1", "change time = -1: expected a finite number >= 0 [s]"),
    ("compare --change 0.1:stiffness=-3", "stiffness = -3: expected a number >= 0 [N/m]"),
    ("compare --change 0.1:mass=nan", "= nan: expected a finite number [kg]"),
    ("compare --change 0.1:gravity=1,2,3", "gravity has 3 numbers: expected one, or one for each of 2 axes"),
    ("compare --change 0.1:stiffness=1,2", "stiffness has 2 numbers: expected one, or one for each of 10 springs"),
    ("compare chain --change 0.1:gravity=1,2", "gravity has 2 numbers: expected one, or one for each of 1 axes"),
    ("compare chain --set angle=90", "unknown parameter of scene 'chain' 'angle'"),
    # A spring of no length.
    (
        "compare spring --set stretch=-0.125",
        "springs[0] = [0, 1]: expected a length > 0, both masses start at [0.0, 0.0]",
    ),
    # Of the wrong form.
    ("compare --dt fast", "'fast' is not a valid float"),
    ("compare --set mass=heavy", "mass = 'heavy': expected a number"),
    ("compare --set masses=2.5", "masses = '2.5': expected a whole number"),
    ("compare --set mass=1,2", "mass has 2 numbers: expected one, or one for each of 10"),
    ("compare --set drag=1,2", "drag = '1,2': expected one number"),
    ("compare --set mass", "--set 'mass': expected KEY=VALUE"),
    ("compare --change 0.1:mass", "--change '0.1:mass': expected T:KEY=VALUE with two numbers"),
    ("compare --change soon:mass=1", "--change 'soon:mass=1': expected T:KEY=VALUE with two numbers"),
    ("compare string again", "unexpected extra argument (again)"),
    ("identify", "Missing argument 'STEPPER'"),
    ("run", "Missing argument 'EXPERIMENT...'"),
    ("compare nowhere.toml", "scene file nowhere.toml: No such file or directory"),
]

MESH = "[system]\npositions = [[0.0, 0.0], [1.0, 0.0]]\nsprings = [[0, 1]]\nmasses = 1.0\nstiffness = 10.0\n"

#: A scene file, and what the line must say after its name.
FILES = {
    "a text for a number": ('scene = "string"\ndt = "fast"\n', ", line 2: dt: expected a number, got text"),
    "a text for a parameter": (
        'scene = "string"\n[parameters]\nmass = "heavy"\n',
        ", line 3: parameters.mass = 'heavy'",
    ),
    "yes for a parameter": (
        'scene = "string"\n[parameters]\nmass = true\n',
        ", line 3: parameters.mass = True: expected",
    ),
    "a text deep inside": (
        MESH.replace("[1.0, 0.0]", '[1.0, "right"]'),
        ", line 2: system.positions[1][1]: expected a number, got text",
    ),
    "a number for a name": (
        'scene = "string"\n[[changes]]\ntime = 0.1\nparameter = 5\nvalue = 1.0\n',
        ", line 4: changes[0].parameter: expected text, got a whole number",
    ),
    "an unknown key": ('scene = "string"\nduraton = 1.0\n', ", line 2: unknown key 'duraton'"),
    "an unknown scene": ('scene = "strng"\n', ": unknown scene 'strng': did you mean 'string'?"),
    "an unknown parameter": ('scene = "string"\n[parameters]\nmas = 1.0\n', "'mas': did you mean 'mass'?"),
    "no TOML": ('scene = "string\n', "line 1"),
    "not UTF-8": ('scene = "\udcff"\n', ": expected UTF-8 text"),
    "empty": ("", ': expected either scene = "..." or a table [system] or a table [mesh]'),
    "both": ('scene = "string"\n' + MESH, ': expected either scene = "..." or a table [system] or a table [mesh]'),
    "a missing node": (
        MESH.replace("[[0, 1]]", "[[0, 2]]"),
        ", line 3: springs[0] = [0, 2]: expected masses from 0 to 1",
    ),
    "a spring to itself": (MESH.replace("[[0, 1]]", "[[1, 1]]"), "springs[0] = [1, 1]: expected two different masses"),
    "a spring of no length": (MESH.replace("[1.0, 0.0]", "[0.0, 0.0]"), "springs[0] = [0, 1]: expected a length > 0"),
    "a negative stiffness": (MESH.replace("10.0", "-10.0"), ", line 5: stiffness = -10: expected a number >= 0 [N/m]"),
    "a mass that is no number": (
        MESH.replace("masses = 1.0", "masses = [1.0, nan]"),
        "line 4: masses[1] = nan: expected",
    ),
    "too few masses": (
        MESH.replace("masses = 1.0", "masses = [1.0, 1.0, 1.0]"),
        "masses has shape (3,): expected (2,)",
    ),
    "a fixed mass that is not there": (MESH + "fixed = [5]\n", "fixed[0] = 5: expected a mass from 0 to 1"),
}


def check_one_clear_line(said: Said, text: str) -> None:
    """Exit code 2, exactly one line on standard error that says it, nothing on standard output."""
    assert text in said.err
    assert said.err.startswith("springlab: ")
    assert said.err.count("\n") == 1
    assert said.err.endswith("\n")
    assert "Traceback" not in said.err
    assert said.out == ""
    assert said.code == 2


@pytest.mark.parametrize(("words", "text"), LINES)
def test_bad_words_are_one_clear_line(words: str, text: str) -> None:
    """Every case the project names, and some more."""
    check_one_clear_line(springlab(*words.split()), text)


@pytest.mark.parametrize("what", FILES)
def test_a_bad_scene_file_is_one_clear_line_that_names_it(what: str, tmp_path: Path) -> None:
    """With the key's path, and its line where it stands in the file once."""
    content, text = FILES[what]
    file = tmp_path / "bad.toml"
    file.write_bytes(content.encode(errors="surrogateescape"))
    said = springlab("compare", str(file))
    check_one_clear_line(said, text)
    assert f"scene file {file}" in said.err


@pytest.mark.rotating(4)
def test_the_same_holds_in_a_process_of_its_own(tmp_path: Path) -> None:
    """As a user sees it: nothing is printed by imports or on the way out."""
    said = python("-m", "report.commands.main", "compare", "string", "--stepper", "huen", folder=tmp_path)
    check_one_clear_line(said, "unknown stepper 'huen': did you mean 'heun'?")


def test_a_folder_that_cannot_be_written_is_one_clear_line(tmp_path: Path) -> None:
    """And so is every other trouble with files."""
    (tmp_path / "file").write_text("")
    said = springlab("compare", "--stepper", "heun", "--duration", "0.01", "--out", str(tmp_path / "file" / "folder"))
    check_one_clear_line(said, str(tmp_path / "file"))


def test_help_imports_nothing_heavy(tmp_path: Path) -> None:
    """`springlab --help` answers at once because of what it does not import; how long it takes is not timed here."""
    heavy = ("numpy", "numba", "scipy", "matplotlib", "engines", "rich", "jinja2", "msgspec")
    program = (
        "import sys; sys.argv = ['springlab', '--help']\n"
        "from report.commands.main import main\n"
        "try: main()\n"
        f"finally: print('imported:', [name for name in {heavy!r} if name in sys.modules])"
    )
    said = python("-c", program, folder=tmp_path)
    assert said.code == 0
    assert said.err == ""
    assert "imported: []" in said.out
    assert {"list", "compare", "identify", "run", "report"} <= set(COMMANDS)
    for command in COMMANDS:
        assert f"\n  {command} " in said.out


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_explains_itself(command: str) -> None:
    """Exit code 0 and how it is used."""
    said = springlab(command, "--help")
    assert said.code == 0
    assert f"Usage: springlab {command}" in said.out


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["simulate", "--set", "dt=1e-3"], "--set 'dt=1e-3': dt is no parameter of a scene: expected --dt 1e-3"),
        (["identify", "string", "heun"], "scene 'heun': that is a stepper"),
        (["compare", "--stepper", "mujoco"], "unknown stepper 'mujoco': expected one of mujoco_cable, "),
        (
            ["sweep", "--stepper", "heun", "--over", "dt=0:1:3:log"],
            "from 0 to 1 by equal factors: expected both ends > 0",
        ),
        (["sweep", "--stepper", "heun", "--over", "dt=1:2:0"], "COUNT = 0: expected at least 1"),
    ],
)
def test_what_is_often_mixed_up_has_a_way_out(words: list[str], said: str) -> None:
    """In a line."""
    done = springlab(*words)
    assert (done.code, done.out) == (2, "")
    assert said in done.err
    assert done.err.count("\n") == 1
