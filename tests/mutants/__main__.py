"""The command line of `make mutants`; see the package."""

from __future__ import annotations

import argparse
import random
import signal
import sys
import time
from collections import Counter
from collections.abc import Sequence
from itertools import zip_longest
from pathlib import Path

from tests.mutants.calls import Calls
from tests.mutants.equivalent import entry_of, equivalents, is_meant
from tests.mutants.kinds import KINDS
from tests.mutants.mutations import Mutant, mutants
from tests.mutants.near import judged_here
from tests.mutants.verdicts import MISSED, Judge, Verdict

ROOT = Path(__file__).parents[2]
ROOMS = ("reference", "engines", "experiments", "report")


def sample(root: Path, places: Sequence[str], count: int, seed: int) -> list[Mutant]:
    """Mutants of the files in some places, chosen at random, of each kind as many as of the others if there are.

    Files of engines that are not installed here are left out: nothing can be said of them.

    Args:
        places: files, or folders of them, as paths from the root.
        count: how many; all there are, where there are no more.
        seed: the same sources and the same seed give the same sample.
    """
    files = [file for place in places for file in sorted([root / place, *(root / place).rglob("*.py")])]
    known, chance = equivalents(root), random.Random(seed)
    kinds: dict[str, list[Mutant]] = {kind: [] for kind in KINDS}
    for file in files:
        name = file.relative_to(root).as_posix()
        if file.suffix == ".py" and judged_here(name):
            for mutant in mutants(name, file.read_text(encoding="utf-8")):
                if not any(is_meant(entry, mutant) for entry in known):
                    kinds[mutant.kind].append(mutant)
    for found in kinds.values():
        chance.shuffle(found)
    rounds = zip_longest(*chance.sample(list(kinds.values()), len(kinds)))
    return [mutant for several in rounds for mutant in several if mutant is not None][:count]


def described(mutant: Mutant) -> str:
    """Its place and kind, and below them its lines before and after."""
    return f"{mutant.file}:{mutant.line}  {mutant.kind}\n    - {mutant.before}\n    + {mutant.after}"


def main(words: Sequence[str], root: Path = ROOT) -> int:
    """Print what became of a sample. Returns 1 where a mutant survived or a test fails without any, else 0."""
    parser = argparse.ArgumentParser(prog="python -m tests.mutants", description="Which small mistakes do tests miss?")
    parser.add_argument("--count", type=int, default=100, help="how many mutants")
    parser.add_argument("--seed", type=int, default=0, help="of the random sample")
    parser.add_argument("--room", action="append", choices=ROOMS, help="of these rooms only")
    parser.add_argument("--file", action="append", help="of these files only")
    parser.add_argument("--workers", type=int, default=2, help="how many are tried at once")
    parser.add_argument("--list", action="store_true", help="show the sample and run nothing")
    parser.add_argument("--toml", action="store_true", help="end with survivors as entries of equivalent.toml")
    given = parser.parse_args(words)
    for name in given.file or ():
        if not (root / name).is_file():
            parser.error(f"--file {name}: expected a file of the project, such as reference/axes.py")
    chosen = sample(root, given.file or given.room or ROOMS, given.count, given.seed)
    if given.list:
        print(*map(described, chosen), sep="\n")
        return 0
    # so that nothing is left of a run that is ended from outside
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    begin, judge = time.monotonic(), Judge(root, Calls.kept() if root == ROOT else Calls())

    def told(mutant: Mutant, verdict: Verdict) -> None:
        what = described(mutant) if verdict in MISSED else described(mutant).splitlines()[0]
        print(f"{(time.monotonic() - begin) / 60:5.1f} min  {verdict:11}  {what}", flush=True)

    verdicts = judge.verdicts(chosen, given.workers, told)
    missed = [mutant for mutant, verdict in zip(chosen, verdicts, strict=True) if verdict in MISSED]
    print("", *map(described, missed), sep="\n")
    if given.toml:
        print("", *map(entry_of, missed), sep="\n")
    print("\n" + ", ".join(f"{verdict} {n}" for verdict, n in sorted(Counter(verdicts).items())))
    for test, said in judge.failing.items():
        print(f"\n{test} fails without any mutant, and was left out:\n{said}")
    return int(bool(missed or judge.failing))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
