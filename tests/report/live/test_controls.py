"""What can be moved on the panel does what it says, and shows what there is; without a browser."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from reference.errors import InputError
from report.live.controls import NO_LANE, Controls
from report.live.lab import Lab
from report.live.prediction import Prediction
from report.live.stepping import MOST_LANES, choices
from tests.report.live.labs import open_lab
from tests.report.live.panel import Panel


class Page:
    """A page whose panel is looked at: what it is asked for is noted."""

    def __init__(self, lab: Lab) -> None:
        self.lab, self.asked, self.said = lab, [], []  # type: ignore[var-annotated]
        self.stage = SimpleNamespace(beside=False, show_true=True, strain_shown=0.05)
        self.panel = Panel()
        self.controls = Controls(self.panel.client, self)  # type: ignore[arg-type]
        self.controls.renew(lab)

    def do(self, action: Any) -> None:
        """At once."""
        action()

    def scene_names(self) -> list[str]:
        """Some."""
        return ["string", "jello", "cloth", "bridge", "crossing"]

    def say(self, text: str) -> None:
        """Kept."""
        self.said.append(text)

    def __getattr__(self, name: str) -> Any:
        """What a page is asked for besides."""
        return lambda *values: self.asked.append((name, *values))

    def part(self, label: str) -> Any:
        """On the panel."""
        return self.panel.parts[label]

    def show(self) -> None:
        """What is shown some times in a second."""
        self.controls.show(self.lab, "You are alone.")


@pytest.fixture
def page(labs: list[Lab]) -> Page:
    """Of a string by kick-drift and Heun; what theory says of them is not waited for."""
    made = Page(open_lab(labs, "string", ["kick_drift", "heun"]))
    made.lab.wait_for_predictions()
    return made


def test_it_plays_and_pauses_steps_and_resets(page: Page) -> None:
    """A single step of each lane, paused; what the page sets itself is nobody's wish."""
    buttons, lab = page.part(""), page.lab
    assert buttons.values == (("Play", "Pause", "Step", "Reset"),)
    page.part("back [s]").value = 3.0
    buttons.move("Play")
    assert (lab.playing, page.part("back [s]").value) == (True, 0.0)
    buttons.move("Pause")
    assert not lab.playing
    lab.play()
    buttons.move("Step")
    assert (lab.playing, lab.timeline.time) == (False, pytest.approx(1e-3))
    buttons.move("Reset")
    assert lab.timeline.time == 0
    buttons.move("Step", by=None)
    assert lab.timeline.time == 0


def test_numbers_go_where_they_are_told(page: Page) -> None:
    """In their own units: dt in milliseconds; with what it starts at."""
    lab = page.lab
    assert page.part("dt [ms]").value == pytest.approx(1.0)
    dt = page.controls._number_sliders["dt"]
    assert (dt._low, dt._high) == pytest.approx((0.01, 100.0))
    page.part("dt [ms]").move(2.0)
    assert lab.timeline.dt == pytest.approx(2e-3)
    page.part("stiffness [N/m]").move(150.0)
    assert lab.timeline.system.stiffness.tolist() == [150.0] * 10
    lab.advance(50)
    page.part("back [s]").move(0.05)
    assert lab.timeline.time <= 0.05 + 1e-9
    with pytest.raises(InputError):
        page.part("mass [kg]").move(-1.0)
    assert page.part("mass [kg]").value == pytest.approx(0.02)


def test_gravity_is_that_of_where_one_is(page: Page) -> None:
    """Its slider goes along; nobody is elsewhere."""
    page.part("as on").move("Moon")
    assert page.lab.timeline.system.gravity.tolist() == [0, -1.62]
    assert page.part("gravity [m/s^2]").value == 1.62
    with pytest.raises(InputError, match="unknown place 'Mars'"):
        page.part("as on").move("Mars")


def test_menus_have_who_steps_each_lane(page: Page) -> None:
    """The first lane is always there; none may be chosen for the others, and a name that is not among the choices."""
    menus = [page.part(f"lane {i + 1}") for i in range(MOST_LANES)]
    assert [menu.value for menu in menus] == ["kick_drift", "heun", *[NO_LANE] * (MOST_LANES - 2)]
    assert (menus[0].values, menus[1].values) == ((choices(),), ([NO_LANE, *choices()],))
    menus[2].move("rk4")
    assert page.lab.timeline.steppers == ("kick_drift", "heun", "rk4")
    menus[1].move(NO_LANE)
    assert page.lab.timeline.steppers == ("kick_drift", "rk4")
    page.part("by name").value = " drift_kick_sequential_damping(rounds=3) "
    page.part("Add lane").move()
    assert page.lab.timeline.steppers[2] == "drift_kick_sequential_damping(rounds=3)"
    assert [menu.value for menu in menus] == [*page.lab.timeline.steppers, NO_LANE]
    assert "drift_kick_sequential_damping(rounds=3)" in menus[3].options
    assert NO_LANE not in menus[0].options


def test_boxes_are_ticked_for_the_stage_and_buttons_ask_the_page(page: Page) -> None:
    """Side by side, the true motion; a picture, a table, a scene, a picture of the lecture."""
    assert (page.part("side by side").value, page.part("true motion, grey").value) == (False, True)
    page.part("side by side").move(True)
    page.part("true motion, grey").move(False)
    assert (page.stage.beside, page.stage.show_true) == (True, False)
    page.part("Picture").move()
    page.part("CSV of this run").move()
    page.part("scene").move("cloth")
    page.part("as on slide").move("15")
    assert page.asked == [("picture",), ("csv",), ("open", "cloth"), ("preset", "15")]


