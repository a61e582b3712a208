"""The command line of the fuzz targets; see the package."""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from random import Random

from tests.fuzz.doors import DOORS, door
from tests.fuzz.runner import entered, run


def main(words: Sequence[str]) -> int:
    """Print what became of the inputs. Returns 1 where there is a finding, else 0."""
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz", description="Wild inputs through a door.")
    parser.add_argument("--door", choices=[*DOORS, "all"], default="all")
    parser.add_argument("--count", type=int, default=1000, help="how many inputs")
    parser.add_argument("--seed", type=int, default=0, help="of the first one; the next have the next")
    parser.add_argument("--show", type=int, metavar="SEED", help="only the input of this seed, and what becomes of it")
    asked = parser.parse_args(words)
    failed = False
    for name in DOORS if asked.door == "all" else [asked.door]:
        with tempfile.TemporaryDirectory() as folder:
            if asked.show is not None:
                found = door(name)
                print(repr(found.make(Random(asked.show))))
                with found.opened(Path(folder)) as enter:
                    print(entered(found, enter, asked.show))
                continue
            report = run(name, asked.count, asked.seed, Path(folder))
        print(report, flush=True)
        for seed, what in report.findings.items():
            print(f"  seed {seed}: {what}")
        failed |= bool(report.findings)
    return int(failed)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
