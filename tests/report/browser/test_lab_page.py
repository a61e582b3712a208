"""The page in Chromium: from disk, at all widths, light and dark; what it shows, and what a link brings back."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from time import monotonic
from typing import Any

import numpy as np
import pytest

from report.browser.lab_page import lab_page
from report.browser.presets import PRESETS, Preset
from report.browser.programs import page_schemes
from report.browser.recordings import Recording
from report.browser.system_data import system_data
from tests.report.browser.node import DRIVER, doubles
from tests.report.browser.systems import random_system
from tests.report.browser.test_bits import FEW_STEPS, MOST_DT, NEAR, SOLVING, STEPS, of_reference, same_bits
from tests.report.chromium import VIEWS, Shown, chromium

#: Scenes that are quick to make, and the lessons'.
SHOWN = [
    preset
    for preset in PRESETS
    if preset.scene in ("oscillator", "cloth", "barrier", "jello", "crossing", "earthquake")
]
SHOWN.append(Preset("string", recordings=(Recording("mujoco_tendons"),)))

#: The most a page may weigh [bytes].
LARGEST = 3_000_000


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The page, on disk."""
    made = tmp_path_factory.mktemp("page") / "lab.html"
    made.write_text(lab_page(SHOWN), encoding="utf-8")
    return made


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """Chromium."""
    with chromium() as found:
        yield found


def opened(browser: Any, file: Path, state: str = "", view: tuple[int, str, str] = VIEWS[0]) -> Shown:
    """The page in a state, its limits computed."""
    shown = Shown(browser, file, view, state, calmly=True)
    until(shown.page, "lab.mode")
    return shown


def until(page: Any, statement: str) -> None:
    """Wait until it is true: the page's own policy forbids Playwright's way of asking for that, which is `eval`."""
    end = monotonic() + 300
    while not page.evaluate(statement):
        assert monotonic() < end, statement
        page.wait_for_timeout(50)


@pytest.mark.rotating(4)
@pytest.mark.parametrize("view", VIEWS[:4], ids=lambda view: "-".join(map(str, view)))
def test_it_is_shown_without_a_request_or_a_complaint(browser: Any, file: Path, view: tuple[int, str, str]) -> None:
    """And without a violation that axe-core knows, or a part that reaches out of the window."""
    shown = opened(browser, file, "lesson=3" if view[0] == 360 else "", view)
    assert file.stat().st_size < LARGEST
    assert shown.requests == []
    assert shown.violations() == []
    assert shown.sideways() == 0
    shown.page.evaluate("setPlaying(true)")
    until(shown.page, "lab.lanes[0].world.steps > 3")
    assert shown.complaints == []
    shown.page.close()


@pytest.mark.rotating(4, in_turn=True)
def test_one_lane_has_no_plot_of_distances(browser: Any, file: Path) -> None:
    """There is nothing it could be far from: with a second lane the plot is there."""
    for schemes, there in (("rk4", False), ("rk4,euler", True)):
        shown = opened(browser, file, f"s=oscillator&w={schemes}")
        shown.page.wait_for_selector("#energy")
        shown.page.wait_for_selector("#apart", state="visible" if there else "hidden")
        shown.page.close()


@pytest.mark.rotating(2, in_turn=True)
def test_chromium_ends_in_the_reference_s_bits(browser: Any, file: Path) -> None:
    """As Node does (`test_bits`): a few random systems by two schemes."""
    shown = opened(browser, file)
    for seed in range(3):
        system, dt = random_system(seed)
        for scheme in ("rk4", "heun_link_by_link"):
            question = {"system": system_data(system), "scheme": scheme, "dt": dt, "steps": STEPS}
            answer = shown.page.evaluate(RUN, question)
            rows = doubles(answer).reshape(STEPS, -1)
            expected = of_reference(system, scheme, dt)
            assert same_bits(rows[: len(expected)], expected), (seed, scheme)
    shown.page.close()


@pytest.mark.rotating(2, in_turn=True)
def test_chromium_solves_equations_as_the_reference_does(browser: Any, file: Path) -> None:
    """As Node does (`test_bits`), to the same bound: two random systems by all schemes that solve."""
    shown = opened(browser, file)
    for seed in (2, 3):
        system, dt = random_system(seed)
        for scheme in SOLVING:
            question = {"system": system_data(system), "scheme": scheme, "dt": min(dt, MOST_DT), "steps": FEW_STEPS}
            rows = doubles(shown.page.evaluate(RUN, question)).reshape(FEW_STEPS, -1)
            expected = of_reference(system, scheme, min(dt, MOST_DT), steps=FEW_STEPS)
            assert np.abs(rows - expected).max() < NEAR * np.abs(expected).max(), (seed, scheme)
    shown.page.close()


