"""What the layers of the sandbox ask of the kernel, by one that is made up; that they hold is in `test_hostile`."""

from __future__ import annotations

import errno
import os
import platform
import re
import signal
import struct
import sys
from pathlib import Path
from typing import Any

import pytest

from experiments.exercises.process import sandbox_layers as layers

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="these layers are Linux's")

#: The kernel's own header of Landlock, where this machine has it.
HEADER = Path("/usr/include/linux/landlock.h")


class Kernel:
    """In place of the C library: what it was asked, and what it answers."""

    def __init__(self, version: int = 7, rules: int = 55) -> None:
        self.calls: list[tuple[Any, ...]] = []
        self._version, self._rules = version, rules

    def __getattr__(self, name: str) -> Any:
        def call(*given: Any) -> int:
            self.calls.append((name, *(getattr(one, "raw", getattr(one, "value", one)) for one in given)))
            if name == "syscall" and given[0] == layers.CREATE_RULESET:
                return self._version if given[1] is None else self._rules
            return 0

        return call


@pytest.mark.parametrize(
    ("version", "fields"),
    [
        (1, [0x1FFF]),
        (2, [0x3FFF]),
        (3, [0x7FFF]),
        (4, [0x7FFF, 3]),
        (5, [0xFFFF, 3]),
        (6, [0xFFFF, 3, 3]),
        (9, [0xFFFF, 3, 3]),
    ],
)
def test_each_version_of_landlock_is_asked_for_all_that_it_knows(version: int, fields: list[int]) -> None:
    """Rights to files, to the network, and what is scoped: eight bytes each."""
    kernel = Kernel(version)
    assert layers.landlock_rules(kernel, []) == 55  # type: ignore[arg-type]
    asked, made = kernel.calls
    assert asked == ("syscall", 444, None, 0, 1)
    assert made == ("syscall", 444, struct.pack(f"={len(fields)}Q", *fields), 8 * len(fields), 0)


def test_a_kernel_without_landlock_has_no_rules() -> None:
    """It says so, or refuses them."""
    for version in (0, -1):
        assert layers.landlock_rules(Kernel(version), ["/"]) is None  # type: ignore[arg-type]
    assert layers.landlock_rules(Kernel(1, -1), ["/"]) is None  # type: ignore[arg-type]


@pytest.mark.parametrize(("version", "truncate"), [(2, 0), (3, 1 << 14)])
@pytest.mark.parametrize("programs", [False, True])
def test_what_is_named_may_be_read_and_no_more(tmp_path: Path, version: int, truncate: int, programs: bool) -> None:
    """Files be read, folders listed; programs run where that is asked for; in other folders files made and removed."""
    (tmp_path / "file").write_text("a", encoding="utf-8")
    kernel = Kernel(version)
    readable = [str(tmp_path / "file"), str(tmp_path), str(tmp_path / "nowhere")]
    layers.landlock_rules(kernel, readable, programs, [str(tmp_path), str(tmp_path / "file")])  # type: ignore[arg-type]
    added = [call for call in kernel.calls if call[1] == 445]
    run = 1 if programs else 0
    changing = (1 << 2) | (1 << 1) | truncate
    assert [struct.unpack("=Qi", call[4])[0] for call in added] == [
        (1 << 2) | run,
        (1 << 2) | (1 << 3) | run,
        changing | (1 << 3) | (1 << 8) | (1 << 5),
        changing,
    ]
    assert {call[:4] + call[5:] for call in added} == {("syscall", 445, 55, 1, 0)}


def test_rights_are_those_of_the_kernels_header() -> None:
    """By their names."""
    if not HEADER.exists():
        pytest.skip("this machine has no header of Landlock")
    found = re.findall(r"#define LANDLOCK_ACCESS_FS_(\w+)\s+\(1ULL << (\d+)\)", HEADER.read_text(encoding="utf-8"))
    rights = {name: 1 << int(place) for name, place in found}
    ours = {
        "EXECUTE": layers.EXECUTE,
        "WRITE_FILE": layers.WRITE_FILE,
        "READ_FILE": layers.READ_FILE,
        "READ_DIR": layers.READ_FOLDER,
        "REMOVE_FILE": layers.REMOVE_FILE,
        "MAKE_REG": layers.MAKE_FILE,
        "TRUNCATE": layers.TRUNCATE,
    }
    assert {name: rights[name] for name in ours if name in rights} == {n: r for n, r in ours.items() if n in rights}


