"""Python's text of loops over numbers, as JavaScript: what `reference.compiled` makes for a compiler, for a browser.

Both compute in IEEE doubles, and + - * / and square roots are rounded alike; so what is translated word by word ends in
the same bits. All that is not known to is refused: sines, powers, hypot are not the same in a browser.

A system's numbers stand in two memories, F of doubles and I of whole numbers; a name of an array is where it begins
there, and `at` has all of them with n, s, d, the numbers of masses, springs and axes. Rows are whole vectors:

    x1[j]         F[x + 2 * j + 1]        of a system in the plane
    x[i, axis]    F[x + d * i + axis]
    ends_b[j]     I[springs + 2 * j + 1]
"""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from reference.errors import Unsupported

#: Arrays of whole numbers; all others are of doubles.
WHOLE = ("springs", "first", "spring", "fixed")

#: Names that loops have for what stands elsewhere: where it begins, by how much it goes on, and what is added.
_ALIASES = {
    "ends_a": ("springs", "2", "0"),
    "ends_b": ("springs", "2", "1"),
    "rest_length": ("rest_lengths", "1", "0"),
}

#: One array per axis: positions, velocities, forces, weights, accelerations of a stage.
_PER_AXIS = re.compile(r"(x|v|xs|vs|force|weight|a\d+_)(\d)")

_OPERATORS: Mapping[type[ast.AST], str] = MappingProxyType(
    {
        ast.Add: "+",
        ast.Sub: "-",
        ast.Mult: "*",
        ast.Div: "/",
        ast.BitAnd: "&&",
        ast.Lt: "<",
        ast.Gt: ">",
        ast.LtE: "<=",
        ast.GtE: ">=",
        ast.Eq: "===",
        ast.USub: "-",
        ast.UAdd: "+",
        ast.Not: "!",
    }
)

#: Functions that end in the same bits in both languages.
_FUNCTIONS = {"sqrt": "Math.sqrt", "abs": "Math.abs", "minimum": "Math.min", "maximum": "Math.max"}

#: Types of whole numbers, which JavaScript does not have.
_CASTS = ("uint32", "uint64", "int64")

_NAMES = {"inf": "Infinity", "nan": "NaN"}

#: How the texts of coefficients write Python's operators.
_CALLED = {"add": "+", "sub": "-", "mul": "*", "truediv": "/"}


