"""What a compiler is asked for, and what is made of what it says: by one that is made up, and a little by the real."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Iterator, Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from engines.own.c_file import compiler_found
from experiments.exercises.c import compiler
from experiments.exercises.c.compiler import (
    FILES,
    FILLED,
    MOST_ROUNDS,
    MOST_WARNINGS,
    OPTIONS,
    OWN,
    QUICKLY,
    WHERE_USED,
    Compiled,
    DoesNotCompileError,
    MissingFunctionError,
)
from experiments.exercises.c.process import NO_SANDBOX
from experiments.exercises.process.sandbox_errors import NotGradedError

#: Exit code, output and errors of a command.
Said = tuple[int, str, str]

GOOD: Said = (0, "", "")


class Sayings:
    """In place of the compiler in its sandbox: says what it is told to, and makes a library."""

    def __init__(self, *said: Sequence[Said]) -> None:
        self._said: Iterator[Sequence[Said]] = iter(said)
        self.commands: list[list[str]] = []
        self.sources: list[str] = []
        self.exposed: list[bool] = []

    def run(self, commands: Sequence[Sequence[str]], folder: Path, exposed: bool) -> list[Said]:
        """As `_run`."""
        self.commands = [list(command) for command in commands]
        self.sources.append((folder / OWN).read_text(encoding="utf-8"))
        self.exposed.append(exposed)
        (folder / "library.so").write_bytes(b"made")
        return list(next(self._said))


def says(
    monkeypatch: pytest.MonkeyPatch, *said: Sequence[Said], options: Sequence[str] = (), tool: bool = True
) -> Sayings:
    """A compiler that has these options, and says this, round after round."""
    made = Sayings(*said)
    monkeypatch.setattr(compiler, "compiler", lambda: "/opt/own/bin/cc")
    monkeypatch.setattr(compiler, "_takes", lambda program, option: option in options)
    monkeypatch.setattr(compiler, "_run", made.run)
    monkeypatch.setattr(compiler.shutil, "which", lambda name: f"/opt/tools/{name}" if tool else None)
    return made


@pytest.mark.parametrize("exposed", [True, False])
@pytest.mark.parametrize("options", [(), (FILLED,)])
def test_a_submission_is_compiled_and_linked_and_its_lines_are_asked_for(
    monkeypatch: pytest.MonkeyPatch, options: tuple[str, ...], exposed: bool
) -> None:
    """With what the compiler has; warnings are those of the submission, not of what it is linked with."""
    warned = f"{OWN}:3:5: warning: careful [-Wall]\nexercise.h:4:1: warning: not ours\n"
    table = f"{OWN}  4  0x10\n{OWN}  5  0x20\nguard.c  6  0x20\nguard.c  7  0x8\n{OWN}  -  0x30\n"
    made = says(
        monkeypatch, [(0, "", warned), (0, "", f"{OWN}:9: warning: of the linker"), (1, table, "")], options=options
    )
    assert compiler.compiled.__wrapped__(3, "own text", exposed) == Compiled(
        b"made", ((8, 0), (16, 4), (32, 5), (48, 0)), ((3, "careful"),)
    )
    assert (made.sources, made.exposed) == (["own text"], [exposed])
    first, second, third = made.commands
    assert first == ["/opt/own/bin/cc", *OPTIONS, *options, f"-I{FILES}", "-c", OWN, "-o", "own.o"]
    assert second[: len(first) - 4] == first[:-4]
    assert {"-DEXERCISE=3", "own.o", str(FILES / "guard.c"), "library.so", "-lm"} <= set(second)
    assert third == ["/opt/tools/objdump", "--dwarf=decodedline", "library.so"]


def test_without_the_tool_no_line_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of a crash; all else is the same."""
    made = says(monkeypatch, [GOOD, GOOD], tool=False)
    assert compiler.compiled.__wrapped__(3, "", False) == Compiled(b"made", (), ())
    assert len(made.commands) == 2