@pytest.mark.parametrize("hard", [None, 10])
def test_limits_are_set_for_good(monkeypatch: pytest.MonkeyPatch, hard: int | None) -> None:
    """Soft and hard ones; none beyond what this process is allowed."""
    import resource

    had: dict[int, tuple[int, int]] = {}
    infinity = resource.RLIM_INFINITY
    monkeypatch.setattr(resource, "getrlimit", lambda what: (0, infinity if hard is None else hard))
    monkeypatch.setattr(resource, "setrlimit", had.__setitem__)
    layers.limit(20, 2**30)
    wanted = {
        resource.RLIMIT_CPU: 20,
        resource.RLIMIT_AS: 2**30,
        resource.RLIMIT_FSIZE: 2**24,
        resource.RLIMIT_CORE: 0,
        resource.RLIMIT_NOFILE: 64,
    }
    assert had == {what: (min(most, hard or most),) * 2 for what, most in wanted.items()}


@pytest.mark.parametrize("refusing", [[], [0], [0, 1]])
def test_root_becomes_a_user_who_owns_nothing(monkeypatch: pytest.MonkeyPatch, refusing: list[int]) -> None:
    """One of its own; where there is none nobody; where there is neither it is told."""
    steps: list[tuple[str, Any]] = []
    user = layers.NOBODIES[os.getpid() % len(layers.NOBODIES)]
    refused = [[user, 65534][i] for i in refusing]

    def set_user(name: str) -> Any:
        def step(*ids: Any) -> None:
            steps.append((name, ids))
            if name == "setresuid" and ids[0] in refused:
                raise OSError(errno.EINVAL, "no such user")

        return step

    for name in ("setgroups", "setresgid", "setresuid"):
        monkeypatch.setattr(os, name, set_user(name))
    monkeypatch.setattr(os, "getresuid", lambda: steps[-1][1])
    assert layers.become_nobody() == (len(refusing) < 2)
    tried = [user, 65534][: len(refusing) + 1]
    assert steps == [
        step
        for one in tried
        for step in (("setgroups", ([],)), ("setresgid", (one, one, one)), ("setresuid", (one, one, one)))
    ]
    assert 61184 <= user <= 65519
    monkeypatch.setattr(os, "getresuid", lambda: (user, user, 0))
    if not refusing:
        assert not layers.become_nobody()


def test_all_capabilities_are_dropped() -> None:
    """Of each of 64 out of the bounds, then the ambient ones, then all that this process has."""
    kernel = Kernel()
    layers.drop_capabilities(kernel)  # type: ignore[arg-type]
    *bounds, ambient, last = kernel.calls
    assert bounds == [("prctl", 24, capability, 0, 0, 0) for capability in range(64)]
    assert ambient == ("prctl", 47, 4, 0, 0, 0)
    assert last == ("capset", struct.pack("=Ii", 0x20080522, 0), bytes(24))


