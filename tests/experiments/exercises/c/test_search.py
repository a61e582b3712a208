"""The search for the smallest change of a C program that makes it right, as in Python, by compiled variants."""

from __future__ import annotations

import _ctypes
import ctypes
from pathlib import Path

import pytest

from experiments.exercises.c import compiler
from experiments.exercises.c.calls import EndedBySignalError, functions_of
from experiments.exercises.c.changes import MOST, CChanges
from experiments.exercises.c.compiler import compiled
from experiments.exercises.c.reading import read
from experiments.exercises.c.switched import Switched, SwitchedProgram
from experiments.exercises.c.tree import Verbatim, functions_in
from experiments.exercises.c.variants import Variants, _names_of
from experiments.exercises.c.written import text_of
from experiments.exercises.closer_look import CloserLook, Effort, _groups, look_closer
from experiments.exercises.exercise import find
from experiments.exercises.grading import Grade
from experiments.exercises.handed_in.submission import Submission
from experiments.exercises.process.child import fresh
from experiments.exercises.teaching.words import paragraphs
from experiments.exercises.verdict.answer_catalogue import catalogue_of
from experiments.exercises.verdict.judge import judge
from tests.experiments.exercises.blind_rates import SAMPLES, Program

pytestmark = pytest.mark.skipif(compiler.compiler_found() is None, reason="there is no C compiler")

PROGRAMS = Path(__file__).parent

#: So many changes are compiled here, the cheapest ones, among which are those that mend these programs.
FEW = 800

#: Enough for each of them, whatever the machine.
PATIENT = Effort(8.0, 0.0, compiled=FEW)

#: Right programs by exercise.
RIGHT = {
    1: "right_struct_copy",
    2: "right_helper",
    3: "right_loop",
    4: "right_arrays",
    7: "right_barrier",
}


def right(number: int) -> str:
    """A right program."""
    return (PROGRAMS / f"e{number:02}" / f"{RIGHT[number]}.c").read_text(encoding="utf-8")


def looked(number: int, text: str, effort: Effort = PATIENT) -> CloserLook:
    """What is seen of a wrong program in C."""
    verdict = judge(find(str(number)), text, language="c")
    assert not verdict.right
    return look_closer(find(str(number)), text, "", verdict, effort=effort, language="c")


#: A step of exercise 1.
STEP = """#define EXERCISE 1
#include "exercise.h"
void step(double *y, double *v, double dt, const struct spring *s)
{
    double a = (s->stiffness * (-*y - s->rest_length) - s->damping * *v) / s->mass - s->gravity;
    *y += dt * *v;
    *v += dt * a;
}
"""


@pytest.mark.rotating(4, in_turn=True)
def test_one_slip_is_led_to_its_line_and_kind_and_told_to_nobody_else() -> None:
    """The student is told the line and the kind, the teacher the change."""
    text = STEP.replace("(-*y - s", "(-*y - 0 * s")
    exercise = find("1")
    closer = looked(1, text)
    assert closer.told[0].places[0][0] == 5
    verdict = judge(exercise, text, language="c")
    said = "\n".join(paragraphs(Submission("own.c", text, exercise, language="c"), Grade(verdict, None, 0.0, closer)))
    assert "line 5 (" in said
    assert "->" not in said
    assert "double a =" in closer.told[0].change


@pytest.mark.rotating(7, in_turn=True)
@pytest.mark.parametrize(
    ("number", "old", "new", "line", "family"),
    [
        (1, "*v += dt * a;", "*v += 1 / 2 * dt * a;", 7, "operator"),
        (1, "*v += dt * a;", "*v -= dt * a;", 7, "sign"),
        (1, "s->stiffness * (", "s->stiffness + (", 5, "operator"),
    ],
)
def test_slips_of_one_line(number: int, old: str, new: str, line: int, family: str) -> None:
    """Those of a step by Euler, by the place that is told."""
    assert old in STEP
    closer = looked(number, STEP.replace(old, new))
    assert (line, family) in {place for repair in closer.told for place in repair.places}


