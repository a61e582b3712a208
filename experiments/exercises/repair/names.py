"""The names that a program has for its values: what may be taken for each other.

Imports Python's own library only; see `source_edits`.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

#: What modules are called, and an object itself: they have no fields that are values.
MODULES = ("np", "numpy", "math", "self")

#: What says whose a file is.
HEADER = ("EXERCISE", "SEED", "KEYED")


@dataclass(frozen=True)
class Names:
    """The names in a function or a class.

    Attributes:
        own: of variables, arguments, and numbers outside of functions; none of modules.
        fields: by object, what is read of it, or can be.
        unread: fields that are given and never read, as in "string.drag".
        loops: those of `own` that loops count. arrays: those that have an index somewhere.
        has_numpy: whether NumPy is called np in the program.
    """

    own: list[str]
    fields: Mapping[str, list[str]]
    unread: list[str]
    loops: list[str]
    arrays: list[str]
    has_numpy: bool

    @property
    def values(self) -> list[str]:
        """All that a value may be taken from: fields of objects."""
        return [f"{owner}.{name}" for owner, names in self.fields.items() if owner not in MODULES for name in names]


def names_in(top: ast.stmt, tree: ast.Module, given: Mapping[str, Sequence[str]]) -> Names:
    """The names in a statement of a program.

    Args:
        given: the fields that functions are given, by the name of the function: those of its last argument.
    """
    fields = _read_fields(top)
    own = _distinct([name for name in [*_variables(top), *_numbers(tree)] if name not in MODULES])
    read = {node.attr for node in ast.walk(tree) if isinstance(node, ast.Attribute)}
    unread: list[str] = []
    for owner, attributes in _given_fields(tree, given):
        if owner in own:
            fields[owner] = _distinct([*fields.get(owner, []), *attributes])
            unread = [f"{owner}.{name}" for name in attributes if name not in read]
    has_numpy = any(isinstance(node, ast.alias) and node.asname == "np" for node in ast.walk(tree))
    return Names(own, fields, unread, _distinct(_counted(top)), _indexed(top), has_numpy)


def _distinct(names: Sequence[str]) -> list[str]:
    return list(dict.fromkeys(names))


def _variables(top: ast.AST) -> list[str]:
    """Names that are read or written, but for those of functions that are called."""
    called = {node.func for node in ast.walk(top) if isinstance(node, ast.Call)}
    found: list[str] = []
    for node in ast.walk(top):
        if isinstance(node, ast.arg):
            found.append(node.arg)
        elif isinstance(node, ast.Name) and node not in called:
            found.append(node.id)
    return found


def _read_fields(top: ast.AST) -> dict[str, list[str]]:
    """By object, the attributes that are read of it."""
    called = {node.func for node in ast.walk(top) if isinstance(node, ast.Call)}
    found: dict[str, list[str]] = {}
    for node in ast.walk(top):
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node not in called:
            found.setdefault(node.value.id, []).append(node.attr)
    return {owner: _distinct(names) for owner, names in found.items()}


def _numbers(tree: ast.Module) -> list[str]:
    """Names that are assigned outside of functions, but for those that say whose a file is."""
    targets = [target for s in tree.body if isinstance(s, ast.Assign) for target in s.targets]
    names = [node.id for target in targets for node in ast.walk(target) if isinstance(node, ast.Name)]
    return [name for name in names if name not in HEADER]


def _given_fields(tree: ast.Module, given: Mapping[str, Sequence[str]]) -> Iterator[tuple[str, Sequence[str]]]:
    """The name that a program has for what it is given fields of, and these."""
    for function in ast.walk(tree):
        if isinstance(function, ast.FunctionDef) and function.name in given and function.args.args:
            yield function.args.args[-1].arg, given[function.name]


def _counted(top: ast.AST) -> list[str]:
    """The names that loops count."""
    targets = [node.target for node in ast.walk(top) if isinstance(node, ast.For | ast.comprehension)]
    return [node.id for target in targets for node in ast.walk(target) if isinstance(node, ast.Name)]


def _indexed(top: ast.AST) -> list[str]:
    """The names that have an index somewhere."""
    nodes = [node.value for node in ast.walk(top) if isinstance(node, ast.Subscript)]
    return _distinct([node.id for node in nodes if isinstance(node, ast.Name)])
