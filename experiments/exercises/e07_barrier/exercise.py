"""Masses that run into a circle (slides 16-17)."""

from __future__ import annotations

from typing import Any

import numpy as np

from experiments.exercises.exercise import Exercise, Mistake, Question, mistake, mistakes
from reference.state import Array


def push_out(
    x: Array,
    v: Array,
    circle: Any,
    *,
    velocity: str = "inwards off",
    place: str = "surface",
    where: str = "inside",
    whose: str = "of those",
    normal: str = "unit",
    centre: str = "own",
) -> tuple[Array, Array]:
    """Masses inside go straight out to the surface, and lose the velocity that leads inwards."""
    middle = circle.centre if centre == "own" else np.zeros(2)
    offset = x - middle
    far = np.linalg.norm(offset, axis=1)
    n = offset if normal != "unit" else offset / far[:, None]
    at = (v * n).sum(axis=1)[:, None]
    along = np.stack([n[:, 1], -n[:, 0]], axis=1)
    slides = (v * along).sum(axis=1)[:, None]
    inside = {
        "inside": far < circle.radius,
        "everywhere": np.full(len(x), True),
        "outside": far > circle.radius,
        "square": far**2 < circle.radius,
        "box": (np.abs(offset) < circle.radius).all(axis=1),
        "first": (far < circle.radius) & (np.arange(len(x)) == 0),
    }[where][:, None]
    new = {
        "inwards off": v - np.minimum(at, 0) * n if normal != "offset, along" else np.where(at < 0, slides * along, v),
        "tangential": v - at * n,
        "printed": v * along,
        "stopped": 0 * v,
        "stopped, inwards": np.where(at < 0, 0, v),
        "mirrored": v - 2 * np.minimum(at, 0) * n,
        "kept": v,
        "normal": at * n,
        "normal, inwards": np.where(at < 0, at * n, v),
        "turned": at * n - v,
        "outwards off": v - np.maximum(at, 0) * n,
        "clockwise": np.where(at < 0, np.abs(slides) * along, v),
        "anticlockwise": np.where(at < 0, -np.abs(slides) * along, v),
        "whole": np.where(at < 0, np.sign(slides) * np.linalg.norm(v, axis=1)[:, None] * along, v),
    }[velocity]
    above = middle[1] + np.sqrt(np.maximum(circle.radius**2 - offset[:, 0] ** 2, 0))
    out = {
        "surface": middle + circle.radius * n,
        "kept": x,
        "origin": circle.radius * n,
        "added": x + circle.radius * n,
        "other side": middle - circle.radius * n,
        "up": np.stack([x[:, 0], above], axis=1),
    }[place]
    return np.where(inside, out, x), np.where(inside | (whose == "everybody's"), new, v)


