"""One C text that holds a program and every small change of it, each to be switched on once all is compiled.

A compiler is started once for thousands of changes. Where statements or conditions are changed, the others are written
beside them, and a number says which is meant (`switches.h`); where statements are moved, the function is written anew.
A change that is not C, or that is written like another one, is left out; one that the compiler refuses takes no other
one with it, as each has lines of its own.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Collection, Iterator, Sequence
from typing import Any

from experiments.exercises.c.kinds import Kinds, may_replace
from experiments.exercises.c.tree import ReadProgram, Verbatim, Word, c_name, functions_in
from experiments.exercises.c.written import TICK, NotInCError, Writer, begun, header_of
from experiments.exercises.repair.edit import Edit, Site, what_stands_at

#: Which variant is meant, at which place: both numbers.
Switch = tuple[int, int]

#: Statements that have others in them.
HOLDERS = (ast.FunctionDef, ast.If, ast.For, ast.While, ast.With)

#: A place: a statement and which part of it ("" for the whole), or a function.
Place = tuple[int, str]


class Variants:
    """A program with changes.

    Attributes:
        switches: of each change, what is to be switched on; nothing where it is left out.
    """

    def __init__(self, program: ReadProgram, edits: Sequence[Edit], most: int = 10**9) -> None:
        """The first changes, so many of them that something is switched on for."""
        self._program = program
        self._owners: dict[int, tuple[ast.FunctionDef, ast.stmt]] = {}
        #: By statement, the names that are declared before it.
        self._declared: dict[int, frozenset[str]] = {}
        #: Nodes of expressions that are indices.
        self._indices: set[int] = set()
        #: Of each place, what may stand there; the number of a place.
        self._texts: dict[Place, list[str]] = {}
        self._numbers: dict[Place, int] = {}
        self._refused: set[Switch] = set()
        self._plain = Writer(program)
        self._copied = Writer(program)
        self._copied.tick = TICK
        for function in functions_in(program.tree):
            given = self._given(function)
            self._declared[id(function)] = given
            self._note(function, function.body, given)
        self.switches: list[tuple[Switch, ...]] = []
        known: set[tuple[Switch, ...]] = {()}
        for edit in edits:
            if len(known) > most:
                break
            switched = self._switched(edit)
            self.switches.append(switched if switched not in known else ())
            known.add(switched)

    def _given(self, function: ast.FunctionDef) -> frozenset[str]:
        """The names that a function finds: what it is given, and what stands outside of functions."""
        outside = [name for node in self._program.tree.body if isinstance(node, Verbatim) for name in node.names]
        return frozenset([*(argument.arg for argument in function.args.args), *outside])

    def _note(self, function: ast.FunctionDef, body: Sequence[ast.stmt], names: frozenset[str]) -> None:
        """Which statement every node belongs to, and which names there are."""
        for statement in body:
            self._owners[id(statement)] = function, statement
            counted = _counted(statement)
            self._declared[id(statement)] = names | counted
            blocks = [b for b in (getattr(statement, name, None) for name in ("body", "orelse")) if isinstance(b, list)]
            inside = {id(s) for block in blocks for s in block}
            for child in ast.iter_child_nodes(statement):
                if id(child) not in inside:
                    self._owners.update((id(node), (function, statement)) for node in ast.walk(child))
                    indices = [node.slice for node in ast.walk(child) if isinstance(node, ast.Subscript)]
                    self._indices.update(id(node) for index in indices for node in ast.walk(index))
            for block in blocks:
                self._note(function, block, self._declared[id(statement)])
            names |= _names_of(statement)

    def _switched(self, edit: Edit) -> tuple[Switch, ...]:
        """What switches a change on; the texts of its places are kept."""
        touched = [self._touched(site) for site, _ in edit.sites]
        functions = {id(function): function for function, _ in filter(None, touched)}
        if None in touched or len(functions) != 1:
            return ()
        (function,) = functions.values()
        places = zip(edit.sites, filter(None, touched), strict=True)
        if not all(self._fits(function, at, site, new) for (site, new), (_, at) in places):
            return ()
        try:
            if any(_moves(site, new) for site, new in edit.sites):
                return self._anew(function, edit)
            statements = {id(statement): statement for _, statement in filter(None, touched)}
            return self._beside(function, list(statements.values()), edit)
        except NotInCError:
            return ()

    def _fits(self, function: ast.FunctionDef, at: ast.stmt, site: Site, new: Any) -> bool:
        """Whether an expression is of a kind that may stand at a place, and its names are declared by then."""
        kinds, old = self._program.kinds[c_name(function.name)], what_stands_at(site)
        if not isinstance(new, ast.expr | ast.Assign | ast.AugAssign):
            return True
        if not _used(new, kinds) <= self._declared[id(at)]:
            return False
        if isinstance(new, ast.stmt):
            return True
        return may_replace(new, old, id(old) in self._indices, kinds, self._program.kinds[""])

    def _touched(self, site: Site) -> tuple[ast.FunctionDef, ast.stmt] | None:
        """The function and the statement that a place is in."""
        holder, name, place = site
        if name == "func":
            return None
        if isinstance(holder, HOLDERS) and place is not None:  # one of its statements
            return self._owners.get(id(what_stands_at(site)))
        return (holder, holder) if isinstance(holder, ast.FunctionDef) else self._owners.get(id(holder))

    def _anew(self, function: ast.FunctionDef, edit: Edit) -> tuple[Switch, ...]:
        """The whole function, changed."""
        with edit.applied():
            if not self._in_order(function.body, self._given(function), self._program.kinds[c_name(function.name)]):
                raise NotInCError("a name before it is declared")
            self._copied.enter(function)
            text = "\n".join(self._copied.block(function.body))
        return (self._number((id(function), ""), text),)

    def _in_order(self, body: Sequence[ast.stmt], names: frozenset[str], kinds: Kinds) -> bool:
        """Whether all names of a function are declared before they are used."""
        for statement in body:
            blocks = [b for b in (getattr(statement, name, None) for name in ("body", "orelse")) if isinstance(b, list)]
            inside = {id(s) for block in blocks for s in block}
            own = [child for child in ast.iter_child_nodes(statement) if id(child) not in inside]
            counted = _counted(statement)
            known = names | counted | (_names_of(statement) if isinstance(statement, ast.Assign) else frozenset())
            if isinstance(statement, Verbatim):
                own, known = [statement], known | frozenset(statement.names)
            if not all(_used(node, kinds) <= known for node in own):
                return False
            if not all(self._in_order(block, names | counted, kinds) for block in blocks):
                return False
            names |= _names_of(statement)
        return True

    def _beside(self, function: ast.FunctionDef, statements: Sequence[ast.stmt], edit: Edit) -> tuple[Switch, ...]:
        """The statements and conditions that are changed."""
        self._plain.enter(function)
        before = [self._parts(statement) for statement in statements]
        new = {id(what_stands_at(site)): value for site, value in edit.sites if isinstance(value, ast.stmt)}
        with edit.applied():
            after = [self._parts(new.get(id(statement), statement)) for statement in statements]
        found = []
        for statement, then, now in zip(statements, before, after, strict=True):
            if isinstance(statement, ast.Assign) and _is_declared(statement) and id(statement) in new:
                raise NotInCError("a declaration that is left out")
            for name, text in now.items():
                if text != then.get(name):
                    found.append(self._number((id(statement), name), text))
        return tuple(sorted(found))

    def _parts(self, statement: ast.stmt) -> dict[str, str]:
        """What can be changed of a statement: its brackets, the value that a name is declared with, or the whole."""
        if isinstance(statement, ast.Assign) and _is_declared(statement):
            return {"value": self._plain.value(statement.value)}
        if isinstance(statement, HOLDERS):
            return self._plain.parts(statement)
        return {"": self._plain.plain(statement)}

    def _number(self, place: Place, text: str) -> Switch:
        """The switch for a text at a place."""
        number = self._numbers.setdefault(place, len(self._numbers))
        texts = self._texts.setdefault(place, [])
        if text not in texts:
            texts.append(text)
        return number, texts.index(text) + 1

    @property
    def places(self) -> int:
        """How many numbers there are of places; one more than are used."""
        return len(self._numbers) + 1

    def refuse(self, names: Collection[str]) -> None:
        """Leave out what the compiler has refused, by the names of its lines."""
        for name in names:
            place, _, variant = name.removeprefix("variant_").partition("_")
            self._refused.add((int(place), int(variant)))
        self.switches = [s if not self._refused & set(s) else () for s in self.switches]

    def at(self, node: ast.AST, part: str) -> tuple[int, list[tuple[int, str]]] | None:
        """The number of a place and what may stand there; None where nothing else may."""
        place = (id(node), part)
        if place not in self._texts:
            return None
        number = self._numbers[place]
        texts = [(i, text) for i, text in enumerate(self._texts[place], 1) if (number, i) not in self._refused]
        return number, texts

    def text(self) -> str:
        """The text for a compiler."""
        lines = [*begun(self._program), f"#define SPRINGLAB_PLACES {self.places}", '#include "switches.h"']
        writer = _Switching(self._program, self)
        for node in self._program.tree.body:
            lines += writer.function(node) if isinstance(node, ast.FunctionDef) else writer.statement(node)
        return "\n".join(lines) + "\n"


class _Switching(Writer):
    """Writes all variants."""

    tick = TICK

    def __init__(self, program: ReadProgram, variants: Variants) -> None:
        """Of a program with changes."""
        super().__init__(program)
        self._variants = variants

    def function(self, function: ast.FunctionDef) -> list[str]:
        """Its variants, then itself, which goes on to one of them where that is meant."""
        self.enter(function)
        own, found = c_name(function.name), self._variants.at(function, "")
        if found is None:
            return super().function(function)
        number, texts = found
        order = ", ".join(function.order)  # type: ignore[attr-defined]
        lines = [f"{header_of(function)};"]
        cases = []
        for i, text in texts:
            other = f"springlab_{own}_{i}"
            lines += [*_own(number, i), header_of(function, other), text]
            nothing = (
                header_of(function).removeprefix("static ").startswith("void ")
                and "*" not in header_of(function).partition("(")[0]
            )
            cases.append(f"case {i}: " + (f"{other}({order}); return;" if nothing else f"return {other}({order});"))
        body = self._indented(function.body)
        return [*lines, *OURS, header_of(function), "{", f"switch (SPRINGLAB_AT({number})) {{", *cases, "}", *body, "}"]

    def part(self, node: ast.stmt, name: str) -> str:
        """A condition is chosen by an expression of its own; what begins a loop, or goes on in it, too."""
        plain, found = self.parts(node)[name], self._variants.at(node, name)
        if found is None:
            return plain
        if name == "test":
            return _chosen("int springlab_value", *found, plain, "springlab_value = !!({});")
        if name == "then":
            return _chosen("int springlab_value = 0", *found, plain, "{};")
        begin, _, value = plain.partition(" = ")
        others = [(i, text.partition(" = ")[2]) for i, text in found[1]]
        return f"{begin} = {_chosen('int springlab_value', found[0], others, value, 'springlab_value = {};')}"

    def simple(self, node: ast.stmt) -> list[str]:
        """A statement beside its variants; a value beside its own."""
        if isinstance(node, ast.Assign) and _is_declared(node):
            return self._declared(node)
        found, plain = self._variants.at(node, ""), self.plain(node)
        if found is None:
            return [plain]
        number, texts = found
        lines = []
        for i, text in texts:  # no switch: it would take a break for its own
            lines += [*_own(number, i), f"if (SPRINGLAB_AT({number}) == {i}) {{ {text} }} else"]
        return [*lines, *OURS, f"{{ {plain} }}"] if len(texts) < FEW else _switched(number, texts, plain)

    def _declared(self, node: ast.Assign) -> list[str]:
        found, plain = self._variants.at(node, "value"), self.value(node.value)
        declared: str = node.declared  # type: ignore[attr-defined]
        if found is None:
            return [f"{declared} = {plain};"]
        number, texts = found
        if not plain.startswith("{"):
            free: str = node.free  # type: ignore[attr-defined]
            return [f"{declared} = {_chosen(free, number, texts, plain, 'springlab_value = {};')};"]
        (target,) = node.targets
        assert isinstance(target, ast.Name)
        name = c_name(target.id)
        put = [(i, f"memcpy((void *)&{name}, &(__typeof__({name})){text}, sizeof {name});") for i, text in texts]
        return [f"{declared} = {plain};", *_switched(number, put, ";")]


#: So many variants are asked for one by one.
FEW = 3

#: What follows is no variant.
OURS = ['#line 1 "ours"']


def _own(number: int, variant: int) -> Iterator[str]:
    """What follows is this variant's, for the compiler to say."""
    yield f'#line 1 "variant_{number}_{variant}"'


