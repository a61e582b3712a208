"""A C submission compiled by the system's compiler, in a process that can open nothing of the teacher's (`process`).

What is compiled is a library that the submission's own process loads: its machine code, and which line of the text each
piece of it is of, so that a crash can be told with its line.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from engines.own.c_file import COMPILERS, compiler_found
from experiments.exercises.c.process import NO_SANDBOX
from experiments.exercises.c.variants import Variants
from experiments.exercises.process.sandbox_errors import NotGradedError

#: Multiplications and additions round one by one, as in Python; the program's own arrays are guarded, and a function
#: that nobody has declared is an error. What nobody has written into is no number that looks right.
OPTIONS = (
    "-O1",
    "-g",
    "-std=gnu11",
    "-ffp-contract=off",
    "-fvisibility=hidden",
    "-shared",
    "-fPIC",
    "-fsanitize=bounds",
    "-fsanitize-undefined-trap-on-error",
    "-Wall",
    "-Werror=implicit-function-declaration",
    "-Werror=implicit-int",
    "-Wno-unused",
    "-Wno-unknown-pragmas",
    "-Wfloat-conversion",
)

#: The same for a program with its variants, of which each is run for a moment only; and how often what the compiler
#: refuses is left out.
QUICKLY = (
    "-O0",
    *(option for option in OPTIONS if not option.startswith(("-O", "-g", "-W"))),
    *(f"-Werror={what}" for what in ("implicit-function-declaration", "int-conversion", "incompatible-pointer-types")),
)
MOST_ROUNDS = 3

#: What makes a local variable that nobody has written into a number that cannot pass: not every compiler has it.
FILLED = "-ftrivial-auto-var-init=pattern"

#: What makes an error stand where a macro is used, not where it is defined: not every compiler has it.
WHERE_USED = "-ftrack-macro-expansion=0"

#: Where a submission, and the exercise's own C files, are while they are compiled.
OWN, FILES = "submission.c", Path(__file__).parent

#: How long a compiler may take [s].
LIMIT = 30.0

#: What a compiler may read: itself, the system's headers and libraries.
READABLE = ("/usr", "/lib", "/lib64", "/bin", "/etc/ld.so.cache", "/dev/null", "/dev/urandom")

#: A warning that is told of a program that is wrong: at most so many.
MOST_WARNINGS = 3


class DoesNotCompileError(Exception):
    """The compiler refused; with the line of the submission and what is wrong there."""

    def __init__(self, line: int | None, words: str) -> None:
        super().__init__(words)
        self.line = line


class MissingFunctionError(Exception):
    """The function that was asked for is not there; its words are its name."""


@dataclass(frozen=True)
class Compiled:
    """What was made of a C submission.

    Attributes:
        library: the bytes of a shared library.
        lines: of its code, address and line of the submission (0: none of it), in order of addresses.
        warnings: lines, and what the compiler says of them.
    """

    library: bytes
    lines: tuple[tuple[int, int], ...]
    warnings: tuple[tuple[int, str], ...]


def compiler() -> str:
    """The system's C compiler. Raises NotGradedError, with the way out, where there is none."""
    found = compiler_found()
    if found is None:
        raise NotGradedError(f"there is no C compiler: expected one of {', '.join(COMPILERS)} on the PATH, or CC")
    return found


@lru_cache(maxsize=256)
def compiled(exercise: int, source: str, exposed: bool) -> Compiled:
    """A C submission, compiled; kept for the checks that follow.

    Args:
        exposed: whether it is compiled even where the machine cannot keep the compiler from files.

    Raises:
        DoesNotCompileError, MissingFunctionError: where it is the submission's fault.
        NotGradedError: where it is not.
    """
    program, tool = compiler(), shutil.which("objdump")
    begin = [program, *OPTIONS, *([FILLED] if _takes(program, FILLED) else []), f"-I{FILES}"]
    commands = [
        [*begin, "-c", OWN, "-o", "own.o"],
        [*begin, f"-DEXERCISE={exercise}", str(FILES / "guard.c"), "own.o", "-Wl,-z,defs", "-o", "library.so", "-lm"],
        # which line each piece of code is of; without the tool no line of a crash is told
        *([[tool, "--dwarf=decodedline", "library.so"]] if tool else []),
    ]
    with _folder(source) as folder:
        said = _run(commands, folder, exposed)
        for code, _, errors in said[:2]:
            if code:
                raise DoesNotCompileError(*_first_error(errors, code))
        lines = _lines(said[2][1]) if len(said) > 2 else []
        return Compiled((folder / "library.so").read_bytes(), tuple(lines), tuple(_warnings(said[0][2])))