def questions(random: np.random.Generator, hidden: bool, seed: str) -> list[Question]:
    """Masses inside and outside, on all sides, coming and going, to the left and to the right."""
    asked = []
    for count in (1, 9, 12) if hidden else (8, 6, 1):
        circle = {"centre": random.uniform(-1, 1, 2), "radius": float(random.uniform(0.3, 0.6))}
        # two inside; one outside in a corner of the square about the circle, one outside of that; one farther away
        kind, quarter = np.arange(count) % 5, np.pi / 2 * random.integers(4, size=count)
        anywhere, within = random.uniform(0, 2 * np.pi, count), random.uniform(0.6, 0.8, count)
        angle = np.choose(kind, [anywhere, anywhere, quarter + np.pi / 4, quarter, anywhere])
        far = circle["radius"] * np.choose(kind, [within, within, 1.2, 1.2, 4.0])
        out = np.stack([np.cos(angle), np.sin(angle)], axis=1)
        # of those inside every other comes in; of the five and five, one slides this way, one that way
        leads = random.uniform(0.2, 1.0, count) * np.where(kind == 1, 1, -1)
        slides = random.uniform(0.2, 1.0, count) * np.where(np.arange(count) // 5 % 2, 1, -1)
        v = leads[:, None] * out + slides[:, None] * np.stack([-out[:, 1], out[:, 0]], axis=1)
        x = circle["centre"] + far[:, None] * out
        asked.append(
            Question("push_out", (x, v, circle), ("x", "v"), f"{count} masses about a circle", units=("m", "m/s"))
        )
    return [*asked, _of_all_kinds(random)]


#: Of masses about a circle: how far from its centre, as a share of its radius, from next to it to far away.
DEPTHS = np.array([1e-3, 0.04, 0.15, 0.3, 0.45, 0.55, 0.75, 0.9, 0.999, 1.001, 1.1, 1.3, 2.0, 6.0])

#: How fast they come in [m/s]; how fast they slide; less than nothing is the other way.
COMES_IN, SLIDES = np.array([1.0, -1.0, 1e-4, 20.0]), np.array([1.0, -1.0, 20.0, -1e-4])


def _of_all_kinds(random: np.random.Generator) -> Question:
    """Of every depth, every way and every speed, on all sides: more masses than are done by hand."""
    depth, comes, slides = (part.ravel() for part in np.meshgrid(DEPTHS, COMES_IN, SLIDES, indexing="ij"))
    angle = random.uniform(0, np.pi / 2) + np.pi / 2 * np.arange(len(depth)) + random.uniform(0, 0.3, len(depth))
    out, near = np.stack([np.cos(angle), np.sin(angle)], axis=1), random.uniform(0.9, 1.1, (2, len(depth), 1))
    along = np.stack([-out[:, 1], out[:, 0]], axis=1)
    circle = {"centre": random.uniform(-1, 1, 2), "radius": float(random.uniform(1.2, 1.6))}
    x = circle["centre"] + circle["radius"] * depth[:, None] * out
    v = -comes[:, None] * near[0] * out + slides[:, None] * near[1] * along
    order = random.permutation(len(depth))
    about = f"{len(depth)} masses of all kinds about a circle"
    return Question("push_out", (x[order], v[order], circle), ("x", "v"), about, units=("m", "m/s"))


EXERCISE = Exercise(
    title="The barrier",
    minutes=45,
    goals="Projections: what of a velocity an obstacle takes, and what it leaves.",
    solutions={"push_out": push_out},
    questions=questions,
    mistakes=[
        mistake(
            "product_of_components",
            "Your velocity is multiplied component by component: that is no projection.",
            "What is the tangential part of a velocity that already is tangential?",
            velocity="printed",
        ),
        Mistake(
            "leaving_is_stopped",
            "You also take the velocity that leads outwards: your circle holds on to masses. (So does slide 17.)",
            "A mass that is leaving: should the obstacle pull it back?",
            {"velocity": "tangential"},
            True,
        ),
        *mistakes(
            "stopped",
            "Your masses stop.",
            "What does a smooth surface do to a velocity along it?",
            {"velocity": "stopped"},
            {"velocity": "stopped, inwards"},
        ),
        mistake(
            "bounces",
            "Your masses bounce: the part that leads inwards is turned about, not taken.",
            "How often do you subtract the part along the normal?",
            velocity="mirrored",
        ),
        mistake(
            "velocity_unchanged",
            "Your velocities stay as they were.",
            "What of a velocity is left at the surface?",
            velocity="kept",
        ),
        *mistakes(
            "normal_part_kept",
            "You keep the part along the normal, and take the tangential one.",
            "Which way does a mass go that slides?",
            {"velocity": "normal"},
            {"velocity": "normal, inwards"},
        ),
        *mistakes(
            "always_one_way",
            "All your masses slide the same way about the circle, whichever way they came.",
            "What becomes of the sign of a velocity whose size you take?",
            {"velocity": "clockwise"},
            {"velocity": "anticlockwise"},
        ),
        mistake(
            "whole_speed_kept",
            "Your masses slide with their whole speed: it is turned along the circle.",
            "How fast does a mass slide that comes straight in?",
            velocity="whole",
        ),
        mistake(
            "velocity_of_everybody",
            "Masses outside lose velocity too.",
            "Which masses does the circle touch? For which is the velocity changed?",
            whose="everybody's",
        ),
        mistake(
            "first_mass_only",
            "You treat the first mass only.",
            "How far is your return indented? What ends a loop?",
            where="first",
        ),
        mistake("tangential_turned", "Your masses slide the other way.", "What minus what?", velocity="turned"),
        mistake(
            "outwards_taken",
            "You take the velocity that leads outwards, and leave what leads inwards.",
            "What is the sign of v . n for a mass that comes in?",
            velocity="outwards off",
        ),
        mistake(
            "position_unchanged",
            "Your masses stay inside.",
            "Where is the nearest place that is allowed?",
            place="kept",
        ),
        *mistakes(
            "centre_forgotten",
            "You put masses on a circle about the origin.",
            "Where is the circle's centre?",
            {"place": "origin"},
            {"centre": "origin"},
        ),
        mistake(
            "straight_up",
            "You push masses straight up.",
            "Which way is out? Look at a mass at the side of the circle.",
            place="up",
        ),
        mistake(
            "radius_added",
            "You move masses out by a whole radius.",
            "How far from the centre is the surface?",
            place="added",
        ),
        mistake(
            "other_side",
            "Your masses come out on the other side.",
            "Which way does your normal point?",
            place="other side",
        ),
        mistake(
            "everywhere",
            "You also move masses that are outside.",
            "Which masses does the circle touch?",
            where="everywhere",
        ),
        mistake(
            "outside_in",
            "You move the masses that are outside, not those inside.",
            "Which way does your < point?",
            where="outside",
        ),
        mistake(
            "square_against_radius",
            "You compare the square of a distance with the radius.",
            "What are the two units?",
            where="square",
        ),
        mistake(
            "box", "You take the square about the circle for the circle.", "What does Pythagoras say?", where="box"
        ),
        *mistakes(
            "not_normalised",
            "Your normal is not of length 1.",
            "How long is the vector from the centre to a mass?",
            {"normal": "offset"},
            {"normal": "offset, along"},
        ),
    ],
)
