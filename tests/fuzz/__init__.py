"""Fuzz targets, one file a door: what comes in from outside is made up at random, from a seed, much like what is meant.

    python -m tests.fuzz --door scene_file --count 1000 --seed 0     # or --door all
    python -m tests.fuzz --door command_line --show 17               # what input 17 is, and what becomes of it

A door either takes its input or refuses it in a line. Anything else is a finding: an exception, a traceback, more than
ten seconds, more than a gibibyte. What was found is a test beside the code it was found in.
"""
