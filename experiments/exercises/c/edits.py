"""Small changes that only a C program needs, beside those of `repair.source_edits`: of its trees (`tree`).

Whole numbers where others were meant, arrays that nobody has cleared, what a pointer leads to after it has been written
into, sizes in bytes, a semicolon or braces that end a loop too early, names that are declared twice.
"""

from __future__ import annotations

import ast
import copy
from collections.abc import Iterator, Sequence
from typing import Any

from experiments.exercises.c.kinds import NUMBER, WHOLE, Kind, Kinds, kind_in
from experiments.exercises.c.tree import ReadProgram, Verbatim, Word, c_name, functions_in
from experiments.exercises.c.written import Writer
from experiments.exercises.repair.edit import Edit, Site, sites_in, what_stands_at
from experiments.exercises.repair.nodes import binary, expression, renewed, statement

#: How whole numbers are declared.
WHOLE_TYPES = ("int ", "long ", "const int ", "const long ")

#: Into a loop or a condition so many of the statements that follow are taken.
FARTHEST = 3


def c_edits_of(program: ReadProgram) -> list[Edit]:
    """All changes of a program's functions."""
    return [edit for function in functions_in(program.tree) for edit in _Changes(program, function).all()]


class _Changes:
    """The changes of one function."""

    def __init__(self, program: ReadProgram, function: ast.FunctionDef) -> None:
        self._function = function
        self._kinds: Kinds = program.kinds[c_name(function.name)]
        self._fields = program.kinds[""]
        self._writer = Writer(program)
        self._writer.enter(function)
        self._count = self._writer.count()

    def all(self) -> Iterator[Edit]:
        """Of its expressions, then of its statements."""
        for site in sites_in(self._function):
            node = what_stands_at(site)
            if isinstance(node, ast.expr):
                yield from self._of_expression(site, node)
        for holder in ast.walk(self._function):
            for name in ("body", "orelse"):
                block = getattr(holder, name, None)
                if isinstance(block, list):
                    yield from self._of_block(holder, name, block)
        yield from self._of_given()
        yield from self._twice_declared(self._function.body, {a.arg for a in self._function.args.args})

    def _kind(self, node: ast.AST) -> Kind:
        return kind_in(node, self._kinds, self._fields)

    # expressions

    def _of_expression(self, site: Site, node: ast.expr) -> Iterator[Edit]:
        line = node.lineno
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Div) and self._kind(node) == WHOLE:
            yield Edit(line, "whole", 1.1, ((site, renewed(node, left=_called("(double)", node.left))),))
        if not isinstance(node, ast.Call) or not isinstance(node.func, ast.Name):
            yield from self._of_size(site, node)
            return
        name, given = node.func.id, node.args
        if name == "abs_c_":
            yield Edit(line, "whole", 1.1, ((site, renewed(node, func=ast.Name("abs", ast.Load()))),))
        if name == "=":
            left, right = given
            yield Edit(line, "condition", 1.0, ((site, _at(node, ast.Compare(left, [ast.Eq()], [right]))),))
        if name in ("(int)", "(long)"):
            (inner,) = given
            yield Edit(line, "whole", 1.2, ((site, inner),))
        others = {"p++": ["p--"], "p--": ["p++"], "++": ["--"], "--": ["++"]}
        for other in others.get(name, ()):
            yield Edit(line, "operator", 1.3, ((site, renewed(node, func=ast.Name(other, ast.Load()))),))
        yield from self._of_size(site, node)

    def _of_size(self, site: Site, node: ast.expr) -> Iterator[Edit]:
        """Bytes of all masses, for those of one, or of a pointer."""
        sizes: list[ast.expr] = [node]
        match node:
            case ast.Call(ast.Name("sizeof"), [inner]):
                if self._kind(inner).depth > 0:
                    first = ast.Subscript(inner, ast.Constant(0), ast.Load())
                    sizes.append(renewed(node, args=[_at(node, first)]))
            case Word(text=text) if text.startswith("sizeof"):
                pass
            case _:
                return
        for size in sizes:
            for by in (self._count, f"2 * {self._count}", "2"):
                yield Edit(node.lineno, "factor", 1.6, ((site, binary(size, ast.Mult(), _word(by, node))),))

    # statements

    def _of_block(self, holder: ast.AST, name: str, block: Sequence[ast.stmt]) -> Iterator[Edit]:
        place: Site = (holder, name, None)
        for i, one in enumerate(block):
            before, after = block[:i], block[i + 1 :]
            for line, family, cost, new in self._instead(one):
                yield Edit(line, family, cost, ((place, [*before, *new, *after]),))
            mirrored = self._mirrored(one)
            if mirrored is not None:
                yield Edit(one.lineno, "left out", 2.1, ((place, [*before, one, mirrored, *after]),))
                yield Edit(one.lineno, "left out", 2.2, ((place, [*before, mirrored, one, *after]),))
            if isinstance(one, ast.If | ast.For | ast.While) and after:
                yield from self._taken_in(place, before, one, after)

    def _mirrored(self, one: ast.stmt) -> ast.stmt | None:
        """The same of the other component, or of velocity for position: of a line that is missing the twin is there."""
        if not isinstance(one, ast.Assign | ast.AugAssign) or getattr(one, "declared", None):
            return None
        made = copy.deepcopy(one)
        for node in ast.walk(made):
            if isinstance(node, ast.Name):
                node.id = self._twin(node.id)
            if isinstance(node, ast.Subscript):
                last = node.slice.elts[-1] if isinstance(node.slice, ast.Tuple) else node.slice
                if isinstance(last, ast.Constant) and last.value in (0, 1):
                    last.value = 1 - last.value
        return made if ast.dump(made) != ast.dump(one) else None

    def _twin(self, name: str) -> str:
        """A name with y for x, or v for y, where there is one; else itself."""
        for a, b in (("x", "y"), ("y", "x"), ("y", "v"), ("v", "y")):
            for i, letter in enumerate(name):
                other = name[:i] + b + name[i + 1 :]
                if letter == a and other in self._kinds and self._kinds[other] == self._kinds.get(name):
                    return other
        return name

    def _instead(self, one: ast.stmt) -> Iterator[tuple[int, str, float, list[ast.stmt]]]:
        """What may stand in place of a statement: line, kind, cost, statements."""
        line = one.lineno
        if isinstance(one, ast.Break | ast.Continue):
            other: ast.stmt = ast.Continue() if isinstance(one, ast.Break) else ast.Break()
            yield line, "condition", 1.3, [_at(one, other)]
        if isinstance(one, ast.Return) and one.value is None:
            yield line, "condition", 1.4, [_at(one, ast.Continue())]
        if isinstance(one, ast.Break | ast.Continue | ast.Return):
            yield line, "too much", 2.2, [_at(one, ast.Pass())]
        match one:
            case ast.Expr(ast.Compare(left, [ast.Eq()], [right])):
                yield line, "operator", 1.0, [_at(one, ast.Assign([left], right))]
        whole = isinstance(one, ast.Assign) and str(getattr(one, "declared", "")).startswith(WHOLE_TYPES)
        if isinstance(one, ast.Assign) and whole and self._kind(one.value) == NUMBER:
            yield line, "whole", 1.2, [_declared_as_number(one)]
        if isinstance(one, Verbatim):
            yield from self._of_copied(one)

    def _of_copied(self, one: Verbatim) -> Iterator[tuple[int, str, float, list[ast.stmt]]]:
        """Declarations: of another type, with a value, cleared, not kept between calls."""
        if one.text.startswith("static "):
            yield one.lineno, "too much", 1.3, [_copied(one, one.text.removeprefix("static "))]
        if "=" in one.text or len(one.names) != 1:
            return
        (name,) = one.names
        kind = self._kinds.get(name, WHOLE)
        if kind == WHOLE and one.text.startswith("int "):
            yield one.lineno, "whole", 1.2, [_copied(one, f"double {one.text.removeprefix('int ')}")]
        if kind in {NUMBER, WHOLE}:
            yield one.lineno, "left out", 1.4, [_copied(one, one.text.replace(";", " = 0;"))]
        elif kind.depth > 0 and "*" not in one.text and "[" in one.text:
            own = c_name(name)
            yield one.lineno, "left out", 1.5, [one, _copied(one, f"memset({own}, 0, sizeof {own});")]

    def _taken_in(self, place: Site, before: Sequence[ast.stmt], one: Any, after: Sequence[ast.stmt]) -> Iterator[Edit]:
        """What follows a loop or a condition, taken into it: there were no braces, or a semicolon too much."""
        ends = [type(statement_) for statement_ in one.body] == [ast.Pass]
        for by in range(1, min(FARTHEST, len(after)) + 1):
            body = [*([] if ends else one.body), *after[:by]]
            line, cost = (one.lineno, 1.2) if ends else (after[0].lineno, 1.8 + 0.1 * by)
            yield Edit(line, "order", cost, ((place, [*before, renewed(one, body=body), *after[by:]]),))

    def _of_given(self) -> Iterator[Edit]:
        """Arrays that the function is given: cleared first; read as they were, after they have been written into."""
        start: Site = (self._function, "body", None)
        body = self._function.body
        for name in self._written_into():
            clear = _copied(self._function, f"memset({c_name(name)}, 0, sizeof *{c_name(name)} * ({self._count}));")
            yield Edit(self._first_added(name) or body[0].lineno, "left out", 1.6, ((start, [clear, *body]),))
            keep = statement(f"_{name}_given = {name}.copy()", self._function)
            by_line: dict[int, list[Site]] = {}
            for site in self._reads(name):
                by_line.setdefault(what_stands_at(site).lineno, []).append(site)
            for line, sites in by_line.items():
                for group in [sites, *([site] for site in sites if len(sites) > 1)]:
                    put = tuple((site, expression(f"_{name}_given", what_stands_at(site))) for site in group)
                    yield Edit(line, "order", 2.0, (*put, (start, [keep, *body])))

    def _first_added(self, name: str) -> int | None:
        """The line on which something is first added to what is in an array."""
        nodes = [node for node in ast.walk(self._function) if isinstance(node, ast.AugAssign)]
        return min((node.lineno for node in nodes if _base(node.target) == name), default=None)

    def _written_into(self) -> list[str]:
        """Of the arrays and pointers that the function is given, those that it writes into."""
        assigned = [node for node in ast.walk(self._function) if isinstance(node, ast.Assign)]
        targets = [target for node in assigned for target in node.targets]
        targets += [node.target for node in ast.walk(self._function) if isinstance(node, ast.AugAssign)]
        bases = {_base(target) for target in targets if not isinstance(target, ast.Name)}
        return [a.arg for a in self._function.args.args if a.arg in bases and self._kinds[a.arg].base == "number"]

    def _reads(self, name: str) -> Iterator[Site]:
        """Where a name is read, and nothing is written through it."""
        written = {
            id(inner)
            for node in ast.walk(self._function)
            if isinstance(node, ast.Assign | ast.AugAssign)
            for target in (node.targets if isinstance(node, ast.Assign) else [node.target])
            for inner in _way_to_base(target)
        }
        for site in sites_in(self._function):
            node = what_stands_at(site)
            if isinstance(node, ast.Name) and node.id == name and id(node) not in written:
                yield site

    def _twice_declared(self, body: Sequence[ast.stmt], names: set[str]) -> Iterator[Edit]:
        """A name that is declared again in a block, where the one outside was meant."""
        here = set(names)
        for statement_ in body:
            for name in ("body", "orelse"):
                block = getattr(statement_, name, None)
                if isinstance(block, list):
                    yield from self._of_inner(statement_, name, block, here)
                    yield from self._twice_declared(block, here)
            if getattr(statement_, "declared", None) and isinstance(statement_, ast.Assign):
                here.update(map(_base, statement_.targets))
            here.update(statement_.names if isinstance(statement_, Verbatim) else ())

    def _of_inner(self, holder: ast.stmt, name: str, block: Sequence[ast.stmt], known: set[str]) -> Iterator[Edit]:
        for i, one in enumerate(block):
            if isinstance(one, ast.Assign) and getattr(one, "declared", None) and _base(one.targets[0]) in known:
                plain = _at(one, ast.Assign(one.targets, one.value))
                yield Edit(one.lineno, "name", 1.2, (((holder, name, None), [*block[:i], plain, *block[i + 1 :]]),))


