"""The text of loops over runs (`runs`): what a scheme computes, for lattices too large for a cache.

The arithmetic is that of `loops`, line for line; what differs is the order in which springs and masses are visited. A
stage goes through the blocks, and in each through its runs of springs and then its rows of masses:

    springs   the force of each spring of a run, read and written in a row;
    sums      of a row of masses the forces of their springs, in their order: some terms at a time, for all masses;
    masses    each mass of a row alone: its acceleration, and all that the scheme makes of it until the next stage.

The first two are functions of their own, and so is each stage, as a compiler trusts that arrays do not overlap only
where they are arguments. One for the masses of a stage would make it compile for half as long again.
"""

from __future__ import annotations

from dataclasses import dataclass

from reference.compiled.loops import Loops, indented
from reference.jit import HEADER, INNER, text_of
from reference.springs.linear_law import spring_force

#: How many terms of a sum are added at a time.
TERMS = 4

_ENTRIES = ["row_entry", "entry_place", "entry_sign"]
_SPRINGS = ["rest_length", "stiffness", "damping"]


@dataclass(frozen=True)
class RunLoops(Loops):
    """One kernel's text in the making, as `Loops`: without lanes, and the same for a string as for others."""

    @property
    def arrays(self) -> list[str]:
        """Arguments that hold numbers of masses and springs, and the lists of `runs_of`."""
        return [*super().arrays, *self.run_lists, "block_runs", "row_mass", *_ENTRIES, "block_rows", "edges"]

    @property
    def run_lists(self) -> list[str]:
        """Where runs begin, and what their springs join."""
        return ["run_a", "run_b", "run_place", "run_spring"]

    @property
    def lists(self) -> list[str]:
        """The numbers of obstacles, where there are some."""
        return ["obstacles"] if self.obstacles else []

    def text(self) -> str:
        """The whole module, with the function `advance`."""
        options = f"cache=True, nogil=True, error_model='numpy'{', noalias=True' if self.noalias else ''}"
        functions = [self._springs_function(), self._sums_function(), *self._stage_functions()]
        lines = ['"""Made by reference/compiled/run_loops.py."""', HEADER, "", text_of(spring_force, inner=True)]
        for function in functions:
            lines += ["", "", f"@njit({options}, {INNER})", *function]
        lines += ["", "", f"@njit(cache=True, nogil=True, error_model='numpy', parallel={self.threads})"]
        return "\n".join([*lines, *self._advance_function()]) + "\n"

    def _each(self, *names: str) -> list[str]:
        """Names of arrays, one for each axis."""
        return [f"{name}{i}" for name in names for i in self.axes]

    def _springs_function(self) -> list[str]:
        """The forces of the springs of some runs, with masses where x and v are."""
        run = [
            "begin = np.uint64(run_place[r])",
            "first = np.uint64(run_spring[r])",
            "n = np.uint64(run_spring[r + 1]) - first",
            *self._run(),
        ]
        arguments = ["begin_run", "end_run", *self._each("x", "v", "force"), *_SPRINGS, *self.run_lists]
        return _function("springs", arguments, ["for r in range(begin_run, end_run):", *indented(run)])

    def _run(self) -> list[str]:
        """The springs of run r: n from the first on."""
        force = self._force("x", "v", "a", "b", "begin + t", "rest_length[first + t]", "stiffness[r]", "damping[r]")
        spring = ["a = first_a + t", "b = first_b + t", *force]
        ends = ["first_a = np.uint64(run_a[r])", "first_b = np.uint64(run_b[r])"]
        return [*ends, "for t in range(n):", *indented(spring)]

    def _sums_function(self) -> list[str]:
        """The weights of row r's masses, n from `mass` on, and the forces of their springs."""
        weight = [f"sum{i}[t] = weight{i}[mass + t]" for i in self.axes]
        body = ["for t in range(n):", *indented(weight), "e = np.uint64(row_entry[r])"]
        body += ["end = np.uint64(row_entry[r + 1])"]
        for terms in (TERMS, 1):
            body += [f"while e + {self._entries(terms)} <= end:", *indented(self._terms(terms))]
        arguments = ["r", "mass", "n", *self._each("sum", "force", "weight"), *_ENTRIES]
        return _function("sums", arguments, body)

    def _entries(self, terms: int) -> str:
        """How many entries some terms of a row take."""
        return f"np.uint64({terms})"

    def _terms(self, terms: int) -> list[str]:
        """Some terms, added one after the other."""
        known = []
        for m in range(terms):
            entry = f"e + np.uint64({m})"
            known += [f"p{m} = np.uint64(entry_place[{entry}])", f"s{m} = entry_sign[{entry}]"]
        return [*known, *self._added([f"s{m} * force{{i}}[p{m} + t]" for m in range(terms)])]

    def _added(self, terms: list[str]) -> list[str]:
        """Terms added to the sums of a row, axis by axis."""
        sums = [f"sum{i}[t] = {' + '.join([f'sum{i}[t]', *terms])}".replace("{i}", str(i)) for i in self.axes]
        return ["for t in range(n):", *indented(sums), f"e += {self._entries(len(terms))}"]

    def _stage_functions(self) -> list[list[str]]:
        """Of every stage the loop over some blocks: the runs of springs of each, and then its rows of masses."""
        functions = []
        for k, after in enumerate([*self.program.stages[1:], None]):
            _, mass = self._mass(k, after)
            row = [
                "first = np.uint64(row_mass[r])",
                "n = np.uint64(row_mass[r + 1]) - first",
                f"sums(r, first, n, {', '.join([*self._each('sum', 'force', 'weight'), *_ENTRIES])})",
                "for t in range(n):",
                *indented(["i = first + t", *mass]),
            ]
            block = [
                self._springs_call(k, "block_runs[b]", "block_runs[b + 1]"),
                "for r in range(block_rows[b], block_rows[b + 1]):",
                *indented(row),
            ]
            loop = [*self._obstacle_numbers(), "for b in range(begin_block, end_block):", *indented(block)]
            functions.append(_function(f"stage{k}", ["begin_block", "end_block", *self._given], loop))
        return functions

    @property
    def _given(self) -> list[str]:
        return [*self.arrays, *self.per_system, *self.lists]

    def _springs_call(self, k: int, begin: str, end: str) -> str:
        arrays = self._each(*self._place(k), "force")
        return f"springs({', '.join([begin, end, *arrays, *_SPRINGS, *self.run_lists])})"

    def _advance_function(self) -> list[str]:
        """Springs between chunks first, and then all chunks."""
        ranges = "prange" if self.threads else "range"
        given = [f"{name}[c]" if name.startswith("sum") else name for name in self._given]
        step = self._start("len(x0)")
        for k in range(len(self.program.stages)):
            step += [
                self._springs_call(k, "block_runs[blocks]", "block_runs[blocks + 1]"),
                f"for c in {ranges}(len(edges) - 1):",
                f"    stage{k}(edges[c], edges[c + 1], {', '.join(given)})",
            ]
        body = ["blocks = len(block_rows) - 1", "for step in range(steps):", *indented(step)]
        return _function("advance", self.arguments, body)

    def _sum(self) -> tuple[list[str], list[str]]:
        """Summed before."""
        return [], [f"f{i} = sum{i}[t]" for i in self.axes]


def _function(name: str, arguments: list[str], body: list[str]) -> list[str]:
    return [f"def {name}({', '.join(arguments)}):", *indented(body)]