@pytest.mark.rotating(13)
@pytest.mark.parametrize(
    "program", [p for p in SAMPLES["blind4"] if p.language == "c" and not p.right], ids=lambda p: p.name
)
def test_what_is_told_makes_the_program_right(program: Program) -> None:
    """Written into the text it passes the public check and a hidden one that it was not tried on."""
    exercise = find(str(int(program.name[1:3])))
    verdict = judge(exercise, program.text, language="c")
    closer = look_closer(exercise, program.text, "", verdict, effort=Effort(2.0, 0.0, compiled=FEW), language="c")
    changes = CChanges.of(exercise.number, program.text, _groups(exercise, "", verdict), most=FEW)
    assert changes is not None
    for repair in closer.told:
        (edit, *_) = [
            e
            for e, on in zip(changes.edits, changes.variants.switches, strict=False)
            if on and ((e.line, e.family),) == repair.places and changes.told(e) == repair.change
        ]
        with edit.applied():
            text = text_of(changes.program).replace("#define EXERCISE", "#include <string.h>\n#define EXERCISE", 1)
        assert judge(exercise, with_copies(text), language="c", key="k").right, repair


def with_copies(text: str) -> str:
    """The text with what copies an array in it."""
    copied = "static void *springlab_copied(const void *a, unsigned long n) { return memcpy(malloc(n), a, n); }"
    return text.replace('#include "exercise.h"', f'#include "exercise.h"\n#include <stdlib.h>\n{copied}', 1)


def changes_of(number: int, text: str) -> CChanges:
    """The cheapest changes of a program, compiled."""
    exercise = find(str(number))
    found = CChanges.of(number, text, _groups(exercise, "", judge(exercise, text, language="c")), most=FEW)
    assert found is not None
    return found


