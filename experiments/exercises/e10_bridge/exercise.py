"""A truss bridge: the member that carries most, and the step that stiffness costs (slides 27-28)."""

from __future__ import annotations

from math import pi, sqrt
from typing import Any

import numpy as np

from experiments.exercises.exercise import Exercise, Question, mistake, mistakes
from experiments.exercises.solutions.bridges import moved, some_bridge, turned_about
from experiments.exercises.solutions.force_mistakes import EXAMPLE_GRAVITY
from experiments.exercises.solutions.links import namespace
from experiments.exercises.solutions.on_strings import MOON
from reference.state import Array


def heaviest(
    bridge: Any,
    choice: str = "size",
    sign: float = 1.0,
    told: str = "signed",
    first: int = 0,
    load: str = "m g",
    joints: str = "all",
    in_joints: str = "unit",
    held: str = "all",
) -> tuple[int, float]:
    """The member with the largest force, and that force [N], tension > 0: the method of joints."""
    unit, count = _directions(bridge, in_joints), len(bridge.joints)
    matrix = np.zeros((2 * count, len(bridge.members) + 3))
    for j, (a, b) in enumerate(bridge.members):
        matrix[2 * a : 2 * a + 2, j] = unit[j]
        matrix[2 * b : 2 * b + 2, j] = -unit[j]
    for j, row in enumerate((2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller + (held != "turned"))):
        matrix[row, len(bridge.members) + j] = 1.0
    weights = np.zeros(2 * count)
    mass = bridge.masses if joints == "all" else bridge.masses * (bridge.joints[:, 1] == 0)
    g = bridge.gravity
    weights[1::2] = {"m g": mass * g, "m": mass, "m g/2": mass * g / 2, "mean": mass.mean() * g, "m 9.81": mass * 9.81}[
        load
    ]
    solve = np.linalg.solve if held != "turned" else lambda a, b: np.linalg.lstsq(a, b)[0]
    force = solve(matrix, weights)[:-3]
    lengths = np.linalg.norm(np.diff(bridge.joints[bridge.members], axis=1)[:, 0], axis=1)
    by = {"size": np.abs(force), "tension": force, "compression": -force}
    by |= {"length": lengths, "stiffness": bridge.stiffness}
    index = int(np.argmax(by[choice]))
    found = abs(force[index]) if told == "size" else sign * force[index]
    return index + first, float(found)


def largest_dt(
    bridge: Any,
    factor: str = "2",
    rate: str = "root",
    mode: str = "highest",
    held: str = "all",
    inertia: str = "own",
    in_stiffness: str = "unit",
    material: str = "k",
) -> float:
    """The largest stable dt [s] of kick-drift: 2 over the highest frequency of the bridge on its supports."""
    unit, count = _directions(bridge, in_stiffness), len(bridge.joints)
    lengths = np.linalg.norm(np.diff(bridge.joints[bridge.members], axis=1)[:, 0], axis=1)
    stiffness = np.zeros((2 * count, 2 * count))
    stiffness_of = bridge.stiffness / (lengths if material == "EA" else 1.0)
    for (a, b), u, k in zip(bridge.members, unit, stiffness_of, strict=True):
        at = [2 * a, 2 * a + 1, 2 * b, 2 * b + 1]
        way = np.concatenate([u, -u])
        stiffness[np.ix_(at, at)] += k * np.outer(way, way)
    supports = {
        "all": [0, 1, 3],
        "pin": [0, 1],
        "both pinned": [0, 1, 2, 3],
        "none": [],
        "turned": [0, 1, 2],
    }[held]
    rows = [2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller, 2 * bridge.roller + 1]
    free = np.setdiff1d(np.arange(2 * count), [rows[i] for i in supports])
    m = bridge.masses
    masses = {"own": m, "forgotten": np.ones_like(m), "mean": np.full_like(m, m.mean())}[inertia]
    root = np.sqrt(np.repeat(masses, 2))[free]
    squares = np.linalg.eigvalsh(stiffness[np.ix_(free, free)] / np.outer(root, root))
    square = {
        "highest": squares[-1],
        "lowest": abs(squares[0]),
        "one": bridge.stiffness.max() / bridge.masses.min(),
        "four": 4 * bridge.stiffness.max() / bridge.masses.min(),
    }[mode]
    return {"2": 2.0, "1": 1.0, "period": 2 * pi}[factor] / (sqrt(square) if rate == "root" else float(square))


def _directions(bridge: Any, length: str) -> Array:
    """Of each member, from its first joint to its second, of length 1."""
    a, b = np.asarray(bridge.members).T
    separation = bridge.joints[b] - bridge.joints[a]
    norm = np.linalg.norm(separation, axis=1)[:, None]
    return np.asarray(separation / norm if length == "unit" else separation)


def _slants(bridge: dict[str, Any]) -> bool:
    """Whether the member that carries most goes from the bottom to the top."""
    member = bridge["members"][heaviest(namespace(bridge))[0]]
    one, other = bridge["joints"][member, 1] > 0
    return bool(one != other)