@pytest.mark.parametrize(
    ("said", "line", "words"),
    [
        ([(1, "", f"{OWN}:7:3: error: no such thing [-Werror=x]\n{OWN}:9:3: error: other")], 7, "no such thing"),
        ([(1, "", f"In file\n/tmp/{OWN}:7: fatal error: stops")], 7, "stops"),
        (
            [GOOD, (1, "", "own.o: in function f\nundefined reference to `half'\n")],
            None,
            "undefined reference to `half'",
        ),
        ([GOOD, (1, "", "a: multiple definition of `f'; b\n")], None, "multiple definition of `f'"),
        ([(1, "", "cc1: error: too much [-Wx]\n")], None, "too much"),
        ([(1, "", "first\nlast [-Wx]\n  \n")], None, "last"),
        ([(1, "", "")], None, "the compiler does not say why"),
        ([(-9, "", "last")], None, "the compiler was stopped: it took too much time or memory"),
    ],
)
def test_what_is_refused_is_told_with_its_line(
    monkeypatch: pytest.MonkeyPatch, said: list[Said], line: int | None, words: str
) -> None:
    """Of the first error in the submission; else what the linker, or the compiler at the end, says."""
    says(monkeypatch, said)
    with pytest.raises(DoesNotCompileError) as told:
        compiler.compiled.__wrapped__(1, "", False)
    assert (told.value.line, str(told.value)) == (line, words)