def _switched(number: int, texts: Sequence[tuple[int, str]], plain: str) -> list[str]:
    """One of many statements."""
    lines = [f"switch (SPRINGLAB_AT({number})) {{"]
    for i, text in texts:
        lines += [*_own(number, i), f"case {i}: {{ {text} break; }}"]
    return [*lines, *OURS, f"default: {{ {plain} }} }}"]


def _chosen(declared: str, number: int, texts: Sequence[tuple[int, str]], plain: str, put: str) -> str:
    """One of many values, as an expression."""
    chosen = _switched(number, [(i, put.format(text)) for i, text in texts], put.format(plain))
    return "\n".join([f"({{ {declared};", *chosen, "springlab_value; })"])


def _is_declared(statement: ast.stmt) -> bool:
    """Whether a name of its own is declared with a value."""
    return isinstance(statement, ast.Assign | ast.For) and bool(getattr(statement, "declared", None))


def _counted(statement: ast.stmt) -> frozenset[str]:
    """The name that a loop declares, for what is in it."""
    if isinstance(statement, ast.For) and _is_declared(statement) and isinstance(statement.target, ast.Name):
        return frozenset([statement.target.id])
    return frozenset()


def _used(node: ast.AST, kinds: Kinds) -> set[str]:
    """The names of values of a function that are used in an expression, or in what is copied."""
    names: set[str] = set()
    for inner in ast.walk(node):
        if isinstance(inner, ast.Name):
            names.add(inner.id)
        elif isinstance(inner, Word | Verbatim):
            names.update(re.findall(r"(?<![.\w>])[A-Za-z_]\w*", inner.text))
    return {name for name in names if name in kinds and kinds[name].base != "function"}


def _names_of(statement: ast.stmt) -> frozenset[str]:
    """The names that are declared by a statement, for those after it."""
    if isinstance(statement, Verbatim):
        return frozenset(statement.names)
    match statement:
        case ast.Assign([ast.Name(name)]) if _is_declared(statement):
            return frozenset([name])
    return frozenset()


def _moves(site: Site, new: Any) -> bool:
    """Whether a place holds statements, or one that has others in it or is put in place of one."""
    holder, name, place = site
    if not (isinstance(holder, HOLDERS) and name in ("body", "orelse")):
        return False
    return place is None or isinstance(what_stands_at(site), (*HOLDERS, Verbatim)) or isinstance(new, HOLDERS)
