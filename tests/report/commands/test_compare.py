"""`springlab compare`: the numbers and names the project promises, in the form it promises."""

from __future__ import annotations

import csv
import json
import math
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from engines.engine import registry, version
from engines.process.isolation import EngineStepper
from experiments.divergence import result_of
from experiments.runs.comparison import compare, too_slow
from experiments.runs.steppers import all_steppers, default_steppers
from reference.errors import InputError
from reference.lecture.listings import listings
from reference.scenes import Setup
from reference.scenes import find as find_scene
from reference.schemes.catalogue import find as find_scheme
from reference.schemes.catalogue import schemes
from reference.stepper import SchemeStepper
from tests.report.commands.terminal import springlab

#: [m], where the string is 1.25 m long.
WITHIN = 1e-12

#: Engines of every package that is installed by default, and the scheme each is identified with on the default string.
IDENTIFIED = {
    "pymunk_springs": "drift_kick",
    "mujoco_tendons": "kick_drift",
    "bullet_softbody": "kick_drift",
    "mujoco_tendons_rk4": "rk4",
    "mujoco_cable": "pendulum_kick_drift",
    "mujoco_cable_rk4": "pendulum_rk4",
}

RUN = {"stepper", "kind", "version", "outcome", "reason", "error_m", "identified_as", "identification_error_m"}
RUN |= {"ties", "told_apart_by", "compared_by", "why_not_identified"}


@cache
def compared(*words: str) -> dict[str, Any]:
    """The JSON that `springlab compare WORDS --json` prints."""
    said = springlab("compare", *words, "--json")
    assert said.code == 0, said.err
    document: dict[str, Any] = json.loads(said.out)
    return document


def rows(*words: str) -> dict[str, dict[str, Any]]:
    """The runs of a comparison by stepper."""
    return {run["stepper"]: run for run in compared(*words)["runs"]}


def installed(name: str) -> None:
    """Skip the test where an engine is not installed."""
    if version(registry()[name]) is None:
        pytest.skip(f"{registry()[name].package} is not installed")


def of_the_engines(*words: str) -> tuple[str, ...]:
    """The words that compare these engines alone, those that are installed."""
    names = [name for name in IDENTIFIED if version(registry()[name]) is not None]
    return ("string", *words, *(word for name in names for word in ("--stepper", name)))


@pytest.mark.rotating(3, in_turn=True)
def test_the_json_has_exactly_the_promised_form() -> None:
    """Keys, types and order; a number that is none is null, a reason is a text, and is there unless all went well."""
    document = compared("string")
    assert list(document) == ["scene", "dt_s", "duration_s", "steps", "run_duration_s", "runs"]
    assert (document["scene"], document["dt_s"], document["duration_s"]) == ("string", 1e-3, 0.5)
    assert [run["stepper"] for run in document["runs"]] == [stepper.name for stepper in default_steppers()]
    for run in document["runs"]:
        assert set(run) == RUN
        assert all(isinstance(run[key], str) for key in ("stepper", "kind", "outcome", "reason"))
        assert all(run[key] is None or isinstance(run[key], str) for key in ("version", "identified_as"))
        for key in ("error_m", "identification_error_m"):
            assert run[key] is None or (isinstance(run[key], float) and math.isfinite(run[key]) and run[key] >= 0)
        assert run["outcome"] in ("done", "diverged", "crashed", "timed out", "unsupported")
        assert bool(run["reason"]) == (run["outcome"] != "done")
        assert bool(run["why_not_identified"]) == (run["identified_as"] is None)


def test_the_scene_is_the_string_unless_another_is_named() -> None:
    """And without --json a table with the same runs is shown."""
    said = springlab("compare", "--stepper", "heun", "--stepper", "rk4", "--duration", "0.01")
    assert (said.code, said.err) == (0, "")
    assert "string: dt = 0.001 s, 0.01 s" in said.out
    assert all(name in said.out for name in ("heun", "rk4"))


