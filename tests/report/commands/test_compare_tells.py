"""`springlab compare` tells what it did: pushes, ties, reasons, the true duration, changes that come too late."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from engines.engine import registry, version
from tests.report.commands.terminal import springlab
from tests.report.commands.test_compare import IDENTIFIED, compared, of_the_engines, rows


@pytest.mark.rotating(3)
@pytest.mark.parametrize(("name", "scheme"), IDENTIFIED.items())
def test_engines_are_identified_where_nothing_moves(name: str, scheme: str) -> None:
    """Without weight the string rests by every scheme: engines are pushed, and no euler is among them."""
    if version(registry()[name]) is None:
        pytest.skip(f"{registry()[name].package} is not installed")
    run = rows(*of_the_engines("--set", "gravity=0", "--duration", "0.02"))[name]
    assert run["identified_as"] == scheme
    assert run["told_apart_by"].startswith("a push of its masses")


def test_ties_are_told_under_the_table() -> None:
    """As identify tells them: what is named first is not the only one; and in the JSON."""
    said = springlab("compare", "--stepper", "kick_drift", "--duration", "0.05")
    remark = " ".join(said.out.split())
    (run,) = rows("string", "--stepper", "kick_drift", "--duration", "0.05").values()
    assert {"kick_drift_implicit_drag", "kick_drift_implicit_damping"} <= set(run["ties"])
    assert all(re.search(rf"kick_drift: .*\b{tie}\b", remark) for tie in run["ties"])


def test_runs_that_diverged_alike_show_the_same() -> None:
    """No error, as one that goes on to the end and one that ends early are both no approximation; and the reason."""
    found = rows("string", "--dt", "0.03", "--duration", "3", "--stepper", "heun", "--stepper", "heun_link_by_link")
    assert {run["outcome"] for run in found.values()} == {"diverged"}
    assert {run["error_m"] for run in found.values()} == {None}
    assert all(run["reason"] for run in found.values())
    assert {name: run["identified_as"] for name, run in found.items()} == {name: name for name in found}


def test_the_duration_said_is_the_one_that_is_run() -> None:
    """60 steps of 16.7 ms are 1.002 s, where 1 s was asked for."""
    words = ("spring", "--dt", "0.0167", "--duration", "1", "--stepper", "heun")
    assert (
        "spring: dt = 0.0167 s, 1.002 s, which is 60 whole steps (1 s were asked for)"
        in springlab("compare", *words).out
    )
    document = compared(*words)
    assert (document["steps"], document["duration_s"]) == (60, 1.0)
    assert document["run_duration_s"] == pytest.approx(1.002)


def test_a_change_after_the_end_is_refused() -> None:
    """Steps begin at 0, 1, .., 9 ms: what changes after 9 ms would change nothing."""
    words = ("compare", "spring", "--stepper", "heun", "--dt", "1e-3", "--duration", "0.01", "--change")
    assert springlab(*words, "0.009:stiffness=10").code == 0
    for time in ("0.0091", "5"):
        said = springlab(*words, f"{time}:stiffness=10")
        assert said.code == 2
        assert said.err == (
            f"springlab: change of stiffness at {time} s: expected at most 0.009 s, when the last step begins\n"
        )


@pytest.mark.rotating(2)
def test_a_mass_alone_is_compared(tmp_path: Path) -> None:
    """It has no size; Heun is exact, and cannot be told from rk4 where nothing drags."""
    scene = tmp_path / "alone.toml"
    scene.write_text(
        "[system]\npositions = [[0.5, 1.0]]\nsprings = []\nmasses = 1.0\nstiffness = 1.0\nrest_lengths = 1.0\n"
    )
    (run,) = rows(str(scene), "--stepper", "heun").values()
    assert run["error_m"] < 1e-12
    assert run["identified_as"] == "heun"
    assert "rk4" in run["ties"]