#: The driver's run, its bits as text without Node's buffers.
RUN = (
    "asked => {"
    + DRIVER.partition('if (asked.ask === "run") {')[2].partition("return bits(")[0]
    + "const bytes = new Uint8Array(Float64Array.from(rows).buffer);"
    + "return btoa(Array.from(bytes, byte => String.fromCharCode(byte)).join('')); }"
)


@pytest.mark.rotating(7, in_turn=True)
def test_a_link_brings_back_the_same_numbers_and_the_same_picture(browser: Any, file: Path) -> None:
    """What was set, changed on the way and stepped: opened anew, every position is the same to the bit."""
    state = "s=string&w=heun,heun_aliased&dt=0.002&at=0:stiffness:150,0.05:gravity:3.7,0.06:hold:4&n=80"
    places = "Array.from(lab.lanes[1].world.memory.F.slice(lab.lanes[1].world.memory.at.x, 40))"
    first = opened(browser, file, state)
    link, numbers = first.page.evaluate("stateText()"), first.page.evaluate(places)
    picture = first.page.evaluate("draw(), canvas.toDataURL()")
    second = opened(browser, file, link)
    assert second.page.evaluate(places) == numbers
    assert second.page.evaluate("draw(), canvas.toDataURL()") == picture
    assert second.page.evaluate("stateText()") == link
    assert "--change=0.05:gravity=3.7" in first.page.evaluate("commandText()")
    for shown in (first, second):
        shown.page.close()


@pytest.mark.rotating(4, in_turn=True)
def test_a_recorded_engine_lies_over_the_scheme_that_it_steps_by(browser: Any, file: Path) -> None:
    """MuJoCo's tendons step as kick-drift does, to rounding: lanes are apart by what the recording is off by."""
    shown = opened(browser, file, "s=string&w=kick_drift,recorded:mujoco_tendons&n=400")
    apart, error = shown.page.evaluate("[measured().apart[1], lab.lanes[1].recording.error]")
    assert 0 < apart <= error < 1e-4
    assert "mujoco_tendons" in shown.page.evaluate("commandText()")
    shown.page.close()


@pytest.mark.rotating(7, in_turn=True)
def test_past_the_limit_it_says_why_and_goes_back(browser: Any, file: Path) -> None:
    """By its buttons: dt to 1.02 times the limit, play, back to before, and a shorter dt that is stable."""
    shown = opened(browser, file, "s=string&w=kick_drift")
    page = shown.page
    page.get_by_role("button", name="1.02").click()
    page.evaluate("lab.speed = 4; setPlaying(true)")
    page.wait_for_selector("#said .banner")
    limit, dt = page.evaluate("[lab.limits.kick_drift.limit, lab.dt]")
    assert dt == pytest.approx(1.02 * limit)
    assert "2.04" in page.inner_text("#said")  # dt times omega, as 2 is the limit
    buttons = page.locator("#said button")
    buttons.nth(0).click()
    assert page.evaluate("lab.lanes[0].world.blownUp === null && lab.lanes[0].world.steps > 0")
    page.evaluate("setPlaying(true)")
    page.wait_for_selector("#said .banner")
    page.locator("#said button").nth(1).click()
    assert page.evaluate("lab.dt") < limit
    page.close()


@pytest.mark.rotating(4, in_turn=True)
def test_every_lane_that_blew_up_is_named(browser: Any, file: Path) -> None:
    """With how many times dt times omega it stands: Euler at any dt, kick-drift at twice its limit; rk4 goes on."""
    shown = opened(browser, file, "s=string&w=euler,rk4,kick_drift&dt=0.0105&speed=4")
    page = shown.page
    page.evaluate("for (let k = 0; k < 3000; k++) oneStep(); keepPast(); showState()")
    blown = page.evaluate("lab.lanes.filter(lane => lane.world.blownUp).map(lane => lane.scheme)")
    said = page.locator("#said .banner p").all_inner_texts()
    assert blown == ["euler", "kick_drift"]
    assert [text.split()[0] for text in said] == blown
    page.close()


