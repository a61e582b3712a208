"""The sandbox's layers: restrictions that the process of a submission puts on itself before it reads the submission.

Each is the kernel's, allows what is named and refuses all else, and cannot be lifted again before the process ends:

    limits    on time, memory and the size of files (setrlimit)
    user      who was root becomes a user who owns nothing and has no capability
    landlock  no file can be opened but those that are named, and these for reading only (Linux 5.13 and later)
    seccomp   no system call but those of `allowed_calls`

Landlock and the filter are tried out once they are in force: one that does not refuse does not count. Which layers are
active is told; `child` does not go on without all of them. Imports Python's own library only.
"""

from __future__ import annotations

import ctypes
import os
import platform
import signal
import struct
import sys
from collections.abc import Callable, Iterable

if sys.platform != "win32":
    import resource

#: Bytes in what a submission answers, and in what it prints.
FILE = 2**24

#: Numbers of system calls, the same on all machines (Linux, include/uapi/asm-generic/unistd.h).
CREATE_RULESET, ADD_RULE, RESTRICT_SELF = 444, 445, 446

#: Where it differs: seccomp on x86-64 and on ARM64.
SECCOMP = {"x86_64": 317, "aarch64": 277}

#: Rights to files (include/uapi/linux/landlock.h).
EXECUTE, WRITE_FILE, READ_FILE, READ_FOLDER = 1 << 0, 1 << 1, 1 << 2, 1 << 3
REMOVE_FILE, MAKE_FILE, TRUNCATE, TRUNCATE_FROM = 1 << 5, 1 << 8, 1 << 14, 3

#: How many rights to files, and to the network, each version of Landlock knows; from 6 on it scopes signals.
FILE_RIGHTS = {1: 13, 2: 14, 3: 15, 4: 15}
SCOPED_FROM, NETWORK_FROM = 6, 4

#: Users that own nothing, by custom given out for a while (systemd's dynamic users); and the one without rights.
NOBODIES, NOBODY = range(61184, 65520), 65534

#: Of prctl (include/uapi/linux/prctl.h).
PDEATHSIG, DROP_FROM_BOUNDS, NO_NEW_PRIVILEGES, AMBIENT, CLEAR_ALL = 1, 24, 38, 47, 4

#: A system call that there is none of.
UNKNOWN_CALL = 9999

#: What there is on this system: every one of these has to be active, "user" for root only.
LAYERS = ("limits", "user", "landlock", "seccomp")


def wanted() -> list[str]:
    """The layers that this process needs; to be asked before any is applied."""
    root = sys.platform != "win32" and os.geteuid() == 0
    return [name for name in LAYERS if name != "user" or root]


def apply(readable: Iterable[str], seconds: int, memory: int, parent: int, calls: bytes | None) -> list[str]:
    """Apply all layers that this system has. Returns which of LAYERS are active.

    Args:
        readable: files and folders that may be read; all others may not, nor may anything be written.
        seconds: of computing. memory: address space [bytes].
        parent: the process that ends this one with itself.
        calls: the filter of system calls (`allowed_calls`); None where there is none for this machine.
    """
    if sys.platform == "win32":
        return []
    limit(seconds, memory)
    if sys.platform != "linux":
        return ["limits"]
    libc = ctypes.CDLL(None, use_errno=True)
    rules = landlock_rules(libc, readable)
    active = {"limits": True, "user": become_nobody() if os.geteuid() == 0 else False}
    drop_capabilities(libc)
    libc.prctl(NO_NEW_PRIVILEGES, 1, 0, 0, 0)
    libc.prctl(PDEATHSIG, signal.SIGKILL, 0, 0, 0)  # after the change of user, which forgets it
    if os.getppid() != parent:
        os._exit(1)
    active["landlock"] = rules is not None and landlock(libc, rules)
    active["seccomp"] = calls is not None and seccomp(libc, calls)
    return [name for name, is_active in active.items() if is_active]


