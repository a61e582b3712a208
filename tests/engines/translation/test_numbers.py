"""Numbers that are typed for a spring, and what numbers mean: by hand, of unequal masses; and what is no spring."""

from __future__ import annotations

import json
from dataclasses import replace
from math import pi, sqrt

import numpy as np
import pytest

from engines.translation.program import run, written, written_in_javascript
from engines.translation.translation import Settings, Spring, Stepping, find, translations
from reference.errors import InputError, Unsupported
from reference.system import MassSpringSystem

#: 0.5 kg and 2 kg swing against one another as 0.4 kg does, at 15/s with 90 N/m; 0.5 kg alone at sqrt(180)/s.
SPRING, STEPPING = Spring(90.0, 0.6, mass=0.5, other=2.0), Stepping(0.02)
ALONE = Spring(90.0, 0.6, mass=0.5)

TYPED = [
    *[(name, {"hertz": 15 / (2 * pi), "damping_ratio": 0.05}) for name in ("box2d", "box2d_2.3", "jolt_constraint")],
    *[
        (name, {"stiffness": 90.0, "damping": 0.6})
        for name in ("pymunk", "mujoco", "exudyn", "drake", "physx", "godot")
    ],
    *[(name, {"spring_ke": 90.0, "spring_kd": 0.6}) for name in ("newton_xpbd", "newton_vbd", "newton_semi_implicit")],
    ("rapier", {"stiffness": 90.0, "damping": 0.6}),
    ("bullet", {"springElasticStiffness": 90.0, "springDampingStiffness": 0.6}),
    ("mujoco_solref", {"solref_0": -225.0, "solref_1": -1.5}),
    # h k = 1.8 kg/s beside c = 0.6 kg/s
    ("bullet_constraint", {"erp": 0.75, "cfm": 1 / 2.4}),
    ("jolt", {"compliance": 1 / 90.0}),
    ("xpbd", {"compliance": 1 / 90.0, "damping": 0.6}),
]


def test_every_engine_is_in_the_table() -> None:
    """Each once."""
    assert sorted(name for name, _ in TYPED) == sorted(translations())


@pytest.mark.parametrize(("name", "typed"), TYPED)
def test_what_is_typed_by_hand(name: str, typed: Settings) -> None:
    """In the engine's own words."""
    assert find(name).settings(SPRING, STEPPING) == pytest.approx(typed, rel=1e-14)


@pytest.mark.parametrize(
    ("name", "typed", "k", "c"),
    [
        # r'' = -(2/T) r' - r/(T z)^2 with T = 0.1 s and z = 0.5: 0.4 kg at 400/s^2 and 20/s
        ("mujoco_solref", {"solref_0": 0.1, "solref_1": 0.5}, 160.0, 8.0),
        # T is 2 dt at least
        ("mujoco_solref", {"solref_0": 0.01, "solref_1": 0.5}, 0.4 * 2500, 0.4 * 50),
        ("mujoco_solref", {"solref_0": -100.0, "solref_1": -3.0}, 40.0, 1.2),
        ("mujoco_solref", {"solref_0": -100.0, "solref_1": 0.0}, 40.0, 0.0),
        ("bullet_constraint", {"erp": 0.2, "cfm": 0.1}, 0.2 / (0.02 * 0.1), 8.0),
        ("bullet_constraint", {"erp": 1.0, "cfm": 0.1}, 500.0, 0.0),
        ("bullet_constraint", {"erp": 0.0, "cfm": 0.1}, 0.0, 10.0),
        ("box2d", {"hertz": 2.0, "damping_ratio": 0.25}, 0.4 * (4 * pi) ** 2, 0.25 * 2 * 0.4 * 4 * pi),
        ("jolt", {"compliance": 0.02}, 50.0, 0.0),
    ],
)
def test_what_numbers_mean_by_hand(name: str, typed: Settings, k: float, c: float) -> None:
    """K [N/m] and c [N s/m] of the spring, on the masses it is given."""
    if k == 0:
        # no stiffness is no spring
        with pytest.raises(InputError, match="stiffness = 0"):
            find(name).meaning(typed, SPRING, STEPPING)
        return
    meant = find(name).meaning(typed, SPRING, STEPPING)
    assert (meant.stiffness, meant.damping) == pytest.approx((k, c), rel=1e-14)
    assert (meant.mass, meant.other) == (0.5, 2.0)


