"""The same change at several places that are alike: who errs at one of them mostly errs at the others too.

x and y components are written one below the other; one expression is used twice in a line; both ends of a spring are
entered in the same way. Imports Python's own library only; see `source_edits`.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from experiments.exercises.repair.edit import Edit, Site, sites_in, what_stands_at
from experiments.exercises.repair.expression_edits import replacements
from experiments.exercises.repair.index_edits import other_indices, with_index
from experiments.exercises.repair.names import Names
from experiments.exercises.repair.nodes import Replacement, binary, expression, renewed

#: How much more than one change the same change at several places costs.
MORE = 0.1

#: Of how many statements in a row the same change is tried.
LONGEST_ROW = 4


def of_alike(top: ast.stmt, names: Names) -> Iterator[Edit]:
    """All changes of places that are alike, in a function or class."""
    for holder in ast.walk(top):
        for name in ("body", "orelse"):
            block = getattr(holder, name, None)
            if isinstance(block, list):
                yield from _of_rows(holder, name, block, names)
                for statement in block:
                    if isinstance(statement, ast.Assign | ast.AugAssign | ast.Return | ast.Expr):
                        yield from _of_one_statement(statement, names)


def _of_rows(holder: ast.AST, name: str, block: Sequence[ast.stmt], names: Names) -> Iterator[Edit]:
    """Statements one below the other that differ in names, numbers and indices only: all changed in the same way."""
    shapes = [_shape(statement) for statement in block]
    for i in range(len(block)):
        for count in range(2, LONGEST_ROW + 1):
            row = list(block[i : i + count])
            if len(row) < count or len(set(shapes[i : i + count])) > 1 or isinstance(block[i], ast.Expr):
                break
            tops = [(holder, name, i + k) for k in range(count)]
            places = [[top, *sites_in(statement)] for top, statement in zip(tops, row, strict=True)]
            yield from _in_step(places, names)


def _shape(node: ast.AST) -> str:
    """What kind of nodes it is made of."""
    return " ".join(type(inner).__name__ for inner in ast.walk(node))


def _in_step(places: Sequence[Sequence[Site]], names: Names) -> Iterator[Edit]:
    """The n-th place of each, changed in the same way, whatever the names there are."""
    if len({len(sites) for sites in places}) > 1:
        return
    for sites in zip(*places, strict=True):
        nodes = [what_stands_at(site) for site in sites]
        if any(isinstance(getattr(node, "ctx", None), ast.Store) for node in nodes):
            continue
        if any(isinstance(node, ast.Name) for node in nodes):
            if len({ast.dump(node) for node in nodes}) == 1:  # other names are changed otherwise in each
                for name in names.own:
                    yield _edit(sites, [Replacement("name", 1.9, expression(name, node)) for node in nodes])
            continue
        found = [list(replacements(node, names, site[0])) for node, site in zip(nodes, sites, strict=True)]
        if len({len(changes) for changes in found}) == 1:
            for changes in zip(*found, strict=True):
                yield _edit(sites, changes)


def _of_one_statement(statement: ast.stmt, names: Names) -> Iterator[Edit]:
    """An expression that a statement has twice, changed at both places; and two parts of one array side by side."""
    by_text: dict[str, list[Site]] = {}
    by_array: dict[tuple[str, int], list[Site]] = {}
    for site in sites_in(statement):
        node = what_stands_at(site)
        if isinstance(getattr(node, "ctx", ast.Load()), ast.Store) or site[1] == "func":
            continue
        if isinstance(node, ast.Name | ast.Subscript | ast.Attribute | ast.Call):
            by_text.setdefault(ast.dump(node), []).append(site)
        if isinstance(node, ast.Subscript) and isinstance(node.value, ast.Name):
            by_array.setdefault((node.value.id, id(site[0])), []).append(site)
    for sites in by_text.values():
        if len(sites) > 1:
            first, *_ = sites
            for change in _of_a_repeated(what_stands_at(first), names):
                yield _edit(sites, [change] * len(sites))
    for sites in by_array.values():
        if len(sites) > 1:
            yield from _of_ranges(sites, names)


def _of_a_repeated(node: ast.expr, names: Names) -> Iterator[Replacement]:
    """Another value, or its distance from one."""
    for text in (*names.own, *names.values):
        yield Replacement("name", 2.2, expression(text, node))
        if "." in text:
            yield Replacement("left out", 2.1, _bracketed(node, text))
    if isinstance(node, ast.Subscript):
        for cost, new in other_indices(node.slice, names) if not isinstance(node.slice, ast.Tuple) else ():
            yield Replacement("index", cost, renewed(node, slice=new))


def _bracketed(node: ast.expr, text: str) -> ast.expr:
    return binary(node, ast.Sub(), expression(text, node))


def _of_ranges(sites: Sequence[Site], names: Names) -> Iterator[Edit]:
    """The same other index at the same place of each part of an array."""
    nodes = [what_stands_at(site) for site in sites]
    indices = [node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice] for node in nodes]
    for place in range(min(map(len, indices))):
        parts = [index[place] for index in indices]
        if len({ast.dump(part) for part in parts}) == 1:
            part, *_ = parts
            for cost, new in other_indices(part, names):
                yield _edit(sites, [Replacement("index", cost, with_index(node, place, new)) for node in nodes])


def _edit(sites: Sequence[Site], changes: Sequence[Replacement]) -> Edit:
    put = tuple((site, change.node) for site, change in zip(sites, changes, strict=True))
    line = what_stands_at(sites[0]).lineno
    change, *_ = changes
    return Edit(line, change.family, change.cost + MORE * (len(sites) - 1), put)
