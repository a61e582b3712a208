"""What may stand in place of an expression, or of a statement by itself, if its writer meant something else.

Imports Python's own library only; see `source_edits`.
"""

from __future__ import annotations

import ast
import copy
from collections.abc import Iterator
from typing import Any

#: Operators that are taken for each other, likelier ones first.
OPERATORS: dict[type[ast.operator], tuple[type[ast.operator], ...]] = {
    ast.Add: (ast.Sub, ast.Mult),
    ast.Sub: (ast.Add, ast.Mult),
    ast.Mult: (ast.Div, ast.Add, ast.Sub),
    ast.Div: (ast.Mult, ast.Sub),
    ast.FloorDiv: (ast.Div,),
    ast.Pow: (ast.Mult,),
    ast.Mod: (ast.Div,),
}
COMPARISONS: dict[type[ast.cmpop], tuple[type[ast.cmpop], ...]] = {
    ast.Lt: (ast.Gt, ast.LtE, ast.GtE),
    ast.Gt: (ast.Lt, ast.GtE, ast.LtE),
    ast.LtE: (ast.GtE, ast.Lt, ast.Gt),
    ast.GtE: (ast.LtE, ast.Gt, ast.Lt),
    ast.Eq: (ast.NotEq, ast.Lt, ast.Gt),
    ast.NotEq: (ast.Eq, ast.Lt, ast.Gt),
}

#: Functions that are taken for each other.
ALIKE = (
    ("sin", "cos", "tan"),
    ("arcsin", "arccos", "arctan"),
    ("sum", "mean"),
    ("argmax", "argmin"),
    ("max", "min"),
    ("maximum", "minimum"),
    ("tile", "repeat"),
    ("any", "all"),
    ("zeros_like", "ones_like"),
    ("zeros", "ones"),
    ("vstack", "hstack"),
    ("deg2rad", "rad2deg"),
    ("radians", "degrees"),
    ("append", "extend"),
)
OTHER_FUNCTIONS = {name: [other for other in group if other != name] for group in ALIKE for name in group}


def renewed(node: Any, **fields: Any) -> Any:
    """A copy of a node, children shared, with these fields."""
    made = copy.copy(node)
    for name, value in fields.items():
        setattr(made, name, value)
    return made


def expression(text: str, at: ast.AST) -> ast.expr:
    """What the text says, at the line of a node."""
    made = ast.parse(text, mode="eval").body
    for node in ast.walk(made):
        ast.copy_location(node, at)
    return made


def binary(left: ast.expr, operator: ast.operator, right: ast.expr) -> ast.BinOp:
    """An operation, at the line of its left side."""
    return ast.copy_location(ast.BinOp(left, operator, right), left)


def replacements(node: ast.AST, names: dict[str, list[str]], holder: ast.AST) -> Iterator[tuple[str, float, Any]]:
    """What may stand in place of a node: the kind of the change, its cost, the new node."""
    if isinstance(node, ast.BinOp):
        yield from _of_operation(node)
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub | ast.Not):
        yield ("sign" if isinstance(node.op, ast.USub) else "condition"), 1.0, node.operand
    elif isinstance(node, ast.Compare):
        for i, compared in enumerate(node.ops):
            for other in COMPARISONS.get(type(compared), ()):
                yield "condition", 1.2, renewed(node, ops=[*node.ops[:i], other(), *node.ops[i + 1 :]])
    elif isinstance(node, ast.BoolOp):
        other_way: ast.boolop = ast.Or() if isinstance(node.op, ast.And) else ast.And()
        yield "condition", 1.3, renewed(node, op=other_way)
        for value in node.values:
            yield "condition", 2.0, value
    elif isinstance(node, ast.IfExp):
        yield "condition", 2.0, node.body
        yield "condition", 2.0, node.orelse
    elif isinstance(node, ast.Constant):
        yield from _of_number(node)
        if isinstance(node.value, float):
            yield from _of_what_is_given(node, names, 1.9)
    elif isinstance(node, ast.Name):
        for other_name in names[""]:
            if other_name != node.id:
                yield "name", 2.2, renewed(node, id=other_name)
        if isinstance(holder, ast.Assign):
            yield "copy", 1.5, expression(f"{node.id}.copy()", node)
    elif isinstance(node, ast.Attribute):
        yield from _of_attribute(node, names)
    elif isinstance(node, ast.Subscript):
        yield from _of_subscript(node)
        if isinstance(node.ctx, ast.Load):
            yield from _of_what_is_given(node, names, 2.3)
    elif isinstance(node, ast.Call):
        yield from _of_call(node, names)
    elif isinstance(node, ast.Tuple | ast.List) and 2 <= len(node.elts) <= 4 and isinstance(node.ctx, ast.Load):
        for i in range(len(node.elts)):
            for j in range(i):
                swapped = list(node.elts)
                swapped[i], swapped[j] = swapped[j], swapped[i]
                yield "order", 1.6, renewed(node, elts=swapped)
    elif isinstance(node, ast.AugAssign):
        yield from _of_augmented(node)
    elif isinstance(node, ast.Assign) and len(node.targets) == 1:
        target = node.targets[0]
        if isinstance(target, ast.Name | ast.Subscript):
            for operator in (ast.Add, ast.Sub):
                yield "operator", 1.6, ast.copy_location(ast.AugAssign(target, operator(), node.value), node)
    if isinstance(node, ast.Expr | ast.Assign | ast.AugAssign):
        yield "too much", 2.5, ast.copy_location(ast.Pass(), node)
    if isinstance(getattr(node, "ctx", None), ast.Store):
        return
    if isinstance(node, ast.expr) and not isinstance(node, ast.Constant | ast.UnaryOp | ast.Slice | ast.Compare):
        yield from _scaled(node, names, holder)


