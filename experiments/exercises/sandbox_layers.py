"""The sandbox's layers: restrictions that the process of a submission puts on itself before it reads the submission.

Each layer is the kernel's: limits on time, memory, file size (setrlimit); no file but those that are named (Landlock,
Linux 5.13), or where that is missing and we are root, another user, who may read only what everybody may; no other
process, no network, no change of what a file may do (a seccomp filter). None can be lifted again before the process
ends. Which of them are active is told: on other systems some are missing. Imports Python's own library only.
"""

from __future__ import annotations

import ctypes
import os
import platform
import signal
import struct
import sys
from collections.abc import Iterable

if sys.platform != "win32":
    import resource

#: What a submission may have unless told otherwise: seconds of computing, bytes of memory, bytes in a file.
SECONDS, MEMORY, FILE = 10, 2**30, 2**24

#: Numbers of system calls, the same on all machines (Linux, include/uapi/asm-generic/unistd.h).
CREATE_RULESET, ADD_RULE, RESTRICT_SELF = 444, 445, 446

#: Rights to files (include/uapi/linux/landlock.h): those to a file, and beyond them those to a folder.
READ_FILE, READ_FOLDER, WRITE, TRUNCATE = 1 << 2, 1 << 3, 1 << 1, 1 << 14

#: How many rights to files, and to the network, each version of Landlock knows; from 6 on it scopes signals.
FILE_RIGHTS = {1: 13, 2: 14, 3: 15, 4: 15}
SCOPED_FROM, NETWORK_FROM = 6, 4

#: System calls on x86-64 that a submission has no business with.
REFUSED = {
    "other processes": (57, 58, 59, 322, 200, 101, 310, 311, 424, 434, 109, 112, 297, 129),
    "network and shared memory": (41, 42, 43, 49, 50, 53, 288, 29, 64, 68, 240, 425, 426, 427),
    "rights and times of files": (90, 91, 92, 93, 94, 260, 268, 452, 132, 235, 261, 280, 188, 189, 190, 197, 198, 199),
    "limits and priorities": (160, 302, 141, 203, 144, 142, 314),
    "mounts": (155, 161, 165, 166, 167, 168, 272, 303, 304, 308, 428, 429, 430, 431, 432, 433, 442),
    "the machine": (103, 159, 163, 164, 169, 170, 171, 172, 173, 175, 176, 179, 227, 305, 246, 313, 320),
    "the kernel's own": (248, 249, 250, 298, 321, 323),
    "users": (105, 106, 113, 114, 116, 117, 119, 122, 123, 126),
}
KILL, SIGNAL_THREAD, CLONE, CLONE3 = 62, 234, 56, 435

#: The user without rights, by custom.
NOBODY = 65534

#: A new thread is a clone with this flag; a new process one without.
THREAD = 0x10000


def apply(readable: Iterable[str], scratch: str, seconds: int, memory: int) -> list[str]:
    """Apply all layers that this system has. Returns which of "limits", "landlock", "user", "seccomp" are active.

    Args:
        readable: files and folders that may be read; all others may not, nor be written.
        scratch: the folder that may be written.
        seconds: of computing. memory: address space [bytes].
    """
    if sys.platform == "win32":
        return []
    limit(seconds, memory)
    if sys.platform != "linux":
        return ["limits"]
    libc = ctypes.CDLL(None, use_errno=True)
    libc.prctl(1, signal.SIGKILL, 0, 0, 0)  # PR_SET_PDEATHSIG: end when the checker does
    libc.prctl(38, 1, 0, 0, 0)  # PR_SET_NO_NEW_PRIVS: asked for by both of the following
    active = {"limits": True, "landlock": landlock(libc, readable, scratch)}
    if not active["landlock"]:
        active["user"] = become_nobody(scratch)
    active["seccomp"] = seccomp(libc)
    if not active["seccomp"]:
        resource.setrlimit(resource.RLIMIT_NPROC, (0, 0))
    return [name for name, is_active in active.items() if is_active]


def limit(seconds: int, memory: int) -> None:
    """Limits that the kernel keeps: SIGXCPU after these seconds of computing, no memory, no file beyond its size."""
    wanted = {
        resource.RLIMIT_CPU: seconds,
        resource.RLIMIT_AS: memory,
        resource.RLIMIT_FSIZE: FILE,
        resource.RLIMIT_CORE: 0,
        resource.RLIMIT_NOFILE: 64,
    }
    for what, most in wanted.items():
        hard = resource.getrlimit(what)[1]
        allowed = most if hard == resource.RLIM_INFINITY else min(most, hard)
        resource.setrlimit(what, (allowed, allowed))


