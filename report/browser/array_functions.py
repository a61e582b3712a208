"""Functions over whole arrays as JavaScript: a scheme as it is written, with all that it calls, for a browser.

What `javascript` does with loops over numbers, this does with the functions that students read. Every operation on an
array is one of `nd`, a small part of NumPy in report/templates/browser/arrays.js, which goes over the numbers in the
same order. Names that a function has from its module are looked up there: a number is written as it is, a function
comes along. What is neither, and not among the few that the page has of its own, is refused.
"""

from __future__ import annotations

import ast
import inspect
import textwrap
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from types import FunctionType, MappingProxyType, ModuleType
from typing import Any

from reference.errors import Unsupported

#: What the page has of its own, by the names that the reference has for it.
OWN: Mapping[str, str] = MappingProxyType(
    {
        "State": "State",
        "Slope": "Slope",
        "Blocks": "Blocks",
        "solve_velocities": "solveVelocities",
        "damping_blocks": "dampingBlocks",
        "assemble": "assembled",
        "stretches": "stretchesOf",
        "damping_at": "dampingOf",
        "len": "nd.len",
        "abs": "nd.abs",
        "float": "Number",
    }
)

#: Of these a new one is made by calling them.
_CLASSES = ("State", "Slope", "Blocks")

_BINARY: Mapping[type[ast.AST], str] = MappingProxyType(
    {
        ast.Add: "plus",
        ast.Sub: "minus",
        ast.Mult: "times",
        ast.Div: "over",
        ast.Pow: "power",
        ast.MatMult: "matmul",
        ast.BitAnd: "and",
    }
)

_COMPARED: Mapping[type[ast.AST], str] = MappingProxyType(
    {ast.Lt: "less", ast.Gt: "greater", ast.LtE: "most", ast.GtE: "least", ast.Eq: "equal"}
)

_NUMBERS = {"np.inf": "Infinity", "np.nan": "NaN", "np.pi": "Math.PI"}


@dataclass
class ArrayFunctions:
    """Functions that have come along so far.

    Attributes:
        texts: of each, by the name it has in the page.
    """

    texts: dict[str, list[str]] = field(default_factory=dict)

    def add(self, function: Callable[..., Any]) -> str:
        """A function with all it calls, and its name in the page. Raises Unsupported for what cannot be said there."""
        assert isinstance(function, FunctionType)
        name = function.__name__
        if name not in self.texts:
            self.texts[name] = []  # it may call itself
            try:
                self.texts[name] = _Text(self, function.__globals__).function(_definition(function))
            except Unsupported:
                del self.texts[name]
                raise
        return name

    def add_class(self, cls: type, methods: Sequence[str]) -> None:
        """A class of plain fields, with some of its methods."""
        text = _Text(self, vars(inspect.getmodule(cls)))
        fields = [name for name in cls.__annotations__ if name[0].islower()]
        given = [f"{name} = {_DEFAULTS[name]}" if name in _DEFAULTS else name for name in fields]
        kept = f"Object.assign(this, {{{', '.join(fields)}}});"
        lines = [f"class {cls.__name__} {{", f"  constructor({', '.join(given)}) {{ {kept} }}"]
        for name in methods:
            method = inspect.getattr_static(cls, name)
            static = isinstance(method, classmethod)
            lines += ["  " + line for line in text.method(_definition(method.__func__ if static else method), static)]
        self.texts[cls.__name__] = [*lines, "}"]

    def script(self, wanted: Sequence[str]) -> list[str]:
        """All of them, of which a page sees the wanted ones."""
        body = ["  " + line for lines in self.texts.values() for line in lines]
        return ["(() => {", *body, f"  return {{{', '.join(wanted)}}};", "})()"]


#: Fields of classes that have a default.
_DEFAULTS = {"memory": "[]", "angles": "nd.zeros([1, 1, 1])"}


def _definition(function: Callable[..., Any]) -> ast.FunctionDef:
    (definition,) = ast.parse(textwrap.dedent(inspect.getsource(function))).body
    assert isinstance(definition, ast.FunctionDef)
    return definition


def _names(definition: ast.FunctionDef) -> list[str]:
    arguments = definition.args
    return [argument.arg for argument in (*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs)]