def with_variants(exercise: int, variants: Variants, exposed: bool) -> Compiled | None:
    """A program with all its variants, compiled quickly; those that the compiler refuses are left out.

    None where it is the program itself that is refused.

    Raises:
        NotGradedError: where the compiler cannot be kept in.
    """
    program = compiler()
    options = [option for option in (FILLED, WHERE_USED) if _takes(program, option)]
    begin = [program, *QUICKLY, *options, f"-I{FILES}"]
    commands = [
        [*begin, "-c", OWN, "-o", "own.o"],
        [
            *begin,
            f"-DEXERCISE={exercise}",
            "-DOWN_STACK",
            "own.o",  # before the other, which ends with a page that nobody can touch
            str(FILES / "guard.c"),
            "-Wl,-z,defs",
            "-o",
            "library.so",
            "-lm",
        ],
    ]
    for _ in range(MOST_ROUNDS):
        with _folder(variants.text()) as folder:
            try:
                said = _run(commands, folder, exposed)
            except DoesNotCompileError:  # it takes too long
                return None
            if not any(code for code, _, _ in said):
                return Compiled((folder / "library.so").read_bytes(), (), ())
        refused = set(re.findall(r"^(variant_\d+_\d+):\d+:(?:\d+:)? (?:fatal )?error: ", said[0][2], re.MULTILINE))
        if not refused:
            return None
        variants.refuse(refused)
    return None


@lru_cache
def _takes(program: str, option: str) -> bool:
    """Whether a compiler has an option, by an empty program."""
    command = [program, "-Werror", option, "-fsyntax-only", "-x", "c", os.devnull]
    try:
        return subprocess.run(command, capture_output=True, timeout=LIMIT).returncode == 0
    except (OSError, subprocess.TimeoutExpired):
        return False


@contextmanager
def _folder(source: str) -> Iterator[Path]:
    """A folder with the submission, in which the compiler may write: whoever it runs as."""
    with tempfile.TemporaryDirectory(prefix="springlab-compiler-") as name:
        folder = Path(name)
        (folder / OWN).write_text(source, encoding="utf-8")
        folder.chmod(0o777 if hasattr(os, "geteuid") and os.geteuid() == 0 else 0o700)
        yield folder


def _run(commands: Sequence[Sequence[str]], folder: Path, exposed: bool) -> list[tuple[int, str, str]]:
    """Exit code, output and errors of commands in the sandbox for compilers, up to the first that fails.

    Raises:
        NotGradedError: where that sandbox cannot be had.
    """
    home = str(Path(commands[0][0]).resolve().parents[1])  # a compiler may live elsewhere than in /usr
    task = {
        "commands": list(map(list, commands)),
        "folder": str(folder),
        "readable": [*READABLE, home, str(FILES)],
        "writable": [str(folder)],
        "exposed": exposed,
    }
    script = Path(__file__).with_name("process.py")
    try:
        done = subprocess.run(
            [sys.executable, "-I", "-S", "-B", "-X", "utf8", str(script)],
            input=json.dumps(task),
            capture_output=True,
            text=True,
            timeout=LIMIT,
            env={"PATH": "/usr/bin:/bin", "TMPDIR": str(folder), "LC_ALL": "C"},
            cwd=folder,
        )
    except subprocess.TimeoutExpired:
        raise DoesNotCompileError(None, f"the compiler does not come to an end within {LIMIT:g} s") from None
    except OSError as error:
        raise NotGradedError(f"the compiler could not be run: {error.strerror or error}") from error
    if done.returncode == NO_SANDBOX:
        raise NotGradedError("this machine cannot keep a compiler from files; see --let-submissions-reach-my-files")
    if done.returncode:
        raise NotGradedError(f"the compiler could not be run: {_last(done.stderr)}")
    return [(code, out, errors) for code, out, errors in json.loads(done.stdout)]


def _first_error(said: str, code: int) -> tuple[int | None, str]:
    """The line, and what is wrong there, of what a compiler or linker said."""
    found = re.search(rf"(?:^|[\s/]){re.escape(OWN)}:(\d+)(?::\d+)?: (?:fatal )?error: (.*)", said)
    if found:
        return int(found[1]), _plain(found[2])
    found = re.search(r"undefined reference to [`'](step|forces|push_out)'", said)
    if found:
        raise MissingFunctionError(found[1])
    found = re.search(r"error: (.*)|(multiple definition of .*?)[;\n]|(undefined reference to .*)", said)
    if found:
        return None, _plain(next(filter(None, found.groups())))
    return None, "the compiler was stopped: it took too much time or memory" if code < 0 else _last(said)


def _last(said: str) -> str:
    lines = [line for line in said.splitlines() if line.strip()]
    return _plain(lines[-1]) if lines else "the compiler does not say why"


def _plain(words: str) -> str:
    """A compiler's message without the name of the option that asks for it."""
    return re.sub(r"\s*\[-W[^]]*\]$", "", words).strip()


def _warnings(said: str) -> list[tuple[int, str]]:
    """What the compiler warns of in the submission, by line."""
    found = re.findall(rf"^{re.escape(OWN)}:(\d+):(?:\d+:)? warning: (.*)$", said, re.MULTILINE)
    return [(int(line), _plain(words)) for line, words in dict.fromkeys(found)][:MOST_WARNINGS]


def _lines(told: str) -> list[tuple[int, int]]:
    """Address and line of the table that a compiler leaves for debuggers, as objdump prints it."""
    found: dict[int, int] = {}
    for file, line, address in re.findall(r"^(\S+)\s+(\d+|-)\s+0x([0-9a-f]+)", told, re.MULTILINE):
        ours = Path(file).name == OWN and line != "-"
        if ours or int(address, 16) not in found:
            found[int(address, 16)] = int(line) if ours else 0
    return sorted(found.items())