@pytest.mark.rotating(7, in_turn=True)
@pytest.mark.parametrize("scene", ["crossing", "earthquake"])
def test_what_drives_a_scene_is_drawn_with_it(browser: Any, file: Path, scene: str) -> None:
    """A truck, and ground with an arrow: the picture is another without what `drawDriven` draws, as at no string."""
    different = "(() => { const all = (draw(), canvas.toDataURL()); const own = drawDriven; drawDriven = () => {};"
    different += "draw(); const without = canvas.toDataURL(); drawDriven = own; return all !== without; })()"
    for name, expected in ((scene, True), ("string", False)):
        shown = opened(browser, file, f"s={name}&w=kick_drift&n=300")
        assert shown.page.evaluate(different) == expected
        assert shown.complaints == []
        shown.page.close()


@pytest.mark.rotating(7, in_turn=True)
def test_every_lesson_s_task_can_be_done(browser: Any, file: Path) -> None:
    """Each is not done at its start, and is done by what its task says."""
    shown = opened(browser, file, "s=string")
    page = shown.page
    for k, deed in enumerate(DEEDS, 1):
        page.evaluate("k => openLesson(k)", k)
        until(page, "lab.limits.kick_drift || lab.limits.heun")
        assert not page.evaluate("checkLesson(), doneLessons.has(lab.lesson)"), k
        page.evaluate(f"(async () => {{ {deed} }})()")
        until(page, "checkLesson(), doneLessons.has(lab.lesson)")
    assert shown.complaints == []
    page.close()


#: What does the task of each lesson.
DEEDS = (
    "$('answer').value = '0.0628'",
    "for (let k = 0; k < 290; k++) oneStep(); keepPast();",
    "change('dt', lab.limits.kick_drift.limit * 0.995); await new Promise(go => setTimeout(go, 300)); checkLesson();"
    "change('dt', 0.011); for (let k = 0; k < 3000; k++) oneStep(); keepPast();",
    "change('damping', 3.1)",
    "togglePin(0); const {I, at} = lab.lanes[0].world.memory;"
    "const held = [...Array(at.n).keys()].filter(i => I[at.fixed + i]); held.slice(1).forEach(togglePin);"
    "for (let k = 0; k < 350; k++) { oneStep(); if (k % 50 === 0) checkLesson(); }",
    "change('stiffness', 160); $('answer').value = '0,5'",
)


@pytest.mark.rotating(7, in_turn=True)
@pytest.mark.parametrize("steps", [0, 8])
def test_the_third_lesson_takes_the_limit_before_it_is_computed_and_after_steps(
    browser: Any, file: Path, steps: int
) -> None:
    """By its fields: 10.1 ms is 0.9987 of the limit, 10.3 ms over it. Without the first it is not done."""
    shown = opened(browser, file, "lesson=3")
    page = shown.page
    limit = page.evaluate("lab.limits.kick_drift.limit")
    assert abs(0.0101 / limit - 1) < 0.01 < 0.0103 / limit - 1
    for fields, done in ((["10.3"], False), (["10.1", "10.3"], True)):
        page.click("#lesson-start")
        for text in fields:
            page.evaluate(f"for (let k = 0; k < {steps}; k++) oneStep();")
            page.fill("#dt", text)
            page.press("#dt", "Enter")
        page.evaluate("for (let k = 0; k < 3000; k++) oneStep(); keepPast(); showState();")
        until(page, "lab.limits.kick_drift")
        assert page.evaluate("lab.lanes[0].world.blownUp !== null")
        assert page.evaluate("checkLesson(), doneLessons.has(3)") == done
    page.close()


@pytest.mark.rotating(4, in_turn=True)
def test_junk_in_a_field_is_refused_and_the_field_keeps_what_it_had(browser: Any, file: Path) -> None:
    """With its name, what was typed, and what was expected; what is right afterwards ends the refusal."""
    shown = opened(browser, file, "s=string&w=kick_drift")
    page = shown.page
    texts = {"dt": ["-3", "0", "1e9", "abc", ""], "typed-mass": ["-1", "0", "x"], "typed-stiffness": ["-5", "1e13"]}
    for field, junk in texts.items():
        kept = page.input_value(f"#{field}")
        for text in junk:
            page.fill(f"#{field}", text)
            page.press(f"#{field}", "Enter")
            assert page.input_value(f"#{field}") == kept
            assert f" = {text}: " in page.inner_text("#refused")
        assert page.evaluate("lab.changes.length") == 0
    page.fill("#typed-stiffness", "0")
    page.press("#typed-stiffness", "Enter")
    assert page.evaluate("[lab.changes[0].value, $('refused').textContent]") == [0, ""]
    assert shown.complaints == []
    page.close()


