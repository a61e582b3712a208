"""Importing this loads what every run of a scheme needs, its compiled functions included, which takes most of a second.

For a server that forks processes: they then begin with it.
"""

from __future__ import annotations

from contextlib import suppress

from reference.scenes import find as find_scene
from reference.schemes.catalogue import find as find_scheme
from reference.simulate import simulate

_SCENE = find_scene("string")

with suppress(Exception):  # what is wrong with it is seen, and said, by who asks for a run
    simulate(_SCENE.system({"masses": 2}), find_scheme("heun"), _SCENE.dt, _SCENE.dt)