def questions(random: np.random.Generator, hidden: bool, seed: str) -> list[Question]:
    """Bridges in which a member that slants carries most, and bridges in which another does."""
    asked = []
    for i, panels in enumerate((3, 6, 4) if hidden else (4, 5)):
        gravity = MOON if i == 1 else 9.81
        light = (0, panels, 1)[i]
        bridge = some_bridge(random, panels, gravity, light)
        while _slants(bridge) != (i == 0):
            bridge = some_bridge(random, panels, gravity, light)
        asked.append((bridge, f"bridge of {len(bridge['members'])} members"))
    for turn in (0.12, -0.15):
        bridge = moved(random, some_bridge(random, 3, MOON, 0), turn)
        member = heaviest(namespace(bridge))[0]
        asked.append((turned_about(bridge, member, rightwards=turn > 0), "bridge that leans, below height 0"))
    questions = []
    for bridge, about in asked:
        questions.append(Question("heaviest", (bridge,), ("member", "force"), about))
        questions.append(Question("largest_dt", (bridge,), ("dt",), about))
    return questions


EXERCISE = Exercise(
    title="The bridge",
    minutes=90,
    goals="The method of joints as a linear system; what stiffness costs: the step.",
    solutions={"heaviest": heaviest, "largest_dt": largest_dt},
    questions=questions,
    mistakes=[
        mistake(
            "tension_only",
            "You look for the largest tension: compression carries too.",
            "Is -5 kN less of a load than 3 kN?",
            choice="tension",
        ),
        mistake(
            "compression_only",
            "You look for the largest compression: tension carries too.",
            "Is 5 kN less of a load than -3 kN?",
            choice="compression",
        ),
        mistake(
            "longest_member", "You name the longest member.", "Does length say what a member carries?", choice="length"
        ),
        mistake(
            "stiffest_member",
            "You name the stiffest member.",
            "Do the forces of this bridge depend on stiffness at all?",
            choice="stiffness",
        ),
        mistake(
            "force_sign",
            "Your tension is compression, and the other way round.",
            "Which way does a member in tension pull its joints?",
            sign=-1.0,
        ),
        mistake(
            "force_without_sign",
            "You give back the size of the force.",
            "How does somebody see whether the member is pulled or pressed?",
            told="size",
        ),
        mistake("counted_from_one", "You count members from 1.", "Which number has the first member?", first=1),
        mistake(
            "weights_spread_evenly",
            "Every joint has the same load in your bridge.",
            "Each joint has a mass of its own.",
            load="mean",
        ),
        mistake(
            *EXAMPLE_GRAVITY,
            load="m 9.81",
        ),
        mistake(
            "mass_forgotten",
            "There is no mass in your frequencies.",
            "What is the unit of a stiffness, and what that of a frequency squared?",
            inertia="forgotten",
        ),
        mistake(
            "one_mass_for_all",
            "You take the mean mass for all joints.",
            "Each joint has a mass of its own.",
            inertia="mean",
        ),
        mistake(
            "stiffness_over_length",
            "You divide the stiffness by the length of the member.",
            "In which unit is the stiffness given: N, or N/m?",
            material="EA",
        ),
        *mistakes(
            "not_normalised",
            "The directions of your members are not of length 1.",
            "How long is the vector from joint to joint?",
            {"in_joints": "separation"},
            {"in_stiffness": "separation"},
            {"in_joints": "separation", "in_stiffness": "separation"},
        ),
        mistake("weight_without_g", "Your loads are masses, not weights.", "What is the unit of a load?", load="m"),
        mistake("half_the_weight", "Your loads are half of the weights.", "What hangs on a joint?", load="m g/2"),
        mistake(
            "top_unloaded", "The top joints carry nothing in your bridge.", "Which joints have a mass?", joints="bottom"
        ),
        mistake(
            "root_forgotten", "You take the eigenvalue for the frequency.", "What is the unit of k/m?", rate="square"
        ),
        mistake(
            "limit_of_one",
            "Your limit is that of dt w = 1.",
            "When does the step's matrix get an eigenvalue -1?",
            factor="1",
        ),
        mistake("a_whole_period", "Your limit is a whole period.", "What happens in half a period?", factor="period"),
        mistake(
            "lowest_mode",
            "You take the lowest frequency.",
            "Which mode is the first to become unstable?",
            mode="lowest",
        ),
        mistake(
            "one_spring",
            "You take the stiffest member and the lightest joint, as if alone.",
            "Several members pull on a joint.",
            mode="one",
        ),
        mistake(
            "upper_bound",
            "This is a bound, from the stiffest member and the lightest joint; not the limit.",
            "The frequencies of the whole bridge are eigenvalues.",
            mode="four",
        ),
        mistake(
            "roller_pinned",
            "Both ends of your bridge are pinned.",
            "Which way is a roller free to move?",
            held="both pinned",
        ),
        mistake(
            "roller_turned",
            "Your roller holds sideways, and is free upwards.",
            "Which way is a roller free to move?",
            held="turned",
        ),
        mistake(
            "roller_free", "Nothing holds the roller of your bridge up.", "Which way does a roller hold?", held="pin"
        ),
        mistake(
            "supports_free",
            "Your bridge has no supports.",
            "Which joints cannot move, and along which axis?",
            held="none",
        ),
    ],
)
