"""Everything on the page that can be moved or read, in folders; what is moved goes to the page, between two frames."""

from __future__ import annotations

from collections.abc import Callable, Coroutine
from contextlib import AbstractContextManager
from typing import TYPE_CHECKING, Any

from reference.errors import unknown_name
from report.live import scenes
from report.live.deferred_removal import DeferredRemoval
from report.live.events import handler
from report.live.host import Host
from report.live.lab import Lab
from report.live.markup import banner, copyable, legend
from report.live.number_slider import NumberSlider
from report.live.parameters import GRAVITIES, PRESETS, Slider, sliders
from report.live.prediction import MS
from report.live.status import status, suggestion
from report.live.stepping import MOST_LANES, choices
from report.plain import shortened

if TYPE_CHECKING:
    from viser import ClientHandle

#: In a menu of steppers: no lane.
NO_LANE = "-"


class Controls:
    """The panel of one viewer.

    Args:
        client: the viewer.
        host: the page, which does what is asked.

    Attributes:
        removal: of parts that are no more.
    """

    def __init__(self, client: ClientHandle, host: Host) -> None:
        self._gui, self._client, self._host = client.gui, client, host
        self._number_sliders: dict[str, NumberSlider] = {}
        self._scene_parts: list[Any] = []
        self._scene_settings: dict[str, Any] = {}
        self._suggested: float | None = None
        self.removal = DeferredRemoval()
        client.gui.set_panel_label("springlab live")
        client.gui.main_panel.dock_right()
        client.gui.main_panel.set_width(380)
        self._banner = client.gui.add_html("", visible=False)
        self._again = client.gui.add_button("Start again", visible=False)
        self._again.on_click(self._on(lambda _: self._start_again()))
        self._status = client.gui.add_html("")
        self._add_run()
        self._add_scene()
        self._parameters = client.gui.add_folder("Parameters")
        self._add_lanes()
        self._add_take_away()
        self._plots_panel = client.gui.add_panel()
        self._plots_tab = self._plots_panel.add_tab("Plots")
        with self._plots_tab:
            self._legend = client.gui.add_html("", order=-1.0)
        self._plots_panel.dock_left()
        self._plots_panel.set_width(340)

    def room_for_plots(self) -> AbstractContextManager[Any]:
        """Where plots are to go."""
        return self._plots_tab

    def _on(self, action: Callable[[Any], None]) -> Callable[[Any], Coroutine[Any, Any, None]]:
        return handler(self._host.do, action)

    # Made once.

    def _add_run(self) -> None:
        gui, host = self._gui, self._host
        with gui.add_folder("Run"):
            gui.add_button_group("", ("Play", "Pause", "Step", "Reset")).on_click(self._on(self._run))
            self._back = gui.add_slider("back [s]", min=0.0, max=10.0, step=0.01, initial_value=0.0)
            self._back.on_update(self._on(self._rewind))
            NumberSlider(self._client, "speed [s of the scene in 1 s]", 1.0, 0.01, 10.0, host.do, self._set_speed)
            most = gui.add_slider("steps a frame, at most", min=1, max=2000, step=1, initial_value=1000)
            most.on_update(self._on(lambda steps: host.lab.set_most_steps(int(steps))))

    def _add_scene(self) -> None:
        gui, host = self._gui, self._host
        with gui.add_folder("Scene") as self._scene_folder:
            self._scene = gui.add_dropdown("scene", host.scene_names(), initial_value=host.lab.timeline.opened.name)
            self._scene.on_update(self._on(host.open))
            self._barrier = gui.add_checkbox("barrier in the way", False)
            self._barrier.on_update(self._on(lambda _: self._reopen()))
            gui.add_button_group("as on slide", tuple(PRESETS)).on_click(self._on(host.preset))

    def _add_lanes(self) -> None:
        gui, host = self._gui, self._host
        with gui.add_folder("Lanes"):
            self._menus = []
            for i in range(MOST_LANES):
                options = choices() if i == 0 else [NO_LANE, *choices()]
                menu = gui.add_dropdown(f"lane {i + 1}", options, initial_value=options[0])
                menu.on_update(self._on(lambda _: self._choose()))
                self._menus.append(menu)
            self._name = gui.add_text(
                "by name", "", hint="also with parameters: drift_kick_sequential_damping(rounds=3)"
            )
            gui.add_button("Add lane").on_click(self._on(lambda _: self._add_lane(self._name.value.strip())))
            beside = gui.add_checkbox("side by side", False)
            beside.on_update(self._on(lambda on: setattr(host.stage, "beside", on)))
            true = gui.add_checkbox("true motion, grey", True)
            true.on_update(self._on(lambda on: setattr(host.stage, "show_true", on)))
            gui.add_markdown("Drag a mass to pull at it, in all lanes; click it to pin it or let it go.")

    def _add_take_away(self) -> None:
        gui, host = self._gui, self._host
        with gui.add_folder("Take away"):
            gui.add_button("Copy command").on_click(self._on(lambda _: self._command()))
            self._command_text = gui.add_html("", visible=False)
            gui.add_button("CSV of this run").on_click(self._on(lambda _: host.csv()))
            gui.add_button("Picture").on_click(self._on(lambda _: host.picture()))

    # Made anew with every scene.

    def renew(self, lab: Lab) -> None:
        """The scene's own settings and number sliders, and who steps the lanes."""
        for part in [*self._scene_parts, *(p for slider in self._number_sliders.values() for p in slider.parts)]:
            self.removal.hide(part)
        self._scene_parts, self._number_sliders, self._scene_settings = [], {}, {}
        self._scene.value = lab.timeline.opened.name
        self._barrier.value = bool(lab.timeline.system.obstacles)
        with self._scene_folder:
            self._add_scene_settings(lab)
        with self._parameters:
            self._add_dt(lab)
            self._add_parameters(lab)
        self._show_lanes(lab)

    def _for_this_scene(self, part: Any) -> Any:
        self._scene_parts.append(part)
        return part

    def _add_scene_settings(self, lab: Lab) -> None:
        """The scene's parameters that are counts or words."""
        opened = lab.timeline.opened
        for name, count in scenes.counts(opened.name).items():
            set_to = int(opened.settings.get(name, count))
            self._scene_settings[name] = self._gui.add_number(name, set_to, min=1, max=1000, step=1)
        for name, words in scenes.words(opened.name).items():
            word = opened.settings.get(name, words[0])
            self._scene_settings[name] = self._gui.add_dropdown(name, words, initial_value=word)
        for part in self._scene_settings.values():
            self._for_this_scene(part).on_update(self._on(lambda _: self._reopen()))

    def _add_dt(self, lab: Lab) -> None:
        host, dt = self._host, lab.timeline.dt / MS
        self._number_sliders["dt"] = NumberSlider(
            self._client, "dt [ms]", dt, dt / 100, dt * 100, host.do, lambda value: host.lab.set_dt(value * MS)
        )

    def _add_parameters(self, lab: Lab) -> None:
        """A number slider for each parameter of the system that the scene does not change itself."""
        opened = lab.timeline.opened
        if opened.driven:
            names = " and ".join(sorted(opened.driven))
            self._for_this_scene(self._gui.add_markdown(f"The scene itself changes {names}."))
        for slider in sliders(opened.system):
            if slider.name not in opened.driven:
                self._add_parameter(slider, lab.numbers.get(slider.name, slider.value))

    def _add_parameter(self, slider: Slider, value: float) -> None:
        host, name = self._host, slider.name
        downwards = name == "gravity" and bool(slider.unit)
        self._number_sliders[name] = NumberSlider(
            self._client,
            f"{name.replace('_', ' ')} [{slider.unit or 'times its own'}]",
            value,
            slider.low,
            slider.high,
            host.do,
            lambda value: host.lab.set_parameter(name, value),
            zero=slider.zero,
            linear=downwards,
        )
        if downwards:
            places = self._for_this_scene(self._gui.add_button_group("as on", tuple(GRAVITIES)))
            places.on_click(self._on(self._set_gravity))

    def _show_lanes(self, lab: Lab) -> None:
        """Who steps each lane, in its menu; a stepper that was named otherwise is put into the menus."""
        names = lab.timeline.steppers
        known = choices()
        known += [name for name in dict.fromkeys(names) if name not in known]
        for i, menu in enumerate(self._menus):
            options = tuple(known if i == 0 else [NO_LANE, *known])
            if menu.options != options:
                menu.options = options
            menu.value = names[i] if i < len(names) else NO_LANE

    # Shown some times in a second.

    def show(self, lab: Lab, company: str) -> None:
        """Where everything is."""
        limits = [prediction.limit / MS for prediction in lab.predictions.values() if prediction.limit is not None]
        if "dt" in self._number_sliders:
            self._number_sliders["dt"].show(lab.timeline.dt / MS)
            self._number_sliders["dt"].mark([(limit, f"▲ {limit:.3g}") for limit in limits[:2]])
        self._status.content = banner(status(lab, company), "#0072b2")
        self._legend.content = legend(lab.timeline.steppers, self._host.stage.strain_shown)
        self._show_notice(lab.notice)
        self._suggested = suggestion(lab)
        self._again.visible = self._suggested is not None
        if self._suggested is not None:
            self._again.label = f"Start again with dt = {self._suggested / MS:.3g} ms, a stable one"

    def _show_notice(self, notice: str) -> None:
        if notice:
            self._banner.content = banner(notice, "#a32a00", "alert")
            if not self._banner.visible:  # above the part of the panel that is looked at, it would not be seen
                self._host.say(notice)
        self._banner.visible = bool(notice)

    # What is asked for.

    def _run(self, what: str) -> None:
        lab = self._host.lab
        if what == "Play":
            self._back.value = 0.0
            lab.play()
        elif what == "Pause":
            lab.playing = False
        elif what == "Step":
            lab.playing = False
            lab.advance(1)
        elif what == "Reset":
            lab.reset()

    def _rewind(self, seconds: float) -> None:
        """There may have been other lanes then."""
        self._host.lab.rewind(seconds)
        self._show_lanes(self._host.lab)

    def _set_speed(self, value: float) -> None:
        self._host.lab.set_speed(value)

    def _choose(self) -> None:
        self._host.lab.set_steppers([menu.value for menu in self._menus if menu.value != NO_LANE])

    def _add_lane(self, name: str) -> None:
        lab = self._host.lab
        lab.set_steppers([*lab.timeline.steppers, name])
        self._show_lanes(lab)

    def _reopen(self) -> None:
        """The scene with the settings there are on the panel; only those that are not its own are set."""
        # not the menu's, where another one may have been chosen that is still to be opened
        scene = self._host.lab.timeline.opened.name
        own = {**scenes.counts(scene), **{name: words[0] for name, words in scenes.words(scene).items()}}
        settings = {name: str(part.value) for name, part in self._scene_settings.items()}
        changed = {name: value for name, value in settings.items() if value != str(own[name])}
        self._host.open(scene, changed, self._barrier.value)

    def _set_gravity(self, where: str) -> None:
        if where not in GRAVITIES:
            raise unknown_name("place", shortened(where), GRAVITIES)
        self._number_sliders["gravity"].show(GRAVITIES[where])
        self._host.lab.set_parameter("gravity", GRAVITIES[where])

    def _start_again(self) -> None:
        if self._suggested is not None:
            self._host.start_again_with(self._suggested)

    def _command(self) -> None:
        lab = self._host.lab
        lab.playing = False
        found = lab.reproduction()
        for name, text in found.files.items():
            self._host.download(name, text.encode())
        note = f"{found.note} Files to be run beside: {', '.join(found.files)}." if found.files else found.note
        self._command_text.content = copyable("\n".join(found.commands), note)
        self._command_text.visible = True