@pytest.mark.rotating(3)
@pytest.mark.parametrize(("name", "scheme"), IDENTIFIED.items())
def test_every_engine_of_the_issue_is_identified_within_1e12(name: str, scheme: str) -> None:
    """On the default string: max |x_engine - x_scheme| <= 1e-12 m, of all masses over 500 steps."""
    installed(name)
    run = rows("string")[name]
    assert (run["outcome"], run["identified_as"]) == ("done", scheme)
    assert run["identification_error_m"] <= WITHIN


@pytest.mark.rotating(5)
@pytest.mark.parametrize(("name", "what"), [(n, w) for n in IDENTIFIED for w in ("damping=0.05", "damping=0.5")])
def test_every_engine_is_identified_with_damped_springs(name: str, what: str) -> None:
    """As it claims to be, within 1e-12 m; Bullet against its own solver, which stops early."""
    installed(name)
    run = rows(*of_the_engines("--set", what))[name]
    assert (run["outcome"], run["identified_as"]) == ("done", registry()[name].identified_as["damping"])
    assert run["identification_error_m"] <= WITHIN


@pytest.mark.parametrize("name", IDENTIFIED)
def test_every_engine_is_identified_with_drag(name: str) -> None:
    """As it claims to be, within 1e-12 m."""
    installed(name)
    run = rows(*of_the_engines("--set", "drag=0.02"))[name]
    assert (run["outcome"], run["identified_as"]) == ("done", registry()[name].identified_as["drag"])
    assert run["identification_error_m"] <= WITHIN


@pytest.mark.parametrize("name", listings())
def test_the_lectures_listings_are_heun(name: str) -> None:
    """The one headed incorrect too, with deviation exactly 0: it does slide 7's arithmetic in slide 7's order.

    The loops and the catalogue's Heun do the same sums and products; whole arrays may add in another order.
    """
    run = rows("string")[name]
    assert run["identified_as"] == "heun"
    assert run["identification_error_m"] <= WITHIN


def test_the_listing_headed_incorrect_is_heun_exactly() -> None:
    """Deviation 0, not merely small."""
    run = rows("string")["lecture_heun_incorrect"]
    assert (run["identified_as"], run["identification_error_m"]) == ("heun", 0.0)


def test_a_wrong_variant_is_never_taken_for_a_correct_scheme() -> None:
    """On the default string, and with drag, where slide 7's algorithm stands."""
    wrong = [name for name, scheme in schemes().items() if scheme.kind == "in_place"]
    assert len(wrong) == 3
    with_drag = rows(
        "string", "--set", "drag=0.02", "--duration", "0.1", *(word for name in wrong for word in ("--stepper", name))
    )
    for run in [*(rows("string")[name] for name in wrong), *with_drag.values()]:
        assert run["identified_as"] == run["stepper"]


def test_every_correct_scheme_is_identified_as_itself() -> None:
    """With strong damping, and drag, no two schemes are alike, and every one is named, with deviation 0."""
    names = [name for name, scheme in schemes().items() if scheme.kind != "in_place"]
    words = [word for name in names for word in ("--stepper", name)]
    found = rows(
        "string", "--set", "damping=0.5", "--set", "drag=0.02", "--set", "mass=0.002", "--duration", "0.1", *words
    )
    assert {name: run["identified_as"] for name, run in found.items()} == {name: name for name in names}
    assert all(run["identification_error_m"] == 0 for run in found.values())


def test_the_error_is_the_distance_from_the_true_motion() -> None:
    """First-order schemes are furthest, the fourth-order one nearest, by orders of magnitude (dt = 1e-3 s, w dt = 0.1).

    The global error of a method of order p goes as (w dt)^p: about 1e-2, 1e-4 and 1e-8 of the amplitude.
    """
    found = rows("string")
    assert found["rk4"]["error_m"] < 1e-3 * found["heun"]["error_m"] < 1e-4 * found["euler"]["error_m"]


@pytest.mark.rotating(3, in_turn=True)
def test_a_change_on_the_fly_is_made_in_every_run() -> None:
    """With stiffness, gravity and drag changed midway, engines still are their schemes; the cable says it cannot."""
    words = ("--change", "0.02:gravity=1.62", "--change", "0.03:drag=0.05", "--change", "0.04:stiffness=150")
    found = rows(*of_the_engines(*words, "--duration", "0.1"))
    plain = rows(*of_the_engines("--duration", "0.1"))
    assert found
    for name, run in found.items():
        if run["outcome"] == "unsupported":
            assert "stiffness" in run["reason"]
            continue
        assert run["identified_as"] == registry()[name].identified_as["drag"]
        assert run["identification_error_m"] <= WITHIN
        assert run["error_m"] != plain[name]["error_m"]


