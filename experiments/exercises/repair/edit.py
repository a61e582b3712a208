"""A change of a program's text: which nodes of its syntax tree are replaced by which.

Imports Python's own library only; see `source_edits`.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

#: Where a node stands: what holds it, in which field, and at which place of a list.
Site = tuple[ast.AST, str, "int | None"]

#: What is said of a function, a class or a name, and is no part of what they compute: by the field of their nodes.
SAID = ("decorator_list", "annotation", "returns", "bases")


@dataclass(frozen=True, eq=False)
class Edit:
    """One change.

    Attributes:
        line: of the text, from 1.
        family: of which kind it is, for the student: operator, sign, factor, index, name, condition, copy, order,
            left out, too much, axis, whole.
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
        before = [(site, what_stands_at(site)) for site, _ in self.sites]
        for site, new in self.sites:
            _put(site, new)
        try:
            yield
        finally:
            for site, old in reversed(before):
                _put(site, old)


def what_stands_at(site: Site) -> Any:
    """The node that is there now."""
    holder, name, place = site
    value = getattr(holder, name)
    return value if place is None else value[place]


def _put(site: Site, new: Any) -> None:
    holder, name, place = site
    if place is None:
        setattr(holder, name, new)
    else:
        getattr(holder, name)[place] = new


def sites_in(top: ast.AST) -> Iterator[Site]:
    """Every place below where an expression or a statement stands that is computed; what holds others comes first."""
    holders = [top]
    for holder in holders:  # which grow meanwhile
        for name, value in ast.iter_fields(holder):
            if name in SAID:
                continue
            if isinstance(value, list):
                yield from ((holder, name, i) for i, item in enumerate(value) if isinstance(item, ast.expr | ast.stmt))
            elif isinstance(value, ast.expr):
                yield holder, name, None
            holders += [item for item in (value if isinstance(value, list) else [value]) if isinstance(item, ast.AST)]
