"""Submissions in C: the same verdicts as in Python, and what goes wrong in C only told with its line."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest

from experiments.exercises.c import compiler
from experiments.exercises.c.compiler import DoesNotCompileError, compiled
from experiments.exercises.exercise import exercises, find
from experiments.exercises.grading import grade, grade_class
from experiments.exercises.handed_in.submission import Submission, read
from experiments.exercises.process.sandbox import Limits
from experiments.exercises.process.sandbox_errors import NotGradedError
from experiments.exercises.teaching.gradescope import grade_folder
from experiments.exercises.teaching.handout import hand_out
from experiments.exercises.teaching.words import paragraphs
from experiments.exercises.verdict.judge import judge
from reference.errors import InputError
from tests.experiments.exercises.blind_rates import SAMPLES, Program

pytestmark = pytest.mark.skipif(compiler.compiler_found() is None, reason="there is no C compiler")

PROGRAMS = Path(__file__).parent
EXPECTED = tomllib.loads((PROGRAMS / "expected.toml").read_text(encoding="utf-8"))

#: Programs whose line is told: by an error, or by what the compiler warns of.
LINES = {
    "e01/semicolon_missing.c": 7,
    "e01/null_pointer.c": 7,
    "e01/integer_stretch.c": 6,
    "e02/half_is_zero.c": 13,
    "e02/local_array_too_short.c": 9,
    "e03/before_the_first.c": 7,
    "e03/beyond_the_last.c": 7,
    "e03/undeclared_helper.c": 6,
    "e03/endless_recursion.c": 6,
    "e07/abs_of_a_fraction.c": 9,
}


@pytest.mark.rotating(13)
@pytest.mark.parametrize("name", EXPECTED)
def test_each_program_is_called_what_it_is(name: str) -> None:
    """Right ones pass the hidden check too; wrong ones have their name, and a line where C tells one."""
    given = grade(read(PROGRAMS / name, name), "sesame", Limits(seconds=1))
    assert given.verdict.name == EXPECTED[name]["called"], EXPECTED[name]["words"]
    if name in LINES:
        words = [f.words for f in (*given.verdict.findings, *given.closer.findings)]
        assert any(said.startswith(f"line {LINES[name]}: ") for said in words), words


@pytest.mark.rotating(13)
@pytest.mark.parametrize("program", [p for p in SAMPLES["blind4"] if p.language == "c"], ids=lambda p: p.name)
def test_programs_of_somebody_who_had_only_the_texts(program: Program) -> None:
    """Right ones pass in the hidden check too, wrong ones in neither."""
    for key in (None, "sesame"):
        verdict = judge(find(str(int(program.name[1:3]))), program.text, program.seed, key, language="c")
        assert verdict.right == program.right, (program.words, verdict.name)


@pytest.mark.rotating(7, in_turn=True)
def test_the_same_by_every_route(tmp_path: Path) -> None:
    """Alone, in a class, and by Gradescope: outcome and name of one program."""
    text = (PROGRAMS / "e03" / "above_only.c").read_text(encoding="utf-8")
    folder = tmp_path / "ada"
    folder.mkdir()
    (folder / "forces.c").write_text(text, encoding="utf-8")
    alone = judge(find("3"), text, language="c")
    (row,) = grade_class([(folder / "forces.c", "ada/forces.c")], tmp_path / "grades.csv")
    gradescope = grade_folder(folder, {"exercise": "forces", "key": None})["extra_data"]
    assert (alone.outcome, alone.name) == ("mistake", "spring_above_only")
    assert (row["outcome"], row["finding"]) == (alone.outcome, alone.name)
    assert (gradescope["outcome"], gradescope["finding"]) == (alone.outcome, alone.name)


@pytest.mark.rotating(7, in_turn=True)
def test_midpoint_and_ralston_are_told_from_heun_by_overflow() -> None:
    """Where dt a > 1.8e308 Heun's guess is infinite; dt/2 a and 2/3 dt a are not. On linear springs all are one."""
    heun = (PROGRAMS / "e02" / "right_helper.c").read_text(encoding="utf-8")
    assert judge(find("2"), heun, language="c").name == "right"
    for part, weights, name in (("0.5", ("0.0", "1.0"), "midpoint"), ("2.0 / 3", ("0.25", "0.75"), "ralston")):
        text = heun.replace("state[i] + dt * first[i]", f"state[i] + {part} * dt * first[i]")
        for i in range(2):
            average = f"0.5 * (first[{i}] + second[{i}])"
            assert average in text
            first = f"{weights[0]} * first[{i}] + " if name == "ralston" else ""
            text = text.replace(average, f"({first}{weights[1]} * second[{i}])")
        verdict = judge(find("2"), text, language="c")
        assert (verdict.name, verdict.outcome) == (name, "another scheme")


