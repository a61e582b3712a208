"""Right programs with one operator or number changed: which of them still pass? By eye: are they still right?

python -m tests.experiments.exercises.mutants EXERCISE [STYLE]
"""

from __future__ import annotations

import ast
import os
import sys
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

from experiments.exercises.grading import grade
from tests.experiments.exercises.confusion import KEY
from tests.experiments.exercises.corpus import RIGHT, STYLES, Program, programs

#: What is written in place of an operator.
OTHERS = {ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult, ast.Lt: ast.Gt, ast.Gt: ast.Lt}
OTHERS |= {ast.LtE: ast.GtE, ast.GtE: ast.LtE, ast.Eq: ast.NotEq, ast.USub: ast.UAdd}


def mutants(text: str) -> Iterator[tuple[int, str]]:
    """Each with one change: the line that was changed, and the text."""
    for i, node in enumerate(ast.walk(ast.parse(text))):
        for kind in ("operator", "without", "number"):
            tree = ast.parse(text)
            if _changed(list(ast.walk(tree))[i], kind):
                yield getattr(node, "lineno", 0), ast.unparse(ast.fix_missing_locations(tree))


def _changed(node: ast.AST, kind: str) -> bool:
    """Change a node. Returns False where there is nothing of that kind to be changed."""
    if kind == "operator" and isinstance(node, ast.BinOp | ast.AugAssign | ast.UnaryOp) and type(node.op) in OTHERS:
        node.op = OTHERS[type(node.op)]()  # type: ignore[assignment]
    elif kind == "operator" and isinstance(node, ast.Compare) and type(node.ops[0]) in OTHERS:
        node.ops[0] = OTHERS[type(node.ops[0])]()  # type: ignore[assignment]
    elif kind == "without" and isinstance(node, ast.BinOp):
        left = node.left
        node.__class__, node.__dict__ = left.__class__, left.__dict__  # type: ignore[assignment]
    elif kind == "number" and isinstance(node, ast.Constant) and type(node.value) in (int, float):
        node.value += 1  # type: ignore[operator]
    else:
        return False
    return True


def _told(program: Program) -> str:
    given = grade(program.submission, KEY)
    return f"{given.verdict.name}, after the public check" if given.public.right else given.verdict.name


def main(exercise: int, style: str) -> None:
    """Print what they are called, and the lines of those that pass."""
    right = next(p for p in programs() if (p.exercise, p.style, p.name) == (exercise, style, RIGHT))
    changed = [(line, text) for line, text in mutants(right.text) if f"EXERCISE = {exercise}\n" in text]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        said = list(pool.map(lambda m: _told(replace(right, text=m[1])), changed))
    for name, many in Counter(said).most_common():
        print(f"{many:4} {name}")
    for (line, text), name in zip(changed, said, strict=True):
        if "after the public check" in name:
            new = [n for n in text.splitlines() if n not in ast.unparse(ast.parse(right.text)).splitlines()]
            print(f"line {line}: {' / '.join(new).strip()}: {name}")


if __name__ == "__main__":
    main(int(sys.argv[1]), *(sys.argv[2:] or STYLES[:1]))