@pytest.mark.parametrize("typed", [(0.1, 0.0), (0.0, 0.5), (-1.0, 0.5), (0.1, -0.5)])
def test_numbers_of_both_forms_are_none(typed: tuple[float, float]) -> None:
    """MuJoCo takes its own in their place."""
    with pytest.raises(InputError, match=r"solref = .*expected a time constant and a damping ratio > 0, or minus"):
        find("mujoco_solref").meaning({"solref_0": typed[0], "solref_1": typed[1]}, SPRING, STEPPING)


@pytest.mark.parametrize("typed", [(-0.01, 1.0), (1.01, 1.0), (0.5, 0.0), (0.5, -1.0)])
def test_a_constraint_needs_some_softness(typed: tuple[float, float]) -> None:
    """And an error reduction from 0 to 1."""
    with pytest.raises(Unsupported, match="expected 0 <= erp <= 1 and cfm > 0"):
        find("bullet_constraint").meaning({"erp": typed[0], "cfm": typed[1]}, SPRING, STEPPING)


def test_an_oscillation_by_hand() -> None:
    """Of two masses and of one; its frequency and damping ratio make the spring again."""
    assert (SPRING.effective_mass, SPRING.omega, SPRING.damping_ratio) == pytest.approx((0.4, 15.0, 0.05), rel=1e-15)
    assert (ALONE.effective_mass, ALONE.omega) == pytest.approx((0.5, sqrt(180)), rel=1e-15)
    assert ALONE.hertz == pytest.approx(sqrt(180) / (2 * pi), rel=1e-15)
    again = Spring(1.0, 0.0, 0.5, 2.0).with_oscillation(15 / (2 * pi), 0.05)
    assert (again.stiffness, again.damping) == pytest.approx((90.0, 0.6), rel=1e-14)
    assert Spring(1.0, 0.0, 0.5).with_oscillation(0.5, 0.0).stiffness == pytest.approx(0.5 * pi**2, rel=1e-14)
    with pytest.raises(InputError, match="hertz = -1: expected a number >= 0"):
        SPRING.with_oscillation(-1.0, 0.0)


@pytest.mark.parametrize(
    ("numbers", "said"),
    [
        ((0.0, 0.0, 1.0), "stiffness = 0: expected a finite number > 0"),
        ((float("inf"), 0.0, 1.0), "stiffness = inf: expected a finite number > 0"),
        ((1.0, -0.1, 1.0), "damping = -0.1: expected a finite number >= 0"),
        ((1.0, 0.0, 0.0), "mass = 0: expected a finite number > 0"),
        ((1.0, 0.0, float("nan")), "mass = nan: expected a finite number > 0"),
        ((1.0, 0.0, 1.0, 0.0), "mass-b = 0: expected a finite number > 0"),
        ((1e100, 0.0, 1e-50), "stiffness = 1e+100, mass = 1e-50: expected k/m between 0 and 1e+150 1/s^2"),
        ((1e100, 0.0, 1.0, 1e-50), "stiffness = 1e+100, mass = 1: expected k/m between 0 and 1e+150 1/s^2"),
        ((0.6e100, 0.0, 1e-50, 1e-50), "stiffness = 6e+99, mass = 1e-50: expected k/m between 0 and 1e+150 1/s^2"),
        ((1e-300, 0.0, 1e300), "stiffness = 1e-300, mass = 1e+300: expected k/m between 0 and 1e+150 1/s^2"),
    ],
)
def test_numbers_that_are_no_spring(numbers: tuple[float, ...], said: str) -> None:
    """Each with its name; without damping there is one."""
    with pytest.raises(InputError) as refused:
        Spring(*numbers)
    assert str(refused.value) == said
    for spring in (Spring(0.6e100, 0.0, 1e-50), Spring(0.4e100, 0.0, 1e-50, 1e-50), Spring(1e-9, 0.0, 1.0)):
        assert spring.damping_ratio == 0


@pytest.mark.parametrize(
    ("fields", "said"),
    [
        ({"dt": 0.0}, "dt = 0: expected a finite number > 0 [s]"),
        ({"dt": float("inf")}, "dt = inf: expected a finite number > 0 [s]"),
        ({"dt": 1.0, "substeps": 0}, "substeps = 0: expected a whole number >= 1"),
        ({"dt": 1.0, "iterations": 0}, "iterations = 0: expected a whole number >= 1"),
    ],
)
def test_no_stepping(fields: dict[str, float], said: str) -> None:
    """One of each is enough."""
    with pytest.raises(InputError) as refused:
        Stepping(**fields)  # type: ignore[arg-type]
    assert str(refused.value) == said
    assert Stepping(1e-9, 1, 1).substeps == 1


