"""The tests, one folder per room; `tests.wrong` holds the deliberately wrong integrators they must catch."""

import os

# As experiments/command_line.py does, and for the same reason; here before any test imports NumPy.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
