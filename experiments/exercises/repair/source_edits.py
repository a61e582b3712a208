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

from experiments.exercises.repair.alike_edits import of_alike
from experiments.exercises.repair.edit import Edit, Site, sites_in, what_stands_at
from experiments.exercises.repair.expression_edits import replacements
from experiments.exercises.repair.names import Names, names_in
from experiments.exercises.repair.statement_edits import of_statements


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
    for top in tree.body:
        if isinstance(top, ast.FunctionDef | ast.ClassDef | ast.Assign):
            names = names_in(top, tree, given or {})
            for site in sites_in(top):
                found += _changes(site, names)
            found += of_alike(top, names)
    functions = [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)]
    found += [edit for function in functions for edit in of_statements(function)]
    return sorted(found, key=lambda edit: edit.cost)


def _changes(site: Site, names: Names) -> Iterator[Edit]:
    """The changes at one place."""
    node = what_stands_at(site)
    written = isinstance(getattr(node, "ctx", None), ast.Store | ast.Del)
    if written and not isinstance(node, ast.Subscript | ast.Tuple):
        return
    for family, cost, new in replacements(node, names, site[0]):
        yield Edit(node.lineno, family, cost, ((site, new),))