def test_what_is_left_out_has_its_value_and_what_is_unknown_is_told() -> None:
    """Or is missing, where there is none to begin with; who has no sub-steps or iterations takes none."""
    jolt, pymunk = find("jolt"), find("pymunk")
    assert pymunk.typed({"stiffness": 3.0}) == {"stiffness": 3.0, "damping": 0.0}
    assert find("bullet").typed({"springElasticStiffness": 3.0})["springDampingStiffness"] == 0.1
    for engine in translations().values():
        damping = {key: value for key, value in engine.fields.items() if value is not None}
        assert set(damping.values()) <= {0.0, 1.0 if engine.name == "mujoco_solref" else 0.1}
    assert find("mujoco_solref").typed({"solref_0": 3.0}) == {"solref_0": 3.0, "solref_1": 1.0}
    for words, said in (({}, "pymunk: expected stiffness=NUMBER"), ({"stifness": 1.0}, "did you mean 'stiffness'")):
        with pytest.raises(InputError, match=said):
            pymunk.typed(words)
    jolt.check(Stepping(0.1, substeps=2))
    pymunk.check(Stepping(0.1, iterations=2))
    for engine, stepping, said in (
        (jolt, Stepping(0.1, iterations=2), "iterations = 2: jolt has none to set"),
        (pymunk, Stepping(0.1, substeps=3), "substeps = 3: pymunk has none to set"),
    ):
        with pytest.raises(InputError, match=said):
            engine.check(stepping)


@pytest.mark.parametrize(
    ("name", "as_it_is", "with_seven"),
    [
        ("pymunk", "drift_kick_sequential_damping(rounds=10)", "drift_kick_sequential_damping(rounds=7)"),
        ("jolt", "xpbd_gauss_seidel(substeps=5)", "xpbd_gauss_seidel(substeps=7)"),
        ("jolt_constraint", "soft_constraints_warm(sweeps=10)", "soft_constraints_warm(sweeps=7)"),
        ("box2d", "soft_constraints_relaxed(substeps=4)", "soft_constraints_relaxed(substeps=7)"),
        ("box2d_2.3", "soft_constraints_warm(sweeps=8)", "soft_constraints_warm(sweeps=7)"),
        ("rapier", "soft_constraints_cold(substeps=4, sweeps=1)", "soft_constraints_cold(substeps=7, sweeps=7)"),
        ("xpbd", "xpbd_gauss_seidel(substeps=1, sweeps=1)", "xpbd_gauss_seidel(substeps=7, sweeps=7)"),
        ("newton_xpbd", "xpbd_jacobi(iterations=2)", "xpbd_jacobi(iterations=7)"),
        ("newton_vbd", "vertex_block_descent(iterations=10)", "vertex_block_descent(iterations=7)"),
    ],
)
def test_sub_steps_and_iterations_stand_in_scheme_and_program(name: str, as_it_is: str, with_seven: str) -> None:
    """As many as the engine has by itself, or as are set: the program has them, too."""
    engine, seven = find(name), Stepping(0.02, substeps=7, iterations=7)
    assert (engine.scheme(Stepping(0.02)), engine.scheme(seven)) == (as_it_is, with_seven)
    if engine.package is not None:
        settings = [engine.settings(SPRING, STEPPING)]
        one, other = (engine.snippet(SYSTEM, stepping, 3, settings) for stepping in (Stepping(0.02), seven))
        assert one != other


SYSTEM = MassSpringSystem(
    positions=np.array([[0.0, 0.0], [1.5, 0.0]]),
    springs=np.array([[0, 1]]),
    masses=np.array([0.5, 2.0]),
    rest_lengths=np.array(1.0),
    stiffness=np.array(90.0),
    gravity=np.array([0.0, -3.0]),
    fixed=np.array([True, False]),
)


