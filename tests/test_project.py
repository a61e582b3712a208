"""The project itself: which way imports point, style and types, the lock, what is kept out of the repository."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
import yaml
from packaging.requirements import Requirement

from experiments.experiment import experiments
from reference.lecture.listings import listings
from reference.scenes import scenes
from reference.schemes.catalogue import schemes
from tests.import_graph import ROOMS, circles, import_graph, modules, modules_imported, modules_named
from tests.parts import LONGEST

ROOT = Path(__file__).parents[1]

#: Of the reference, the files that must work in a bare environment.
BARE_REFERENCE = (
    "axes",
    "bisection",
    "cache",
    "changes",
    *(f"collisions.{name}" for name in ("round_masses",)),
    "collisions",
    "checked_numbers",
    "checked_springs",
    "errors",
    "growth_factor",
    "lengths",
    "limit",
    "line",
    "measured_stability",
    "pulls",
    *(f"obstacles.{name}" for name in ("kinds", "obstacle", "validation")),
    "obstacles",
    "outcome",
    "scratch",
    "registry",
    *(
        f"scenes.{name}"
        for name in ("barrier", "cloths", "drape", "lattices", "line", "parameters", "strings", "trusses")
    ),
    "scenes",
    "spring_frequencies",
    *(f"springs.{name}" for name in ("breaking", "kinds", "linear_law", "nonlinear_law")),
    "springs",
    "state",
    "system",
)

#: What may be imported at the top of the files that must work in a bare environment, beside the standard library.
LIGHT = ["numpy", "engines"]
LIGHT += [f"reference.{name}" for name in BARE_REFERENCE]

#: Those files.
BARE = [ROOT / "reference" / f"{name.replace('.', '/')}.py" for name in BARE_REFERENCE]
BARE = [file if file.exists() else file.with_suffix("") / "__init__.py" for file in BARE]
BARE += sorted((ROOT / "engines").rglob("*.py"))


def check_direction(room: str, source: str) -> None:
    """A file of a room imports no room in front of it."""
    allowed = ROOMS[: ROOMS.index(room) + 1]
    for module in modules_imported(source, everywhere=True):
        top = module.split(".")[0]
        assert top not in ROOMS or top in allowed, f"{room} imports {module}"
        assert top != "tests", f"{room} imports the tests"
        assert top != "springlab" or room == "report", f"{room} imports the public module"


def check_named(module: str, source: str) -> None:
    """A file's strings name modules of its own room and those behind it; commands only their entry point names."""
    room = ROOMS.index(module.split(".")[0])
    for named in modules_named(source, modules()):
        assert named.split(".")[0] in ROOMS[: room + 1], f"a string in {module} names {named}"
        commands = f"{named}.".startswith("report.commands.")
        assert not commands or module == "report.commands.main", f"a string in {module} names {named}"


def check_bare(source: str) -> None:
    """A file imports, when it is imported, only the standard library, NumPy, and what is as light as itself."""
    for module in modules_imported(source, everywhere=False):
        known = module.split(".")[0] in sys.stdlib_module_names
        assert known or any(f"{module}.".startswith(f"{light}.") for light in LIGHT), f"it imports {module}"


@pytest.mark.parametrize("room", ROOMS)
def test_imports_point_one_way(room: str) -> None:
    """From the report to the experiments, to the engines, to the reference: never back."""
    files = sorted((ROOT / room).rglob("*.py"))
    assert files
    for file in files:
        check_direction(room, file.read_text(encoding="utf-8"))


def test_there_is_no_circle_of_imports() -> None:
    """Neither at the top of files, nor in functions, nor for types alone."""
    assert circles(import_graph({name: file.read_text(encoding="utf-8") for name, file in modules().items()})) == []


def test_a_circle_is_caught_wherever_the_import_stands() -> None:
    """Shown to fail: of two and of three modules, in a function, for types alone; and without one all is well."""
    at_top, in_function = "from b import x", "def f():\n    import a"
    for_types = "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from a import X"
    for back in (in_function, for_types, "import a"):
        assert circles(import_graph({"a": at_top, "b": back, "c": "import a"})) == [{"a", "b"}]
        assert circles(import_graph({"a": at_top, "b": "import c.d", "c.d": back})) == [{"a", "b", "c.d"}]
    assert circles(import_graph({"a": "import a"})) == [{"a"}]
    assert circles(import_graph({"a": "import b, c", "b": "import c", "c": "import numpy"})) == []


@pytest.mark.parametrize("room", ROOMS)
def test_strings_name_no_module_of_another_room(room: str) -> None:
    """What is imported by a name in a string keeps to the direction of imports, too."""
    for name, file in modules().items():
        if name.split(".")[0] == room:
            check_named(name, file.read_text(encoding="utf-8"))