@dataclass
class _Text:
    """The text of one function of a module, in the making.

    Attributes:
        along: where functions that it calls are entered.
        module: what its module has, by name.
        local: names that are its own, and those of functions around it.
    """

    along: ArrayFunctions
    module: Mapping[str, Any]
    local: set[str] = field(default_factory=set)

    def function(self, definition: ast.FunctionDef) -> list[str]:
        return [f"function {definition.name}({self._arguments(definition)}) {{", *self._inside(definition), "}"]

    def method(self, definition: ast.FunctionDef, static: bool) -> list[str]:
        own, head = definition.args.args.pop(0).arg, "static " if static else ""
        self.local = {own}
        named = f"const {own} = {'Blocks' if static else 'this'};"
        arguments = self._arguments(definition)
        return [f"{head}{definition.name}({arguments}) {{", f"  {named}", *self._inside(definition), "}"]

    def _arguments(self, definition: ast.FunctionDef) -> str:
        arguments, texts = definition.args, []
        defaults = [None] * (len(_names(definition)) - len(arguments.defaults) - len(arguments.kwonlyargs))
        for name, default in zip(
            _names(definition), [*defaults, *arguments.defaults, *arguments.kw_defaults], strict=True
        ):
            texts.append(name if default is None else f"{name} = {self.expression(default)}")
        return ", ".join([*texts, *([f"...{arguments.vararg.arg}"] if arguments.vararg else [])])

    def _inside(self, definition: ast.FunctionDef) -> list[str]:
        given = {*_names(definition), *([definition.args.vararg.arg] if definition.args.vararg else [])}
        within = {one.name for one in definition.body if isinstance(one, ast.FunctionDef)}
        before, stored = self.local, _stored(definition.body) - given
        self.local = before | given | stored | within
        body = [line for statement in definition.body for line in self.statement(statement)]
        self.local = before
        declared = [f"  let {', '.join(sorted(stored))};"] if stored else []
        return [*declared, *("  " + line for line in body)]

    def statement(self, statement: ast.stmt) -> list[str]:
        match statement:
            case ast.Assign(targets=targets, value=value):
                made = self.expression(value)
                if len(targets) == 1:
                    return [self._store(targets[0], made)]
                return [
                    self._store(target, made if k == 0 else self.expression(targets[0]))
                    for k, target in enumerate(targets)
                ]
            case ast.AugAssign(target=target, op=operator, value=value):
                made = f"nd.{self._of(_BINARY, operator)}({self.expression(target)}, {self.expression(value)})"
                return [self._store(target, made)]
            case ast.For(target=ast.Name(id=name), iter=ast.Call(func=ast.Name(id="range"), args=args), body=body):
                begin, end = (["0", *map(self.expression, args)])[-2:]
                return [f"for ({name} = {begin}; {name} < {end}; {name}++) {{", *self._block(body), "}"]
            case ast.For(target=target, iter=values, body=body):
                return [f"for ({self.expression(target)} of {self.expression(values)}) {{", *self._block(body), "}"]
            case ast.If(test=test, body=body, orelse=other):
                otherwise = ["} else {", *self._block(other)] if other else []
                return [f"if ({self._truth(test)}) {{", *self._block(body), *otherwise, "}"]
            case ast.FunctionDef():
                return self.function(statement)
            case ast.Return(value=ast.expr() as value):
                return [f"return {self.expression(value)};"]
            case ast.Raise():
                return ["throw new SolverError();"]
            case ast.Break():
                return ["break;"]
            case ast.Expr(value=ast.Constant()) | ast.Assert():
                return []
            case ast.Expr(value=value):
                return [f"{self.expression(value)};"]
        raise Unsupported(f"the page cannot say in JavaScript: {ast.unparse(statement).splitlines()[0]}")

    def _block(self, statements: list[ast.stmt]) -> list[str]:
        return ["  " + line for statement in statements for line in self.statement(statement)]

    def _store(self, target: ast.expr, made: str) -> str:
        match target:
            case ast.Subscript(value=array, slice=place):
                return f"nd.put({self.expression(array)}, {made}, {self._place(place)});"
            case ast.Tuple(elts=names):
                return f"[{', '.join(map(self.expression, names))}] = {made};"
        return f"{self.expression(target)} = {made};"

    def _truth(self, test: ast.expr) -> str:
        return f"nd.truth({self.expression(test)})"

    def expression(self, value: ast.expr) -> str:
        match value:
            case ast.Constant(value=None):
                return "null"
            case ast.Constant(value=bool(truth)):
                return "true" if truth else "false"
            case ast.Constant(value=int() | float()):
                return repr(value.value)
            case ast.Name(id=name):
                return self._name(name)
            case ast.Attribute() if ast.unparse(value) in _NUMBERS:
                return _NUMBERS[ast.unparse(value)]
            case ast.Attribute(value=ast.Name(id="np"), attr=name):
                return f"nd.{name}"
            case ast.Attribute(value=of, attr=name):
                return f"{self.expression(of)}.{'push' if name == 'append' else name}"
            case ast.BinOp(left=left, op=operator, right=right):
                return f"nd.{self._of(_BINARY, operator)}({self.expression(left)}, {self.expression(right)})"
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return f"nd.negative({self.expression(operand)})"
            case ast.UnaryOp(op=ast.Not(), operand=operand):
                return f"!{self._truth(operand)}"
            case ast.UnaryOp(op=ast.Invert(), operand=operand):
                return f"nd.invert({self.expression(operand)})"
            case ast.Compare(left=left, ops=[ast.Is()], comparators=[ast.Constant(value=None)]):
                return f"({self.expression(left)} === null)"
            case ast.Compare(left=left, ops=[operator], comparators=[right]):
                return f"nd.{self._of(_COMPARED, operator)}({self.expression(left)}, {self.expression(right)})"
            case ast.IfExp(test=test, body=body, orelse=other):
                return f"({self._truth(test)} ? {self.expression(body)} : {self.expression(other)})"
            case ast.Tuple(elts=elements) | ast.List(elts=elements):
                return f"[{', '.join(map(self.expression, elements))}]"
            case ast.Starred(value=of):
                return f"...{self.expression(of)}"
            case ast.Subscript(value=array, slice=place):
                return f"nd.at({self.expression(array)}, {self._place(place)})"
            case ast.Lambda(args=arguments, body=body):
                names = [argument.arg for argument in arguments.args]
                inner = _Text(self.along, self.module, self.local | set(names))
                return f"(({', '.join(names)}) => {inner.expression(body)})"
            case ast.Call(func=function, args=args, keywords=keywords):
                return self._call(function, args, keywords)
        raise Unsupported(f"the page cannot say in JavaScript: {ast.unparse(value)}")

    def _of(self, table: Mapping[type[ast.AST], str], operator: ast.AST) -> str:
        if type(operator) not in table:
            raise Unsupported(f"the page cannot say in JavaScript: {type(operator).__name__}")
        return table[type(operator)]

    def _place(self, place: ast.expr) -> str:
        parts = place.elts if isinstance(place, ast.Tuple) else [place]
        return ", ".join("nd.ALL" if isinstance(part, ast.Slice) else self.expression(part) for part in parts)

    def _name(self, name: str) -> str:
        if name in self.local:
            return name
        if name in OWN:
            return OWN[name]
        found = self.module.get(name)
        if isinstance(found, int | float):
            return repr(found)
        # a compiled function is entered by its text
        function = self.module.get(getattr(found, "__name__", ""), found)
        if isinstance(function, FunctionType) and not isinstance(found, ModuleType):
            return self.along.add(function)
        raise Unsupported(f"the page cannot say in JavaScript: {name}")

    def _call(self, function: ast.expr, args: list[ast.expr], keywords: list[ast.keyword]) -> str:
        called, given = self.expression(function), [self.expression(arg) for arg in args]
        named = {keyword.arg: self.expression(keyword.value) for keyword in keywords if keyword.arg}
        if isinstance(function, ast.Name) and function.id not in self.local and function.id not in OWN and named:
            order = _names(_definition(self.module[function.id]))
            given += [named.pop(name, "undefined") for name in order[len(given) :]]
        if named:
            given.append("{" + ", ".join(f"{name}: {text}" for name, text in named.items()) + "}")
        makes = isinstance(function, ast.Name) and (function.id in _CLASSES or function.id == "cls")
        return f"{'new ' if makes else ''}{called}({', '.join(given)})"


def _stored(statements: Sequence[ast.stmt]) -> set[str]:
    """Names that are given values in them, those of functions within left out."""
    found: set[str] = set()
    for statement in statements:
        if isinstance(statement, ast.FunctionDef):
            continue
        for node in ast.walk(statement):
            if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
                found.add(node.id)
    return found
