"""The tests, one folder per room; `tests.wrong` holds the deliberately wrong integrators they must catch."""