@pytest.mark.parametrize("name", ["step", "forces", "push_out"])
def test_a_missing_function_is_told_by_its_name(monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    """Those that exercises ask for."""
    says(monkeypatch, [GOOD, (1, "", f"guard.c: undefined reference to `{name}'")])
    with pytest.raises(MissingFunctionError, match=f"^{name}$"):
        compiler.compiled.__wrapped__(1, "", False)


def test_few_warnings_are_told_each_once() -> None:
    """The first ones."""
    lines = [f"{OWN}:{n}:1: warning: w{n} [-Wx]" for n in (4, 4, 5, 6, 7)]
    assert compiler._warnings("\n".join(lines)) == [(4, "w4"), (5, "w5"), (6, "w6")][:MOST_WARNINGS]


class FewVariants:
    """A program with variants, some of which are refused."""

    def __init__(self) -> None:
        self.refused: list[set[str]] = []

    def text(self) -> str:
        """By how many times something was refused."""
        return f"without {len(self.refused)}"

    def refuse(self, names: set[str]) -> None:
        """They are left out."""
        self.refused.append(names)


def of(*variants: str) -> Said:
    """What is said where these are wrong."""
    return 1, "", "".join(f"{name}:1:{n}: error: no\n" for n, name in enumerate(variants)) + "ours:1:1: warning: x\n"


def test_variants_that_are_refused_are_left_out_until_none_is(monkeypatch: pytest.MonkeyPatch) -> None:
    """By the names of their lines, with or without columns."""
    first = (1, "", "variant_0_2:1:5: error: no\nvariant_3_11:1: fatal error: no\nvariant_9_9:1: warning: x\n")
    made = says(monkeypatch, [first], [of("variant_4_1")], [GOOD, GOOD], options=(FILLED, WHERE_USED))
    variants: Any = FewVariants()
    assert compiler.with_variants(4, variants, True) == Compiled(b"made", (), ())
    assert variants.refused == [{"variant_0_2", "variant_3_11"}, {"variant_4_1"}]
    assert made.sources == ["without 0", "without 1", "without 2"]
    assert made.exposed == [True] * 3
    assert all({FILLED, WHERE_USED, *QUICKLY} <= set(command) for command in made.commands)
    assert {"-DEXERCISE=4", "-DOWN_STACK"} <= set(made.commands[1])


@pytest.mark.parametrize(
    ("said", "rounds"),
    [
        ([[of()]], 0),
        ([[(1, "", "submission.c:1:1: error: not of a variant\n")]], 0),
        ([[GOOD, of("variant_0_1")]], 0),
        ([[of("variant_0_1")]] * MOST_ROUNDS, MOST_ROUNDS),
    ],
    ids=["nothing", "the program", "the linker", "again and again"],
)
def test_where_it_is_not_a_variant_there_is_none(
    monkeypatch: pytest.MonkeyPatch, said: list[list[Said]], rounds: int
) -> None:
    """Nor where variants are refused round after round."""
    says(monkeypatch, *said)
    variants: Any = FewVariants()
    assert compiler.with_variants(4, variants, False) is None
    assert len(variants.refused) == rounds


def test_variants_that_take_too_long_are_none(monkeypatch: pytest.MonkeyPatch) -> None:
    """As what the compiler does not come to an end with."""
    says(monkeypatch)

    def late(*_: object) -> list[Said]:
        raise DoesNotCompileError(None, "late")

    monkeypatch.setattr(compiler, "_run", late)
    variants: Any = FewVariants()
    assert compiler.with_variants(4, variants, False) is None


def test_variants_are_compiled_as_the_program_is_but_quickly() -> None:
    """What it means is the same; it is not made fast, and has no lines, and nothing is warned of."""
    meaning = {"-std=gnu11", "-ffp-contract=off", "-shared", "-fPIC", "-fsanitize=bounds"}
    assert meaning <= set(OPTIONS)
    assert meaning <= set(QUICKLY)
    assert "-O0" in QUICKLY
    assert not {"-O1", "-g", "-Wall", "-Wfloat-conversion"} & set(QUICKLY)


@pytest.mark.parametrize(("user", "rights"), [(0, 0o777), (1000, 0o700), (None, 0o700)])
def test_whoever_compiles_may_write_in_the_folder(
    monkeypatch: pytest.MonkeyPatch, user: int | None, rights: int
) -> None:
    """Who was root compiles as another user; there may be no users at all. Afterwards it is gone."""
    if user is None:
        monkeypatch.delattr(compiler.os, "geteuid")
    else:
        monkeypatch.setattr(compiler.os, "geteuid", lambda: user)
    with compiler._folder("own text") as folder:
        assert folder.stat().st_mode & 0o777 == rights
        assert (folder / OWN).read_text(encoding="utf-8") == "own text"
    assert not folder.exists()


@pytest.mark.skipif(compiler_found() is None, reason="there is no C compiler")
def test_whether_a_compiler_takes_an_option(capfd: pytest.CaptureFixture[str]) -> None:
    """It is asked, and nothing of what it says is shown; who is not there takes none."""
    takes = compiler._takes.__wrapped__
    assert takes(compiler.compiler(), "-O1")
    assert not takes(compiler.compiler(), "-fno-such-option-at-all")
    assert not takes("/nowhere/cc", "-O1")
    assert "".join(capfd.readouterr()) == ""


def ran(
    monkeypatch: pytest.MonkeyPatch, folder: Path, **done: Any
) -> tuple[list[Said], dict[str, Any], dict[str, Any]]:
    """What comes of commands, the task that the process was given, and how it was begun."""
    begun: dict[str, Any] = {}

    def run(command: list[str], **how: Any) -> SimpleNamespace:
        begun.update(how, command=command)
        if "raised" in done:
            raise done["raised"]
        return SimpleNamespace(**{"returncode": 0, "stdout": "[]", "stderr": "", **done})

    monkeypatch.setattr(compiler.subprocess, "run", run)
    said = compiler._run([["/opt/own/bin/cc", "-c"], ["/else/tools/bin/objdump", "-d"]], folder, True)
    return said, json.loads(begun["input"]), begun


def test_the_compiler_may_read_itself_and_write_in_its_folder(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """The folder that it was installed in, the system's, and the exercise's files."""
    said, task, begun = ran(monkeypatch, tmp_path, stdout='[[1, "out", "no"], [0, "", ""]]')
    assert said == [(1, "out", "no"), (0, "", "")]
    assert task["commands"] == [["/opt/own/bin/cc", "-c"], ["/else/tools/bin/objdump", "-d"]]
    assert {"/opt/own", "/usr", str(FILES)} <= set(task["readable"])
    assert not {"/opt/own/bin", "/else/tools", "/", "/opt", str(tmp_path)} & set(task["readable"])
    assert task["writable"] == [str(tmp_path)]
    assert (task["folder"], task["exposed"]) == (str(tmp_path), True)
    assert begun["env"].keys() == {"PATH", "TMPDIR", "LC_ALL"}
    assert (begun["env"]["TMPDIR"], begun["cwd"]) == (str(tmp_path), tmp_path)
    assert begun["command"][1:] == ["-I", "-S", "-B", "-X", "utf8", str(FILES / "process.py")]
    assert (begun["capture_output"], begun["text"]) == (True, True)


@pytest.mark.parametrize(
    ("done", "error", "words"),
    [
        ({"returncode": NO_SANDBOX}, NotGradedError, "see --let-submissions-reach-my-files"),
        ({"returncode": 1, "stderr": "first\nlast\n"}, NotGradedError, "the compiler could not be run: last$"),
        ({"raised": OSError(2, "no such file")}, NotGradedError, "the compiler could not be run: no such file$"),
        (
            {"raised": subprocess.TimeoutExpired("cc", 30)},
            DoesNotCompileError,
            "the compiler does not come to an end within 30 s$",
        ),
    ],
)
def test_a_compiler_that_cannot_be_run_is_told(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, done: dict[str, Any], error: type[Exception], words: str
) -> None:
    """It is no fault of the submission, but where it takes too long."""
    with pytest.raises(error, match=words):
        ran(monkeypatch, tmp_path, **done)
