"""The command line, called in this process, or in a new one as a user would."""

from __future__ import annotations

import contextlib
import io
import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from unittest import mock

from report.commands.main import main

ROOT = Path(__file__).parents[3]


@dataclass(frozen=True)
class Said:
    """What a command left: its exit code, standard output and standard error."""

    code: int
    out: str
    err: str


def springlab(*words: str) -> Said:
    """`springlab WORDS`, in this process."""
    out, err = io.StringIO(), io.StringIO()
    code: object = None
    with (
        mock.patch.object(sys, "argv", ["springlab", *words]),
        contextlib.redirect_stdout(out),
        contextlib.redirect_stderr(err),
    ):
        try:
            main()
        except SystemExit as ending:
            code = ending.code
    assert isinstance(code, int), f"main() ended without an exit code: {code!r}"
    return Said(code, out.getvalue(), err.getvalue())


def python(*words: str, folder: Path) -> Said:
    """`python WORDS`, in a new process that works in a folder and knows where the project is."""
    known = {**os.environ, "PYTHONPATH": str(ROOT)}
    done = subprocess.run([sys.executable, *words], capture_output=True, text=True, cwd=folder, env=known)
    return Said(done.returncode, done.stdout, done.stderr)