@pytest.mark.rotating(7, in_turn=True)
def test_a_variant_answers_as_the_changed_text_does(tmp_path: Path) -> None:
    """Switched on, a change does what it does where it is written into the text; switched off, nothing."""
    changes = changes_of(1, STEP.replace("dt * a", "dt + a"))
    (tmp_path / "variants.so").write_bytes(changes.library.library)
    program = SwitchedProgram(str(tmp_path / "variants.so"), 1, changes.variants.places)
    question = _groups(find("1"), "", judge(find("1"), STEP, language="c"))[0][0].asked()

    def answer(names: object) -> tuple[float, float]:
        program.begin_call()
        return names["step"](*map(fresh, question["arguments"]))  # type: ignore[index]

    before, others = answer(program.anew()), 0
    tried = [(e, on) for e, on in zip(changes.edits, changes.variants.switches, strict=False) if on]
    for edit, on in tried[:: len(tried) // 6]:
        with edit.applied():
            text = with_copies(text_of(changes.program).replace("#define EX", "#include <string.h>\n#define EX", 1))
        (tmp_path / "plain.so").write_bytes(compiled(1, text, False).library)
        plain = SwitchedPlain(str(tmp_path / "plain.so"))
        with program.changed([Switched(edit.cost, on)]) as names:
            now = answer(names)
        assert now == pytest.approx(plain.answer(question), rel=1e-12, nan_ok=True), text
        assert answer(program.anew()) == before
        others += now != before
    assert others > 3


class SwitchedPlain:
    """A library of a program without variants."""

    def __init__(self, path: str) -> None:
        self._library = ctypes.CDLL(path)
        self._step = functions_of(self._library, 1, [])["step"]

    def answer(self, question: dict[str, object]) -> tuple[float, float]:
        """Of one question."""
        try:
            return self._step(*map(fresh, question["arguments"]))  # type: ignore[call-overload]
        finally:
            _ctypes.dlclose(self._library._handle)


@pytest.mark.rotating(4, in_turn=True)
def test_one_change_that_the_compiler_refuses_takes_no_other_with_it() -> None:
    """A struct among numbers: what it makes no C of is left out, and what mends the program is found."""
    text = STEP.replace("double a =", "struct spring own = *s;\n    double a =").replace("*v += dt", "*v -= dt")
    assert {repair.places for repair in looked(1, text).told} >= {((8, "sign"),)}
    changes = changes_of(1, text)
    before = list(changes.variants.switches)
    first = next(on for on in before if len(on) == 1)
    changes.variants.refuse({"variant_{}_{}".format(*first[0])})
    after = changes.variants.switches
    assert [on for on, then in zip(before, after, strict=True) if on != then and first[0] not in on] == []
    assert first not in after


@pytest.mark.rotating(7, in_turn=True)
@pytest.mark.parametrize(
    ("number", "name", "old", "new"),
    [(3, "right_malloc", "x[i - 1][1]", "x[i - 0][1]"), (4, "right_arrays", "v[i][k] += dt", "v[i][k] -= dt")],
)
def test_what_writes_beyond_its_arrays_ends_no_search(number: int, name: str, old: str, new: str) -> None:
    """Indices too far in a helper, more bytes than were asked for: such changes are tried, and the right one found."""
    text = (PROGRAMS / f"e{number:02}" / f"{name}.c").read_text(encoding="utf-8")
    line = text[: text.index(old)].count("\n") + 1
    closer = looked(number, text.replace(old, new))
    assert line in {line for repair in closer.told for line, _ in repair.places}


@pytest.mark.rotating(4)
@pytest.mark.parametrize(
    "change",
    [
        "memset(x, 0, (size_t)-1);",
        "memset(own, 0, (size_t)-1);",
        "memset(asked, 0, (size_t)-1);",
        "for (int i = 0; i >= 0; i++) local[i] = 1;",
        "for (int i = 0; i <= 0; i--) v[i][0] = 1;",
        *(f"x[{far}][0] = 1;" for far in (3000, 20000, 60000, -3000, -20000, -60000)),
        "for (;;) ;",
        "step(x, v, dt, s);",
        "abort();",
    ],
)
def test_whatever_a_variant_does_the_next_call_is_as_before(tmp_path: Path, change: str) -> None:
    """Writes over all memory that it can reach, loops, signals: it is stopped, and nothing else has changed."""
    text = (
        '#define EXERCISE 4\n#include "exercise.h"\n#include <stdlib.h>\n#include <string.h>\nstatic double own[9];\n'
        "void step(double x[][2], double v[][2], double dt, const struct string *s)\n{\n    double local[2];\n"
        "    double *asked = malloc(64);\n    if (dt > 1) {\n        HERE\n    }\n"
        "    local[0] = own[0] + asked[1] * 0;\n    x[0][0] += 2 * dt;\n    v[0][0] = dt;\n}\n"
    ).replace("HERE", change)
    variants = Variants(read(text), [])
    library = compiler.with_variants(4, variants, False)
    assert library is not None
    (tmp_path / "variants.so").write_bytes(library.library)
    program = SwitchedProgram(str(tmp_path / "variants.so"), 4, variants.places)
    x, v, dt, string = catalogue_of(find("4"), "", None).questions[0].arguments

    def answer(by: float) -> list[float]:
        program.begin_call()
        positions, velocities = program.anew()["step"](fresh(x), fresh(v), by, fresh(string))
        return [*positions.ravel(), *velocities.ravel()]

    before = answer(dt)
    with pytest.raises(EndedBySignalError):
        answer(2.0)
    assert answer(dt) == before


@pytest.mark.rotating(4, in_turn=True)
def test_a_program_that_is_not_read_is_told_its_behaviour_as_before() -> None:
    """A macro for a piece of a statement: nothing is searched, and nothing is claimed to have been tried."""
    text = STEP.replace("void step", "#define MINUS -\nvoid step").replace("*v += dt * a", "*v += MINUS dt * a")
    closer = looked(1, text)
    assert (closer.tried, closer.told) == (0, ())
    assert closer.findings


@pytest.mark.rotating(7, in_turn=True)
def test_no_more_changes_are_compiled_than_time_allows() -> None:
    """The cheapest ones are."""
    changes = changes_of(4, right(4).replace("+= ", "-= ", 1))
    on = [i for i, switches in enumerate(changes.variants.switches) if switches]
    assert 0.9 * FEW < len(on) <= FEW < MOST
    assert [e.cost for e in changes.edits] == sorted(e.cost for e in changes.edits)


def test_names_that_a_copied_statement_declares_are_known_after_it() -> None:
    """As those of a declaration that is read, and of none that declares nothing."""
    copied = Verbatim()
    copied.text, copied.names = "struct spring *s, t;", ["s", "t"]
    assert _names_of(copied) == {"s", "t"}
    (own,) = functions_in(read("void own(double x)\n{\ndouble l = 2 * x;\nx = l;\n}\n").tree)
    assert [_names_of(one) for one in own.body] == [{"l"}, set()]
