r"""Small changes of a program's text, on its syntax tree: what a slip of the pen would undo.

A change replaces nodes of the tree in place and puts them back (`Edit.applied`), so that thousands can be tried on one
tree. The same text has the same changes in the same order, so that one is known by its number. Used in the process of
a submission, too: it imports Python's own library only.

>>> tree = ast.parse("def f(a, b):\n    return a - b")
>>> with edits_of(tree)[0].applied():
...     print(ast.unparse(tree.body[0].body[0]))
return a + b
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from experiments.exercises.repair.expression_edits import UNUSED, binary, expression, renewed, replacements

#: Where a node stands: what holds it, in which field, and at which place of a list.
Site = tuple[ast.AST, str, "int | None"]


@dataclass(frozen=True, eq=False)
class Edit:
    """One change.

    Attributes:
        line: of the text, from 1.
        family: of which kind it is, for the student: operator, sign, factor, index, name, condition, copy, order,
            left out, too much, axis.
        cost: how far from the text it is; likelier changes cost less.
        sites: where, and what is put there.
    """

    line: int
    family: str
    cost: float
    sites: tuple[tuple[Site, Any], ...]

    @contextmanager
    def applied(self) -> Iterator[None]:
        """The tree with this change, for a while."""
        before = [(site, _get(site)) for site, _ in self.sites]
        for site, new in self.sites:
            _put(site, new)
        try:
            yield
        finally:
            for site, old in reversed(before):
                _put(site, old)


def _get(site: Site) -> Any:
    holder, name, place = site
    value = getattr(holder, name)
    return value if place is None else value[place]


def _put(site: Site, new: Any) -> None:
    holder, name, place = site
    if place is None:
        setattr(holder, name, new)
    else:
        getattr(holder, name)[place] = new


def functions_of(tree: ast.Module) -> list[ast.FunctionDef]:
    """All functions and methods."""
    return [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)]


def without_main(tree: ast.Module) -> ast.Module:
    """The tree without what is done when the file is run."""
    tree.body = [s for s in tree.body if not (isinstance(s, ast.If) and "__main__" in ast.dump(s.test))]
    return tree


def edits_of(tree: ast.Module, given: Mapping[str, Sequence[str]] | None = None) -> list[Edit]:
    """All changes of the functions of a program, cheapest first; and of its numbers and lambdas outside of them.

    Args:
        given: the fields that the functions are given, by the name of the function: those of its last argument.
    """
    found: list[Edit] = []
    fields = dict(_given_fields(tree, given or {}))
    read = {node.attr for node in ast.walk(tree) if isinstance(node, ast.Attribute)}
    numbers = _module_names(tree)
    for statement in tree.body:
        if isinstance(statement, ast.FunctionDef | ast.ClassDef | ast.Assign):
            names = _names(statement)
            names[""] = list(dict.fromkeys([*names[""], *numbers]))
            for owner, attributes in fields.items():
                if owner in names[""]:
                    names[owner] = list(dict.fromkeys([*names.get(owner, []), *attributes]))
                    names[UNUSED] = [f"{owner}.{name}" for name in attributes if name not in read]
            for site in _sites(statement):
                found += _changes(site, names)
    found += [edit for function in functions_of(tree) for edit in _of_function(function)]
    return sorted(found, key=lambda edit: edit.cost)


def _module_names(tree: ast.Module) -> list[str]:
    """Names that are assigned outside of functions, but for those that say whose a file is."""
    targets = [target for s in tree.body if isinstance(s, ast.Assign) for target in s.targets]
    names = [node.id for target in targets for node in ast.walk(target) if isinstance(node, ast.Name)]
    return [name for name in dict.fromkeys(names) if name not in ("EXERCISE", "SEED", "KEYED")]


def _given_fields(tree: ast.Module, given: Mapping[str, Sequence[str]]) -> Iterator[tuple[str, Sequence[str]]]:
    """The name that a program has for what it is given fields of, and these."""
    for function in functions_of(tree):
        if function.name in given and function.args.args:
            yield function.args.args[-1].arg, given[function.name]


def _sites(top: ast.AST) -> Iterator[Site]:
    """Every place below where an expression or a statement stands."""
    for holder in ast.walk(top):
        for name, value in ast.iter_fields(holder):
            if isinstance(value, list):
                yield from ((holder, name, i) for i, item in enumerate(value) if isinstance(item, ast.expr | ast.stmt))
            elif isinstance(value, ast.expr):
                yield holder, name, None


def _names(top: ast.AST) -> dict[str, list[str]]:
    """Names that are read or written in it, as "", and by object the attributes that are read of it."""
    names: dict[str, list[str]] = {"": []}
    called = {node.func for node in ast.walk(top) if isinstance(node, ast.Call)}
    for node in ast.walk(top):
        if isinstance(node, ast.arg):
            names[""].append(node.arg)
        elif isinstance(node, ast.Name) and node not in called:
            names[""].append(node.id)
        elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node not in called:
            names.setdefault(node.value.id, []).append(node.attr)
    return {owner: list(dict.fromkeys(used)) for owner, used in names.items()}


def _changes(site: Site, names: dict[str, list[str]]) -> Iterator[Edit]:
    """The changes at one place."""
    node = _get(site)
    line = getattr(node, "lineno", 0)
    holder, field_, _ = site
    if field_ in ("decorator_list", "annotation", "returns", "bases"):
        return
    if isinstance(getattr(node, "ctx", None), ast.Store | ast.Del) and not isinstance(node, ast.Subscript):
        return
    for family, cost, new in replacements(node, names, holder):
        yield Edit(line, family, cost, ((site, new),))


def _of_function(function: ast.FunctionDef) -> Iterator[Edit]:
    """Changes of whole statements: one left out, twice there, in another order, on another level."""
    own = [a.arg for a in function.args.args if a.arg != "self"]
    for name in own:
        copied = _statement(f"{name} = {name}.copy()", function.body[0])
        body = [copied, *function.body]
        yield Edit(function.lineno, "copy", 1.7, (((function, "body", None), body),))
    if len(own) > 1:
        both = [_statement(f"{name} = {name}.copy()", function.body[0]) for name in own[:2]]
        yield Edit(function.lineno, "copy", 1.8, (((function, "body", None), [*both, *function.body]),))
    for holder in ast.walk(function):
        for name in ("body", "orelse"):
            block = getattr(holder, name, None)
            if isinstance(block, list) and block and isinstance(block[0], ast.stmt):
                yield from _of_block(holder, name, block)
    yield from _of_old_values(function, own)


def _of_block(holder: ast.AST, name: str, block: Sequence[ast.stmt]) -> Iterator[Edit]:
    place: Site = (holder, name, None)
    for i, statement in enumerate(block):
        before, after = block[:i], block[i + 1 :]
        if after:
            swapped = [*before, after[0], statement, *after[1:]]
            yield Edit(after[0].lineno, "order", 1.9, ((place, swapped),))
        if isinstance(statement, ast.If):
            for kept in (statement.body, statement.orelse):
                yield Edit(
                    statement.lineno,
                    "condition",
                    2.1,
                    ((place, [*before, *(kept or [ast.copy_location(ast.Pass(), statement)]), *after]),),
                )
        if isinstance(statement, ast.For | ast.While | ast.If | ast.With) and len(statement.body) > 1:
            last = statement.body[-1]
            rest = renewed(statement, body=statement.body[:-1])
            yield Edit(last.lineno, "order", 1.6, ((place, [*before, rest, last, *after]),))
        if isinstance(statement, ast.For) and after:
            more = renewed(statement, body=[*statement.body, after[0]])
            yield Edit(after[0].lineno, "order", 2.0, ((place, [*before, more, *after[1:]]),))
        if isinstance(statement, ast.AugAssign) and isinstance(statement.target, ast.Subscript):
            for extra in _reactions(statement):
                yield Edit(statement.lineno, "left out", 2.2, ((place, [*before, statement, extra, *after]),))
        if isinstance(holder, ast.For) and isinstance(holder.target, ast.Name) and not isinstance(statement, ast.If):
            for test in (f"{holder.target.id} > 0", f"{holder.target.id} == 0"):
                guarded = ast.copy_location(ast.If(expression(test, statement), [statement], []), statement)
                yield Edit(statement.lineno, "condition", 2.0, ((place, [*before, guarded, *after]),))


def _statement(text: str, at: ast.stmt) -> ast.stmt:
    made = ast.parse(text).body[0]
    for node in ast.walk(made):
        ast.copy_location(node, at)
    return made


def _reactions(statement: ast.AugAssign) -> Iterator[ast.stmt]:
    """What the same term does to a neighbour, the other way: F[i - 1] -= f beside F[i] += f."""
    target = statement.target
    assert isinstance(target, ast.Subscript)
    opposite = {ast.Add: ast.Sub, ast.Sub: ast.Add}.get(type(statement.op))
    index = target.slice.elts[0] if isinstance(target.slice, ast.Tuple) else target.slice
    if opposite is None or not isinstance(index, ast.Name):
        return
    for operator, test in ((ast.Sub(), f"{index.id} > 0"), (ast.Add(), None)):
        shifted: ast.expr = binary(index, operator, ast.copy_location(ast.Constant(1), index))
        if isinstance(target.slice, ast.Tuple):
            shifted = renewed(target.slice, elts=[shifted, *target.slice.elts[1:]])
        extra: ast.stmt = renewed(statement, target=renewed(target, slice=shifted), op=opposite())
        if test:
            extra = ast.copy_location(ast.If(expression(test, statement), [extra], []), statement)
        yield extra


def _of_old_values(function: ast.FunctionDef, own: Sequence[str]) -> Iterator[Edit]:
    """What is read after it was written over: the value that the function was given, in its place."""
    written = {
        n.id for n in ast.walk(function) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store) and n.id in own
    }
    for name in sorted(written):
        keep = _statement(f"_{name}_given = {name}.copy() if hasattr({name}, 'copy') else {name}", function.body[0])
        body: tuple[Site, Any] = ((function, "body", None), [keep, *function.body])
        reads = [s for s in _sites(function) if _reads(_get(s), name)]
        by_line: dict[int, list[Site]] = {}
        for site in reads:
            by_line.setdefault(_get(site).lineno, []).append(site)
        for line, sites in by_line.items():
            groups = [sites, *([site] for site in sites if len(sites) > 1)]
            for group in groups:
                # a site in the function's own list of statements would be lost with that list; expressions are not
                put = tuple((site, expression(f"_{name}_given", _get(site))) for site in group)
                yield Edit(line, "order", 1.9, (*put, body))


def _reads(node: ast.AST, name: str) -> bool:
    return isinstance(node, ast.Name) and node.id == name and isinstance(node.ctx, ast.Load)
