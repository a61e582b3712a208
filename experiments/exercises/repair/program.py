"""A program whose text is changed thousands of times, and of which only the changed function is compiled anew.

Used in the process of a submission; imports Python's own library only.
"""

from __future__ import annotations

import ast
import copy
import sys
import warnings
from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from types import FrameType
from typing import Any

from experiments.exercises.repair.edit import Edit, what_stands_at

#: What the text is called, and what the program calls itself.
NAME, MODULE = "<submission>", "submission"

#: How often loops may go round in one call, all together.
MOST_ROUNDS = 20_000

#: A value is a number, an array of so many axes, or of another type; a name may stand for several.
Kinds = dict[str, set[str]]

#: A function that can be compiled by itself: at the top, or a method with its class.
Unit = tuple[ast.FunctionDef, "ast.ClassDef | None"]


class TooLongError(BaseException):
    """A loop goes round too often."""


#: What a program that is tried may end in.
FAILS = (Exception, TooLongError, SystemExit)


class _Counted(ast.NodeTransformer):
    """Counts the rounds of loops that may not end."""

    def visit_While(self, node: ast.While) -> ast.While:
        self.generic_visit(node)
        tick = ast.Expr(ast.Call(ast.Name("__tick__", ast.Load()), [], []))
        node.body = [ast.fix_missing_locations(ast.copy_location(tick, node)), *node.body]
        return node


class Program:
    """A tree that can be run as it is at any time; it is not changed by that."""

    def __init__(self, tree: ast.Module) -> None:
        self.tree = tree
        #: First lines of the functions that are called while the module is made; of which kind names in them are.
        self._entered: set[int] = set()
        self._kinds: Kinds = {}
        with _noting(self._entered, self._kinds):
            self._names = self.anew()
        self._units = dict(_units(tree, self._entered))

    def anew(self) -> dict[str, Any] | None:
        """The names of a module of its own, of the tree as it is now; None where it cannot be read."""
        names: dict[str, Any] = {"__name__": MODULE, "__tick__": self._tick, "__file__": f"{MODULE}.py"}
        return names if self._run(self.tree, names, names) else None

    def begin_call(self) -> None:
        """Rounds of loops are counted from 0."""
        self._rounds = 0

    @contextmanager
    def reached(self) -> Iterator[set[int]]:
        """The first lines of all functions that are called meanwhile, or were while the module was made.

        Of which kind the names in them are is kept, too.
        """
        lines = set(self._entered)
        with _noting(lines, self._kinds):
            yield lines

    def can_matter(self, edit: Edit, reached: Collection[int]) -> bool:
        """Whether a change can make a difference that is wanted.

        It is in a function that begins on one of these lines, or in none that is known; and a name is put in the place
        of one of its kind, or reckoned with if it is a number or an array.
        """
        units = self._of([edit])
        called = units is None or any(_first_line(function) in reached for function, _ in units)
        return called and all(_fits(what_stands_at(site), new, self._kinds) for site, new in edit.sites)

    @contextmanager
    def changed(self, edits: Sequence[Edit]) -> Iterator[Mapping[str, Any] | None]:
        """The names of the module with these changes, for a while; None where it cannot be read."""
        with ExitStack() as stack:
            for edit in edits:
                stack.enter_context(edit.applied())
            units = self._of(edits)
            if units is None or self._names is None:
                yield self.anew()
            else:
                yield self._names if all(stack.enter_context(self._put(unit)) for unit in units) else None

    @contextmanager
    def changed_anew(self, edits: Sequence[Edit]) -> Iterator[Mapping[str, Any] | None]:
        """The same of a module of its own."""
        with ExitStack() as stack:
            for edit in edits:
                stack.enter_context(edit.applied())
            yield self.anew()

    def _of(self, edits: Sequence[Edit]) -> list[Unit] | None:
        """The functions that edits are in; None where one is in none."""
        found = [self._units.get(id(site[0])) for edit in edits for site, _ in edit.sites]
        units = {id(unit): unit for unit in found if unit is not None}
        return None if None in found else list(units.values())

    @contextmanager
    def _put(self, unit: Unit) -> Iterator[bool]:
        """A function as its tree is now, in place of what it was; False where it cannot be read."""
        function, owner = unit
        names, made = self._names, {}  # type: ignore[var-annotated]
        assert names is not None
        if not self._run(ast.Module([function], []), names, made):
            yield False
        elif owner is None:
            before, names[function.name] = names[function.name], made[function.name]
            yield True
            names[function.name] = before
        else:
            holder = names[owner.name]
            before = vars(holder)[function.name]
            setattr(holder, function.name, made[function.name])
            yield True
            setattr(holder, function.name, before)

    def _run(self, tree: ast.Module, names: dict[str, Any], into: dict[str, Any]) -> bool:
        self.begin_call()
        if any(isinstance(node, ast.While) for node in ast.walk(tree)):
            tree = _Counted().visit(copy.deepcopy(tree))
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                code = compile(tree, NAME, "exec")
            exec(code, names, into)
        except FAILS:
            return False
        return True

    def _tick(self) -> None:
        self._rounds += 1
        if self._rounds > MOST_ROUNDS:
            raise TooLongError