def test_a_module_of_another_room_in_a_string_is_caught() -> None:
    """Shown to fail, as a whole string, as its part, in an f-string; docstrings and other words are free."""
    for wrong in ('x = "report.page.page"', 'x = ["-m", "report.commands.main:main"]', 'x = f"report.figures.{y}"'):
        with pytest.raises(AssertionError):
            check_named("experiments.maps", wrong)
    with pytest.raises(AssertionError):
        check_named("report.page.page", 'x = f"report.commands.{y}"')
    check_named("report.commands.main", 'x = f"report.commands.{y}"')
    check_named(
        "experiments.maps", '"""See report.page.page."""\nx = "report.html", "the report. figures", "experiments.maps"'
    )


@pytest.mark.parametrize("file", BARE, ids=lambda file: str(file.relative_to(ROOT)))
def test_what_runs_in_a_bare_environment_imports_nothing_heavy(file: Path) -> None:
    """So that an engine of another version can run with nothing but NumPy beside it."""
    check_bare(file.read_text(encoding="utf-8"))


def test_an_import_in_the_wrong_direction_is_caught() -> None:
    """Shown to fail, wherever in a file it stands; and the right direction passes."""
    for wrong in ("import engines.engine", "def f():\n    from report import page", "from tests.wrong import x"):
        with pytest.raises(AssertionError):
            check_direction("reference", wrong)
        with pytest.raises(AssertionError):
            check_bare(f"import scipy\n{wrong}")
    check_direction("report", "from experiments import comparison\nimport reference.state, numpy")
    check_bare("import os, numpy as np\nfrom reference.state import State\ndef f():\n    import mujoco")
    for heavy in ("import mujoco", "from reference.forces import SpringMotion", "if 1:\n    import numba"):
        with pytest.raises(AssertionError):
            check_bare(heavy)


@pytest.mark.parametrize("words", ["ruff format --check .", "ruff check .", "mypy"])
def test_style_and_types(words: str) -> None:
    """As `make check` runs them, with what pyproject.toml says."""
    if words == "mypy" and sys.version_info >= (3, 12):
        pytest.skip("types are checked with Python 3.11: the NumPy that is locked for later ones types them otherwise")
    done = subprocess.run([sys.executable, "-m", *words.split()], capture_output=True, text=True, cwd=ROOT)
    assert done.returncode == 0, done.stdout[-4000:] + done.stderr[-2000:]


def test_what_is_tested_first_is_there() -> None:
    """The files that take longest, by their names."""
    assert [file for file in LONGEST if not (ROOT / file).is_file()] == []


def locked() -> dict[str, str]:
    """The entries of requirements.lock, each on one line, by name."""
    text = (ROOT / "requirements.lock").read_text(encoding="utf-8").replace("\\\n", " ")
    lines = [line.strip() for line in text.splitlines() if line.strip() and not line.startswith("#")]
    return {re.split(r"[=<>!~ ;\[@]", line)[0]: line for line in lines}


def test_every_locked_package_has_one_version_and_hashes() -> None:
    """So that what is installed is what was tested, whoever hands it out."""
    for name, line in locked().items():
        assert re.match(rf"{re.escape(name)}==[\w.!+]+( ;|\s)", line), line[:80]
        assert re.search(r"--hash=sha256:[0-9a-f]{64}\b", line), f"{name} has no hash"


def test_the_lock_names_no_address() -> None:
    """No index, no link, no path: where packages come from is the machine's own business."""
    text = (ROOT / "requirements.lock").read_text(encoding="utf-8")
    for word in ("://", "--index-url", "--extra-index-url", "--find-links", "--trusted-host", " @ ", "file:"):
        assert word not in text


def test_the_lock_has_every_package_the_project_asks_for() -> None:
    """In a version it asks for."""
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    for text in [*settings["project"]["dependencies"], *settings["dependency-groups"]["dev"]]:
        wanted = Requirement(text)
        line = locked()[wanted.name.lower()]
        assert wanted.specifier.contains(line.split("==")[1].split()[0]), f"{text}, but {line[:60]}"


def kept_files() -> list[Path]:
    """What is in the repository, or would be with the next `git add`."""
    if shutil.which("git") is None or not (ROOT / ".git").exists():
        pytest.skip("this is no git repository")
    words = ("git", "ls-files", "-z", "--cached", "--others", "--exclude-standard")
    names = subprocess.run(words, cwd=ROOT, capture_output=True, check=True, text=True).stdout
    return [ROOT / name for name in names.split("\0") if name and (ROOT / name).is_file()]