def landlock(libc: ctypes.CDLL, readable: Iterable[str], scratch: str) -> bool:
    """Leave this process no files but these. False where the kernel has no Landlock."""
    version = libc.syscall(CREATE_RULESET, None, ctypes.c_size_t(0), 1)
    if version < 1:
        return False
    every = (1 << FILE_RIGHTS.get(version, 16)) - 1
    fields = [every]
    fields += [3] if version >= NETWORK_FROM else []
    fields += [3] if version >= SCOPED_FROM else []
    attributes = struct.pack(f"={len(fields)}Q", *fields)
    rules = libc.syscall(CREATE_RULESET, attributes, ctypes.c_size_t(len(attributes)), 0)
    if rules < 0:
        return False
    read = READ_FILE | READ_FOLDER
    allowed = [*((path, read) for path in readable), (scratch, every), (os.devnull, READ_FILE | WRITE)]
    for path, rights in allowed:
        if os.path.exists(path):
            of_files = (READ_FILE | WRITE | TRUNCATE) & every
            place = os.open(path, os.O_PATH | os.O_CLOEXEC)
            rule = struct.pack("=Qi", rights if os.path.isdir(path) else rights & of_files, place)
            libc.syscall(ADD_RULE, rules, 1, rule, 0)
            os.close(place)
    restricted = libc.syscall(RESTRICT_SELF, rules, 0) == 0
    os.close(rules)
    return bool(restricted)


def become_nobody(scratch: str) -> bool:
    """From root to a user who owns nothing but the folder. False for who is not root."""
    if sys.platform == "win32" or os.geteuid() != 0:
        return False
    os.chown(scratch, NOBODY, NOBODY)
    os.setgroups([])
    os.setresgid(NOBODY, NOBODY, NOBODY)
    os.setresuid(NOBODY, NOBODY, NOBODY)
    return True


def seccomp(libc: ctypes.CDLL) -> bool:
    """Refuse system calls: those of REFUSED, signals to others, new processes. False where there is no filter."""
    if platform.machine() != "x86_64" or struct.calcsize("P") != 8:
        return False
    lines = _program()
    program = ctypes.create_string_buffer(b"".join(struct.pack("=HBBI", *line) for line in lines))
    # struct sock_fprog: the number of lines, and where they stand.
    pointer = ctypes.create_string_buffer(struct.pack("@HP", len(lines), ctypes.addressof(program)))
    return bool(libc.prctl(22, 2, pointer, 0, 0) == 0)  # PR_SET_SECCOMP, SECCOMP_MODE_FILTER


def _program() -> list[tuple[int, int, int, int]]:
    """A program for the kernel's packet filter (man 2 seccomp): (code, jump if true, jump if false, number)."""
    load, equal, at_least, any_bit, give = 0x20, 0x15, 0x35, 0x45, 0x06
    allow, refuse, missing, kill = 0x7FFF0000, 0x00050001, 0x00050026, 0x80000000
    lines = [
        (load, 0, 0, 4),  # the architecture
        (equal, 1, 0, 0xC000003E),
        (give, 0, 0, kill),
        (load, 0, 0, 0),  # which call
        (at_least, 0, 1, 0x40000000),
        (give, 0, 0, kill),
        (equal, 0, 1, CLONE3),  # its flags are out of a filter's sight: without it, the C library takes clone
        (give, 0, 0, missing),
        (equal, 0, 4, CLONE),
        (load, 0, 0, 16),  # the first argument
        (any_bit, 0, 1, THREAD),
        (give, 0, 0, allow),
        (give, 0, 0, refuse),
    ]
    for call in (KILL, SIGNAL_THREAD):
        lines += [
            (equal, 0, 4, call),
            (load, 0, 0, 16),
            (equal, 0, 1, os.getpid()),
            (give, 0, 0, allow),
            (give, 0, 0, refuse),
        ]
    for call in sorted({call for calls in REFUSED.values() for call in calls}):
        lines += [(equal, 0, 1, call), (give, 0, 0, refuse)]
    return [*lines, (give, 0, 0, allow)]