SCENE = """
scene = "string"
dt = 5e-4
duration = 0.05

[parameters]
masses = 4
mass = [0.01, 0.02, 0.03, 0.02]

[[changes]]
time = 0.02
parameter = "gravity"
value = 1.62
"""

SYSTEM = """
duration = 0.02

[system]
positions = [[0.0, 0.0], [0.1, 0.0], [0.2, 0.0], [0.1, -0.1]]
springs = [[0, 1], [1, 2], [1, 3], [2, 3]]
masses = [1.0, 0.02, 0.02, 0.01]
stiffness = 100.0
fixed = [0]
"""


def test_a_scene_file_is_a_scene(tmp_path: Path) -> None:
    """Its name is the file's; its dt, duration, parameters and changes are used; options go before it."""
    file = tmp_path / "short.toml"
    file.write_text(SCENE)
    document = compared(str(file), "--stepper", "heun")
    assert (document["scene"], document["dt_s"], document["duration_s"]) == ("short", 5e-4, 0.05)
    same = compared(
        *("string", "--dt", "5e-4", "--duration", "0.05", "--set", "masses=4", "--set", "mass=0.01,0.02,0.03,0.02"),
        *("--change", "0.02:gravity=1.62", "--stepper", "heun"),
    )
    assert document["runs"] == same["runs"]
    assert compared(str(file), "--dt", "1e-3", "--stepper", "heun")["dt_s"] == 1e-3


def test_a_system_written_out_is_a_scene_and_is_refused_by_whom_it_is_too_much_for(tmp_path: Path) -> None:
    """A mesh: schemes and some engines step it, the lecture's listings and other engines say it is no string."""
    file = tmp_path / "mesh.toml"
    file.write_text(SYSTEM)
    found = rows(str(file))
    assert found["heun"]["identified_as"] == "heun"
    assert found["lecture_heun_loops"]["outcome"] == "unsupported"
    for name, engine in registry().items():
        if version(engine) is not None:
            can = {"mesh", "masses", "rest_lengths"} <= engine.capabilities
            assert found[name]["outcome"] == ("done" if can else "unsupported"), found[name]


def test_out_writes_the_tables_and_the_json(tmp_path: Path) -> None:
    """CSV of the runs and of their distances over time; the same JSON as on standard output."""
    folder = tmp_path / "new" / "folder"
    words = ("compare", "--stepper", "heun", "--stepper", "euler_in_place", "--duration", "0.01", "--json")
    said = springlab(*words, "--out", str(folder))
    assert said.code == 0
    assert json.loads((folder / "compare.json").read_text()) == json.loads(said.out)
    with (folder / "divergence.csv").open() as file:
        summary = list(csv.DictReader(file))
    assert [row["stepper"] for row in summary] == ["heun", "euler_in_place"]
    assert float(summary[0]["error [m]"]) == json.loads(said.out)["runs"][0]["error_m"]
    with (folder / "divergence_over_time.csv").open() as file:
        over_time = list(csv.DictReader(file))
    assert len(over_time) == 2 * 11
    assert all(str(file) in said.err for file in folder.iterdir())


def test_every_stepper_can_be_named() -> None:
    """The pendulum's schemes too, which are no part of the default comparison."""
    names = [stepper.name for stepper in all_steppers().values() if stepper.kind == "pendulum"]
    words = [word for name in names for word in ("--stepper", name)]
    found = rows("string", "--duration", "0.05", *words)
    assert {name: run["identified_as"] for name, run in found.items()} == {name: name for name in names}