@dataclass
class Translation:
    """One text on its way.

    Attributes:
        dimension: of the systems it is for; None where the text asks for it as it runs.
        functions: names of functions of the same text, which are given the memories too.
        plain: names of those of numbers alone.
        rooms: names of arrays it makes for itself, in their order.
    """

    dimension: int | None = None
    functions: tuple[str, ...] = ()
    plain: tuple[str, ...] = ()
    rooms: tuple[str, ...] = ()

    def body(self, statements: list[ast.stmt], returned: tuple[str, ...] = ()) -> list[str]:
        """Lines of JavaScript. Args: returned: where the arrays go that the text returns."""
        self._returned = returned
        names = _assigned(statements) - set(self.rooms)
        declared = [f"let {', '.join(sorted(names))};"] if names else []
        return [*declared, *self._block(statements)]

    def _block(self, statements: list[ast.stmt]) -> list[str]:
        return [line for statement in statements for line in self._statement(statement)]

    def _statement(self, statement: ast.stmt) -> list[str]:
        match statement:
            case ast.Assign(targets=[ast.Tuple(elts=names)], value=ast.Tuple(elts=values)):
                both = zip(map(self.expression, names), map(self.expression, values), strict=True)
                return [f"{name} = {value};" for name, value in both]
            case ast.Assign(targets=[ast.Name(id=name)], value=value) if name in self.rooms:
                return self._room(name, value)
            case ast.Assign(targets=[target], value=value):
                return [f"{self.expression(target)} = {self.expression(value)};"]
            case ast.AugAssign(target=target, op=operator, value=value):
                return [f"{self.expression(target)} {self._operator(operator)}= {self.expression(value)};"]
            case ast.For(target=ast.Name(id=name), iter=ast.Call(func=ast.Name(id="range"), args=args), body=body):
                begin, end = (["0", *map(self.expression, args)])[-2:]
                head = f"for ({name} = {begin}; {name} < {end}; {name}++) {{"
                return [head, *("  " + line for line in self._block(body)), "}"]
            case ast.Expr(value=ast.Call() as call):
                return [f"{self.expression(call)};"]
            case ast.Return(value=ast.Tuple(elts=made)) if self._returned:
                pairs = zip(self._returned, map(self.expression, made), strict=True)
                return [f"F.copyWithin({to}, {array}, {array} + n * d);" for to, array in pairs]
            case ast.Return(value=ast.expr() as value):
                return [f"return {self.expression(value)};"]
        raise Unsupported(f"the page cannot say in JavaScript: {ast.unparse(statement)}")

    def _room(self, name: str, value: ast.expr) -> list[str]:
        """A new array: a copy of another, or left as it is."""
        match value:
            case ast.Call(func=ast.Attribute(value=ast.Name(id=of), attr="copy"), args=[]):
                return [f"F.copyWithin({name}, {of}, {of} + n * d);"]
            case ast.Call(func=ast.Attribute(attr="empty_like")):
                return []
        raise Unsupported(f"the page cannot say in JavaScript: {name} = {ast.unparse(value)}")

    def expression(self, value: ast.expr) -> str:
        """As JavaScript."""
        match value:
            case ast.Constant(value=bool(truth)):
                return "true" if truth else "false"
            case ast.Constant(value=int() | float()):
                return repr(value.value)
            case ast.Name(id=name):
                return name
            case ast.Attribute(value=ast.Name(id="np"), attr=name) if name in _NAMES:
                return _NAMES[name]
            case ast.BinOp(left=base, op=ast.Pow(), right=ast.Constant(value=2)) if isinstance(base, ast.Name):
                return f"({base.id} * {base.id})"  # as NumPy has it
            case ast.BinOp(left=left, op=operator, right=right):
                return f"({self.expression(left)} {self._operator(operator)} {self.expression(right)})"
            case ast.UnaryOp(op=operator, operand=operand):
                return f"({self._operator(operator)}{self.expression(operand)})"
            case ast.Compare(left=left, ops=[operator], comparators=[right]):
                return f"({self.expression(left)} {self._operator(operator)} {self.expression(right)})"
            case ast.IfExp(test=test, body=body, orelse=other):
                return f"({self.expression(test)} ? {self.expression(body)} : {self.expression(other)})"
            case ast.Subscript():
                return self._entry(value)
            case ast.Call(func=function, args=args):
                return self._call(function, args)
        raise Unsupported(f"the page cannot say in JavaScript: {ast.unparse(value)}")

    def _operator(self, operator: ast.AST) -> str:
        if type(operator) not in _OPERATORS:
            raise Unsupported(f"the page cannot say in JavaScript: {type(operator).__name__}")
        return _OPERATORS[type(operator)]

    def _entry(self, entry: ast.Subscript) -> str:
        match entry:
            case ast.Subscript(value=ast.Attribute(attr="shape"), slice=ast.Constant(value=1)):
                return "d"
            case ast.Subscript(value=ast.Name(id=name), slice=ast.Tuple(elts=[row, column])):
                stride = "2" if name == "springs" else "d"
                return f"{_memory(name)}[{name} + {stride} * {self.expression(row)} + {self.expression(column)}]"
            case ast.Subscript(value=ast.Name(id=name), slice=index):
                return self._of_row(name, self.expression(index))
        raise Unsupported(f"the page cannot say in JavaScript: {ast.unparse(entry)}")

    def _of_row(self, name: str, index: str) -> str:
        """An entry of an array of numbers, or of one axis of an array of vectors."""
        per_axis = _PER_AXIS.fullmatch(name)
        if per_axis and self.dimension is not None:
            base, axis = per_axis.groups()
            base = "forces" if base == "force" else base
            return f"F[{base} + {self.dimension} * {index} + {axis}]"
        if name in _ALIASES:
            base, stride, offset = _ALIASES[name]
            return f"{_memory(base)}[{base} + {stride} * {index} + {offset}]"
        return f"{_memory(name)}[{name} + {index}]"

    def _call(self, function: ast.expr, args: list[ast.expr]) -> str:
        given = [self.expression(arg) for arg in args if not isinstance(arg, ast.Starred)]
        match function:
            case ast.Name(id="len") if given:
                return "s" if given[0] in ("springs", "rest_length") else "n"
            case ast.Name(id=name) if name in self.plain:
                return f"{name}({', '.join(given)})"
            case ast.Name(id=name) if name in self.functions:
                return f"{name}({', '.join(['F', 'I', 'at', *given])})"
            case ast.Name(id=name) if name in _CALLED:
                return f"({given[0]} {_CALLED[name]} {given[1]})"
            case ast.Attribute(value=ast.Name(id="np"), attr=name) if name in _CASTS:
                return given[0]
            case ast.Attribute(value=ast.Name(id="np"), attr=name) if name in _FUNCTIONS:
                return f"{_FUNCTIONS[name]}({', '.join(given)})"
        raise Unsupported(f"the page cannot say in JavaScript: {ast.unparse(function)}")


def of_expression(text: str) -> str:
    """An expression of numbers, as JavaScript.

    >>> of_expression("truediv(dt, 2)")
    '(dt / 2)'
    """
    return Translation().expression(ast.parse(text, mode="eval").body)


def plain_function(text: str, name: str) -> list[str]:
    """A function of numbers alone, as JavaScript, by its text and a name of one's own."""
    definition = definitions(text)[0]
    arguments = [argument.arg for argument in definition.args.args]
    body = Translation().body(definition.body)
    return [f"function {name}({', '.join(arguments)}) {{", *("  " + line for line in body), "}"]


def definitions(text: str) -> list[ast.FunctionDef]:
    """The functions of a module's text."""
    return [node for node in ast.parse(text).body if isinstance(node, ast.FunctionDef)]


def _memory(name: str) -> str:
    return "I" if name in WHOLE else "F"


def _assigned(statements: list[ast.stmt]) -> set[str]:
    """Names that are given values anywhere in them."""
    nodes = [node for statement in statements for node in ast.walk(statement)]
    return {node.id for node in nodes if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)}
