"""The text of a scheme's loops: from what a scheme computes to a function a compiler can make fast.

The plan is the same for every explicit scheme and every mesh. A step is a row of stages; a stage is two loops:

    springs   each spring once: the force on its first mass, from where its two masses are;
    masses    each mass alone: the sum of its springs' forces in their order, its acceleration, and at once all that
              the scheme makes of it until the next stage needs to look at neighbours again.

The last stage's masses are also put out of obstacles, each alone, before they are left. Of Euler on a string in the
plane, with what depends on dt alone in c0 = dt, the text is

    for step in range(steps):
        for j in range(s):
            separation0 = x0[j + 1] - x0[j]
            separation1 = x1[j + 1] - x1[j]
            length = np.sqrt(separation0 * separation0 + separation1 * separation1)
            unit0 = separation0 / length
            unit1 = separation1 / length
            rate = unit0 * (v0[j + 1] - v0[j]) + unit1 * (v1[j + 1] - v1[j])
            stretch = length - rest_length[j]
            force = spring_force(stiffness[j], stretch, damping[j], rate)
            force0[j + 1] = unit0 * force
            force1[j + 1] = unit1 * force
        for i in range(n):
            f0 = weight0[i]
            f1 = weight1[i]
            f0 = f0 - force0[i] + force0[i + 1]
            f1 = f1 - force1[i] + force1[i + 1]
            f0 -= drag * v0[i]
            f1 -= drag * v1[i]
            now0 = f0 / divisor[i]
            now1 = f1 / divisor[i]
            new_x0 = (x0[i] + (c0 * v0[i]))
            new_v0 = (v0[i] + (c0 * now0))
            x0[i] = new_x0
            v0[i] = new_v0
            new_x1 = (x1[i] + (c0 * v1[i]))
            new_v1 = (v1[i] + (c0 * now1))
            x1[i] = new_x1
            v1[i] = new_v1

No mass writes what another reads in the same loop, so neither the order of the masses nor the number of threads can
change a bit of the result. A string needs no lists of who is joined to whom: spring j joins masses j and j + 1. Systems
too large for a cache go through the same lines in blocks (`run_loops`, `mesh_loops`).
"""

from __future__ import annotations

from dataclasses import dataclass

from reference.compiled.expressions import Expression
from reference.compiled.tracing import ObstacleProgram, Place, Program
from reference.jit import HEADER, INNER, text_of
from reference.springs.linear_law import spring_force