def test_a_system_is_written_out() -> None:
    """Three numbers to a position, and to gravity; what is fixed has no mass; in JavaScript the same."""
    numbers = {
        "gravity": [0.0, -3.0, 0.0],
        "positions": [[0.0, 0.0, 0.0], [1.5, 0.0, 0.0]],
        "masses": [None, 2.0],
        "springs": [[0, 1]],
        "rest_lengths": [1.0],
        "stiffness": [90.0],
    }
    names: dict[str, object] = {}
    exec(written(SYSTEM, 0.02, 7, [{"stiffness": 90.0}]), names)
    assert {name: names[name] for name in ("dt", "steps", *numbers)} == {"dt": 0.02, "steps": 7, **numbers}
    first, *lines = written_in_javascript(SYSTEM, 0.02, 7, [{"stiffness": 90.0}]).splitlines()
    assert first.startswith("const dt = 0.02, steps = 7;")
    assert {line.split()[1]: json.loads(line.partition(" = ")[2].rstrip(";")) for line in lines} == numbers


def test_the_program_of_xpbd_steps_as_its_scheme() -> None:
    """It needs no engine. One mass: v' = (v + h g - h w^2 x)/(1 + h c/m + h^2 w^2), in each of two sub-steps."""
    engine = find("xpbd")
    stepping = Stepping(0.02, substeps=2)
    typed = engine.settings(Spring(90.0, 0.6, mass=2.0), stepping)
    along = replace(SYSTEM, positions=np.array([[0.0, 0.0], [0.0, 1.5]]))
    found = run(engine.snippet(along, stepping, 2, [typed]))
    h, x, v, expected = 0.01, 0.5, 0.0, [0.5]
    for i in range(4):
        v = (v - 3.0 * h - h * 45.0 * x) / (1 + h * 0.3 + h * h * 45.0)
        x += h * v
        expected += [x] if i % 2 else []
    assert found == pytest.approx(expected, rel=1e-13)


#: The same with a second spring of another length, and a system of two masses that move.
TWO = replace(SYSTEM, springs=np.array([[0, 1], [0, 1]]), rest_lengths=np.array([1.0, 2.0]))
FREE = replace(SYSTEM, fixed=np.zeros(2, dtype=bool))


@pytest.mark.parametrize(
    ("name", "lines"),
    [
        (
            "jolt_constraint",
            ["spring.mMinDistance = spring.mMaxDistance = 1.0f;", "FrequencyAndDamping, 2.5f, 0.25f);"],
        ),
        (
            "godot",
            ["physics_ticks_per_second = 50\n", "rest_length = 1.0 ", "stiffness = 2.5\nspring.damping = 0.25\n"],
        ),
        (
            "bullet_constraint",
            ["CONSTRAINT_STOP_ERP, 2.5, i)", "CONSTRAINT_STOP_CFM, 0.25, i)", "contactStiffness=500.0"],
        ),
        ("bullet_constraint", ["contactDamping=-6.0)"]),
    ],
)
def test_calls_to_type_have_the_numbers_of_the_first_spring(name: str, lines: list[str]) -> None:
    """As they were typed, and for a contact of Bullet's k = erp/(h cfm) and c = (1 - erp)/cfm."""
    engine = find(name)
    first, second = (dict(zip(engine.fields, numbers, strict=True)) for numbers in ((2.5, 0.25), (7.0, 0.5)))
    alone = name == "bullet_constraint"
    program = engine.snippet(SYSTEM if alone else TWO, STEPPING, 3, [first] if alone else [first, second])
    assert [line for line in lines if line not in program] == []


def test_who_knows_one_spring_or_one_mass_refuses_more() -> None:
    """Bullet and MuJoCo's constraint have programs of one spring; all nodes of a soft body are as heavy."""
    bullet, solref, constraint = find("bullet"), find("mujoco_solref"), find("bullet_constraint")
    two = [bullet.settings(SPRING, STEPPING)] * 2
    for engine in (bullet, solref, constraint):
        with pytest.raises(Unsupported, match="has a snippet for a single spring only"):
            engine.snippet(TWO, STEPPING, 3, two)
    with pytest.raises(Unsupported, match="expected mass-b = mass"):
        bullet.snippet(FREE, STEPPING, 3, two[:1])
    for system in (SYSTEM, replace(FREE, masses=np.array([2.0, 2.0]))):
        assert "pybullet.loadSoftBody" in bullet.snippet(system, STEPPING, 3, two[:1])


def test_who_knows_the_plane_only_says_so() -> None:
    """Box2D, Pymunk and Godot."""
    flat = [name for name, engine in translations().items() if engine.dimensions == {2}]
    assert sorted(flat) == ["box2d", "box2d_2.3", "godot", "pymunk"]
    assert all(engine.dimensions in ({2}, {2, 3}) for engine in translations().values())
