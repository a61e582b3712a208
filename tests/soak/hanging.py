"""Runs that all hang but the first: `python -m tests.soak.hanging STORE`, to be interrupted.

With --busy it is at work on the first answer when that comes, else it is waiting for the next.
"""

from __future__ import annotations

import sys
import time
from contextlib import closing
from pathlib import Path

import click

from experiments.runs.task import Task
from report.commands.runner_options import chosen_runner
from tests.engines.process import misbehaving

#: [s]: much longer than anybody waits, on however busy a machine.
LONG = 600.0


def main() -> None:
    """Do them, as a command of springlab's would."""
    hangs = [Task(misbehaving.fine, ())]
    hangs += [Task(misbehaving.hang, (), {"number": number}, time_limit=LONG + number) for number in range(10)]
    try:
        with chosen_runner(True, Path(sys.argv[1]), jobs=2) as runner:
            print("begun", flush=True)
            with closing(runner.answers(hangs)) as answers:
                for _ in answers:
                    if "--busy" in sys.argv:
                        time.sleep(LONG)
    except click.exceptions.Exit as ending:
        sys.exit(ending.exit_code)


if __name__ == "__main__":
    main()