def limit(seconds: int, memory: int) -> None:
    """Limits that the kernel keeps: SIGXCPU after these seconds of computing, no memory, no file beyond its size."""
    most_of = {
        resource.RLIMIT_CPU: seconds,
        resource.RLIMIT_AS: memory,
        resource.RLIMIT_FSIZE: FILE,
        resource.RLIMIT_CORE: 0,
        resource.RLIMIT_NOFILE: 64,
    }
    for what, most in most_of.items():
        hard = resource.getrlimit(what)[1]
        allowed = most if hard == resource.RLIM_INFINITY else min(most, hard)
        resource.setrlimit(what, (allowed, allowed))


def become_nobody() -> bool:
    """From root to a user of this process's own, who owns nothing."""
    for user in (NOBODIES[os.getpid() % len(NOBODIES)], NOBODY):
        try:
            os.setgroups([])
            os.setresgid(user, user, user)
            os.setresuid(user, user, user)
        except OSError:  # a container that has no such user
            continue
        return os.getresuid() == (user, user, user)
    return False


def drop_capabilities(libc: ctypes.CDLL) -> None:
    """All of them, for ever (man 7 capabilities)."""
    for capability in range(64):
        libc.prctl(DROP_FROM_BOUNDS, capability, 0, 0, 0)
    libc.prctl(AMBIENT, CLEAR_ALL, 0, 0, 0)
    header = struct.pack("=Ii", 0x20080522, 0)  # the third version of the interface; this process
    libc.capset(header, struct.pack("=6I", *[0] * 6))


def landlock_rules(
    libc: ctypes.CDLL, readable: Iterable[str], programs: bool = False, writable: Iterable[str] = ()
) -> int | None:
    """A ruleset of these files alone, opened while they can be; None where the kernel has no Landlock.

    Args:
        programs: whether what may be read may be run, too. writable: folders in which files may be made and removed.
    """
    version = libc.syscall(CREATE_RULESET, None, ctypes.c_size_t(0), 1)
    if version < 1:
        return None
    fields = [(1 << FILE_RIGHTS.get(version, 16)) - 1]
    fields += [3] if version >= NETWORK_FROM else []
    fields += [3] if version >= SCOPED_FROM else []
    attributes = struct.pack(f"={len(fields)}Q", *fields)
    rules = libc.syscall(CREATE_RULESET, attributes, ctypes.c_size_t(len(attributes)), 0)
    if rules < 0:
        return None
    reading = READ_FILE | (EXECUTE if programs else 0)
    changing = READ_FILE | WRITE_FILE | (TRUNCATE if version >= TRUNCATE_FROM else 0)
    given = [(path, reading, READ_FOLDER) for path in readable]
    given += [(path, changing, READ_FOLDER | MAKE_FILE | REMOVE_FILE) for path in writable]
    for path, of_files, of_folders in given:
        if os.path.exists(path):
            place = os.open(path, os.O_PATH | os.O_CLOEXEC)
            rights = of_files | (of_folders if os.path.isdir(path) else 0)
            libc.syscall(ADD_RULE, rules, 1, struct.pack("=Qi", rights, place), 0)
            os.close(place)
    return int(rules)


def landlock(libc: ctypes.CDLL, rules: int) -> bool:
    """Leave this process no files but these. False where it can still open another."""
    libc.syscall(RESTRICT_SELF, rules, 0)
    os.close(rules)
    return refused(lambda: os.close(os.open("/", os.O_RDONLY)))


def seccomp(libc: ctypes.CDLL, lines: bytes) -> bool:
    """Refuse all system calls but those that are allowed, in all threads. False where they are not refused."""
    program = ctypes.create_string_buffer(lines)
    # struct sock_fprog: the number of lines, and where they stand
    pointer = ctypes.create_string_buffer(struct.pack("@HP", len(lines) // 8, ctypes.addressof(program)))
    libc.syscall(SECCOMP[platform.machine()], 1, 1, pointer)  # SECCOMP_SET_MODE_FILTER, for all threads
    if libc.syscall(UNKNOWN_CALL) != -1 or ctypes.get_errno() != 1:
        return False
    return refused(os.pipe) and refused(lambda: os.open(".", os.O_WRONLY | os.O_TMPFILE))


def refused(attempt: Callable[[], object]) -> bool:
    """Whether the kernel refuses to."""
    try:
        attempt()
    except PermissionError:
        return True
    except OSError:
        return False
    return False
