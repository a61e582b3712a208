"""The lab's definitions as JavaScript: schemes, the law of a spring, obstacles. Nothing of them is typed twice.

Explicit schemes come from the text of their loops (`reference.compiled.loops`), in-place ones from theirs
(`reference.compiled.in_place`), for systems of one, two and three dimensions. What the loops leave at the end of a run
that has blown up is the readable forces' answer here: a fixed mass has the acceleration zero, also where forces are
infinite. Schemes that solve equations, and those of the wide catalogue, come as they are written (`step_functions`).
"""

from __future__ import annotations

import ast
import json
from dataclasses import dataclass
from functools import cache

from reference.compiled.expressions import Untraceable
from reference.compiled.in_place import trace_in_place
from reference.compiled.loops import Loops
from reference.compiled.tracing import Place, Program, trace, trace_obstacles
from reference.errors import InputError, Unsupported
from reference.jit import text_of
from reference.obstacles import Box, Circle, Cylinder, Obstacle, Plane, Sphere
from reference.schemes.catalogue import Scheme, schemes, wide_schemes
from reference.springs.linear_law import elastic_energy, force_by_rate, force_by_stretch, spring_force
from reference.theory.keeps_to_surfaces import keeps_to_surfaces
from reference.theory.limits import SOLVED
from reference.theory.runge_kutta import stability_polynomial
from reference.theory.step_coefficients import solves_for_positions
from report.browser.javascript import Translation, definitions, of_expression, plain_function
from report.browser.spring_laws import ASKED, law_functions
from report.browser.step_functions import damps_in_proportion, drags_in_proportion, step_refusal, steps_script
from report.site.linear_form import NotLinear
from report.site.mathml import of_equations
from report.site.solved_form import equations_of

#: Dimensions of systems.
DIMENSIONS = (1, 2, 3)

#: One of each kind of obstacle in each space it can stand in: only kind and dimension are in a program.
_ONES: tuple[Obstacle, ...] = (
    Circle((0.0, 0.0), 1.0),
    Sphere((0.0, 0.0, 0.0), 1.0),
    Cylinder((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), 1.0),
    *(Plane((0.0,) * d, (1.0, 0.0, 0.0)[:d]) for d in DIMENSIONS),
    *(Box((0.0,) * d, (1.0,) * d) for d in (2, 3)),
)

#: What every program reads of a system, by where it begins.
_ARRAYS = (
    *("x", "v", "springs", "rest_lengths", "stiffness", "damping", "masses", "gravity", "fixed"),
    *("weight", "divisor", "first", "spring", "sign", "forces", "out"),
    "nonlinear",
)

#: The force of spring j as loops have it, and where a system has springs that are not linear.
_LINEAR_FORCE = "spring_force(stiffness[j], stretch, damping[j], rate)"
_ANY_FORCE = "force_at(j, stretch, rate)"

#: What separations are divided by, as `reference.forces` has it.
_APART = "length if length > 0.0 else 1.0 if rest_length[j] == 0.0 else length"

#: A spring pulls its first mass towards the second, and the second towards the first.
_ENDS = (("a", "+="), ("b", "-="))

_HEAD = [f"const {{{', '.join((*_ARRAYS, 'n', 's', 'd'))}}} = at, drag = F[at.drag];"]