def _of_what_is_given(node: ast.expr, names: dict[str, list[str]], cost: float) -> Iterator[tuple[str, float, Any]]:
    """A field of what is given, in place of a number or another value; of all, and of one."""
    for owner, attributes in names.items():
        if owner not in NO_OWNERS:
            for attribute in attributes:
                yield "name", cost, expression(f"{owner}.{attribute}", node)


def _of_operation(node: ast.BinOp) -> Iterator[tuple[str, float, Any]]:
    for i, other in enumerate(OPERATORS.get(type(node.op), ())):
        family = "sign" if isinstance(node.op, ast.Add | ast.Sub) and other in (ast.Add, ast.Sub) else "operator"
        yield family, 1.0 + 0.3 * i, renewed(node, op=other())
    yield "too much", 1.5, node.left
    yield "too much", 1.8, node.right
    if isinstance(node.op, ast.Sub | ast.Div | ast.Pow | ast.MatMult):
        yield "order", 1.4, renewed(node, left=node.right, right=node.left)
    inner = node.left
    if isinstance(inner, ast.BinOp):
        # the other way to set brackets: (a - b) * c for a - b * c, and so on
        yield "order", 1.5, renewed(inner, right=renewed(node, left=inner.right))
    inner = node.right
    if isinstance(inner, ast.BinOp):
        yield "order", 1.5, renewed(inner, left=renewed(node, right=inner.left))


def _of_number(node: ast.Constant) -> Iterator[tuple[str, float, Any]]:
    value = node.value
    if isinstance(value, bool):
        yield "condition", 1.3, renewed(node, value=not value)
    elif isinstance(value, int | float) and abs(value) < 1e6:
        for new in dict.fromkeys((value + 1, value - 1, 2 * value, value / 2, -value, 0, 1, 2)):
            if new != value:
                yield "factor", 1.3 if abs(new - value) == 1 else 1.6, renewed(node, value=new)


def _of_attribute(node: ast.Attribute, names: dict[str, list[str]]) -> Iterator[tuple[str, float, Any]]:
    for other in OTHER_FUNCTIONS.get(node.attr, ()):
        yield "name", 1.4, renewed(node, attr=other)
    if isinstance(node.value, ast.Name):
        for other in names.get(node.value.id, ()):
            if other != node.attr and node.attr not in OTHER_FUNCTIONS:
                yield "name", 1.8, renewed(node, attr=other)
    if node.attr == "T":
        yield "axis", 1.4, node.value


def _of_subscript(node: ast.Subscript) -> Iterator[tuple[str, float, Any]]:
    index = node.slice
    parts = index.elts if isinstance(index, ast.Tuple) else [index]
    for i, part in enumerate(parts):
        for cost, new in _other_indices(part):
            whole = new if not isinstance(index, ast.Tuple) else renewed(index, elts=[*parts[:i], new, *parts[i + 1 :]])
            yield "index", cost, renewed(node, slice=whole)
    if isinstance(index, ast.Tuple) and len(parts) == 2:
        yield "index", 1.6, renewed(node, slice=renewed(index, elts=parts[::-1]))
    if isinstance(node.ctx, ast.Load):
        yield "index", 2.2, node.value


