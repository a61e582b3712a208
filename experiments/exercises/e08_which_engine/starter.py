"""Exercise 8: which engine is it? The trajectories are in A.csv to E.csv. Run me: python which_engine.py."""

EXERCISE = 8
SEED = "example"


def names():
    """Who has made A, B, C, D and E."""
    return ["", "", "", "", ""]


if __name__ == "__main__":
    with open("A.csv") as file:
        print("A:", file.read()[:200], "...", sep="\n")
    print(names())
