"""Which test files are near a source file: its mirror, then those that import it, then those that do by way of another.

Of its own room only, as far as there are any. A module that a string names counts as imported: registries import what
they hold by name.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from pathlib import Path

from engines.engine import registry, version
from tests.import_graph import import_graph, modules_named

#: How many imports away tests still are near.
FARTHEST = 2

#: Tests that run for minutes, tests of these mutants, and those of style, which every mutant offends against.
LEFT_OUT = ("tests/soak/", "tests/mutants/", "tests/test_project.py")

#: What reads all sources, quickly: near each of them.
OF_ALL = "tests/test_habits.py"

#: The suite that every engine goes through, which imports none of them.
CONFORMANCE = "conformance"


class Imports:
    """Who imports whom, in a project whose tests mirror its sources: `engines/a/b.py`, `tests/engines/a/test_b.py`."""

    def __init__(self, root: Path) -> None:
        self.root = root

    def near(self, source: str) -> list[str]:
        """The test files near a source file, nearest first, as paths from the root."""
        path = Path(source)
        home, entered = Path("tests", path.parent), engines_of(source)
        while not (self.root / home).is_dir():
            home = home.parent
        distances = self._distances(_module(path))
        found = []
        for test in self._tests:
            distance = distances.get(_module(test), FARTHEST + 1)
            if test == Path("tests", path.parent, f"test_{path.name}"):
                distance = 0
            elif entered and test.parts[1] == CONFORMANCE:
                distance = 1
            if distance <= FARTHEST or test.parent == home:
                found.append((distance, test.parent != home, test))
        own = [entry for entry in found if entry[-1].parts[1] in (path.parts[0], *[CONFORMANCE] * bool(entered))]
        near = [test.as_posix() for *_, test in sorted(own or found)]
        of_all = [OF_ALL] if (self.root / OF_ALL).exists() else []
        return [*near[:1], *of_all, *near[1:]]

    @cached_property
    def _tests(self) -> list[Path]:
        tests = sorted(file.relative_to(self.root) for file in (self.root / "tests").rglob("test_*.py"))
        return [test for test in tests if not test.as_posix().startswith(LEFT_OUT)]

    @cached_property
    def _imported_by(self) -> Mapping[str, set[str]]:
        """By module, those that import it or name it."""
        folders = [folder for folder in self.root.iterdir() if folder.is_dir() and not folder.name.startswith(".")]
        files = [file for folder in folders for file in sorted(folder.rglob("*.py"))]
        texts = {_module(file.relative_to(self.root)): file.read_text(encoding="utf-8") for file in files}
        importers: dict[str, set[str]] = {name: set() for name in texts}
        for name, imported in import_graph(texts).items():
            for other in imported | modules_named(texts[name], texts):
                importers[other].add(name)
        return importers

    def _distances(self, module: str) -> dict[str, int]:
        """How many imports away every module is that reaches this one."""
        distances = {module: 0}
        for name in (queue := [module]):
            for importer in sorted(self._imported_by.get(name, ())):
                if importer not in distances:
                    distances[importer] = distances[name] + 1
                    queue.append(importer)
        return distances


def _module(path: Path) -> str:
    parts = path.with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def engines_of(source: str) -> list[str]:
    """The engines that a file enters, or else any file of its folder: a suite of all engines need run for no others."""
    module = _module(Path(source))
    homes = {name: type(engine).__module__ for name, engine in registry().items()}
    entered = [name for name, home in homes.items() if home == module]
    return entered or [name for name, home in homes.items() if home.rpartition(".")[0] == module.rpartition(".")[0]]


def judged_here(source: str) -> bool:
    """Whether tests can run a file here: not that of an engine that is not installed."""
    entered = engines_of(source)
    return not entered or any(version(registry()[name]) is not None for name in entered)