#: Put together here, so that this file does not hold them itself.
PATHS = [f"/{folder}/" for folder in ("home", "root", "work", "Users", "mnt", "scratch")]
HOSTS = [".".join(parts) for parts in (("pypi", "org"), ("pythonhosted", "org"), ("anaconda", "org"))]


def test_no_file_names_a_folder_of_a_machine_or_a_registry() -> None:
    """A clone works anywhere, and packages come from wherever the machine gets them."""
    for file in kept_files():
        text = file.read_bytes().decode(errors="replace")
        found = [word for word in [*PATHS, *HOSTS] if word in text]
        assert not found, f"{file.relative_to(ROOT)} holds {found}"


def test_nothing_that_is_made_is_kept() -> None:
    """No results, caches, environments, compiled files."""
    for file in kept_files():
        name = str(file.relative_to(ROOT))
        assert not re.search(r"(^|/)(results|\.venv|__pycache__|\.mypy_cache|\.ruff_cache|\.hypothesis)/", name), name
        assert file.suffix not in (".pyc", ".nbi", ".nbc", ".so", ".db"), name


def test_at_the_top_stands_what_belongs_there() -> None:
    """The folders that are fixed, the papers, and what tools look for there; nothing that a run has left."""
    rooms = {"reference", "engines", "experiments", "tests", "report"}
    papers = {"README.md", "CONTRIBUTING.md", "CHANGELOG.md", "SECURITY.md", "CITATION.cff", "LICENSE"}
    tools = {
        "Makefile",
        "pyproject.toml",
        "requirements.lock",
        ".ci",
        ".github",
        ".gitignore",
        ".pre-commit-config.yaml",
    }
    assert {file.relative_to(ROOT).parts[0] for file in kept_files()} <= rooms | papers | tools


def test_the_papers_are_there() -> None:
    """And the licence is BSD-3-Clause, in its own words."""
    for name in (
        "README.md",
        "CONTRIBUTING.md",
        "CHANGELOG.md",
        "LICENSE",
        "Makefile",
        "requirements.lock",
        "SECURITY.md",
    ):
        assert (ROOT / name).stat().st_size > 0
    licence = " ".join((ROOT / "LICENSE").read_text(encoding="utf-8").split())
    for words in (
        "Redistribution and use in source and binary forms, with or without modification, are permitted",
        "1. Redistributions of source code must retain the above copyright notice",
        "2. Redistributions in binary form must reproduce the above copyright notice",
        "3. Neither the name of the copyright holder nor the names of its contributors may be used",
    ):
        assert words in licence


def test_the_version_is_the_same_everywhere() -> None:
    """In pyproject.toml, in CITATION.cff with its date, and as the newest heading of the changelog."""
    version = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"]
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    headings = re.findall(r"^## (.+)$", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), re.MULTILINE)
    assert citation["version"] == version
    assert headings[:2] == ["Unreleased", f"{version} ({citation['date-released']})"]


def test_issue_forms_can_be_read() -> None:
    """Each with a name, a description, and fields that have labels."""
    forms = [file for file in (ROOT / ".github" / "ISSUE_TEMPLATE").glob("*.yml") if file.name != "config.yml"]
    assert len(forms) == 3
    for file in forms:
        form = yaml.safe_load(file.read_text(encoding="utf-8"))
        assert form["name"]
        assert form["description"]
        assert all(field["attributes"]["label"] for field in form["body"])


def test_continuous_integration_runs_make_test() -> None:
    """From wherever it is called; and the Makefile has the project's two commands."""
    script = ROOT / ".ci" / "run"
    assert re.search(r"^make test$", script.read_text(encoding="utf-8"), re.MULTILINE)
    assert script.stat().st_mode & 0o111
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    for target in ("report", "test", "help"):
        assert re.search(rf"^{target}:", makefile, re.MULTILINE)


SUMMARIES = {
    **{name: scheme.summary for name, scheme in schemes().items()},
    **{name: scene.summary for name, scene in scenes().items()},
    **{name: listing.summary for name, listing in listings().items()},
    **{name: experiment.question for name, experiment in experiments().items()},
}


@pytest.mark.parametrize("name", SUMMARIES)
def test_what_is_listed_is_said_in_a_sentence(name: str) -> None:
    """It begins with a capital, ends with a full stop or a question mark, and fits on a line."""
    summary = SUMMARIES[name]
    assert summary[0].isupper()
    assert summary[-1] in ".?"
    assert 20 < len(summary) <= 120
    assert "\n" not in summary