@pytest.mark.rotating(4, in_turn=True)
def test_what_a_link_says_and_the_page_does_not_take_is_told(browser: Any, file: Path) -> None:
    """Each part as it stands there; all others are taken, and of a good link nothing is told."""
    shown = opened(browser, file, "s=string")
    page = shown.page
    wrong = ("s=nothing", "w=foo", "dt=-1", "at=0:foo:1", "at=0:mass:-1", "at=0:mass:1+2", "at=0:hold:99", "lesson=99")
    for part in (*wrong, "n=xyz", "lang=xx", "foo=1", "v=2"):
        link = part if part.startswith(("s=", "lesson=")) else f"s=string&{part}"
        page.evaluate("link => { location.hash = link; openHash(); }", link)
        assert page.evaluate("lab.refused.map(one => one.split(' ')[0])") == [part]
        assert part in page.inner_text("#not-taken")
    page.evaluate("location.hash = 'lesson=3&w=euler'; openHash();")
    assert page.evaluate("lab.refused") == ["w=euler"]  # a lesson has lanes of its own
    for link in (
        "s=string&w=rk4&at=0:mass:0.5,0.01:hold:3&n=2&speed=2&lang=en",
        "lesson=3",
        "controls",
        "v=1&s=string",
    ):
        page.evaluate("link => { location.hash = link; openHash(); }", link)
        assert page.evaluate("[lab.refused, $('not-taken').textContent]") == [[], ""], link
    page.close()


@pytest.mark.rotating(4, in_turn=True)
def test_a_link_without_a_scene_is_about_the_first_one(browser: Any, file: Path) -> None:
    """All else that it says is taken, and it is a whole state from then on."""
    shown = opened(browser, file, "w=rk4,euler&at=0:mass:0.5&n=3")
    page = shown.page
    assert page.evaluate("[lab.scene.name, lab.refused.length, lab.lanes[1].scheme]") == ["string", 0, "euler"]
    assert page.evaluate("stateText()").startswith("v=1&s=string&w=rk4,euler&dt=0.001&at=0:mass:0.5&n=3")
    page.evaluate("location.hash = 'dt=0.002'; openHash();")
    assert page.evaluate("[lab.dt, lab.lanes.length, lab.lanes[0].scheme]") == [0.002, 1, "kick_drift"]
    page.close()


@pytest.mark.rotating(4, in_turn=True)
def test_the_last_answer_to_a_lesson_counts(browser: Any, file: Path) -> None:
    """A period of 63 ms is right, twice that is not, whatever was answered before."""
    shown = opened(browser, file, "lesson=1")
    said = []
    for answer in ("0.0628", "0.1256", "", "0,0628"):
        shown.page.fill("#answer", answer)
        said.append(shown.page.inner_text("#lesson-state"))
    assert said == ["Done.", "Not yet.", "", "Done."]
    shown.page.close()


@pytest.mark.rotating(4, in_turn=True)
def test_positions_are_written_with_time_and_step_and_called_after_the_scene_and_dt(browser: Any, file: Path) -> None:
    """The file that the button hands over, of a string of 12 masses after 5 steps of 2 ms."""
    shown = opened(browser, file, "s=string&w=rk4&dt=0.002&n=5")
    with shown.page.expect_download() as handed:
        shown.page.click("#places")
    assert handed.value.suggested_filename == "springlab-string-dt-0.002-positions.csv"
    head, first, *_ = shown.page.evaluate("placesText()").splitlines()
    assert head == "stepper,time [s],step,mass,x [m],y [m],vx [m/s],vy [m/s]"
    assert first.startswith("rk4,0.01,5,0,")
    shown.page.close()


