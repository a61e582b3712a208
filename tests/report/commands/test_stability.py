"""`springlab stability`: its rows, its maps, and bad words."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest

from experiments.limits import stability_map
from experiments.stability import CASES
from reference.files.setup import setup_for
from reference.scenes import scenes
from report.commands.stability import cases
from tests.report.commands.terminal import springlab


def test_json_rows_have_the_promised_keys(tmp_path: Path) -> None:
    """`springlab stability --json`."""
    done = springlab("stability", "string", "--stepper", "heun", "--set", "drag=0.1", "--json", "--out", str(tmp_path))
    assert done.code == 0
    (row,) = json.loads(done.out)
    keys = ["stepper", "damping", "drag", "predicted_dt_s", "measured_dt_s", "relative_difference", "outcome", "reason"]
    keys += ["predicted_certainty", "predicted_at_most_s", "predicted_stable_steps", "measured_stable_steps"]
    assert list(row) == [*keys, "windows_s"]
    files = [tmp_path / f"stability.{ending}" for ending in ("csv", "svg")]
    assert [file.read_text(encoding="utf-8")[:4] for file in files] == ["step", "<svg"]


@pytest.mark.rotating(2)
@pytest.mark.parametrize("scene", scenes())
def test_every_scene_takes_the_cases_it_is_shown_in(scene: str) -> None:
    """As it is first; drag or damping only where it has such a parameter, then with the number that is said."""
    made = cases(scene, {})
    assert made[0] == {}
    assert len(made) == sum(case.keys() <= scenes()[scene].parameters.keys() for case in CASES)
    for case in made[1:]:
        system = setup_for(scene, settings=case).system
        assert float(case.get("drag", system.drag)) == system.drag
        assert float(case.get("damping", system.damping[0])) in system.damping
    assert cases(scene, {"drag": "0.1"}) == [{}]


@pytest.mark.rotating(3, in_turn=True)
def test_a_scene_without_damping_has_its_limits(tmp_path: Path) -> None:
    """The strip has drag, and no damping that could be set: it is shown as it is, and with drag."""
    done = springlab("stability", "strip", "--stepper", "kick_drift", "--json", "--out", str(tmp_path))
    assert (done.code, done.err.count("springlab:")) == (0, 0)
    assert [row["drag"] for row in json.loads(done.out)] == [3e-4, 0.1]


def test_on_its_line_euler_has_the_limit_of_the_damped_oscillator(tmp_path: Path) -> None:
    """For Euler |1 + h lambda| < 1 with m lambda^2 + c lambda + k = 0 is h < c / k while lambda is complex: 2.5 ms.

    In the plane the same mass swings undamped, and Euler is unstable at any dt. Predicted to 1e-6, measured to 1e-4.
    """
    words = ("--set", "damping=0.5", "--stepper", "euler", "--json", "--out", str(tmp_path))
    (row,) = json.loads(springlab("stability", "oscillator", *words).out)
    assert row["predicted_dt_s"] == pytest.approx(0.5 / 200, rel=1e-6)
    assert row["measured_dt_s"] == pytest.approx(0.5 / 200, rel=1e-4)
    (row,) = json.loads(springlab("stability", "spring", *words).out)
    assert row["predicted_dt_s"] is None


def test_a_listing_is_a_row_that_says_why_not(tmp_path: Path) -> None:
    """The lecture's listings are neither schemes nor engines: unsupported, with the reason, and nothing breaks."""
    words = ("--stepper", "lecture_heun_loops", "--set", "drag=0.1", "--json", "--out", str(tmp_path))
    done = springlab("stability", "string", *words)
    assert done.code == 0
    (row,) = json.loads(done.out)
    assert row["outcome"] == "unsupported"
    assert "schemes and engines" in row["reason"]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--map", "dt", "dt"], "two different axes"),
        (["--map", "dt", "dampin"], "did you mean 'damping'"),
        (["--map", "dt", "drag", "--range", "drag=1"], "KEY=LOW:HIGH"),
        (["--map", "dt", "drag", "--range", "mass=1:2"], "one of the map's axes"),
        (["--stepper", "hein"], "did you mean 'heun'"),
    ],
)
def test_bad_words_are_one_line(words: list[str], said: str) -> None:
    """Exit code 2, and what was expected."""
    done = springlab("stability", "string", *words)
    assert done.code == 2
    assert said in done.err
    assert done.err.count("\n") == 1


@pytest.mark.parametrize("words", [("--dt", "nan"), ("--dt", "0.001"), ("--range", "dt=1e-3:4e-3")])
def test_what_only_a_map_has_is_refused_without_one(words: tuple[str, str]) -> None:
    """It was passed over, whatever it was."""
    done = springlab("stability", "oscillator", "--stepper", "kick_drift", *words)
    assert (done.code, done.err) == (2, f"springlab: {words[0]}: expected with --map X Y only\n")


def test_a_scene_that_is_all_held_has_no_limit(tmp_path: Path) -> None:
    """It ended with an error of a library's. Nothing moves, until something is released."""
    file = tmp_path / "held.toml"
    points = "positions = [[0.0, 0.0], [1.0, 0.0]]\nfixed = [0, 1]"
    file.write_text(f"[system]\n{points}\nsprings = [[0, 1]]\nmasses = 0.1\nstiffness = 50.0\n")
    words = ("--stepper", "kick_drift", "--stepper", "radau_iia", "--json", "--out", str(tmp_path))
    rows = json.loads(springlab("stability", str(file), *words).out)
    assert [row["reason"] for row in rows] == 2 * ["predicted and measured: nothing moves"]


@pytest.mark.rotating(5, in_turn=True)
def test_a_map_is_a_figure_and_a_table_of_growth(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A point for each pair of values, from one end of each range to the other: Pymunk's on 5 x 5 here."""
    assert stability_map.ENGINE == 16
    monkeypatch.setattr(stability_map, "ENGINE", 5)
    out = tmp_path / "made" / "for it"
    words = ("--stepper", "pymunk_springs", "--range", "dt=1e-3:4e-3", "--range", "damping=0:0.1")
    done = springlab("stability", "spring", "--map", "dt", "damping", *words, "--out", str(out))
    assert done.code == 0, done.err
    assert (out / "pymunk_springs-dt-damping.svg").read_text(encoding="utf-8").startswith("<svg")
    with (out / "pymunk_springs-dt-damping.csv").open(newline="", encoding="utf-8") as file:
        rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]
    assert len(rows) == 5 * 5
    assert (rows[0]["dt [s]"], rows[-1]["dt [s]"]) == (1e-3, 4e-3)
    assert (rows[0]["damping [N s/m]"], rows[-1]["damping [N s/m]"]) == (0.0, 0.1)
