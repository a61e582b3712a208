"""What is said of a lab in sentences: limits, blow-ups, what hangs on the cursor."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from report.live import status as module
from report.live.lane import notice_of
from report.live.prediction import Prediction, percent
from report.live.status import status, suggestion


def lab(*predictions: Prediction, grabbed: int | None = None, why_not: str = "", playing: bool = True) -> Any:
    """One at 1.5 s, with a step of 2 ms."""
    timeline = SimpleNamespace(
        opened=SimpleNamespace(stem="string"),
        time=1.5,
        dt=2e-3,
        grabbed=grabbed,
        reference=SimpleNamespace(why_not=why_not),
    )
    return SimpleNamespace(timeline=timeline, playing=playing, predictions={p.scheme: p for p in predictions})


def test_time_limits_and_company_are_told() -> None:
    """A limit with the part of it that dt is; why there is none."""
    known, none = Prediction(8e-3, "", 1.0, "heun"), Prediction(None, "unstable at any dt", 1.1, "euler")
    assert status(lab(known, none), "You are alone.") == (
        "string, t = 1.500 s. heun: dt is 0.25 of the predicted largest stable dt, 8 ms. euler: unstable at any dt. "
        "You are alone."
    )


def test_what_else_there_is_to_say() -> None:
    """Paused; a mass on the cursor, the first one too; why the true motion is not followed."""
    said = status(lab(grabbed=0, why_not="it is too large", playing=False), "Hello.")
    assert said == "string, t = 1.500 s, paused. Mass 0 hangs on the cursor. It is too large. Hello."


def test_a_file_is_told_as_what_it_is(monkeypatch: pytest.MonkeyPatch) -> None:
    """Which it has been identified as; a scheme is told by its name, and a file that is none, too."""
    monkeypatch.setattr(module, "opened", lambda: {"mine.py": "mine.py", "own.py": "own.py"})
    heun, unknown = Prediction(8e-3, "", 1.0, "heun"), Prediction(None, "not identified", 1.0, "own.py")
    made = lab()
    made.predictions = {"mine.py": heun, "own.py": unknown, "heun": heun}
    said = status(made, "")
    assert "mine.py, identified as heun on a string: dt is 0.25" in said
    assert " own.py: not identified." in said
    assert said.count("identified as") == 1


def lane(blown_up: bool, dt: float = 2e-3) -> Any:
    """One that has stopped."""
    return SimpleNamespace(name="heun", stopped="it broke", blown_up=blown_up, dt=dt)


def test_a_lane_that_stopped_says_why_and_one_that_blew_up_what_theory_says() -> None:
    """Where it says something."""
    assert notice_of(lane(False), {}) == "heun stopped: it broke."
    assert notice_of(lane(True), {}) == "heun blew up: it broke."
    known = {"heun": Prediction(1e-3, "", 1.25, "heun", 2000.0)}
    assert notice_of(lane(False), known) == "heun stopped: it broke."
    assert notice_of(lane(True), known) == (
        "heun blew up: it broke. dt = 2 ms is 2 times the predicted largest stable dt, 1 ms. dt times omega is 4, "
        "over 2. The fastest mode grows 25 % a step."
    )


@pytest.mark.parametrize(
    ("prediction", "says"),
    [
        (
            Prediction(2e-3, "", 1.5, "heun"),
            "is 1 times the predicted largest stable dt, 2 ms. That limit is for small",
        ),
        (
            Prediction(4e-3, "", 1.5, "heun"),
            "is 0.5 times the predicted largest stable dt, 4 ms. That limit is for small",
        ),
        (Prediction(1e-3, "", np.nan, "heun"), "2 times the predicted largest stable dt, 1 ms."),
        (Prediction(1e-3, "", 1.0, "heun"), "2 times the predicted largest stable dt, 1 ms."),
        (Prediction(None, "none", 1.5, "heun"), "no largest stable dt here: none. The fastest mode grows 50 % a step."),
        (Prediction(None, "none", 1.0, "heun"), "no largest stable dt here: none."),
    ],
)
def test_a_prediction_says_what_it_says_of_a_step(prediction: Prediction, says: str) -> None:
    """Of 2 ms; no growth that is none, or not known, and nothing of omega then."""
    said = prediction.of(2e-3)
    assert says in said
    assert "omega" not in said
    assert said.endswith(says) or "That limit is for small swings about the rest, and these are large." in said


@pytest.mark.parametrize(
    ("part", "said"),
    [(0.005, "0.5 %"), (0.99, "99 %"), (1.0, "2-fold"), (3.5, "4.5-fold"), (np.inf, "without bound")],
)
def test_growth_is_told_as_people_say_it(part: float, said: str) -> None:
    """From a doubling on as a factor."""
    assert percent(part) == said


@pytest.mark.parametrize(
    ("blown", "limits", "dt"),
    [
        ({"a"}, {"a": 1e-3, "b": 3e-3}, 9e-4),
        ({"b"}, {"a": 1e-3, "b": 3e-3}, 9e-4),
        ({"a", "b"}, {"a": 1e-3, "b": None}, None),
        ({"b"}, {"a": 1e-3, "b": None}, None),
        ({"a"}, {"a": 1e-3, "b": None}, 9e-4),
        ({"a", "c"}, {"a": 1e-3}, None),
        ({"a"}, {"a": 5e-3}, None),
        (set(), {"a": 1e-3}, None),
    ],
)
def test_after_a_blow_up_a_step_is_offered_that_is_stable_for_all(
    blown: set[str], limits: dict[str, float | None], dt: float | None
) -> None:
    """Nine tenths of the least limit; none where a lane that blew up has no limit, or a step of 2 ms is below it."""
    made = lab()
    made.timeline.lanes = [SimpleNamespace(name=name, blown_up=name in blown) for name in "abc"]
    made.predictions = {name: Prediction(limit, "", 1.0, name) for name, limit in limits.items()}
    assert suggestion(made) == (None if dt is None else pytest.approx(dt, rel=0.05, abs=0.0))