@pytest.mark.rotating(7, in_turn=True)
def test_each_lane_says_about_which_rest_its_prediction_is(browser: Any, file: Path) -> None:
    """As in `springlab stability`: euler leads masses into an obstacle in every second step only. No limit, no rest."""
    about, without = "about its rest on obstacles, where 4 masses press.", "of the scene without its obstacles."
    shown = opened(browser, file, "s=barrier&w=rk4,euler,kick_drift")
    lines = shown.page.locator("#limits .about").all_inner_texts()
    assert lines == [f"Of rk4, kick_drift the prediction is {about}", f"Of euler the prediction is {without}"]
    after = ("delete lab.limits.rk4", "lab.limits.euler = {limit: null}", "lab.limits = {}")
    told = [shown.page.evaluate(f"{statement}, aboutSaid()") for statement in after]
    assert told == [
        [f"Of euler the prediction is {without}", f"Of kick_drift the prediction is {about}"],
        [f"Of kick_drift the prediction is {about}"],
        [],
    ]
    shown.page.close()


@pytest.mark.rotating(4, in_turn=True)
def test_no_factor_below_one_is_given_as_the_reason_of_a_blow_up(browser: Any, file: Path) -> None:
    """On obstacles a limit may be below that of the fastest mode: then only dt and the limit are told.

    Of rk4 at z = dt omega the factor is |1 - z^2/2 + z^4/24 + i (z - z^3/6)|: 0.75 at 1.99, and 1.51 at 3;
    which is told; a little less by the scene's drag.
    """
    shown = opened(browser, file, "s=barrier&w=rk4")
    why = "([limit, z]) => { const {w2} = lab.mode, omega = Math.sqrt(w2); lab.limits = {rk4: {limit: limit / omega}};"
    why += "lab.lanes[0].world.dt = z / omega; return whyBlown(lab.lanes[0]); }"
    below, beyond = (shown.page.evaluate(why, pair) for pair in ((1.977, 1.989), (2.8, 3.0)))
    assert below.startswith("dt is 1.006 of the predicted largest stable dt")
    assert "multiplied" not in below
    assert "over 2.8: the fastest mode" in beyond
    assert 1.45 < float(beyond.partition("multiplied by ")[2].split()[0]) < 1.51
    assert all("number." not in text for text in shown.page.evaluate("[say('blew_position'), say('blew_velocity')]"))
    shown.page.close()


@pytest.mark.rotating(4, in_turn=True)
def test_links_and_commands_have_short_times_and_no_duration_of_nothing(browser: Any, file: Path) -> None:
    """A time that steps add up to with an error of rounding; at no steps there is no duration."""
    shown = opened(browser, file, "s=string&w=kick_drift&dt=0.002")
    page = shown.page
    assert "--duration" not in page.evaluate("commandText()")
    page.evaluate("lab.changes = [{time: 0.40399999999999997, parameter: 'mass', value: 0.5}]; oneStep();")
    assert "at=0.404:mass:0.5" in page.evaluate("stateText()")
    assert page.evaluate("commandText()").endswith("--duration=0.002 --change=0.404:mass=0.5")
    page.close()


@pytest.mark.rotating(4, in_turn=True)
def test_the_keyboard_does_what_a_pointer_does(browser: Any, file: Path) -> None:
    """Play, step, choose a mass, move it, hold it."""
    shown = opened(browser, file, "s=string&w=kick_drift")
    page = shown.page
    page.focus("#stage")
    for key in (".", ".", "n", "n", "n", "p", "ArrowRight"):
        page.keyboard.press(key)
    assert page.evaluate("[lab.lanes[0].world.steps, view.selected, lab.touched]") == [2, 2, True]
    assert page.evaluate("lab.lanes[0].world.memory.I[lab.lanes[0].world.memory.at.fixed + 2]") == 1
    page.keyboard.press("Space")
    assert page.evaluate("lab.playing")
    page.close()


def test_words_are_there_in_every_language() -> None:
    """The same keys, with the same blanks; and every scene's and scheme's text, which English has from these."""
    import json
    import re

    from report.browser.lab_page import TEMPLATES

    words = json.loads((TEMPLATES / "browser" / "words.json").read_text(encoding="utf-8"))
    english = words.pop("en")
    described = {f"scene_{preset.scene}" for preset in PRESETS} | {f"about_{name}" for name in page_schemes()}
    for language, own in words.items():
        assert own.keys() == english.keys() | described, language
        for key, text in own.items():
            if key in described:
                continue
            assert set(re.findall(r"{\w+}", text)) == set(re.findall(r"{\w+}", english[key])), (language, key)
