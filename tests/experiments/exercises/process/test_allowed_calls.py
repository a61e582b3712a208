"""The filter of system calls, run by a small packet filter machine of our own for both machines, and by the kernel."""

from __future__ import annotations

import errno
import mmap
import os
import platform
import re
import signal
import struct
import sys
from pathlib import Path

import pytest

from experiments.exercises.process import sandbox
from experiments.exercises.process.allowed_calls import (
    ALLOW,
    ANY_BIT,
    CHECKED,
    CLONE3,
    EQUAL,
    GIVE,
    KILL,
    LOAD,
    MACHINES,
    MISSING,
    NOT_READING,
    PLAIN,
    PROT_EXEC,
    REFUSE,
    SIGNAL_THREAD,
    SIGNALS,
    THREADS,
    filter_of,
    program,
)

#: Headers of the kernel's tables of calls, where this machine has them.
HEADERS = {
    "x86_64": Path("/usr/include/x86_64-linux-gnu/asm/unistd_64.h"),
    "aarch64": Path("/usr/include/asm-generic/unistd.h"),
}

PID = 4711


def answer(machine: str, call: int, *arguments: int, code: int | None = None, loads: bool = False) -> int:
    """What the filter says to a call, by the rules of the kernel's packet filter (man 2 seccomp)."""
    given = [*arguments, *[0] * (6 - len(arguments))]
    data = struct.pack("<iIQ6Q", call, MACHINES[machine][1] if code is None else code, 0, *given)
    held, at, lines = 0, 0, program(machine, PID, loads)
    while True:
        what, if_true, if_false, number = lines[at]
        at += 1
        if what == GIVE:
            return number
        if what == LOAD:
            (held,) = struct.unpack_from("<I", data, number)
            continue
        assert what in (EQUAL, ANY_BIT)
        at += if_true if (held == number if what == EQUAL else held & number) else if_false


@pytest.mark.parametrize("machine", MACHINES)
def test_what_is_not_named_is_refused(machine: str) -> None:
    """All numbers up to 1,000, with any arguments: future calls, those of other machines, and x32's."""
    which = MACHINES[machine][0]
    plain = {numbers[which] for numbers in PLAIN.values()}
    checked = {numbers[which] for numbers, _ in CHECKED.values()} | {SIGNAL_THREAD[which], CLONE3}
    for call in [*range(1000), 0x40000000, 0x40000001, 2**31 - 1]:
        if call not in checked:
            assert answer(machine, call) == (ALLOW if call in plain else REFUSE), call
    assert answer(machine, CLONE3) == MISSING
    assert answer(machine, 0, code=0x40000003) == KILL


@pytest.mark.parametrize("machine", MACHINES)
def test_arguments_are_looked_at(machine: str) -> None:
    """Opening to read, not to write; memory that is no code; threads, not processes; signals to oneself."""
    which = MACHINES[machine][0]
    number = {name: numbers[which] or 0 for name, (numbers, _) in CHECKED.items()}
    cloexec, directory = 0o2000000, 0o200000
    for flags in (0, cloexec, cloexec | directory):
        assert answer(machine, number["openat"], 0, 0, flags) == ALLOW
    for flags in (1, 2, 0o100, 0o1000, 0o2000, 0o20000, 0o20200000, cloexec | 1):
        assert answer(machine, number["openat"], 0, 0, flags) == REFUSE
    for call in ("mmap", "mprotect"):
        assert answer(machine, number[call], 0, 0, 3) == ALLOW
        assert answer(machine, number[call], 0, 0, 7) == REFUSE
        assert answer(machine, number[call], 0, 0, 7, loads=True) == (ALLOW if call == "mmap" else REFUSE)
    threads = 0x3D0F00
    assert answer(machine, number["clone"], threads) == ALLOW
    for flags in (17, 0, threads | 0x10000000, threads | 1 << 32, threads & ~0x10000):
        assert answer(machine, number["clone"], flags) == REFUSE
    assert answer(machine, SIGNAL_THREAD[which], PID, 1, 6) == ALLOW
    assert answer(machine, SIGNAL_THREAD[which], PID - 1, 1, 6) == REFUSE
    assert answer(machine, SIGNAL_THREAD[which], PID, 1, 9) == REFUSE  # it would look as if struck from outside
    assert answer(machine, number["prlimit64"], 0, 0, 0) == ALLOW
    assert answer(machine, number["prlimit64"], 0, 0, 1 << 40) == REFUSE
    assert answer(machine, number["fcntl"], 1, 8) == answer(machine, number["fcntl"], 1, 10) == REFUSE
    assert answer(machine, number["ioctl"], 1, 0xC0045877) == REFUSE  # FIFREEZE


def test_other_machines_have_no_filter() -> None:
    """And so are closed (`child`)."""
    assert filter_of("riscv64", PID, False) is None
    assert filter_of("i686", PID, True) is None


