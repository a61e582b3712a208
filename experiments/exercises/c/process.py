"""The process in which a C submission is compiled: it restricts itself as the sandbox does, then runs the compiler.

A compiler runs nothing of the submission, but it opens what the submission names: `#include` can ask for any file. So
it may read the system's files and this exercise's header, and write in one folder. Run as a script by `compiler`;
imports Python's own library only.
"""

from __future__ import annotations

import ctypes
import importlib
import json
import os
import subprocess
import sys

#: Seconds of computing, and memory [bytes].
SECONDS, MEMORY = 10, 2**30

#: What cannot be had: said with this exit code.
NO_SANDBOX = 77


def main() -> None:
    """The task is on standard input: commands, what may be read, where may be written.

    The commands run one after another, up to the first that fails; what they said goes to standard output.
    """
    sys.path.append(os.path.abspath(os.path.join(__file__, *[os.pardir] * 4)))
    layers = importlib.import_module("experiments.exercises.process.sandbox_layers")

    task = json.loads(sys.stdin.read())
    layers.limit(SECONDS, MEMORY)
    if sys.platform == "linux":
        libc = ctypes.CDLL(None)
        rules = layers.landlock_rules(libc, task["readable"], programs=True, writable=task["writable"])
        user = layers.become_nobody() if os.geteuid() == 0 else True
        layers.drop_capabilities(libc)
        libc.prctl(layers.NO_NEW_PRIVILEGES, 1, 0, 0, 0)
        stands = rules is not None and layers.landlock(libc, rules) and user
        if not stands and not task["exposed"]:
            sys.exit(NO_SANDBOX)
    said = []
    for command in task["commands"]:
        done = subprocess.run(command, capture_output=True, errors="replace", cwd=task["folder"])
        said.append([done.returncode, done.stdout, done.stderr])
        if done.returncode:
            break
    print(json.dumps(said))


if __name__ == "__main__":
    main()