def test_settings_of_a_scene_are_those_that_are_not_its_own(page: Page, labs: list[Lab]) -> None:
    """Counts and words; of another scene there are others, and those of before are hidden."""
    masses = page.part("masses")
    assert (masses.value, masses.min, page.part("barrier in the way").value) == (10, 1, False)
    masses.move(10)
    masses.move(12)
    page.part("barrier in the way").move(True)
    settings = {"masses": "12"}
    assert page.asked == [
        ("open", "string", {}, False),
        ("open", "string", settings, False),
        ("open", "string", settings, True),
    ]
    old = page.part("stiffness [N/m]")
    bridge = open_lab(labs, "bridge", panels="4")
    page.lab = bridge
    page.controls.renew(bridge)
    assert not masses.visible
    assert not old.visible
    assert page.part("panels").value == 4
    assert page.part("scene").value == "bridge"
    assert page.part("stiffness [times its own]").value == 1.0
    assert isinstance(page.part("kind").value, str)
    assert page.part("kind").value == page.part("kind").values[0][0]
    page.part("panels").move(5)
    page.part("kind").move(page.part("kind").values[0][-1])
    assert page.asked[3:] == [
        ("open", "bridge", {"panels": "5"}, False),
        ("open", "bridge", {"panels": "5", "kind": page.part("kind").value}, False),
    ]


def test_what_the_scene_changes_itself_has_no_slider(labs: list[Lab]) -> None:
    """And that is said."""
    page = Page(open_lab(labs, "crossing"))
    assert "The scene itself changes mass." in {part.content for part in page.panel.parts.values()}
    assert not [label for label in page.panel.parts if label.startswith("mass [")]
    assert [label for label in page.panel.parts if label.startswith("stiffness [")]


def test_the_limit_is_told_and_marked(page: Page, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of each lane that has one, on the slider of dt; who is looking, in the status."""
    marked: list[Any] = []
    monkeypatch.setattr("report.live.number_slider.set_marks", lambda slider, marks: marked.append(marks))
    page.show()
    limit = page.lab.predictions["kick_drift"].limit
    assert limit is not None
    assert [text for _, text in marked[-1] if "▲" in text] == [f"▲ {1e3 * limit:.3g}"]
    assert "kick_drift: dt is 0.10 of the predicted largest stable dt, 10.11 ms." in page.controls._status.content
    assert "string, t = 0.000 s, paused." in page.controls._status.content
    assert page.controls._status.content.count("You are alone.") == 1
    assert "5 %" in page.controls._legend.content
    page.lab.timeline.dt = 2e-3
    page.show()
    assert page.part("dt [ms]").value == pytest.approx(2.0)


def test_a_notice_is_seen_until_it_is_no_more_and_said_once(page: Page, monkeypatch: pytest.MonkeyPatch) -> None:
    """Red, above all; the panel may have been scrolled."""
    assert not page.controls._banner.visible
    for notice in ("euler blew up", "euler blew up", "", "again"):
        monkeypatch.setattr(type(page.lab), "notice", notice)
        page.show()
        assert page.controls._banner.visible == bool(notice)
        assert notice in page.controls._banner.content
        assert "alert" in page.controls._banner.content
    assert page.said == ["euler blew up", "again"]


def test_after_a_blow_up_a_stable_step_is_offered(page: Page, monkeypatch: pytest.MonkeyPatch) -> None:
    """A tenth below the smallest limit of all lanes; not where one that blew up has none, nor a longer one."""
    button = page.part("Start again")
    assert not button.visible
    assert not page.controls._command_text.visible
    page.show()
    assert not button.visible
    lab, lanes = page.lab, page.lab.timeline.lanes
    lanes[0].blown_up = True
    found = {"kick_drift": Prediction(0.01, "", 1.0, "kick_drift"), "heun": Prediction(0.004, "", 1.0, "heun")}
    monkeypatch.setattr(type(lab), "predictions", property(lambda self: found))
    lab.timeline.dt = 0.02
    page.show()
    assert (button.visible, button.label) == (True, "Start again with dt = 3.6 ms, a stable one")
    button.move()
    assert page.asked == [("start_again_with", pytest.approx(3.6e-3))]
    lab.timeline.dt = 3.6e-3
    page.show()
    assert not button.visible
    button.move()
    assert len(page.asked) == 1
    lab.timeline.dt = 0.02
    found["kick_drift"] = Prediction(None, "unstable at any dt", 1.0, "kick_drift")
    page.show()
    assert not button.visible
    found["kick_drift"], found["heun"] = Prediction(0.01, "", 1.0, "kick_drift"), found["kick_drift"]
    page.show()
    assert button.label == "Start again with dt = 9 ms, a stable one"


def test_the_command_is_there_to_be_copied(page: Page) -> None:
    """Paused; with its files where it needs any."""
    page.lab.play()
    page.lab.advance(3)
    page.part("Copy command").move()
    assert not page.lab.playing
    text = page.controls._command_text
    assert text.visible
    assert "springlab compare string" in text.content
    assert page.asked == []
    page.lab.set_dt(2e-3)
    page.lab.advance(3)
    page.part("Copy command").move()
    names = [name for what, name, content in page.asked if what == "download" and b"[system]" in content]
    assert len(names) == len(page.asked) > 0
    assert all(name.startswith("string-live") for name in names)
    assert f"Files to be run beside: {', '.join(names)}." in text.content