@pytest.mark.parametrize("machine", MACHINES)
def test_numbers_are_those_of_the_kernels_own_tables(machine: str) -> None:
    """Read from the headers; a name that is not there on one machine has None."""
    header = HEADERS[machine]
    if not header.exists():
        pytest.skip(f"this machine has no {header.name}")
    found = re.findall(r"#define __NR(?:3264)?_(\w+)\s+(\d+)", header.read_text())
    numbers = {name: int(number) for name, number in found}
    which = MACHINES[machine][0]
    known = {**PLAIN, **{name: numbers for name, (numbers, _) in CHECKED.items()}}
    for name, both in {**known, "tgkill": SIGNAL_THREAD, "clone3": (CLONE3, CLONE3)}.items():
        generic = {"newfstatat": "fstatat"}.get(name, name) if machine == "aarch64" else name
        assert both[which] == numbers.get(name, numbers.get(generic)), name


#: The flags of a thread (man 2 clone), which Python has no names for: VM, FS, FILES, SIGHAND, THREAD, SYSVSEM, SETTLS,
#: PARENT_SETTID and CHILD_CLEARTID; and DETACHED, which musl sets besides.
CLONE = (0x100, 0x200, 0x400, 0x800, 1 << 16, 1 << 18, 1 << 19, 1 << 20, 1 << 21)
DETACHED = 1 << 22

#: What memory may be advised, of the kernel's newer advice (include/uapi/asm-generic/mman-common.h).
MADV_COLLAPSE = 25


@pytest.mark.skipif(sys.platform != "linux", reason="Python has Linux's numbers on Linux")
def test_numbers_of_arguments_are_those_that_python_knows() -> None:
    """Flags, signals and errors by their names, as the C library of this machine has them."""
    import fcntl
    import termios

    among = {name: set(condition.among) for name, (_, condition) in CHECKED.items()}
    duplicate, read, write, flags = fcntl.F_DUPFD, fcntl.F_GETFD, fcntl.F_SETFD, fcntl.F_GETFL
    assert among["fcntl"] == {duplicate, read, write, flags, fcntl.F_DUPFD_CLOEXEC}
    assert among["ioctl"] == {termios.TCGETS, termios.TIOCGWINSZ, termios.FIONCLEX, termios.FIOCLEX}
    advice = {getattr(mmap, f"MADV_{name}") for name in ("WILLNEED", "DONTNEED", "FREE", "HUGEPAGE", "NOHUGEPAGE")}
    assert among["madvise"] == {*advice, MADV_COLLAPSE}
    assert among["clone"] == set(THREADS) == {sum(CLONE), sum(CLONE) | DETACHED}
    writing = ("WRONLY", "RDWR", "CREAT", "TRUNC", "APPEND", "ASYNC")
    flags = sum(getattr(os, f"O_{name}") for name in writing) | os.O_TMPFILE & ~os.O_DIRECTORY
    assert flags == NOT_READING
    assert mmap.PROT_EXEC == PROT_EXEC
    handled = ("INT", "ILL", "ABRT", "FPE", "USR1", "SEGV", "USR2", "ALRM", "TERM")
    assert [getattr(signal, f"SIG{name}") for name in handled] == list(SIGNALS)
    assert (0x50000 | errno.EPERM, 0x50000 | errno.ENOSYS) == (REFUSE, MISSING)


@pytest.mark.parametrize("machine", MACHINES)
def test_what_may_be_among_numbers_may_be_no_other(machine: str) -> None:
    """Each condition by the filter itself: its values are let through, their neighbours and other bits are not."""
    which = MACHINES[machine][0]
    for name, (numbers, condition) in CHECKED.items():
        call = numbers[which]
        if call is None or not condition.among:
            continue
        near = {value + by for value in condition.among for by in (-1, 0, 1)} - {-1}
        for value in sorted(near):
            arguments = [*[0] * condition.argument, value]
            assert answer(machine, call, *arguments) == (ALLOW if value in condition.among else REFUSE), (name, value)
            beyond = answer(machine, call, *arguments[:-1], value | 1 << 40)
            assert beyond == (ALLOW if value in condition.among and not condition.whole else REFUSE), (name, value)


@pytest.mark.skipif(sys.platform != "linux" or platform.machine() != "x86_64", reason="by the calls of x86-64")
def test_every_other_call_is_refused_by_the_kernel() -> None:
    """All numbers there are, and a thousand that are not yet, each from within a submission.

    But for two of the kernel's own probes, which it lets past any filter, and which end who calls them (SIGILL).
    """
    if "seccomp" not in sandbox.layers():
        pytest.skip("this machine has no seccomp")
    named = {numbers[0] for numbers in PLAIN.values()} | {numbers[0] for numbers, _ in CHECKED.values()}
    uretprobe, uprobe = 335, 336
    tried = sorted(set(range(1500)) - named - {SIGNAL_THREAD[0], uretprobe, uprobe})
    source = f"""
import ctypes
libc, through = ctypes.CDLL(None, use_errno=True), []
for call in {tried}:
    if libc.syscall(call, 0, 0, 0, 0, 0, 0) != -1 or ctypes.get_errno() not in (1, 38):
        through.append(call)
def found():
    return list(through)
"""
    reply = sandbox.run(source, [{"function": "found", "arguments": [], "steps": 0, "parts": ["calls"]}])
    assert reply.ended == "done", reply
    (answer_,) = reply.answers
    assert answer_["values"][0][0].tolist() == []
