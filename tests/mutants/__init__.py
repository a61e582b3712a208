"""`make mutants`: small mistakes put into the sources one at a time, and whether tests notice.

Well-kept tools for this (mutmut, cosmic-ray) run all tests, or a fixed list of them, for every mistake, which takes
hours where tests start engines and compile kernels; so this is a short runner of our own. It runs tests that call the
function in question, where that has been written down (`calls`), the file's own first, then those near the file.

    python -m tests.mutants --count 100 --seed 1          # a random sample over the four rooms
    python -m tests.mutants --room reference --list       # which it would be, without running anything
    python -m tests.mutants --file reference/axes.py      # of one file
"""
