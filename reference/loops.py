"""The text of a scheme's loops: from what a scheme computes to a function a compiler can make fast.

The plan is the same for every explicit scheme and every mesh. A step is a row of stages; a stage is two loops:

    springs   each spring once: the pull it has on its first mass, from where its two masses are;
    masses    each mass alone: the sum of its springs' pulls in their order, its acceleration, and at once all that
              the scheme makes of it until the next stage needs to look at neighbours again.

The last stage's masses are also pushed out of obstacles, each alone, before they are left.

No mass writes what another reads in the same loop, so neither the order of the masses nor the number of threads can
change a bit of the result. A string needs no lists of who is joined to whom: spring j joins masses j and j + 1.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from reference.tracing import Barriers, Program

#: How many systems the innermost loop advances at once, where it advances many.
LANES = 16

#: What there is one number of in a system, and so one number per lane.
PER_SYSTEM = ("drag", "dt")

#: What obstacles call the positions and velocities of a mass.
_READ = (("place", "x"), ("velocity", "v"))


@dataclass(frozen=True)
class Loops:
    """One kernel's text in the making.

    Attributes:
        program: what the scheme computes.
        dimension: 2 or 3.
        string: whether spring j joins masses j and j + 1. Else lists say what springs join.
        lanes: whether every array has a last axis of LANES systems, which the innermost loops run along.
        barriers: what obstacles do to a mass; None where there are none.
        threads: whether the loops may be spread over threads: over springs and masses, or over blocks of systems.
    """

    program: Program
    dimension: int
    string: bool
    barriers: Barriers | None = None
    lanes: bool = False
    threads: bool = False

    @property
    def axes(self) -> range:
        """0, 1 and perhaps 2."""
        return range(self.dimension)

    @property
    def kept(self) -> list[int]:
        """The stages whose accelerations are needed after the loop that computes them."""
        texts = [" ".join(pair) for pair in (*self.program.stages[1:], self.program.end)]
        # texts[k] is computed in the loop of stage k, where only earlier stages' accelerations must be read back.
        return [k for k in range(len(texts)) if any(re.search(rf"\ba{k}\b", later) for later in texts[k + 1 :])]

    @property
    def arrays(self) -> list[str]:
        """Arguments that hold numbers of masses and springs, one array per axis where they have axes."""
        per_axis = ["x", "v", "xs", "vs", "pull", "weight", "sum", *(f"a{k}_" for k in self.kept)]
        return [
            *(f"{name}{i}" for name in per_axis for i in self.axes),
            "rest_length",
            "stiffness",
            "damping",
            "divisor",
        ]

    @property
    def lists(self) -> list[str]:
        """Arguments that all systems have in common: what is joined to what, and the numbers of obstacles."""
        joined = [] if self.string else ["ends_a", "ends_b", "first", "spring", "sign"]
        return [*joined, *(["barriers"] if self.barriers else [])]

    @property
    def arguments(self) -> list[str]:
        """All arguments of the function, in order."""
        return [*self.arrays, *PER_SYSTEM, *self.lists, "steps"]

    def text(self) -> str:
        """The whole module, with the function `advance`; with lanes also `sweep`, which advances many blocks."""
        threads = self.threads and not self.lanes
        lines = [
            '"""Made by reference/loops.py."""',
            "import numpy as np",
            "from numba import njit, prange",
            "from reference.forces import spring_force",
            "",
            "",
            f"@njit(cache=True, nogil=True, error_model='numpy', parallel={threads}, noalias=True)",
            f"def advance({', '.join(self.arguments)}):",
            *_indented(self._body()),
        ]
        if self.lanes:
            one = [f"{name}[b]" for name in (*self.arrays, *PER_SYSTEM)]
            lines += [
                "",
                "",
                f"@njit(cache=True, nogil=True, error_model='numpy', parallel={self.threads})",
                f"def sweep(blocks, {', '.join(self.arguments)}):",
                f"    for q in {'prange' if self.threads else 'range'}(len(blocks)):",
                "        b = blocks[q]",
                f"        advance({', '.join([*one, *self.lists, 'steps'])})",
            ]
        return "\n".join(lines) + "\n"

    def _body(self) -> list[str]:
        whole = "np.int64" if self.string else "np.uint32"
        step: list[str] = []
        if self.program.stages[0] != ("x", "v"):
            step += self._loop("i", "n", [], self._assign(*self.program.stages[0]))
        following = [*self.program.stages[1:], None]
        for k, after in enumerate(following):
            step += self._loop("j", "s", *self._spring(k))
            step += self._loop("i", "n", *self._mass(k, after))
        counts = [f"n = {whole}(len(x0))", f"s = {whole}(len(rest_length))"]
        numbers = [f"o{k} = barriers[{k}]" for k in range(self.barriers.numbers if self.barriers else 0)]
        return [*counts, *numbers, "for step in range(steps):", *_indented(step)]

    def _loop(self, index: str, count: str, before: list[str], body: list[str]) -> list[str]:
        """A loop over springs or masses; with lanes, all but what comes `before` is done for every lane."""
        if self.lanes:
            return [f"for {index} in range({count}):", *_indented(before + self._each_lane(body))]
        return [f"for {index} in {'prange' if self.threads else 'range'}({count}):", *_indented(before + body)]

    def _each_lane(self, body: list[str]) -> list[str]:
        return [f"for w in range({LANES}):", *_indented(body)]

    def _at(self, array: str, place: str) -> str:
        """An entry of an array; with lanes, the one of lane w."""
        return f"{array}[{place}, w]" if self.lanes else f"{array}[{place}]"

    def _of_system(self, name: str) -> str:
        return f"{name}[w]" if self.lanes else name

    def _place(self, k: int) -> tuple[str, str]:
        """The arrays that hold positions and velocities at stage k."""
        x, v = self.program.stages[k]
        return ("x" if x == "x" else "xs"), ("v" if v == "v" else "vs")

    def _spring(self, k: int) -> tuple[list[str], list[str]]:
        """The loop over springs: as forces.spring_pull, one axis after the other."""
        x, v = self._place(k)
        a, b, pull = ("j", "j + 1", "j + 1") if self.string else ("a", "b", "j")
        at = self._at
        before = [] if self.string else ["a = ends_a[j]", "b = ends_b[j]"]
        lines = [f"gap{i} = {at(f'{x}{i}', b)} - {at(f'{x}{i}', a)}" for i in self.axes]
        lines += [f"length = np.sqrt({' + '.join(f'gap{i} * gap{i}' for i in self.axes)})"]
        lines += [f"unit{i} = gap{i} / length" for i in self.axes]
        rates = [f"unit{i} * ({at(f'{v}{i}', b)} - {at(f'{v}{i}', a)})" for i in self.axes]
        lines += [f"lengthening = {' + '.join(rates)}", f"stretch = length - {at('rest_length', 'j')}"]
        lines += [f"force = spring_force({at('stiffness', 'j')}, stretch, {at('damping', 'j')}, lengthening)"]
        return before, [*lines, *(f"{at(f'pull{i}', pull)} = unit{i} * force" for i in self.axes)]

    def _mass(self, k: int, following: tuple[str, str] | None) -> tuple[list[str], list[str]]:
        """The loop over masses: the acceleration at stage k, and the state at the next stage or the step's end."""
        before, lines = self._sum()
        _, v = self._place(k)
        lines += [f"f{i} -= {self._of_system('drag')} * {self._at(f'{v}{i}', 'i')}" for i in self.axes]
        lines += [f"now{i} = f{i} / {self._at('divisor', 'i')}" for i in self.axes]
        if following is None:
            lines += self._assign(*self.program.end, target=("x", "v"), now=k) + self._push_out()
        else:
            lines += self._assign(*following, now=k)
        return before, [*lines, *(f"{self._at(f'a{k}_{i}', 'i')} = now{i}" for i in self.axes if k in self.kept)]

    def _push_out(self) -> list[str]:
        """Mass i out of all obstacles; a mass that is divided by infinity is fixed."""
        barriers = self.barriers
        if barriers is None:
            return []
        known = [f"free = {self._at('divisor', 'i')} < np.inf"]
        known += [f"{name}{i} = {self._at(f'{q}{i}', 'i')}" for name, q in _READ for i in self.axes]
        results = zip((f"{q}{i}" for q in "xv" for i in self.axes), barriers.place + barriers.velocity, strict=True)
        return [*known, *barriers.lines, *(f"{self._at(array, 'i')} = {text}" for array, text in results)]

    def _sum(self) -> tuple[list[str], list[str]]:
        """The weight of mass i and the pulls of its springs, added in the springs' order."""
        at, axes = self._at, self.axes
        weight = [f"f{i} = {at(f'weight{i}', 'i')}" for i in axes]
        if self.string:
            pulls = [f"f{i} = f{i} - {at(f'pull{i}', 'i')} + {at(f'pull{i}', 'i + 1')}" for i in axes]
            return [], weight + pulls
        each = "for e in range(first[i], first[i + np.uint32(1)]):"
        if not self.lanes:
            return [], [*weight, each, *_indented([f"f{i} += sign[e] * pull{i}[spring[e]]" for i in axes])]
        # With lanes the innermost loop must be the one along them: the sum is kept in memory meanwhile.
        begin = [f"sum{i}[w] = {at(f'weight{i}', 'i')}" for i in axes]
        added = ["p = spring[e]", *self._each_lane([f"sum{i}[w] += sign[e] * pull{i}[p, w]" for i in axes])]
        return [*self._each_lane(begin), each, *_indented(added)], [f"f{i} = sum{i}[w]" for i in axes]

    def _assign(self, x: str, v: str, target: tuple[str, str] = ("xs", "vs"), now: int = -1) -> list[str]:
        """Both expressions, computed before either is written, for every axis."""
        lines = []
        for i in self.axes:
            wanted = [(t, text) for t, text in zip(target, (x, v), strict=True) if text not in ("x", "v")]
            lines += [f"new_{t}{i} = {self._read(text, i, now)}" for t, text in wanted]
            lines += [f"{self._at(f'{t}{i}', 'i')} = new_{t}{i}" for t, _ in wanted]
        return lines

    def _read(self, expression: str, axis: int, now: int) -> str:
        """An expression in x, v, dt, a0, a1, ... with the entries of mass i in their places."""

        def entry(match: re.Match[str]) -> str:
            name = match[0]
            if name == "dt":
                return self._of_system(name)
            if name == f"a{now}":
                return f"now{axis}"
            return self._at(f"{name}_{axis}" if name.startswith("a") else f"{name}{axis}", "i")

        return re.sub(r"\b(x|v|dt|a\d+)\b", entry, expression)


def _indented(lines: list[str]) -> list[str]:
    return ["    " + line for line in lines]
