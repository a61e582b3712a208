"""What a submission may ask of the kernel: a list of what is allowed, and a filter (seccomp) that refuses all else.

Found by measuring what right programs, CPython and NumPy ask for; what is not named here is refused with an error, also
calls that future kernels will have. Opening is allowed for reading only, memory may not become code, and of new threads
only those of the C library; nothing creates, changes or removes a file, and nothing reaches another process.
Imports Python's own library only.
"""

from __future__ import annotations

import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

#: Calls that are allowed whatever their arguments, by their numbers on x86-64 and on ARM64 (the kernel's tables
#: arch/x86/entry/syscalls/syscall_64.tbl and include/uapi/asm-generic/unistd.h); None where a machine has no such call.
PLAIN: Mapping[str, tuple[int | None, int | None]] = MappingProxyType(
    {
        # what is open already
        "read": (0, 63),
        "pread64": (17, 67),
        "readv": (19, 65),
        "write": (1, 64),
        "writev": (20, 66),
        "lseek": (8, 62),
        "close": (3, 57),
        "dup": (32, 23),
        "dup2": (33, None),
        "dup3": (292, 24),
        "fstat": (5, 80),
        "getdents64": (217, 61),
        # names of files
        "stat": (4, None),
        "lstat": (6, None),
        "newfstatat": (262, 79),
        "statx": (332, 291),
        "access": (21, None),
        "faccessat": (269, 48),
        "faccessat2": (439, 439),
        "readlink": (89, None),
        "readlinkat": (267, 78),
        "getcwd": (79, 17),
        # memory
        "brk": (12, 214),
        "munmap": (11, 215),
        "mremap": (25, 216),
        # threads and signals of its own
        "futex": (202, 98),
        "sched_yield": (24, 124),
        "sched_getaffinity": (204, 123),
        "set_robust_list": (273, 99),
        "set_tid_address": (218, 96),
        "rseq": (334, 293),
        "gettid": (186, 178),
        "rt_sigaction": (13, 134),
        "rt_sigprocmask": (14, 135),
        "rt_sigreturn": (15, 139),
        "rt_sigpending": (127, 136),
        "rt_sigsuspend": (130, 133),
        "sigaltstack": (131, 132),
        "exit": (60, 93),
        "exit_group": (231, 94),
        # time and chance
        "clock_gettime": (228, 113),
        "clock_getres": (229, 114),
        "clock_nanosleep": (230, 115),
        "nanosleep": (35, 101),
        "gettimeofday": (96, 169),
        "time": (201, None),
        "getrandom": (318, 278),
        # who and where it is
        "uname": (63, 160),
        "sysinfo": (99, 179),
        "getrusage": (98, 165),
        "times": (100, 153),
        "getpid": (39, 172),
        "getppid": (110, 173),
        "getuid": (102, 174),
        "geteuid": (107, 175),
        "getgid": (104, 176),
        "getegid": (108, 177),
        "getgroups": (115, 158),
    }
)


@dataclass(frozen=True)
class Condition:
    """What an argument must be for a call to be allowed.

    Attributes:
        argument: which, from 0.
        among: the values that it may have; empty for any.
        without: bits that must not be set.
        whole: whether all 64 bits count; else the lower 32, as the kernel itself reads such an argument.
    """

    argument: int
    among: tuple[int, ...] = ()
    without: int = 0
    whole: bool = False


#: O_WRONLY, O_RDWR, O_CREAT, O_TRUNC, O_APPEND, O_ASYNC and the bit of O_TMPFILE: all that is not reading.
NOT_READING = 0o1 | 0o2 | 0o100 | 0o1000 | 0o2000 | 0o20000 | 0o20000000

#: Memory that is code.
PROT_EXEC = 4

#: The threads of the C library: glibc's flags and musl's.
THREADS = (0x3D0F00, 0x7D0F00)

#: Calls that are allowed with certain arguments, numbers as in PLAIN.
CHECKED: Mapping[str, tuple[tuple[int | None, int | None], Condition]] = MappingProxyType(
    {
        "open": ((2, None), Condition(1, without=NOT_READING)),
        "openat": ((257, 56), Condition(2, without=NOT_READING)),
        "mmap": ((9, 222), Condition(2, without=PROT_EXEC)),
        "mprotect": ((10, 226), Condition(2, without=PROT_EXEC)),
        # TCGETS, TIOCGWINSZ: what a terminal is asked; FIONCLEX, FIOCLEX
        "ioctl": ((16, 29), Condition(1, among=(0x5401, 0x5413, 0x5450, 0x5451))),
        # F_DUPFD, F_GETFD, F_SETFD, F_GETFL, F_DUPFD_CLOEXEC
        "fcntl": ((72, 25), Condition(1, among=(0, 1, 2, 3, 1030))),
        # MADV_WILLNEED, DONTNEED, FREE, HUGEPAGE, NOHUGEPAGE, COLLAPSE
        "madvise": ((28, 233), Condition(2, among=(3, 4, 8, 14, 15, 25))),
        "clone": ((56, 220), Condition(0, among=THREADS, whole=True)),
        # limits may be read, not set
        "prlimit64": ((302, 261), Condition(2, among=(0,), whole=True)),
    }
)

