"""The numbers that questions are made of: alike in size, physical, and as far out as their words say."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest

from experiments.exercises.exercise import Question, exercises, find
from experiments.exercises.solutions.links import random_string
from experiments.exercises.solutions.on_strings import crumpled_string, wild_string
from experiments.exercises.solutions.stepping import DT

#: Gravity on the Earth and on the Moon [m/s^2].
EARTH, MOON = 9.81, 1.62

SPAN = 3.0


def asked(name: str, hidden: bool, seed: int = 1) -> list[Question]:
    """The questions of an exercise."""
    return list(find(name).questions(np.random.default_rng(seed), hidden, "ada"))


def test_numbers_of_strings_are_alike_in_size_and_fill_their_range() -> None:
    """All more than nothing, none three times as large as another of its kind; speeds both ways, up to 1 m/s.

    A mass of some tens of grams on springs of some tens of N/m: w dt is 0.3, well below 2, where kick-drift ends.
    """
    strings = [random_string(np.random.default_rng(seed), 9) for seed in range(40)]
    for name in ("masses", "stiffness", "rest_lengths", "drag", "anchor"):
        values = np.concatenate([np.ravel(string[name]) for _, _, string in strings])
        assert values.min() > 0
        assert 1.7 < values.max() / values.min() <= SPAN
    velocities = np.concatenate([v for _, v, _ in strings])
    assert (-1.0 <= velocities.min() < -0.95, 0.95 < velocities.max() <= 1.0) == (True, True)
    assert {string["gravity"] for _, _, string in strings} == {EARTH}
    frequencies = [np.sqrt(4 * string["stiffness"].max() / string["masses"].min()) for _, _, string in strings]
    assert 0.2 < np.mean(frequencies) * DT < 0.6


def test_strings_flung_about_and_crumpled_have_physical_numbers() -> None:
    """Gravity as it is asked for, drag, and an anchor that is in no corner of its own."""
    for seed in range(30):
        _, _, string = wild_string(np.random.default_rng(seed), MOON)
        assert string["gravity"] == MOON
        assert 0.1 <= string["drag"] <= 0.3
        assert ((string["anchor"] >= -0.3) & (string["anchor"] <= -0.1)).all()
        assert ((string["rest_lengths"] >= 0.1) & (string["rest_lengths"] <= 0.2)).all()
        soft = np.delete(string["stiffness"], 2)
        assert ((soft >= 40) & (soft <= 80)).all()
        assert 1.6e5 <= string["stiffness"][2] <= 3.2e5
        _, v, crumpled = crumpled_string(np.random.default_rng(seed))
        assert ((crumpled["anchor"] >= 0.01) & (crumpled["anchor"] <= 0.02)).all()
        assert np.abs(v[0]).max() <= 0.1
        assert np.abs(v[1]).max() <= 1.0
        assert crumpled["gravity"] == MOON
    firsts = [crumpled_string(np.random.default_rng(seed)) for seed in range(30)]
    ways = {tuple(np.sign(x[0] - string["anchor"]).tolist()) for x, _, string in firsts}
    assert ways == {(a, b) for a in (1, -1) for b in (1, -1)}
    assert {float(np.sign(x[1, 0] - x[0, 0])) for x, _, _ in firsts} == {1.0, -1.0}
    assert max(np.abs(v[1]).max() for _, v, _ in firsts) > 0.9


@pytest.mark.parametrize("hidden", [False, True])
def test_strings_are_stepped_a_dozen_times_and_others_once(hidden: bool) -> None:
    """Every third of them on the Moon; with a dt of their own, and in the end strings and a dt out of the ordinary."""
    questions = asked("whole_state", hidden)
    counts = [1, 2, 6, 4] if hidden else [5, 4, 3, 1]
    few, others = questions[: len(counts)], questions[len(counts) :]
    assert [len(q.arguments[0]) for q in questions] == [*counts, 6, 2, 3]
    assert [q.about for q in few] == [f"string of {n} mass" + ("es" if n > 1 else "") for n in counts]
    assert [q.about for q in others] == ["string flung about", "crumpled string", "string of 3 masses, a long dt"]
    assert [q.steps for q in questions] == [12] * len(counts) + [1, 1, 2]
    assert [q.arguments[3]["gravity"] for q in questions] == [EARTH, EARTH, MOON, EARTH, EARTH, MOON, EARTH]
    assert all(0.5 * DT <= q.arguments[2] <= DT for q in few)
    for question, dt in zip(others, (DT, DT / 4, 0.02), strict=True):
        assert question.arguments[2] == pytest.approx(dt, rel=0.1)
        assert question.arguments[2] != dt
    assert {(q.function, q.parts, q.units) for q in questions} == {("step", ("x", "v"), ("m", "m/s"))}
    for question in questions:
        assert_of_a_string(question)
    steps = [q.arguments[2] / DT for seed in range(30) for q in asked("whole_state", hidden, seed)[:4]]
    assert (min(steps) < 0.55, max(steps) > 0.95) == (True, True)


def assert_of_a_string(question: Question) -> None:
    """Positions come first: they hang together by springs of a few rest lengths; masses move by themselves."""
    x, v, string = question.arguments[0], question.arguments[1], question.arguments[-1]
    rest = string["rest_lengths"]
    lengths = np.linalg.norm(np.diff(x, axis=0, prepend=string["anchor"][None]), axis=1)
    assert (lengths < 5 * rest).all()
    crumpled = question.about == "crumpled string"
    assert (lengths[crumpled:] > 0.2 * rest[crumpled:]).all()
    assert np.abs(v).max() <= (120 if question.about == "string flung about" else 1.0)
    if len(x) > 2:
        assert not (np.linalg.norm(np.diff(v, axis=0, prepend=string["anchor"][None]), axis=1) < 5 * rest).all()


@pytest.mark.parametrize("hidden", [False, True])
def test_forces_are_asked_of_the_same_strings(hidden: bool) -> None:
    """One call each."""
    questions = asked("forces", hidden)
    counts = [1, 2, 6, 4] if hidden else [5, 4, 3, 1]
    assert [len(q.arguments[0]) for q in questions] == [*counts, 6, 2]
    assert [q.arguments[2]["gravity"] for q in questions] == [EARTH, EARTH, MOON, EARTH, EARTH, MOON]
    assert {(q.function, q.parts, q.units, q.steps) for q in questions} == {("forces", ("the force",), ("N",), 0)}
    assert [q.about for q in questions[-2:]] == ["string flung about", "crumpled string"]
    for question in questions:
        assert_of_a_string(question)


@pytest.mark.parametrize("name", ["euler", "heun"])
@pytest.mark.parametrize("hidden", [False, True])
def test_springs_are_stretched_and_pressed_by_turns(name: str, hidden: bool) -> None:
    """One stretched, its mass on its way up; the next pressed, on its way down; the third is on the Moon."""
    for seed in range(20):
        questions = asked(name, hidden, seed)
        few = questions[:-4]
        assert [q.about for q in few] == [f"spring {i + 1}" for i in range(5 if hidden else 3)]
        assert {(q.function, q.parts, q.units) for q in questions} == {("step", ("y", "v"), ("m", "m/s"))}
        assert [q.steps for q in questions] == [20] * len(few) + [1] * 4
        for i, question in enumerate(few):
            y, v, dt, spring = question.arguments
            share = -y / spring["rest_length"]
            assert (1.1 <= share <= 1.4) if i % 2 == 0 else (0.6 <= share <= 0.9)
            assert (0.3 <= v <= 1.0) if i % 2 == 0 else (-1.0 <= v <= -0.3)
            assert 0.5 * DT <= dt <= DT
            assert spring["gravity"] == (MOON if i == 2 else EARTH)
            assert bool(spring["damping"]) == (i != 4)
            assert_of_a_spring(spring)


def assert_of_a_spring(spring: Mapping[str, Any], stiffer: float = 1.0) -> None:
    """Its numbers are those of one of some tens of grams."""
    assert 0.02 <= spring["mass"] <= 0.06
    assert 40 <= spring["stiffness"] / stiffer <= 80
    assert 0.1 <= spring["rest_length"] <= 0.2
    assert spring["damping"] == 0.0 or 0.02 <= spring["damping"] <= 0.05


def test_springs_are_far_out_as_their_words_say() -> None:
    """By length, stiffness, speed and dt, to a twentieth; the first and third on Earth, one without damping."""
    wanted = {
        "spring of four times its length": (4.0, 1.0, 3.0, DT),
        "spring pressed to a fifth": (1 / 5, 1.0, -30.0, DT),
        "stiff spring": (1.2, 5.0, -12.0, DT),
        "spring with a long dt": (1.1, 1.0, -0.5, 0.03),
    }
    for seed in range(20):
        questions = asked("euler", False, seed)[-4:]
        assert [q.about for q in questions] == list(wanted)
        assert [q.arguments[3]["gravity"] for q in questions] == [EARTH, MOON, EARTH, MOON]
        assert [bool(q.arguments[3]["damping"]) for q in questions] == [True, True, False, True]
        for question in questions:
            (y, v, dt, spring), (share, stiffer, speed, took) = question.arguments, wanted[question.about]
            assert (-y / spring["rest_length"] / share, v / speed, dt / took) == pytest.approx((1, 1, 1), abs=0.05)
            assert_of_a_spring(spring, stiffer)


def test_numbers_far_out_are_drawn_each_by_itself() -> None:
    """How long the spring is, how fast its mass, and dt: none follows from another."""
    drawn = []
    for seed in range(30):
        y, v, dt, spring = asked("euler", False, seed)[-4].arguments
        drawn.append((-y / spring["rest_length"], v, dt))
    assert np.abs(np.corrcoef(np.array(drawn).T) - np.eye(3)).max() < 0.6


def test_numbers_fill_their_ranges() -> None:
    """Of many springs some are near either end."""
    springs = [q.arguments for seed in range(60) for q in asked("euler", True, seed)[:-4]]
    for name, low, high in (("mass", 0.02, 0.06), ("stiffness", 40, 80), ("rest_length", 0.1, 0.2)):
        values = [spring[name] for *_, spring in springs]
        assert min(values) < low + 0.1 * (high - low)
        assert max(values) > high - 0.1 * (high - low)
    damping = [spring["damping"] for *_, spring in springs if spring["damping"]]
    assert (min(damping) < 0.023, max(damping) > 0.047) == (True, True)
    speeds = [abs(v) for _, v, *_ in springs]
    assert (min(speeds) < 0.37, max(speeds) > 0.93) == (True, True)


def test_a_factor_of_a_mistake_is_a_sign_a_half_or_a_unit() -> None:
    """Nobody errs by ten: mistakes take a number off, turn it about, halve it, or take it in another unit."""
    for exercise in exercises().values():
        for mistake in exercise.mistakes:
            for name, value in mistake.parameters.items():
                if isinstance(value, tuple):
                    value = [number for number in value if isinstance(number, float)]
                    assert set(value) <= {0.5, 1.0}, (mistake.name, name)
                elif isinstance(value, float):
                    assert value in (0.0, 0.5, 1.0, -1.0, 1000.0, 0.001), (mistake.name, name)