#: How many systems the innermost loop advances at once, where it advances many.
LANES = 16

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
        obstacles: what they do to a mass; None where there are none.
        noalias: whether Numba can be told that no two arrays share memory.
        threads: whether the loops may be spread over threads: over springs and masses, or over blocks of systems.
    """

    program: Program
    dimension: int
    string: bool
    obstacles: ObstacleProgram | None = None
    lanes: bool = False
    threads: bool = False
    noalias: bool = False

    @property
    def axes(self) -> range:
        """0, 1 and perhaps 2."""
        return range(self.dimension)

    @property
    def kept(self) -> list[int]:
        """The stages whose accelerations are needed after the loop that computes them."""
        places = [*self.program.stages[1:], self.program.end]
        # places[k] is computed in the loop of stage k, where only earlier stages' accelerations must be read back.
        later = [frozenset().union(*(q.names for place in places[k + 1 :] for q in place)) for k in range(len(places))]
        return [k for k in range(len(places)) if f"a{k}" in later[k]]

    @property
    def arrays(self) -> list[str]:
        """Arguments that hold numbers of masses and springs, one array per axis where they have axes."""
        per_axis = ["x", "v", "xs", "vs", "force", "weight", "sum", *(f"a{k}_" for k in self.kept)]
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
        return [*joined, *(["obstacles"] if self.obstacles else [])]

    @property
    def per_system(self) -> list[str]:
        """Arguments there is one number of in a system, and so one number per lane: drag, and what dt makes."""
        return ["drag", *(f"c{k}" for k in range(len(self.program.coefficients)))]

    @property
    def arguments(self) -> list[str]:
        """All arguments of the function, in order."""
        return [*self.arrays, *self.per_system, *self.lists, "steps"]

    def text(self) -> str:
        """The whole module, with the function `advance`; with lanes also `sweep`, which advances many blocks."""
        threads = self.threads and not self.lanes
        options = f"parallel={threads}{', noalias=True' if self.noalias else ''}"
        ways_in = f", {INNER}" if self.lanes else ""  # then `sweep` alone calls it
        lines = [
            '"""Made by reference/compiled/loops.py."""',
            HEADER,
            "",
            text_of(spring_force, inner=True),
            "",
            "",
            f"@njit(cache=True, nogil=True, error_model='numpy', {options}{ways_in})",
            f"def advance({', '.join(self.arguments)}):",
            *indented(self._body()),
        ]
        if self.lanes:
            one = [f"{name}[b]" for name in (*self.arrays, *self.per_system)]
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
        step = self._start("n")
        following = [*self.program.stages[1:], None]
        for k, after in enumerate(following):
            step += self._loop("j", "s", *self._spring(k))
            step += self._loop("i", "n", *self._mass(k, after))
        counts = [f"n = {whole}(len(x0))", f"s = {whole}(len(rest_length))"]
        return [*counts, *self._obstacle_numbers(), "for step in range(steps):", *indented(step)]

    def _start(self, count: str) -> list[str]:
        """The loop over masses to where the first stage wants them, if that is not where they are."""
        first = self.program.stages[0]
        return [] if first == (Expression("x"), Expression("v")) else self._loop("i", count, [], self._assign(first))

    def _obstacle_numbers(self) -> list[str]:
        return [f"o{k} = obstacles[{k}]" for k in range(self.obstacles.numbers if self.obstacles else 0)]

    def _loop(self, index: str, count: str, before: list[str], body: list[str]) -> list[str]:
        """A loop over springs or masses; with lanes, all but what comes `before` is done for every lane."""
        if self.lanes:
            return [f"for {index} in range({count}):", *indented(before + self._each_lane(body))]
        return [f"for {index} in {'prange' if self.threads else 'range'}({count}):", *indented(before + body)]

    def _each_lane(self, body: list[str]) -> list[str]:
        return [f"for w in range({LANES}):", *indented(body)]

    def _at(self, array: str, place: str) -> str:
        """An entry of an array; with lanes, the one of lane w."""
        return f"{array}[{place}, w]" if self.lanes else f"{array}[{place}]"

    def _of_system(self, name: str) -> str:
        return f"{name}[w]" if self.lanes else name

    def _place(self, k: int) -> tuple[str, str]:
        """The arrays that hold positions and velocities at stage k."""
        x, v = self.program.stages[k]
        return ("x" if _is("x", x) else "xs"), ("v" if _is("v", v) else "vs")

    def _spring(self, k: int) -> tuple[list[str], list[str]]:
        """The loop over springs: as forces.force_of_spring, one axis after the other."""
        before = [] if self.string else ["a = ends_a[j]", "b = ends_b[j]"]
        a, b, place = ("j", "j + 1", "j + 1") if self.string else ("a", "b", "j")
        coefficients = [self._at(name, "j") for name in ("rest_length", "stiffness", "damping")]
        return before, self._force(*self._place(k), a, b, place, *coefficients)

    def _force(
        self, x: str, v: str, a: str, b: str, place: str, rest_length: str, stiffness: str, damping: str
    ) -> list[str]:
        """The force of one spring between masses a and b, whose state is in the arrays x and v, to its place."""
        at = self._at
        lines = [f"separation{i} = {at(f'{x}{i}', b)} - {at(f'{x}{i}', a)}" for i in self.axes]
        lines += [f"length = np.sqrt({' + '.join(f'separation{i} * separation{i}' for i in self.axes)})"]
        lines += [f"unit{i} = separation{i} / length" for i in self.axes]
        rates = [f"unit{i} * ({at(f'{v}{i}', b)} - {at(f'{v}{i}', a)})" for i in self.axes]
        lines += [f"rate = {' + '.join(rates)}", f"stretch = length - {rest_length}"]
        lines += [f"force = spring_force({stiffness}, stretch, {damping}, rate)"]
        return [*lines, *(f"{at(f'force{i}', place)} = unit{i} * force" for i in self.axes)]

    def _mass(self, k: int, following: Place | None) -> tuple[list[str], list[str]]:
        """The loop over masses: the acceleration at stage k, and the state at the next stage or the step's end."""
        before, lines = self._sum()
        _, v = self._place(k)
        lines += [f"f{i} -= {self._of_system('drag')} * {self._at(f'{v}{i}', 'i')}" for i in self.axes]
        lines += [f"now{i} = f{i} / {self._at('divisor', 'i')}" for i in self.axes]
        if following is None:
            lines += self._assign(self.program.end, target=("x", "v"), now=k) + self._project()
        else:
            lines += self._assign(following, now=k)
        return before, [*lines, *(f"{self._at(f'a{k}_{i}', 'i')} = now{i}" for i in self.axes if k in self.kept)]

    def _project(self) -> list[str]:
        """Mass i out of all obstacles; a mass that is divided by infinity is fixed."""
        program = self.obstacles
        if program is None:
            return []
        known = [f"free = {self._at('divisor', 'i')} < np.inf"]
        known += [f"{name}{i} = {self._at(f'{q}{i}', 'i')}" for name, q in _READ for i in self.axes]
        results = zip((f"{q}{i}" for q in "xv" for i in self.axes), program.place + program.velocity, strict=True)
        return [*known, *program.lines, *(f"{self._at(array, 'i')} = {text}" for array, text in results)]

    def _sum(self) -> tuple[list[str], list[str]]:
        """The weight of mass i and the forces of its springs, added in the springs' order."""
        at, axes = self._at, self.axes
        weight = [f"f{i} = {at(f'weight{i}', 'i')}" for i in axes]
        if self.string:
            forces = [f"f{i} = f{i} - {at(f'force{i}', 'i')} + {at(f'force{i}', 'i + 1')}" for i in axes]
            return [], weight + forces
        each = "for e in range(first[i], first[i + np.uint32(1)]):"
        if not self.lanes:
            return [], [*weight, each, *indented([f"f{i} += sign[e] * force{i}[spring[e]]" for i in axes])]
        # With lanes the innermost loop must be the one along them: the sum is kept in memory meanwhile.
        begin = [f"sum{i}[w] = {at(f'weight{i}', 'i')}" for i in axes]
        added = ["p = spring[e]", *self._each_lane([f"sum{i}[w] += sign[e] * force{i}[p, w]" for i in axes])]
        return [*self._each_lane(begin), each, *indented(added)], [f"f{i} = sum{i}[w]" for i in axes]

    def _assign(self, place: Place, target: tuple[str, str] = ("xs", "vs"), now: int = -1) -> list[str]:
        """Both expressions, computed before either is written, for every axis."""
        lines = []
        for i in self.axes:
            wanted = [(t, q) for t, q, name in zip(target, place, "xv", strict=True) if not _is(name, q)]
            lines += [f"new_{t}{i} = {self._read(q, i, now)}" for t, q in wanted]
            lines += [f"{self._at(f'{t}{i}', 'i')} = new_{t}{i}" for t, _ in wanted]
        return lines

    def _read(self, expression: Expression, axis: int, now: int) -> str:
        """An expression with the entries of mass i for x, v, a0, a1, ..., and those of the system for c0, c1, ..."""

        def entry(name: str) -> str:
            if name == f"a{now}":
                return f"now{axis}"
            if name in ("x", "v"):
                return self._at(f"{name}{axis}", "i")
            if name.startswith("a"):
                return self._at(f"{name}_{axis}", "i")
            # c0, c1, ... or a number that the scheme has written out
            return self._of_system(name) if name.startswith("c") else name

        return expression.text(entry)


def _is(name: str, expression: Expression) -> bool:
    return expression == Expression(name)


def indented(lines: list[str]) -> list[str]:
    """Lines one level further in."""
    return ["    " + line for line in lines]