#: A signal to a thread of one's own; and which: those that end a program that has gone wrong (abort), and those that it
#: may handle. Not SIGKILL or SIGSTOP, by which nobody could tell who struck.
SIGNAL_THREAD = (234, 131)
SIGNALS = (2, 4, 6, 8, 10, 11, 12, 14, 15)

#: Its flags are out of a filter's sight: where it is missing, the C library takes clone.
CLONE3 = 435

#: The machines there are numbers for: their names in `uname`, and in a filter (include/uapi/linux/audit.h).
MACHINES: Mapping[str, tuple[int, int]] = MappingProxyType({"x86_64": (0, 0xC000003E), "aarch64": (1, 0xC00000B7)})

#: Instructions of the kernel's packet filter (man 2 seccomp), and what it may answer.
LOAD, EQUAL, ANY_BIT, GIVE = 0x20, 0x15, 0x45, 0x06
ALLOW, REFUSE, MISSING, KILL = 0x7FFF0000, 0x00050001, 0x00050026, 0x80000000  # EPERM is 1, ENOSYS 38

#: Where struct seccomp_data has the call, the machine and the first argument.
CALL, MACHINE, ARGUMENTS = 0, 4, 16

Line = tuple[int, int, int, int]


def filter_of(machine: str, own_pid: int, code: bool) -> bytes | None:
    """The filter for a machine, as struct sock_filter; None for one whose numbers are not known here.

    Args:
        machine: as `platform.machine` says. own_pid: of the process it is for.
        code: whether memory may become code, as what was compiled of a C submission has to be loaded.
    """
    if machine not in MACHINES or struct.calcsize("P") != 8:
        return None
    return b"".join(struct.pack("=HBBI", *line) for line in program(machine, own_pid, code))


def program(machine: str, own_pid: int, code: bool) -> list[Line]:
    """The filter, line by line: (code, how far to jump if true, if false, number)."""
    which, architecture = MACHINES[machine]
    lines: list[Line] = [(LOAD, 0, 0, MACHINE), (EQUAL, 1, 0, architecture), (GIVE, 0, 0, KILL), (LOAD, 0, 0, CALL)]
    lines += [(EQUAL, 0, 1, CLONE3), (GIVE, 0, 0, MISSING)]
    for numbers in PLAIN.values():
        number = numbers[which]
        if number is not None:
            lines += [(EQUAL, 0, 1, number), (GIVE, 0, 0, ALLOW)]
    for name, (numbers, condition) in CHECKED.items():
        number = numbers[which]
        if number is not None:
            checked = _checked(Condition(0) if code and name == "mmap" else condition)
            lines += [(EQUAL, 0, len(checked), number), *checked]
    own = [(LOAD, 0, 0, ARGUMENTS), (EQUAL, 1, 0, own_pid), (GIVE, 0, 0, REFUSE)]
    signal = [*own, *_checked(Condition(2, among=SIGNALS))]
    lines += [(EQUAL, 0, len(signal), SIGNAL_THREAD[which]), *signal]
    return [*lines, (GIVE, 0, 0, REFUSE)]


def _checked(condition: Condition) -> Sequence[Line]:
    """Allow if the condition holds, else refuse: both ways the filter ends."""
    lower = ARGUMENTS + 8 * condition.argument  # both machines have the lower half first
    lines: list[Line] = []
    if condition.whole:
        lines += [(LOAD, 0, 0, lower + 4), (EQUAL, 1, 0, 0), (GIVE, 0, 0, REFUSE)]
    lines.append((LOAD, 0, 0, lower))
    if condition.without:
        lines += [(ANY_BIT, 0, 1, condition.without), (GIVE, 0, 0, REFUSE)]
    if not condition.among:
        return [*lines, (GIVE, 0, 0, ALLOW)]
    for value in condition.among:
        lines += [(EQUAL, 0, 1, value), (GIVE, 0, 0, ALLOW)]
    return [*lines, (GIVE, 0, 0, REFUSE)]
