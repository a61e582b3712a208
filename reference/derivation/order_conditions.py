"""Up to which order the conditions of a Runge-Kutta method hold: one for every rooted tree (Butcher 1963).

Hairer, Norsett and Wanner, *Solving Ordinary Differential Equations I* (1993), II.2: sum b_i Phi_i(t) = 1/gamma(t) for
all trees t of as many nodes as the order at most.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import cache
from itertools import combinations_with_replacement

from reference.derivation.formula import Number, number

#: A rooted tree: those that hang on its root.
Tree = tuple["Tree", ...]

#: Conditions are tried up to this order.
HIGHEST = 7

#: What a condition whose numbers are no fractions may be missed by.
SAME = 1e-12

#: The conditions of low order, as textbooks write them.
WRITTEN: dict[Tree, str] = {
    (): "sum b_i",
    ((),): "sum b_i c_i",
    ((), ()): "sum b_i c_i^2",
    (((),),): "sum b_i a_ij c_j",
    ((), (), ()): "sum b_i c_i^3",
    ((), ((),)): "sum b_i c_i a_ij c_j",
    (((), ()),): "sum b_i a_ij c_j^2",
    ((((),),),): "sum b_i a_ij a_jk c_k",
}


def order_of(a: Sequence[Sequence[Number]], b: Sequence[Number], within: float = SAME) -> tuple[int, str]:
    """The order, and which condition of the next fails: "sum b_i c_i is 5/12, not 1/2"; empty beyond HIGHEST.

    Args:
        a, b: the tableau's. within: the part that a condition may be missed by, where its numbers are known so well.
    """
    for order in range(1, HIGHEST + 1):
        for tree in trees(order):
            weights = _weights(tree, a)
            found: Number = sum((w * u for w, u in zip(b, weights, strict=True)), start=Fraction(0))
            if abs(float(found) * gamma(tree) - 1) > within:
                name = WRITTEN.get(tree, "a sum")
                return order - 1, f"of order {order}, {name} is {_beside(found, Fraction(1, gamma(tree)))}"
    return HIGHEST, ""


def _beside(found: Number, expected: Fraction) -> str:
    """As "5/12, not 1/2"; two that are the same in seven figures are told by what is between them."""
    if number(found) != number(float(expected)):
        return f"{number(found)}, not {expected}"
    off = float(found) - float(expected)
    return f"{expected} {'+' if off > 0 else '-'} {abs(off):.2g}, not {expected}"


@cache
def trees(nodes: int) -> tuple[Tree, ...]:
    """All rooted trees of so many nodes: 1, 1, 2, 4, 9, 20, 48."""
    return tuple(dict.fromkeys(_forests(nodes - 1, nodes - 1)))


def size(tree: Tree) -> int:
    """How many nodes it has."""
    return 1 + sum(map(size, tree))


def gamma(tree: Tree) -> int:
    """Its density."""
    result = size(tree)
    for branch in tree:
        result *= gamma(branch)
    return result


def _forests(nodes: int, largest: int) -> Iterator[Tree]:
    """Trees to hang on a root: so many nodes in all, none of more than `largest`, smaller ones first in each."""
    if nodes == 0:
        yield ()
        return
    for biggest in range(min(nodes, largest), 0, -1):
        for count in range(1, nodes // biggest + 1):
            for rest in _forests(nodes - count * biggest, biggest - 1):
                for chosen in combinations_with_replacement(trees(biggest), count):
                    yield (*rest, *chosen)


def _weights(tree: Tree, a: Sequence[Sequence[Number]]) -> list[Number]:
    """Phi_i of a tree, for every stage i."""
    weights: list[Number] = [Fraction(1) for _ in a]
    for branch in tree:
        below = _weights(branch, a)
        sums = [sum((c * w for c, w in zip(row, below, strict=True)), start=Fraction(0)) for row in a]
        weights = [w * s for w, s in zip(weights, sums, strict=True)]
    return weights
