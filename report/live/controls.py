"""Everything on the page that can be moved or read, in folders; what is moved goes to the page, between two frames."""

from __future__ import annotations

from collections.abc import Callable, Coroutine
from contextlib import AbstractContextManager
from typing import TYPE_CHECKING, Any

from experiments.advice.advice import rounded_down
from report.live import scenes
from report.live.deferred_removal import Leaving
from report.live.events import heard
from report.live.lab import Lab
from report.live.number_slider import Dial
from report.live.parameters import GRAVITIES, PRESETS, sliders
from report.live.stepping import MOST_WORLDS, choices

if TYPE_CHECKING:
    from viser import ClientHandle

    from report.live.page import Page

#: In a menu of steppers: no world.
NOBODY = "-"

#: dt in the page is in milliseconds.
MS = 1e-3


class Controls:
    """The panel of one viewer.

    Args:
        client: the viewer.
        page: does what is asked.

    Attributes:
        leaving: parts that go.
    """

    def __init__(self, client: ClientHandle, page: Page) -> None:
        self._gui, self._client, self._page = client.gui, client, page
        self._dials: dict[str, Dial] = {}
        self._scene_parts: list[Any] = []
        self._suggested: float | None = None
        self.leaving = Leaving()
        client.gui.set_panel_label("springlab live")
        client.gui.main_panel.dock_right()
        client.gui.main_panel.set_width(380)
        self._banner = client.gui.add_html("", visible=False)
        self._again = client.gui.add_button("Start again", visible=False)
        self._again.on_click(self._heard(lambda _: self._start_again()))
        self._status = client.gui.add_html("")
        self._add_run()
        self._add_scene()
        self._parameters = client.gui.add_folder("Parameters")
        self._add_worlds()
        self._add_take_away()
        self._plots_panel = client.gui.add_panel()
        self._plots_tab = self._plots_panel.add_tab("Plots")
        self._plots_panel.dock_left()
        self._plots_panel.set_width(340)

    def room_for_plots(self) -> AbstractContextManager[Any]:
        """Where plots are to go."""
        return self._plots_tab

    def _heard(self, action: Callable[[Any], None]) -> Callable[[Any], Coroutine[Any, Any, None]]:
        return heard(self._page.do, action)

    # Made once.

    def _add_run(self) -> None:
        gui, page = self._gui, self._page
        with gui.add_folder("Run"):
            run = gui.add_button_group("", ("Play", "Pause", "Step", "Reset"))
            run.on_click(self._heard(self._run))
            self._back = gui.add_slider("back [s]", min=0.0, max=10.0, step=0.05, initial_value=0.0)
            self._back.on_update(self._heard(lambda seconds: page.lab.rewind(seconds)))
            Dial(self._client, "speed [s of the scene in 1 s]", 1.0, 0.01, 10.0, page.do, self._set_speed)
            most = gui.add_slider("steps a frame, at most", min=1, max=2000, step=1, initial_value=1000)
            most.on_update(self._heard(lambda steps: setattr(page.lab, "most_steps", int(steps))))

    def _add_scene(self) -> None:
        gui, page = self._gui, self._page
        with gui.add_folder("Scene") as self._scene_folder:
            names = page.scene_names()
            self._scene = gui.add_dropdown("scene", names, initial_value=page.lab.opened.name)
            self._scene.on_update(self._heard(page.open))
            self._barrier = gui.add_checkbox("barrier in the way", False)
            self._barrier.on_update(self._heard(lambda _: self._reopen()))
            slides = gui.add_button_group("as on slide", tuple(PRESETS))
            slides.on_click(self._heard(page.preset))

    def _add_worlds(self) -> None:
        gui, page = self._gui, self._page
        with gui.add_folder("Worlds"):
            self._worlds = []
            for i in range(MOST_WORLDS):
                options = choices() if i == 0 else [NOBODY, *choices()]
                menu = gui.add_dropdown(f"world {i + 1}", options, initial_value=options[0])
                menu.on_update(self._heard(lambda _: self._choose()))
                self._worlds.append(menu)
            beside = gui.add_checkbox("side by side", False)
            beside.on_update(self._heard(lambda on: setattr(page.stage, "beside", on)))
            true = gui.add_checkbox("true motion, grey", True)
            true.on_update(self._heard(lambda on: setattr(page.stage, "show_true", on)))
            gui.add_markdown("Drag a mass to pull at it, in all worlds; click it to pin it or let it go.")

    def _add_take_away(self) -> None:
        gui, page = self._gui, self._page
        with gui.add_folder("Take away"):
            gui.add_button("Copy command").on_click(self._heard(lambda _: self._command()))
            self._command_text = gui.add_html("", visible=False)
            gui.add_button("CSV of this run").on_click(self._heard(lambda _: page.csv()))
            gui.add_button("Picture").on_click(self._heard(lambda _: page.picture()))

    # Made anew with every scene.

    def renew(self, lab: Lab) -> None:
        """The scene's own parameters and dials."""
        for part in [*self._scene_parts, *(part for dial in self._dials.values() for part in dial.parts)]:
            self.leaving.hide(part)
        self._scene_parts, self._dials, self._counts = [], {}, {}
        self._scene.value = lab.opened.name
        self._barrier.value = bool(lab.own.obstacles)
        with self._scene_folder:
            for name, value in scenes.counts(lab.opened.name).items():
                self._counts[name] = self._keep(
                    self._gui.add_number(name, int(lab.opened.settings.get(name, value)), min=1, max=1000, step=1)
                )
            for name, words in scenes.words(lab.opened.name).items():
                self._counts[name] = self._keep(
                    self._gui.add_dropdown(name, words, initial_value=lab.opened.settings.get(name, words[0]))
                )
            for part in self._counts.values():
                part.on_update(self._heard(lambda _: self._reopen()))
        with self._parameters:
            self._add_dials(lab)
        for i, menu in enumerate(self._worlds):
            menu.value = lab.worlds[i].name if i < len(lab.worlds) else NOBODY

    def _keep(self, part: Any) -> Any:
        self._scene_parts.append(part)
        return part

    def _add_dials(self, lab: Lab) -> None:
        page = self._page
        dt = lab.dt / MS
        self._dials["dt"] = Dial(
            self._client, "dt [ms]", dt, dt / 100, dt * 100, page.do, lambda value: page.lab.set_dt(value * MS)
        )
        driven = lab.opened.driven
        if driven:
            self._keep(self._gui.add_markdown(f"The scene itself changes {' and '.join(sorted(driven))}."))
        for slider in (slider for slider in sliders(lab.opened.system) if slider.name not in driven):
            label = f"{slider.name.replace('_', ' ')} [{slider.unit or 'times its own'}]"

            def move(value: float, name: str = slider.name) -> None:
                page.lab.set_parameter(name, value)

            self._dials[slider.name] = Dial(
                self._client,
                label,
                lab.numbers.get(slider.name, slider.value),
                slider.low,
                slider.high,
                page.do,
                move,
                zero=slider.zero,
                linear=slider.name == "gravity" and bool(slider.unit),
            )
            if slider.name == "gravity" and slider.unit:
                places = self._keep(self._gui.add_button_group("as on", tuple(GRAVITIES)))
                places.on_click(self._heard(self._gravity))

    # Shown some times in a second.

    def show(self, lab: Lab, company: str) -> None:
        """Where everything is."""
        from report.live.page import banner

        limits = [(p.limit, name) for name, p in lab.predictions.items() if p.limit is not None]
        if "dt" in self._dials:
            self._dials["dt"].show(lab.dt / MS)
            self._dials["dt"].mark([(limit / MS, f"▲ {limit / MS:.3g}") for limit, _ in limits[:2]])
        self._status.content = banner(status(lab, company), "#0072b2")
        blown = bool(lab.notice)
        if blown:
            self._banner.content = banner(lab.notice, "#a32a00", "alert")
            if not self._banner.visible:  # above the part of the panel that is looked at, it would not be seen
                self._page.say(lab.notice)
        self._banner.visible = blown
        self._suggested = suggestion(lab)
        self._again.visible = self._suggested is not None
        if self._suggested is not None:
            self._again.label = f"Start again with dt = {self._suggested / MS:.3g} ms, a stable one"

    # What is asked for.

    def _run(self, what: str) -> None:
        lab = self._page.lab
        if what == "Play":
            self._back.value = 0.0
            lab.play()
        elif what == "Pause":
            lab.playing = False
        elif what == "Step":
            lab.playing = False
            lab.advance(1)
        else:
            lab.reset()

    def _set_speed(self, value: float) -> None:
        self._page.lab.speed = max(value, 1e-6)

    def _choose(self) -> None:
        names = [menu.value for menu in self._worlds if menu.value != NOBODY]
        self._page.lab.set_steppers(names)

    def _reopen(self) -> None:
        settings = {name: str(part.value) for name, part in self._counts.items()}
        own = {**scenes.counts(self._scene.value), **{n: w[0] for n, w in scenes.words(self._scene.value).items()}}
        changed = {name: value for name, value in settings.items() if value != str(own[name])}
        self._page.open(self._scene.value, changed, self._barrier.value)

    def _gravity(self, where: str) -> None:
        self._dials["gravity"].show(GRAVITIES[where])
        self._page.lab.set_parameter("gravity", GRAVITIES[where])

    def _start_again(self) -> None:
        if self._suggested is not None:
            self._page.start_again_with(self._suggested)

    def _command(self) -> None:
        from report.live.page import copyable

        lab = self._page.lab
        lab.playing = False
        found = lab.reproduction()
        for name, text in found.files.items():
            self._page.download(name, text.encode())
        note = f"{found.note} Files to be run beside: {', '.join(found.files)}." if found.files else found.note
        self._command_text.content = copyable("\n".join(found.commands), note)
        self._command_text.visible = True


