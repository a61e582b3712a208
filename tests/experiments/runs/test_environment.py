"""What a result is said to depend on, on a machine and an installation made by hand."""

from __future__ import annotations

import hashlib
from pathlib import Path

import pytest

from experiments.runs import environment


def test_the_processor_is_what_linux_calls_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The first of them, with how many cores there are; elsewhere what Python knows, if anything."""
    information = tmp_path / "cpuinfo"
    monkeypatch.setattr(environment, "Path", lambda _: information)
    monkeypatch.setattr(environment.os, "cpu_count", lambda: 3)
    monkeypatch.setattr(environment.platform, "processor", lambda: "")
    assert environment.processor() == "unknown, 3 cores"
    information.write_text("cpu family : 6\nmodel name\t: Quick: 4 GHz\nmodel name\t: Slow\n")
    assert environment.processor() == "Quick: 4 GHz, 3 cores"
    information.write_text("cpu family : 6\n")
    monkeypatch.setattr(environment.platform, "processor", lambda: "arm")
    assert environment.processor() == "arm, 3 cores"


def test_the_lock_is_told_by_its_digest(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Two folders above; and what is not installed is said not to be."""
    monkeypatch.setattr(environment, "__file__", str(tmp_path / "experiments" / "runs" / "environment.py"))
    assert environment.environment()["requirements.lock (SHA-256)"] == "no lock beside this installation"
    (tmp_path / "requirements.lock").write_bytes(b"numpy==1\n")
    digest = hashlib.sha256(b"numpy==1\n").hexdigest()[:16]
    assert environment.environment()["requirements.lock (SHA-256)"] == digest
    monkeypatch.setattr(environment, "PACKAGES", ("numpy", "no-such-package"))
    found = environment.environment()
    assert found["no-such-package"] == "not installed"
    assert found["numpy"][0].isdigit()
