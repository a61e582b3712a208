"""The tests, one folder per room; `tests.wrong` holds the deliberately wrong integrators they must catch."""

import os

# As report/commands/main.py does, and for the same reason; here before any test imports NumPy.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
