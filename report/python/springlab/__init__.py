"""The lab in Python: run a scene under schemes and engines, and find out what each of them is.

>>> import springlab as lab
>>> found = lab.identify("mujoco_tendons", "string", masses=5, duration=0.1)
>>> found.identified_as
'kick_drift'

Every function takes a scene: its name, a TOML file, or what `scene` or `system` gave; parameters of a named scene by
their names, as above. A stepper is a name of `schemes` or `engines`, a file of your own, as "my_step.py", or a function
in one of the forms of such a file, as `step(x, v, dt, system)`. All quantities are in SI units. Answers are frozen,
show themselves in a notebook, and have their numbers as plain arrays, as `document` (what the commands print with
`--json`), and by `to_pandas()`.

Engines and own files run in processes of their own, functions in yours, without a limit on time. It makes no
difference whether this is a notebook, a plain script, or a program read from standard input.
"""

from __future__ import annotations

from springlab._rooms import check_rooms

check_rooms()

from reference.changes import Change  # noqa: E402 - the check comes first
from reference.drives import Ramp, Sine  # noqa: E402
from reference.errors import InputError, SolverError  # noqa: E402
from springlab.deriving import Explained, explain  # noqa: E402
from springlab.listings import engines, experiments, scenes, schemes  # noqa: E402
from springlab.naming import Identified, identify  # noqa: E402
from springlab.pages import Page, report  # noqa: E402
from springlab.plot import Plot  # noqa: E402
from springlab.running import Compared, Comparison, Run, Simulation, compare, simulate  # noqa: E402
from springlab.setting import Scene, scene, system  # noqa: E402
from springlab.table import Table  # noqa: E402
from springlab.theory import Modes, Stability, modes, stability  # noqa: E402

__all__ = [
    "Change",
    "Compared",
    "Comparison",
    "Explained",
    "Identified",
    "InputError",
    "Modes",
    "Page",
    "Plot",
    "Ramp",
    "Run",
    "Scene",
    "Simulation",
    "Sine",
    "SolverError",
    "Stability",
    "Table",
    "__version__",
    "compare",
    "engines",
    "experiments",
    "explain",
    "identify",
    "modes",
    "report",
    "scene",
    "scenes",
    "schemes",
    "simulate",
    "stability",
    "system",
]


def __dir__() -> list[str]:
    """The public names alone."""
    return sorted(__all__)


def _version() -> str:
    from importlib import metadata

    try:
        return metadata.version("springlab")
    except metadata.PackageNotFoundError:  # a folder on the path, and nothing installed
        return "0+unknown"


__version__: str = _version()