def _units(tree: ast.Module, entered: Collection[int]) -> Iterator[tuple[int, Unit]]:
    """By the number of a node, the function that it is in and that can be put in place of what it was.

    That is none where something else may hold what it was, or what it returned.

    Args:
        entered: first lines of functions that were called while the module was made.
    """
    named = Counter(node.id for node in _outside_of_functions(tree) if isinstance(node, ast.Name))
    if any(isinstance(node, ast.Global) or "cache" in _name(node) for node in ast.walk(tree)):
        return
    tops = [statement for statement in tree.body if isinstance(statement, ast.FunctionDef | ast.ClassDef)]
    named.update(statement.name for statement in tops)
    for statement in tops:
        own: list[Unit] = [(statement, None)] if isinstance(statement, ast.FunctionDef) else []
        if isinstance(statement, ast.ClassDef) and not _is_needed_by_its_methods(statement):
            methods = [s for s in statement.body if isinstance(s, ast.FunctionDef)]
            own = [(s, statement) for s in methods if [m.name for m in methods].count(s.name) == 1]
        for unit in own:
            if named[statement.name] == 1 and _first_line(unit[0]) not in entered:
                yield from ((id(node), unit) for node in ast.walk(unit[0]))


def _outside_of_functions(node: ast.AST) -> Iterator[ast.AST]:
    """All that is computed while a module is made."""
    yield node
    inside = node.body if isinstance(node, ast.FunctionDef) else []
    for child in ast.iter_child_nodes(node):
        if child not in inside:
            yield from _outside_of_functions(child)


def _is_needed_by_its_methods(statement: ast.ClassDef) -> bool:
    """Whether they cannot be compiled outside of it: for `super()`, or for names with two underscores."""
    names = [_name(node) for node in ast.walk(statement)]
    return any(name == "super" or (name.startswith("__") and not name.endswith("__")) for name in names)


def _name(node: ast.AST) -> str:
    return str(getattr(node, "id", getattr(node, "attr", "")))


def _first_line(function: ast.FunctionDef) -> int:
    """As code objects have it."""
    return min([function.lineno, *(decorator.lineno for decorator in function.decorator_list)])


def _fits(old: Any, new: Any, kinds: Kinds) -> bool:
    """Whether a name may stand in place of another, or beside a value, as far as their kinds are known."""
    if isinstance(old, ast.Name) and isinstance(new, ast.Name):
        before, then = kinds.get(old.id), kinds.get(new.id)
        return not before or not then or bool(before & then)
    if isinstance(new, ast.BinOp) and new.left is old and isinstance(new.right, ast.Name):
        return any(kind.startswith("number") for kind in kinds.get(new.right.id, {"number"}))
    return True


def kind_of(value: object) -> str:
    """Of which kind a value is.

    >>> [kind_of(value) for value in (1, 2.5, "a", [1])]
    ['number', 'number', 'str', 'list']
    """
    axes = getattr(value, "ndim", 0 if isinstance(value, int | float) else None)
    return type(value).__name__ if axes is None else "number" + f" of {axes} axes" * bool(axes)


@contextmanager
def _noting(lines: set[int], kinds: Kinds) -> Iterator[None]:
    """Adds the first lines of those functions of the program that are called meanwhile, and what their names are."""

    def note(frame: FrameType, event: str, _: object) -> None:
        code = frame.f_code
        if code.co_filename != NAME:
            return
        if event == "call" and code.co_name != "<module>":  # which has a first line, too, and is no function
            lines.add(code.co_firstlineno)
        if event == "return":
            for name, value in frame.f_locals.items():
                kinds.setdefault(name, set()).add(kind_of(value))

    sys.setprofile(note)
    try:
        yield
    finally:
        sys.setprofile(None)