@dataclass(frozen=True)
class PageLoops(Loops):
    """The loops as a browser has them.

    Fixed masses have no acceleration, whatever the force: infinity over infinity would be no number. Springs add their
    forces to both masses at once: each mass has the same sum in the same order, the springs', and nothing is looked up.

    Attributes:
        nonlinear: whether springs need not be linear. One text for both would take several times as long.
    """

    nonlinear: bool = False

    def statements(self) -> list[ast.stmt]:
        """The loop over steps."""
        return ast.parse("\n".join(self._body())).body

    def _loop(self, index: str, count: str, before: list[str], body: list[str]) -> list[str]:
        begin = ["forces = weight.copy()"] if index == "j" else []
        return [*begin, *super()._loop(index, count, before, body)]

    def _spring(self, k: int) -> tuple[list[str], list[str]]:
        before, lines = super()._spring(k)
        kept = [line for line in lines if not line.startswith(tuple(f"force{i}[" for i in self.axes))]
        assert len(kept) == len(lines) - self.dimension, "the loops' text has changed"
        # one of rest length 0 and no length has no direction, and no force
        begin = kept.index("unit0 = separation0 / length")
        units = [line.replace(" / length", " / apart") for line in kept[begin:]]
        kept = [*kept[:begin], f"apart = {_APART}", *units]
        kept[kept.index(f"force = {_LINEAR_FORCE}")] = f"force = {_ANY_FORCE if self.nonlinear else _LINEAR_FORCE}"
        pulls = [f"pull{i} = unit{i} * force" for i in self.axes]
        return before, [*kept, *pulls, *(f"force{i}[{to}] {how} pull{i}" for to, how in _ENDS for i in self.axes)]

    def _sum(self) -> tuple[list[str], list[str]]:
        return [], [f"f{i} = force{i}[i]" for i in self.axes]

    def _mass(self, k: int, following: Place | None) -> tuple[list[str], list[str]]:
        before, lines = super()._mass(k, following)
        for i in self.axes:
            plain, guarded = (
                f"now{i} = f{i} / divisor[i]",
                f"now{i} = 0.0 if divisor[i] == np.inf else f{i} / divisor[i]",
            )
            assert plain in lines, "the loops' text has changed"
            lines[lines.index(plain)] = guarded
        return before, lines


@dataclass(frozen=True)
class PageScheme:
    """A scheme that the page can run.

    Attributes:
        scheme: the catalogue's.
        text: of a JavaScript object with its functions.
    """

    scheme: Scheme
    text: str


def unavailable() -> dict[str, str]:
    """The schemes that the page cannot run, with the reason."""
    return {name: str(found) for name, found in _all().items() if isinstance(found, Unsupported)}


def page_schemes() -> dict[str, PageScheme]:
    """Those that it can."""
    return {name: found for name, found in _all().items() if isinstance(found, PageScheme)}


@cache
def _all() -> dict[str, PageScheme | Unsupported]:
    found: dict[str, PageScheme | Unsupported] = {}
    for name, scheme in {**schemes(), **wide_schemes()}.items():
        try:
            found[name] = page_scheme(scheme)
        except Unsupported as reason:
            found[name] = reason
    return found


def page_scheme(scheme: Scheme) -> PageScheme:
    """A scheme as JavaScript. Raises Unsupported, with the reason, for one that cannot be traced or translated."""
    own = _loops(scheme)
    refusal = step_refusal(scheme)
    if refusal and "advance" not in own:
        raise Unsupported(f"{scheme.name} is not in the page: {refusal}")
    entries = {
        "name": json.dumps(scheme.name),
        "kind": json.dumps(scheme.kind),
        "order": str(scheme.order),
        "summary": json.dumps(scheme.summary),
        "equations": json.dumps(_equations(scheme)),
        "keeps": json.dumps(keeps_to_surfaces(scheme)),
        "polynomial": json.dumps(stability_polynomial(scheme)),
        "step": "null" if refusal else f"steps.{scheme.step.__name__}",
        "memory": json.dumps(not scheme.one_step),
        "implicit": json.dumps(scheme.implicit),
        "iterated": json.dumps(scheme.iterated),
        "solves": json.dumps(solves_for_positions(scheme)),
        "solved": json.dumps(SOLVED.get(scheme.name, scheme.name)),
        "proportional": json.dumps(damps_in_proportion(scheme)),
        "proportional_drag": json.dumps(drags_in_proportion(scheme)),
        **own,
    }
    return PageScheme(scheme, "{\n" + ",\n".join(f"{key}: {value}" for key, value in entries.items()) + "\n}")


def _loops(scheme: Scheme) -> dict[str, str]:
    """The loops of a scheme that has any; of one of the wide catalogue only what theory asks of it."""
    try:
        if scheme.needs == "accelerations of one mass":
            return _in_place(scheme)
        program = trace(scheme)
    except (Untraceable, Unsupported, InputError, AttributeError, TypeError, ValueError, IndexError):
        return {}
    return _of_theory(program) if scheme.kind == "wide_scheme" else _of_theory(program) | _explicit(program)


def _equations(scheme: Scheme) -> str:
    """What it computes in a step, as MathML; empty where that is no row of sums."""
    try:
        return of_equations(equations_of(scheme))
    except NotLinear:
        return ""