def test_which_layers_are_needed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Another user is, for root only."""
    for user, names in ((0, ["limits", "user", "landlock", "seccomp"]), (1000, ["limits", "landlock", "seccomp"])):
        monkeypatch.setattr(os, "geteuid", lambda user=user: user)
        assert layers.wanted() == names


@pytest.mark.parametrize(
    ("user", "rules", "calls", "stands", "active"),
    [
        (0, 55, b"filter", True, ["limits", "user", "landlock", "seccomp"]),
        (1000, 55, b"filter", True, ["limits", "landlock", "seccomp"]),
        (1000, None, b"filter", True, ["limits", "seccomp"]),
        (1000, 55, None, True, ["limits", "landlock"]),
        (0, 55, b"filter", False, ["limits"]),
    ],
)
def test_layers_are_active_where_they_stand(
    monkeypatch: pytest.MonkeyPatch, user: int, rules: int | None, calls: bytes | None, stands: bool, active: list[str]
) -> None:
    """No new privileges, and an end with the parent, come between; whose parent is gone ends at once."""
    kernel, order = Kernel(), []
    monkeypatch.setattr(layers.ctypes, "CDLL", lambda *_, **__: kernel)
    monkeypatch.setattr(os, "geteuid", lambda: user)
    monkeypatch.setattr(os, "getppid", lambda: 77)
    monkeypatch.setattr(layers, "limit", lambda *given: order.append(given))
    monkeypatch.setattr(layers, "landlock_rules", lambda libc, readable: rules)
    monkeypatch.setattr(layers, "become_nobody", lambda: stands)
    monkeypatch.setattr(layers, "drop_capabilities", lambda libc: order.append("capabilities"))
    monkeypatch.setattr(layers, "landlock", lambda libc, given: stands and given == rules)
    monkeypatch.setattr(layers, "seccomp", lambda libc, given: stands and given == calls)
    assert layers.apply(["/a"], 20, 2**30, 77, calls) == active
    assert order == [(20, 2**30), "capabilities"]
    assert kernel.calls == [("prctl", 38, 1, 0, 0, 0), ("prctl", 1, signal.SIGKILL, 0, 0, 0)]

    def ended(code: int) -> None:
        raise SystemExit(code)

    monkeypatch.setattr(os, "_exit", ended)
    with pytest.raises(SystemExit) as left:
        layers.apply(["/a"], 20, 2**30, 78, calls)
    assert left.value.code == 1


def test_landlock_counts_where_it_refuses(monkeypatch: pytest.MonkeyPatch) -> None:
    """It is put in force, its handle closed, and tried out on the root folder."""
    kernel = Kernel()
    for refuses in (True, False):
        closed: list[int] = []
        monkeypatch.setattr(layers.os, "close", closed.append)
        monkeypatch.setattr(layers, "refused", lambda attempt, refuses=refuses: refuses)
        assert layers.landlock(kernel, 55) == refuses  # type: ignore[arg-type]
        assert closed == [55]
    assert kernel.calls == [("syscall", 446, 55, 0)] * 2


def test_the_filter_counts_where_it_refuses(monkeypatch: pytest.MonkeyPatch) -> None:
    """By a call that there is none of, by a pipe, and by a file that is written."""
    number = {"x86_64": 317, "aarch64": 277}[platform.machine()]

    class Filtering(Kernel):
        answers = -1

        def __getattr__(self, name: str) -> Any:
            call = super().__getattr__(name)
            return lambda *given: (call(*given), self.answers if given[0] == 9999 else 0)[1]

    kernel = Filtering()
    for answers, error, refuses, counts in (
        (-1, errno.EPERM, [True, True], True),
        (-1, errno.ENOSYS, [True, True], False),
        (0, errno.EPERM, [True, True], False),
        (-1, errno.EPERM, [False, True], False),
        (-1, errno.EPERM, [True, False], False),
    ):
        kernel.answers = answers
        left = iter(refuses)
        monkeypatch.setattr(layers.ctypes, "get_errno", lambda error=error: error)
        monkeypatch.setattr(layers, "refused", lambda attempt, left=left: next(left))
        assert layers.seccomp(kernel, bytes(24)) == counts  # type: ignore[arg-type]
    first = kernel.calls[0]
    assert first[:4] == ("syscall", number, 1, 1)
    assert struct.unpack("@HP", first[4][: struct.calcsize("@HP")])[0] == 3


@pytest.mark.parametrize(
    ("error", "refuses"),
    [(PermissionError(), True), (FileNotFoundError(), False), (OSError(38, "no"), False), (None, False)],
)
def test_what_counts_as_refused(error: OSError | None, refuses: bool) -> None:
    """Not that something is missing, or that it went well."""

    def attempt() -> None:
        if error is not None:
            raise error

    assert layers.refused(attempt) == refuses