@pytest.mark.rotating(7, in_turn=True)
def test_starters_compile_and_are_not_written_yet(tmp_path: Path) -> None:
    """Each exercise that has one; the others say so."""
    for number, exercise in exercises().items():
        folder = tmp_path / str(number)
        if exercise.starter_in_c is None:
            with pytest.raises(InputError, match="in C"):
                hand_out(exercise, folder, "example", None, "c")
            continue
        own, *others = hand_out(exercise, folder, "example", None, "c")
        assert own.suffix == ".c"
        assert "exercise.h" in {file.name for file in others}
        submission = read(own, own.name)
        assert (submission.exercise.number, submission.language) == (number, "c")
        assert judge(exercise, submission.source, language="c").name == "not_written_yet"
        compiled(number, submission.source, False)


def test_a_comment_that_nobody_closed_is_what_the_compiler_says() -> None:
    """What stands in it is no function that has nothing in it."""
    text = '#define EXERCISE 1\n#include "exercise.h"\n/* open\nvoid step(double *y) {\n}\n'
    verdict = judge(find("1"), text, language="c")
    assert (verdict.name, verdict.findings[0].line) == ("does_not_compile", 3)


@pytest.mark.rotating(7, in_turn=True)
def test_what_nobody_has_written_into_is_not_zero() -> None:
    """A sum that begins with no number: compilers take 0 for it where they may. The line is told."""
    text = (
        '#define EXERCISE 1\n#include "exercise.h"\n'
        "void step(double *y, double *v, double dt, const struct spring *s)\n{\n    double a;\n"
        "    a = a + (s->stiffness * (-*y - s->rest_length) - s->damping * *v) / s->mass - s->gravity;\n"
        "    *y += *v * dt;\n    *v += a * dt;\n}\n"
    )
    assert judge(find("1"), text.replace("double a;", "double a = 0.0;"), language="c").right
    if not compiler._takes(compiler.compiler(), compiler.FILLED):
        pytest.skip("this compiler does not fill local variables")
    given = grade(Submission("own.c", text, find("1"), language="c"))
    assert not any(given.public.passed)
    assert [f.name for f in given.closer.findings if "line 6" in f.words] == ["compiler_warns"]


def test_a_compiler_opens_nothing_of_the_teachers(tmp_path: Path) -> None:
    """What a program includes, or takes in by the assembler, is refused as a file that may not be read."""
    secret = tmp_path / "key.txt"
    secret.write_text("int sesame;\n", encoding="utf-8")
    start = '#define EXERCISE 1\n#include "exercise.h"\n'
    ways = (f'#include "{secret}"\n', f'__asm__(".incbin \\"{secret}\\"");\n')
    for way in ways:
        with pytest.raises(DoesNotCompileError) as refused:
            compiled(
                1,
                f"{start}{way}void step(double *y, double *v, double dt, const struct spring *s) {{ *y = 0; }}\n",
                False,
            )
        assert "sesame" not in str(refused.value)


@pytest.mark.rotating(7, in_turn=True)
def test_what_is_compiled_is_kept_in() -> None:
    """Code that runs while it is loaded finds the sandbox closed already: it opens no file, and its step counts."""
    text = (PROGRAMS / "e01" / "right_pointers.c").read_text(encoding="utf-8").replace("#define EXERCISE 1\n", "")
    early = (
        "#include <stdio.h>\n#include <stdlib.h>\nstatic int open_files;\n"
        "__attribute__((constructor)) static void early(void)\n"
        '{ open_files = fopen("/etc/passwd", "r") != 0 || system("true") == 0; }\n'
    )
    text = f"#define EXERCISE 1\n{text.replace('double stretch', 'if (open_files) *y = 1e9; double stretch')}"
    text = text.replace('#include "exercise.h"\n', f'#include "exercise.h"\n{early}')
    assert judge(find("1"), text, language="c").name == "right"


def test_without_a_compiler_nothing_is_graded(monkeypatch: pytest.MonkeyPatch) -> None:
    """That is not the student's fault, and it says what is needed."""
    monkeypatch.setattr(compiler, "compiler_found", lambda: None)
    with pytest.raises(NotGradedError, match="gcc"):
        compiled(1, "int other_than_before;", False)


