"""Which module of the project imports which, wherever in its file; circles; and modules that strings name."""

from __future__ import annotations

import ast
import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[1]

#: Each room, and what it may import of the rooms: itself and those before it.
ROOMS = ("reference", "engines", "experiments", "report")

#: What may be the name of a module of the project.
NAME = re.compile(rf"\b(?:{'|'.join(ROOMS)})(?:\.[A-Za-z_]\w*)+")


@cache
def modules() -> dict[str, Path]:
    """The files of the rooms by the names of their modules."""
    found = {}
    for room in ROOMS:
        for file in sorted((ROOT / room).rglob("*.py")):
            parts = file.relative_to(ROOT).with_suffix("").parts
            found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = file
    return found


@cache
def modules_imported(source: str, everywhere: bool) -> Sequence[str]:
    """The modules a source text imports: everywhere, or only when it is imported itself.

    Of `from module import name` it is module.name, whatever the name is.
    """
    return tuple(_imported(source, everywhere))


def _imported(source: str, everywhere: bool) -> Iterator[str]:
    waiting: list[ast.AST] = [ast.parse(source)]
    while waiting:
        node = waiting.pop()
        if isinstance(node, ast.Import):
            yield from (name.name for name in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, "imports are written out in full"
            yield from (f"{node.module}.{name.name}" for name in node.names)
        asked = node.test if isinstance(node, ast.If) else None
        typing_only = isinstance(asked, ast.Name) and asked.id == "TYPE_CHECKING"
        later = isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda)
        if everywhere or not (typing_only or later):
            waiting += ast.iter_child_nodes(node)


def import_graph(sources: Mapping[str, str]) -> dict[str, set[str]]:
    """For each module of some source texts, those of the others it imports anywhere, also for types alone."""
    return {
        module: {_module_of(name, sources) for name in modules_imported(source, everywhere=True)} - {""}
        for module, source in sources.items()
    }


def circles(graph: Mapping[str, Collection[str]]) -> list[set[str]]:
    """The sets of modules that import one another: strongly connected components (Tarjan, SIAM J. Comput. 1972)."""
    index: dict[str, int] = {}
    lowest: dict[str, int] = {}
    stack: list[str] = []
    found = []

    def visit(module: str) -> None:
        index[module] = lowest[module] = len(index)
        stack.append(module)
        for other in graph[module]:
            if other not in index:
                visit(other)
            if other in stack:
                lowest[module] = min(lowest[module], lowest[other])
        if lowest[module] == index[module]:
            start = stack.index(module)
            component = set(stack[start:])
            del stack[start:]
            if len(component) > 1 or module in graph[module]:
                found.append(component)

    for module in graph:
        if module not in index:
            visit(module)
    return found


def modules_named(source: str, known: Collection[str]) -> set[str]:
    """The modules whose names stand in strings of a source text, docstrings aside; the parts of f-strings, too."""
    prose: set[int] = set()
    strings: list[str] = []
    for node in ast.walk(ast.parse(source)):  # what an expression is of comes before it
        if isinstance(node, ast.Expr):
            prose.add(id(node.value))
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in prose:
            strings.append(node.value)
    return {_module_of(name, known) for text in strings for name in NAME.findall(text)} - {"", *ROOMS}


def _module_of(name: str, known: Collection[str]) -> str:
    """The module that a dotted name is, or is something of; empty where it is none of the known ones."""
    while name and name not in known:
        name = name.rpartition(".")[0]
    return name