def suggestion(lab: Lab) -> float | None:
    """A dt [s] that is stable for all worlds; None where nothing blew up, or a shorter step would not help."""
    blown = {world.name for world in lab.worlds if world.blown_up}
    limits = {name: p.limit for name, p in lab.predictions.items()}
    if not blown or any(limits.get(name) is None for name in blown):
        return None
    dt = rounded_down(0.9 * min(limit for limit in limits.values() if limit is not None))
    return dt if dt < lab.dt else None


def status(lab: Lab, company: str) -> str:
    """Time, limits and who is looking, in sentences."""
    said = [f"{lab.opened.stem}, t = {lab.time:.3f} s{'' if lab.playing else ', paused'}."]
    for name, prediction in lab.predictions.items():
        if prediction.limit is None:
            said.append(f"{name}: {prediction.reason}.")
        else:
            part = lab.dt / prediction.limit
            said.append(f"{name}: dt is {part:.2f} of the predicted largest stable dt, {prediction.limit / MS:.4g} ms.")
    if lab.grabbed is not None:
        said.append(f"Mass {lab.grabbed} hangs on the cursor.")
    if lab.why_no_truth:
        said.append(f"{lab.why_no_truth[0].upper()}{lab.why_no_truth[1:]}.")
    return " ".join([*said, company])
