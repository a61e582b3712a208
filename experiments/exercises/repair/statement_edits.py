"""Changes of whole statements: one left out, twice there, in another order, on another level; copies that are missing.

Imports Python's own library only; see `source_edits`.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from experiments.exercises.repair.edit import Edit, Site, sites_in, what_stands_at
from experiments.exercises.repair.nodes import expression, function_name, moved, renewed, statement

#: How far a statement is moved down at most.
FARTHEST = 3


def of_statements(function: ast.FunctionDef) -> Iterator[Edit]:
    """All changes of statements of a function."""
    own = [a.arg for a in function.args.args if a.arg != "self"]
    for name in own:
        copied = statement(f"{name} = {name}.copy()", function)
        yield Edit(function.lineno, "copy", 1.7, (((function, "body", None), [copied, *function.body]),))
    if len(own) > 1:
        both = [statement(f"{name} = {name}.copy()", function) for name in own[:2]]
        yield Edit(function.lineno, "copy", 1.8, (((function, "body", None), [*both, *function.body]),))
    for holder in ast.walk(function):
        for name in ("body", "orelse"):
            block = getattr(holder, name, None)
            if isinstance(block, list):
                yield from _of_block(holder, name, block)
    yield from _of_given_values(function, own)


def _of_block(holder: ast.AST, name: str, block: Sequence[ast.stmt]) -> Iterator[Edit]:
    """Changes of the statements that stand one below the other."""
    place: Site = (holder, name, None)
    for i, one in enumerate(block):
        before, after = block[:i], block[i + 1 :]
        yield from _moved_down(place, before, one, after)
        if isinstance(one, ast.If):
            for kept in [one.body, one.orelse]:
                always = kept or [ast.copy_location(ast.Pass(), one)]
                yield Edit(one.lineno, "condition", 2.1, ((place, [*before, *always, *after]),))
            match one.orelse:
                case [ast.If() as other]:
                    both = renewed(one, orelse=[]), other
                    yield Edit(other.lineno, "condition", 1.7, ((place, [*before, *both, *after]),))
        if isinstance(one, ast.For | ast.While | ast.If | ast.With) and len(one.body) > 1:
            last, rest = one.body[-1], renewed(one, body=one.body[:-1])
            yield Edit(last.lineno, "order", 1.6, ((place, [*before, rest, last, *after]),))
        if isinstance(one, ast.For) and after:
            more = renewed(one, body=[*one.body, after[0]])
            yield Edit(after[0].lineno, "order", 2.0, ((place, [*before, more, *after[1:]]),))
        if isinstance(one, ast.For):
            yield from _of_values_before(place, before, one, after)
        for extra in _left_out_after(one):
            yield Edit(one.lineno, "left out", 2.2, ((place, [*before, one, extra, *after]),))
        if isinstance(one, ast.For):
            yield from _across_the_edge(place, before, one, after)
        if isinstance(holder, ast.For) and isinstance(holder.target, ast.Name) and not isinstance(one, ast.If):
            for test in _ends_of(holder.target.id, holder.iter):
                guarded = ast.copy_location(ast.If(expression(test, one), [one], []), one)
                yield Edit(one.lineno, "condition", 2.0, ((place, [*before, guarded, *after]),))


def _across_the_edge(
    place: Site, before: Sequence[ast.stmt], loop: ast.For, after: Sequence[ast.stmt]
) -> Iterator[Edit]:
    """What is done once in place of each time, and the other way: a sum that begins at 0 too often, or too seldom."""
    if before:
        inside = renewed(loop, body=[before[-1], *loop.body])
        yield Edit(before[-1].lineno, "order", 2.0, ((place, [*before[:-1], inside, *after]),))
    if len(loop.body) > 1:
        rest = renewed(loop, body=loop.body[1:])
        yield Edit(loop.body[0].lineno, "order", 2.0, ((place, [*before, loop.body[0], rest, *after]),))


def _ends_of(name: str, over: ast.expr) -> Iterator[str]:
    """Conditions on what a loop counts, by which its first or last round is another one."""
    yield from (f"{name} > 0", f"{name} == 0")
    if isinstance(over, ast.Call) and function_name(over) == "range":
        bound = ast.unparse(over.args[min(1, len(over.args) - 1)]) if over.args else "0"
        yield from (f"{name} < {bound} - 1", f"{name} == {bound} - 1")


def _moved_down(place: Site, before: Sequence[ast.stmt], one: ast.stmt, after: Sequence[ast.stmt]) -> Iterator[Edit]:
    """A statement after one or a few of those that follow."""
    for by in range(1, min(FARTHEST, len(after)) + 1):
        line = after[0].lineno if by == 1 else one.lineno
        yield Edit(line, "order", 1.8 + 0.1 * by, ((place, [*before, *after[:by], one, *after[by:]]),))


def _left_out_after(one: ast.stmt) -> Iterator[ast.stmt]:
    """What may be missing after a statement: the other end of a force, the end of an array that was turned round."""
    if isinstance(one, ast.AugAssign) and isinstance(one.target, ast.Subscript):
        yield from _reactions(one, one.target)
    match one:
        case ast.Assign([ast.Name(name), *_], value):
            called = {function_name(node) for node in ast.walk(value) if isinstance(node, ast.Call)}
            if called & {"roll", "empty", "empty_like"}:
                for index in ("0", "-1"):
                    yield statement(f"{name}[{index}] = 0.0", one)


def _reactions(one: ast.AugAssign, target: ast.Subscript) -> Iterator[ast.stmt]:
    """What the same term does to a neighbour, the other way: F[i - 1] -= f beside F[i] += f."""
    opposite = {ast.Add: ast.Sub, ast.Sub: ast.Add}.get(type(one.op))
    index = target.slice.elts[0] if isinstance(target.slice, ast.Tuple) else target.slice
    if opposite is None or not isinstance(index, ast.Name):
        return
    for by, test in ((-1, f"{index.id} > 0"), (1, None)):
        shifted: ast.expr = moved(index, by)
        if isinstance(target.slice, ast.Tuple):
            shifted = renewed(target.slice, elts=[shifted, *target.slice.elts[1:]])
        extra: ast.stmt = renewed(one, target=renewed(target, slice=shifted), op=opposite())
        yield ast.copy_location(ast.If(expression(test, one), [extra], []), one) if test else extra


def _of_values_before(
    place: Site, before: Sequence[ast.stmt], loop: ast.For, after: Sequence[ast.stmt]
) -> Iterator[Edit]:
    """A loop that reads an array which it writes into: what was there before it, in place of that."""
    nodes = [node for node in ast.walk(loop) if isinstance(node, ast.Subscript) and isinstance(node.ctx, ast.Store)]
    written = {node.value.id: node.lineno for node in reversed(nodes) if isinstance(node.value, ast.Name)}
    read = {name: [s for s in sites_in(loop) if _reads(s, name) and not _is_written_into(s)] for name in written}
    changed = {name: sites for name, sites in read.items() if sites}
    groups = [[name] for name in changed] + ([list(changed)] if len(changed) > 1 else [])
    for group in groups:
        kept = [statement(f"_{name}_before = {name}.copy()", loop) for name in group]
        put = [(s, expression(f"_{name}_before", what_stands_at(s))) for name in group for s in changed[name]]
        for line in {written[group[0]], *(what_stands_at(site).lineno for site, _ in put[:1])}:
            yield Edit(line, "order", 1.9, (*put, (place, [*before, *kept, loop, *after])))


def _of_given_values(function: ast.FunctionDef, own: Sequence[str]) -> Iterator[Edit]:
    """What is read after it was written over: the value that the function was given, in its place."""
    stored = [n.id for n in ast.walk(function) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)]
    for name in sorted({name for name in stored if name in own}):
        keep = statement(f"_{name}_given = {name}.copy() if hasattr({name}, 'copy') else {name}", function)
        by_line: dict[int, list[Site]] = {}
        for site in sites_in(function):
            if _reads(site, name):
                by_line.setdefault(what_stands_at(site).lineno, []).append(site)
        for line, sites in by_line.items():
            for group in [sites, *([site] for site in sites if len(sites) > 1)]:
                # a site in the function's own list of statements would be lost with that list; expressions are not
                put = tuple((site, expression(f"_{name}_given", what_stands_at(site))) for site in group)
                yield Edit(line, "order", 1.9, (*put, ((function, "body", None), [keep, *function.body])))


def _reads(site: Site, name: str) -> bool:
    node = what_stands_at(site)
    return isinstance(node, ast.Name) and node.id == name and isinstance(node.ctx, ast.Load)


def _is_written_into(site: Site) -> bool:
    """Whether it is the array of an index that is assigned to: there the name itself is read."""
    return isinstance(site[0], ast.Subscript) and isinstance(site[0].ctx, ast.Store) and site[1] == "value"
