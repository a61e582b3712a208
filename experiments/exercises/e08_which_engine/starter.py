"""Exercise 8: which engine is it? The trajectories are in A.csv to E.csv. Run me: python which_engine.py."""

from pathlib import Path

EXERCISE = 8
SEED = "example"


def names():
    """Who has made A, B, C, D and E."""
    return ["", "", "", "", ""]


if __name__ == "__main__":
    print("A:", Path(__file__).with_name("A.csv").read_text()[:200], "...", sep="\n")
    print(names())
