"""Examples in docstrings, run: they give what they say."""

from __future__ import annotations

import doctest
import importlib
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]

#: Where the public module stands.
PYTHON = ROOT / "report" / "python"


def module_of(file: Path) -> str:
    """The name that a file is imported by."""
    inside = file.relative_to(PYTHON if file.is_relative_to(PYTHON) else ROOT).with_suffix("")
    return ".".join(inside.parent.parts if inside.name == "__init__" else inside.parts)


#: The modules that have examples.
MODULES = sorted(
    module_of(file)
    for room in ("reference", "engines", "experiments", "report")
    for file in (ROOT / room).rglob("*.py")
    if re.search(r"^ *>>> ", file.read_text(encoding="utf-8"), re.MULTILINE)
)


@pytest.mark.parametrize("name", MODULES)
def test_examples_give_what_they_say(name: str) -> None:
    """Every one, in its module."""
    found = doctest.testmod(importlib.import_module(name))
    assert found.attempted > 0
    assert found.failed == 0


#: The pages with programs that import the public module.
PAGES = [
    str(file.relative_to(ROOT))
    for file in (ROOT / "README.md", *sorted((ROOT / "report" / "docs").glob("*.md")))
    if "import springlab" in file.read_text(encoding="utf-8")
]


@pytest.mark.rotating(8)
@pytest.mark.parametrize("page", PAGES)
def test_programs_of_the_pages_run(page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each from its beginning, in a folder for what it writes; what a comment behind a line says it gives, it gives."""
    monkeypatch.chdir(tmp_path)
    programs = re.findall(r"```python\n(.*?)```", (ROOT / page).read_text(encoding="utf-8"), re.DOTALL)
    for program in (p for p in programs if "import springlab" in p):
        names: dict[str, object] = {}
        exec(compile(program, page, "exec"), names)
        for line, said in re.findall(r"^(\S.*?)  # ('.*'|[\d.]+)$", program, re.MULTILINE):
            assert repr(eval(line, names)) == said


def test_an_example_that_is_wrong_is_seen() -> None:
    """Shown to fail."""
    wrong = doctest.DocTestParser().get_doctest(">>> 1 + 1\n3\n", {}, "wrong", None, None)
    assert doctest.DocTestRunner(verbose=False).run(wrong, out=lambda _: None).failed == 1
