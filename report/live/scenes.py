"""What the live lab can show: every scene, or a user's own in a file, each with an obstacle in the way or without."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, replace

from reference.changes import Change
from reference.errors import InputError
from reference.files.setup import is_file, setup_for
from reference.obstacles import Circle, Obstacle, Plane, Sphere
from reference.scenes import find, scenes
from reference.system import MassSpringSystem

#: More masses than that are no fun to watch.
MOST_MASSES = 5_000

#: The radius of the obstacle in the way, and how far it is below the lowest mass, as parts of the system's size: for
#: the default string the circle of the scene `barrier`.
RADIUS, BELOW = 0.24, 0.2

#: For how long a truck or the ground is followed [s]; what changes more often is driven, and not only changed.
FOLLOWED, OFTEN = 30.0, 20


@dataclass(frozen=True, eq=False)
class OpenedScene:
    """A scene as it was opened.

    Attributes:
        name: of the scene, or the path of its file.
        system: where it starts.
        dt: the step it is shown with [s].
        settings: parameters of the scene that were set otherwise, as text.
        changes: parameters that change while it moves, by themselves.
        as_named: whether name and settings say it all.
        ground_moves: whether gravity changes as it does seen from ground that moves.
    """

    name: str
    system: MassSpringSystem
    dt: float
    settings: Mapping[str, str]
    changes: tuple[Change, ...]
    as_named: bool
    ground_moves: bool

    @property
    def stem(self) -> str:
        """The name; of a file, without its folder."""
        return self.name.rpartition("/")[2].removesuffix(".toml")

    @property
    def driven(self) -> frozenset[str]:
        """The parameters that change all the time: nobody else can."""
        often = Counter(change.parameter for change in self.changes)
        return frozenset(name for name, count in often.items() if count > OFTEN)


def names() -> list[str]:
    """The scenes there are."""
    return list(scenes())


def open_scene(name: str, settings: Mapping[str, str] | None = None, barrier: bool | None = None) -> OpenedScene:
    """A scene by name or file, with some of its parameters.

    Args:
        barrier: whether there is to be something in the way; left out, as the scene has it.

    Raises:
        InputError: for what makes no sense, and for systems too large to watch.
    """
    settings = settings or {}
    setup = setup_for(name, settings=settings)
    if setup.changes:
        setup = setup_for(name, setup.dt, max(FOLLOWED, setup.duration), settings)
    system, as_named = setup.system, not setup.changes
    if len(system.masses) > MOST_MASSES:
        raise InputError(f"{name} has {len(system.masses):,} masses: expected at most {MOST_MASSES:,} in the live lab")
    if barrier is not None and barrier != bool(system.obstacles):
        system = replace(system, obstacles=(in_the_way(system),) if barrier else ())
        as_named = False
    return OpenedScene(name, system, setup.dt, settings, setup.changes, as_named, setup.ground_moves)


def in_the_way(system: MassSpringSystem) -> Obstacle:
    """A circle or a sphere below the masses; along a line, a floor."""
    low, high = system.positions.min(axis=0), system.positions.max(axis=0)
    if system.dimension == 1:
        return Plane(tuple((low - BELOW * system.size).tolist()), (1.0,))
    radius = RADIUS * system.size
    centre = (low + high) / 2
    centre[1] = low[1] - BELOW * system.size - radius
    kind = Circle if system.dimension == 2 else Sphere
    return kind(tuple(centre.tolist()), radius)


def counts(name: str) -> Mapping[str, int]:
    """The scene's parameters that are counts (of masses, rows, panels), with their defaults; none of a file's."""
    if is_file(name):
        return {}
    return {key: value for key, value in find(name).parameters.items() if type(value) is int and value > 0}


def words(name: str) -> Mapping[str, tuple[str, ...]]:
    """The scene's parameters that are a word, with the words there are, the default first; none of a file's."""
    if is_file(name):
        return {}
    scene = find(name)
    return {
        key: (scene.parameters[key], *(word for word in choices if word != scene.parameters[key]))
        for key, choices in scene.choices.items()
    }