def _other_indices(part: ast.expr) -> Iterator[tuple[float, ast.expr]]:
    if isinstance(part, ast.Slice):
        for text in ("1:", ":-1", ":", "1:-1", "2:", ":-2", "::-1"):
            made = ast.parse(f"a[{text}]", mode="eval").body
            assert isinstance(made, ast.Subscript)
            for inner in ast.walk(made.slice):
                ast.copy_location(inner, part)
            if ast.dump(made.slice) != ast.dump(part):
                yield 1.3, made.slice
    elif isinstance(part, ast.Constant) and isinstance(part.value, int):
        every = ast.parse("a[:, None]", mode="eval").body
        assert isinstance(every, ast.Subscript)
        for inner in ast.walk(every.slice):
            ast.copy_location(inner, part)
        if part.value == 0:
            yield 1.4, every.slice  # of all masses, for that of the first
        for value in (0, 1, -1, part.value + 1, part.value - 1):
            if value != part.value:
                yield 1.2, renewed(part, value=value)
    elif isinstance(part, ast.BinOp) and isinstance(part.op, ast.Add | ast.Sub):
        yield 1.2, part.left
        yield 1.2, renewed(part, op=ast.Sub() if isinstance(part.op, ast.Add) else ast.Add())
    elif not isinstance(part, ast.UnaryOp):
        yield 1.3, binary(part, ast.Sub(), ast.copy_location(ast.Constant(1), part))
        yield 1.3, binary(part, ast.Add(), ast.copy_location(ast.Constant(1), part))


def _of_call(node: ast.Call, names: dict[str, list[str]]) -> Iterator[tuple[str, float, Any]]:
    for argument in node.args:
        if not isinstance(argument, ast.Starred):
            yield "too much", 1.9, argument
    for i in range(len(node.args) - 1):
        swapped = list(node.args)
        swapped[i], swapped[i + 1] = swapped[i + 1], swapped[i]
        yield "order", 1.7, renewed(node, args=swapped)
    for i, keyword in enumerate(node.keywords):
        yield "too much", 2.0, renewed(node, keywords=[*node.keywords[:i], *node.keywords[i + 1 :]])
        if keyword.arg == "axis" and isinstance(keyword.value, ast.Constant) and keyword.value.value in (0, 1, -1):
            other = renewed(keyword, value=renewed(keyword.value, value=0 if keyword.value.value else 1))
            yield "axis", 1.2, renewed(node, keywords=[*node.keywords[:i], other, *node.keywords[i + 1 :]])
    name = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
    if name == "array" or not node.args:
        yield from _of_what_is_given(node, names, 2.0)
    if name in ("mean", "sum", "max", "min"):
        averaged = node.args[0] if node.args else node.func.value if isinstance(node.func, ast.Attribute) else node
        for loop in (name for name in names[""] if name in ("i", "j", "n", "k", "idx")):
            yield "index", 1.9, ast.copy_location(ast.Subscript(averaged, expression(loop, node), ast.Load()), node)
    if name in ("sin", "cos", "tan") and node.args:
        for text in ("0.017453292519943295", "57.29577951308232"):
            yield "factor", 1.6, renewed(node, args=[binary(node.args[0], ast.Mult(), expression(text, node))])
    ratio = node.args[0] if node.args else None
    if name in ("arctan", "atan") and isinstance(ratio, ast.BinOp) and isinstance(ratio.op, ast.Div):
        function = renewed(node.func, **{"attr" if isinstance(node.func, ast.Attribute) else "id": f"{name}2"})
        yield "name", 1.3, renewed(node, func=function, args=[ratio.left, ratio.right])
    if name in ("norm", "sum", "mean", "max", "min", "cumsum", "diff") and not any(
        k.arg == "axis" for k in node.keywords
    ):
        for axis in (1, 0):
            yield "axis", 1.5, _with_keyword(node, "axis", str(axis))
    if name in ("zeros", "ones", "empty", "full"):
        yield from _other_sizes(node, names)
    if name in ("zeros_like", "ones_like", "array", "zeros", "asarray") and not any(
        k.arg == "dtype" for k in node.keywords
    ):
        yield "copy", 1.6, _with_keyword(node, "dtype", "float")
    if name == "eigvalsh" and isinstance(node.func, ast.Attribute):
        yield "name", 1.5, renewed(node, func=renewed(node.func, attr="eigvals"))
    if name == "range":
        for i, argument in enumerate(node.args):
            for way in (ast.Add, ast.Sub):
                shifted = binary(argument, way(), ast.copy_location(ast.Constant(1), argument))
                yield "index", 1.3, renewed(node, args=[*node.args[:i], shifted, *node.args[i + 1 :]])


def _with_keyword(node: ast.Call, name: str, text: str) -> ast.Call:
    """The call with one more argument, by its name."""
    more = ast.copy_location(ast.keyword(name, expression(text, node)), node)
    made: ast.Call = renewed(node, keywords=[*node.keywords, more])
    return made