def _base(target: ast.AST) -> str:
    """The name of the array that is written into."""
    *_, last = _way_to_base(target)
    return last.id if isinstance(last, ast.Name) else ""


def _way_to_base(target: ast.AST) -> Iterator[ast.AST]:
    """The nodes from what is written into to the name of its array."""
    yield target
    if isinstance(target, ast.Subscript | ast.Attribute):
        yield from _way_to_base(target.value)


def _declared_as_number(one: ast.Assign) -> ast.Assign:
    """The same name, of another type."""
    made: Any = copy.copy(one)
    for name in ("declared", "free"):
        text: str = getattr(one, name)
        setattr(made, name, text.replace("int ", "double ", 1).replace("long ", "double ", 1))
    return made


def _copied(at: ast.stmt, text: str) -> Verbatim:
    made: Verbatim = _at(at, Verbatim())
    made.text, made.names = text, list(getattr(at, "names", ()))
    return made


def _word(text: str, at: ast.expr) -> Word:
    made: Word = _at(at, Word())
    made.text = f"({text})"
    return made


def _called(name: str, node: ast.expr) -> ast.Call:
    made: ast.Call = _at(node, ast.Call(_at(node, ast.Name(name, ast.Load())), [node], []))
    return made


def _at(node: ast.AST, made: Any) -> Any:
    return ast.copy_location(made, node)