#: A right step of exercise 1 in C, up to its last line.
STEP = (
    '#define EXERCISE 1\n#include "exercise.h"\nvoid step(double *y, double *v, double dt, const struct spring *s)\n{\n'
    "    double a = (s->stiffness * (-*y - s->rest_length) - s->damping * *v) / s->mass - s->gravity;\n"
    "    *y += dt * *v;\n"
)


@pytest.mark.rotating(7, in_turn=True)
def test_what_the_compiler_warns_of_is_told_of_a_program_that_passes_too() -> None:
    """It passes all the same, and has no remark where the compiler has none."""
    quiet, warned = f"{STEP}    *v += dt * a;\n}}\n", f"{STEP}    int n = 1.0e3 + dt;\n    *v += dt * a + 0 * n;\n}}\n"
    assert judge(find("1"), quiet, language="c").remarks == ()
    given = grade(Submission("own.c", warned, find("1"), language="c"))
    assert given.verdict.name == "right"
    assert "line 7: the compiler warns" in "\n".join(paragraphs(Submission("own.c", warned, find("1")), given))


@pytest.mark.rotating(7, in_turn=True)
def test_a_crash_by_memory_may_be_an_earlier_lines() -> None:
    """A loop one too far writes over what the next line reads; the compiler's own check stops where it went wrong."""
    crashes = f"{STEP}    double *late = 0;\n    *late = a;\n}}\n"
    stopped = f"{STEP}    double b[2] = {{a, a}};\n    int i = 2 + (dt < 0);\n    *v += dt * b[i];\n}}\n"
    for text, line, by_memory in ((crashes, 8, True), (stopped, 9, False)):
        (finding,) = judge(find("1"), text, language="c").findings
        assert (finding.name, finding.line) == ("outside_an_array", line)
        assert ("an earlier line may have written over" in finding.words) == by_memory


@pytest.mark.rotating(7, in_turn=True)
def test_a_program_that_ends_itself_is_told_so() -> None:
    """By abort, or an assert that fails."""
    begin = STEP.replace("void step", "#include <assert.h>\n#include <stdlib.h>\nvoid step")
    for call in ("abort();", "assert(dt < 0);"):
        (finding,) = judge(find("1"), f"{begin}    {call}\n}}\n", language="c").findings
        assert "your program ended itself: it called abort, or an assert failed" in finding.words


@pytest.mark.rotating(7, in_turn=True)
def test_a_programs_own_trap_is_no_arrays() -> None:
    """Though the compiler's check of an index is the same instruction."""
    trapped = f"{STEP}    /* a\n       b */\n    if (dt > 0) __builtin_trap();\n}}\n"
    (finding,) = judge(find("1"), trapped, language="c").findings
    assert (finding.name, finding.line) == ("crashed", 9)
    assert "illegal instruction" in finding.words
    assert "array" not in finding.words


def test_a_missing_include_is_named() -> None:
    """Only where the text lacks it."""
    lacks = STEP.replace('#include "exercise.h"', '// #include "exercise.h"')
    for text, missing in ((f"{lacks}}}\n", True), (f"{STEP}    *v += ;\n}}\n", False)):
        (finding,) = judge(find("1"), text, language="c").findings
        assert finding.name == "does_not_compile"
        assert ('#include "exercise.h" is missing' in finding.words) == missing


@pytest.mark.rotating(7, in_turn=True)
def test_in_c_nothing_is_returned() -> None:
    """What is told of a C program speaks of what it writes; of the lines that do; C++ is told as such."""
    still = judge(find("1"), f"{STEP.split('    double')[0]}    if (dt < 0) *y = 0;\n}}\n", language="c")
    assert still.name == "nothing_moves"
    assert "return" not in still.findings[0].words + still.findings[0].hint
    given = grade(Submission("own.c", f"{STEP}    *v += dt * a * a;\n}}\n", find("1"), language="c"))
    assert [f.lines for f in given.closer.findings if f.name == "right_and_wrong_parts"] == [(7,)]
    other = judge(find("1"), f"#include <iostream>\n{STEP}}}\n", language="c")
    assert (other.name, other.findings[0].hint) == ("does_not_compile", "Is it C++? It is compiled as C.")


def test_a_file_with_the_ending_of_another_language_is_taken_as_c(tmp_path: Path) -> None:
    """Many write C into files of that name; it passes if it compiles as C."""
    (tmp_path / "euler.cpp").write_text(f"{STEP}    *v += dt * a;\n}}\n", encoding="utf-8")
    assert grade(read(tmp_path / "euler.cpp", "euler.cpp")).verdict.name == "right"