def script() -> str:
    """All of it: `schemes`, `law` and `obstacles`, in one text."""
    laws = (spring_force, elastic_energy, force_by_stretch, force_by_rate)
    lines = [line for function in laws for line in plain_function(text_of(function), function.__name__)]
    lines += [*law_functions(), *_force_at()]
    lines += ["const law = {" + ", ".join(function.__name__ for function in laws) + "};", *_readable_forces()]
    members = [f"{json.dumps(name)}: {scheme.text}" for name, scheme in page_schemes().items()]
    lines += [steps_script({**schemes(), **wide_schemes()})]
    lines += ["const schemes = {", ",\n".join(members), "};"]
    lines += ["const obstacles = {", ",\n".join(_obstacle(one) for one in _ONES), "};"]
    return "\n".join(lines) + "\n"


def _force_at() -> list[str]:
    """The force of a spring that need not be linear."""
    spring = ", ".join((*(f"F[at.{name} + j]" for name in ASKED), "stretch"))
    stiffness, damping = (f"{name}({spring})" for name in ("secant_stiffness", "damping_at"))
    force = f"spring_force({stiffness}, stretch, {damping}, rate)"
    return ["function force_at(F, I, at, j, stretch, rate) {", f"  return {force};", "}"]


def _of_theory(program: Program) -> dict[str, str]:
    return {"coefficients": _coefficients([text for text, _ in program.coefficients]), "linear": _linear(program)}


def _explicit(program: Program) -> dict[str, str]:
    rooms = ["xs", "vs", *(f"a{k}_" for k in PageLoops(program, 1, False).kept)]
    linear, nonlinear = (
        "{" + ", ".join(f"{d}: {_function(_explicit_lines(program, d, rooms, kind))}" for d in DIMENSIONS) + "}"
        for kind in (False, True)
    )
    return {"rooms": str(len(rooms)), "advance": linear, "nonlinear": nonlinear}


def _explicit_lines(program: Program, dimension: int, rooms: list[str], nonlinear: bool) -> list[str]:
    translation = Translation(dimension, functions=("force_at",), plain=("spring_force",), rooms=("forces",))
    body = translation.body(PageLoops(program, dimension, False, nonlinear=nonlinear).statements())
    shadowed = {"n", "s"}  # the loops count again what is known
    return [*_HEAD, *_rooms(rooms), *_numbers(len(program.coefficients)), *_without(body, shadowed)]


def _in_place(scheme: Scheme) -> dict[str, str]:
    loops = trace_in_place(scheme)
    step = definitions(loops.text)[-1]
    known = [argument.arg for argument in step.args.args if argument.arg.startswith("c")]
    stored = {n.id for n in ast.walk(step) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)}
    made = {n.value.id for n in ast.walk(step) if isinstance(n, ast.Subscript) and isinstance(n.value, ast.Name)}
    rooms = sorted(stored & made)
    translation = Translation(functions=("one_acceleration",), rooms=tuple(rooms))
    lines = translation.body(step.body, returned=("x", "v"))
    steps = ["for (let step = 0; step < steps; step++) {", *("  " + line for line in lines), "}"]
    head = [*_HEAD, "const one_acceleration = accelerate || (nonlinear ? acceleration_of_any : acceleration_of_one);"]
    function = _function([*head, *_rooms(rooms), *_numbers(len(known)), *steps])
    return {
        "coefficients": _coefficients(list(loops.texts)),
        "rooms": str(len(rooms)),
        "advance": f"(run => ({{1: run, 2: run, 3: run}}))({function})",
        "nonlinear": "null",
        "linear": "null",
    }


def _readable_forces() -> list[str]:
    """The forces on one mass, from the functions that `reference.forces` compiles; and for springs of any law."""
    from reference.forces import acceleration_of_mass, all_accelerations, force_of_spring, one_acceleration

    linear, any_law = text_of(force_of_spring), "force_of_any_spring"
    plain = f"force = {_LINEAR_FORCE.replace('stretch', 'length - rest_lengths[j]')}"
    assert plain in linear, "the forces' text has changed"
    nonlinear = linear.replace(plain, f"stretch = length - rest_lengths[j]\n    force = {_ANY_FORCE}")
    one, every = text_of(one_acceleration), text_of(all_accelerations)
    texts = {
        "force_of_spring": linear,
        any_law: nonlinear,
        "acceleration_of_mass": text_of(acceleration_of_mass),
        "acceleration_of_one": one,
        "acceleration_of_any": one.replace("force_of_spring(", f"{any_law}("),
        "accelerations_of_all": every,
        "accelerations_of_any": every.replace("force_of_spring(", f"{any_law}("),
    }
    lines: list[str] = []
    for name, text in texts.items():
        (definition,) = definitions(text)
        arguments = [argument.arg for argument in definition.args.args]
        body = Translation(functions=(*texts, "force_at"), plain=("spring_force",)).body(definition.body)
        lines += [f"function {name}(F, I, at, {', '.join(arguments)}) {{", "  const {n, s, d} = at;"]
        lines += [*("  " + line for line in body), "}"]
    return lines