def _other_sizes(node: ast.Call, names: dict[str, list[str]]) -> Iterator[tuple[str, float, Any]]:
    """An array of another size: a length that is a multiple of a name, or a few longer."""
    shape = node.args[0] if node.args else None
    lengths = shape.elts if isinstance(shape, ast.Tuple | ast.List) else [shape] if shape is not None else []
    for i, length in enumerate(lengths):
        longer = [binary(length, ast.Add(), ast.copy_location(ast.Constant(n), node)) for n in (1, 2, 3)]
        times = [binary(length, ast.Mult(), expression(name, node)) for name in names[""] if name not in MODULES]
        for new in (*longer, *times):
            whole = renewed(shape, elts=[*lengths[:i], new, *lengths[i + 1 :]]) if shape is not length else new
            yield "factor", 1.6, renewed(node, args=[whole, *node.args[1:]])


def _of_augmented(node: ast.AugAssign) -> Iterator[tuple[str, float, Any]]:
    for i, other in enumerate(OPERATORS.get(type(node.op), ())):
        yield ("sign" if i == 0 else "operator"), 1.0 + 0.3 * i, renewed(node, op=other())
    target = copy.deepcopy(node.target)
    assert isinstance(target, ast.Name | ast.Subscript | ast.Attribute)
    yield "operator", 1.6, ast.copy_location(ast.Assign([node.target], node.value, lineno=node.lineno), node)
    target.ctx = ast.Load()
    product = ast.copy_location(ast.BinOp(target, node.op, node.value), node)
    yield "copy", 1.4, ast.copy_location(ast.Assign([node.target], product, lineno=node.lineno), node)


def _scaled(node: ast.expr, names: dict[str, list[str]], holder: ast.AST) -> Iterator[tuple[str, float, Any]]:
    """A value, or a term of a sum, with another sign or factor, or with a term beside it."""
    in_product = isinstance(holder, ast.BinOp) and not isinstance(holder.op, ast.Pow)
    if in_product or (isinstance(holder, ast.Attribute) and isinstance(node, ast.Name)):
        yield "factor", 1.8, binary(node, ast.Pow(), expression("2", node))
    if isinstance(node, ast.Tuple | ast.List | ast.Starred):
        return
    is_term = isinstance(holder, ast.BinOp) and isinstance(holder.op, ast.Add | ast.Sub)
    is_value = isinstance(holder, ast.Assign | ast.AugAssign | ast.Return | ast.Tuple)
    if is_term or is_value or isinstance(holder, ast.Call):
        yield "sign", 1.3, ast.copy_location(ast.UnaryOp(ast.USub(), node), node)
    if is_term or is_value:
        for text in ("2", "0.5"):
            yield "factor", 1.7, binary(node, ast.Mult(), expression(text, node))
        yield from _with_what_is_unused(node, names)
        for name in names[""] if "dt" in names[""] else ():
            for operator in (ast.Add(), ast.Sub()):
                yield "left out", 2.3, binary(node, operator, expression(f"dt * {name}", node))
    of_a_root = isinstance(holder, ast.Call) and ast.unparse(holder.func).split(".")[-1] == "sqrt"
    if is_term or is_value or of_a_root or isinstance(holder, ast.Compare | ast.BinOp):
        yield from _with_another(node, names)


def _with_what_is_unused(node: ast.expr, names: dict[str, list[str]]) -> Iterator[tuple[str, float, Any]]:
    """A factor or a term of what the function is given, and the program never reads."""
    for text in names.get(UNUSED, ()):
        for operator in (ast.Mult(), ast.Div(), ast.Add(), ast.Sub()):
            yield "left out", 1.9, binary(node, operator, expression(text, node))
        for name in names[""]:
            for operator in (ast.Sub(), ast.Add()):
                yield "left out", 2.1, binary(node, operator, expression(f"{text} * {name}", node))
            for difference in (f"({name} - {text})", f"({name} - {text}[:, None])"):
                yield "left out", 2.2, binary(node, ast.Mult(), expression(difference, node))


def _with_another(node: ast.expr, names: dict[str, list[str]]) -> Iterator[tuple[str, float, Any]]:
    """A value times, over, plus or minus another one that the function has."""
    fields = [f"{owner}.{name}" for owner in names if owner not in NO_OWNERS for name in names[owner]]
    for text in (*names[""], *fields):
        if text in MODULES or (isinstance(node, ast.Name) and node.id == text):
            continue
        plain = 2.0 if text in SCALARS or "." in text else 2.4
        for cost, operator in ((0.0, ast.Mult()), (0.1, ast.Div()), (0.3, ast.Add()), (0.3, ast.Sub())):
            yield "factor" if cost < 0.2 else "left out", plain + cost, binary(node, operator, expression(text, node))


#: What modules are called; what single numbers often are; where the names are of what is given and never read.
MODULES, SCALARS, UNUSED = ("np", "numpy", "math", "self"), ("dt", "h", "m", "mass", "k", "g"), "what is never read"

#: What has no fields that can be read.
NO_OWNERS = ("", UNUSED, *MODULES)