def test_what_takes_long_is_left_out_unless_it_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    """On more masses than a stepper says, it has a row that says so; at as many it runs. Here it says a hundredth."""
    implicit = {"backward_euler": 2000, "implicit_midpoint": 2000}
    assert {name: find_scheme(name).interactive_up_to for name in implicit} == implicit
    most = property(lambda stepper: 20 if stepper.name in implicit else None)
    monkeypatch.setattr(SchemeStepper, "interactive_up_to", most)
    words = ("string", "--set", "masses=20", "--dt", "1e-5", "--duration", "1e-5")
    (asked,) = rows(*words, "--stepper", "backward_euler").values()
    assert asked["outcome"] == "done"
    steppers = [s for s in all_steppers().values() if s.name in ("heun", "backward_euler", "implicit_midpoint")]
    for masses, ending in ((19, "done"), (20, "unsupported")):
        setup = Setup("string", find_scene("string").system({"masses": masses}), 1e-5, 1e-5)
        runs = {run.stepper.name: run.outcome for run in compare(setup, steppers, patient=False).runs}
        assert runs["heun"].ending == "done"
        for name in ("backward_euler", "implicit_midpoint"):
            assert runs[name].ending == ending
    reason = f"left out: with more than 20 masses it takes long, here are 21; --stepper {name} runs it"
    assert runs[name].reason == reason


def test_engines_say_how_many_masses_are_too_many() -> None:
    """Those that solve for all masses at once; others take any number."""
    most = {s.name: s.interactive_up_to for s in all_steppers().values() if isinstance(s, EngineStepper)}
    assert {name for name, count in most.items() if count} == {
        *("mujoco_cable", "mujoco_cable_rk4", "mujoco_rope", "mujoco_tendons_implicit")
    }
    large = find_scene("cloth").system({"rows": 30, "columns": 30})
    assert too_slow(all_steppers()["mujoco_tendons_implicit"], large) is not None
    assert too_slow(all_steppers()["mujoco_rope"], large) is None


@pytest.mark.rotating(3, in_turn=True)
def test_after_a_run_has_ended_early_it_has_no_distance() -> None:
    """Heun with steps three times too long is no number before the end, as is the scheme it is: no distance then."""
    system = find_scene("string").system({})
    comparison = compare(Setup("string", system, 0.03, 6.0), [SchemeStepper(find_scheme("heun"))])
    (run,) = comparison.runs
    assert run.deviation is not None
    assert len(run.deviation) < len(comparison.times)
    rows = result_of(comparison).tables[1].rows
    assert len(rows) == len(comparison.times)
    assert rows[-1][3] is None


def test_what_would_fill_the_memory_is_refused_before_it_is_run(monkeypatch: pytest.MonkeyPatch) -> None:
    """One line with what was asked and what there is. With room for just what is kept, it runs."""
    asked = ("compare", "spring", "--stepper", "heun", "--duration", "0.1")
    needed = 2 * 101 * 2 * 2 * 2 * 8  # trajectories, states, arrays, masses, axes, bytes
    for free, code in ((needed - 1, 2), (needed, 0)):
        monkeypatch.setattr("psutil.virtual_memory", lambda free=free: SimpleNamespace(available=free))
        said = springlab(*asked)
        assert said.code == code, said.err
    monkeypatch.setattr("psutil.virtual_memory", lambda: SimpleNamespace(available=1000))
    assert springlab(*asked).err == (
        "springlab: 1 steppers, 2 masses and 100 steps take 1.2e-05 GiB of memory, where 9.31e-07 are free: "
        "expected fewer of them; see --stepper and --duration\n"
    )


def test_room_is_asked_for_those_that_are_run(monkeypatch: pytest.MonkeyPatch) -> None:
    """Those that take long are left out of it unless they are asked for, and the others are in it."""

    class Slow(SchemeStepper):
        """Takes long with more than one mass."""

        interactive_up_to = 1

    steppers = [SchemeStepper(find_scheme("heun")), Slow(find_scheme("rk4"))]
    setup = Setup("spring", find_scene("spring").system({}), 1e-3, 0.1)
    monkeypatch.setattr("psutil.virtual_memory", lambda: SimpleNamespace(available=1000))
    for patient, counted in ((False, 1), (True, 2)):
        with pytest.raises(InputError, match=f"^{counted} steppers, "):
            compare(setup, steppers, patient=patient)