def _linear(program: Program) -> str:
    """A step of linear motion: vectors x and v, changed in place; `accelerate` writes accelerations to its third."""
    lines = ["const m = x.length, a = [], X = new Float64Array(m), V = new Float64Array(m);"]
    for k, (x, v) in enumerate(program.stages):
        lines += ["for (let i = 0; i < m; i++) {", f"  X[i] = {_of_vectors(x)}; V[i] = {_of_vectors(v)};", "}"]
        lines += [f"a[{k}] = new Float64Array(m); accelerate(X, V, a[{k}]);"]
    x, v = program.end
    lines += ["for (let i = 0; i < m; i++) {", f"  const moved = {_of_vectors(x)}, fast = {_of_vectors(v)};"]
    lines += ["  x[i] = moved; v[i] = fast;", "}"]
    return "(x, v, c, accelerate) => {\n" + "\n".join("  " + line for line in lines) + "\n}"


def _of_vectors(expression: object) -> str:
    def read(name: str) -> str:
        if name in ("x", "v"):
            return f"{name}_"
        return f"{name[0]}_{name[1:]}" if name[0] in "ac" and name[1:].isdigit() else name

    text = of_expression(expression.text(read))  # type: ignore[attr-defined]
    for name in ("x_", "v_"):
        text = text.replace(name, f"{name[0]}[i]")
    return _indexed(text)


def _indexed(text: str) -> str:
    """a_0 and c_0 as a[0][i] and c[0]."""
    import re

    return re.sub(r"\ba_(\d+)\b", r"a[\1][i]", re.sub(r"\bc_(\d+)\b", r"c[\1]", text))


def _obstacle(one: Obstacle) -> str:
    """A function that puts mass i out of obstacles of a kind; its numbers are o0, o1, ..."""
    d = one.dimension
    program = trace_obstacles([one], d)
    statements = ast.parse("\n".join(program.lines)).body
    body = Translation().body(statements)
    place = [of_expression(text) for text in program.place]
    velocity = [of_expression(text) for text in program.velocity]
    axes = range(d)
    lines = [f"const [{', '.join(f'o{k}' for k in range(program.numbers))}] = numbers;"]
    lines += [f"const place{i} = F[x + {d} * i + {i}], velocity{i} = F[v + {d} * i + {i}];" for i in axes]
    lines += body
    lines += [f"F[x + {d} * i + {i}] = {place[i]}; F[v + {d} * i + {i}] = {velocity[i]};" for i in axes]
    text = "\n".join("  " + line for line in lines)
    return f"{json.dumps(f'{one.kind}{d}')}: (F, x, v, i, free, numbers) => {{\n{text}\n}}"


def _function(lines: list[str]) -> str:
    return "(F, I, at, c, steps, accelerate) => {\n" + "\n".join("  " + line for line in lines) + "\n}"


def _rooms(names: list[str]) -> list[str]:
    rooms = ", ".join(f"{name} = at.room + {k} * n * d" for k, name in enumerate(names))
    return [f"const {rooms};"] if names else []


def _numbers(count: int) -> list[str]:
    return [f"const [{', '.join(f'c{k}' for k in range(count))}] = c;"] if count else []


def _coefficients(texts: list[str]) -> str:
    return f"dt => [{', '.join(map(of_expression, texts))}]"


def _without(lines: list[str], names: set[str]) -> list[str]:
    """The lines without what would give these names values again."""
    kept = []
    for line in lines:
        if line.startswith("let "):
            left = [name for name in line[4:-1].split(", ") if name not in names]
            line = f"let {', '.join(left)};"
        if not any(line.startswith(f"{name} = ") for name in names):
            kept.append(line)
    return kept
