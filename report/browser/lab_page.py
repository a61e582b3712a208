"""The page: the lab's definitions and the page's own scripts, style and words, in one file that asks for nothing."""

from __future__ import annotations

import json
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from reference.errors import InputError, Unsupported
from report.browser.engines import carried_engines, engine_script, refusals
from report.browser.programs import script

if TYPE_CHECKING:
    from report.browser.presets import Preset

#: The page's own files, and those it shares with the report's page.
TEMPLATES = Path(__file__).parents[1] / "templates"

#: What computes, without looking at a page: this also runs in a worker, and in Node.
PHYSICS = (
    "arrays.js",
    "memory.js",
    "motion.js",
    "solver.js",
    "stepping.js",
    "eigen.js",
    "rest.js",
    "contacts.js",
    "limits.js",
)

#: What shows it, in the order in which it is read.
SHOWN = ("engines.js", "lab.js", "view.js", "driven.js", "plots.js", "link.js", "lessons.js", "hands.js", "page.js")


@cache
def physics() -> str:
    """The text of all that computes."""
    return script() + "".join(_text(f"browser/{name}") for name in PHYSICS)


def lab_page(presets: Sequence[Preset], engines: Sequence[str] = ()) -> str:
    """The whole file.

    Args:
        engines: names of engines that it carries, to be stepped in it.

    Raises:
        InputError: for an unknown scene, one that makes no sense, or one with something the page cannot do; for an
            engine that it cannot carry, that is not installed, or that can run none of the scenes.
    """
    import jinja2

    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(TEMPLATES), autoescape=False, undefined=jinja2.StrictUndefined
    )
    carried = carried_engines(engines)
    scenes = [_data(preset, engines) for preset in presets]
    for name in engines:
        if all(scene["engines"][name] for scene in scenes):
            raise InputError(f"--with {name}: it can run none of the scenes; {scenes[0]['engines'][name]}")
    first = f"s={'string' if 'string' in {scene['name'] for scene in scenes} else scenes[0]['name']}&w=kick_drift"
    words = f"const WORDS = {_json(json.loads(_text('browser/words.json')))};\n"
    read = 'const DATA = JSON.parse(document.getElementById("data").textContent);\n'
    return environment.get_template("browser/lab.html.j2").render(
        style=_text("base.css") + _text("browser/lab.css"),
        data=_json({"scenes": scenes, "first": first, **({"carried": carried} if carried else {})}),
        allowed=" 'wasm-unsafe-eval'" if carried else "",
        physics=physics(),
        page=read + words + (engine_script() if carried else "") + "".join(_text(f"browser/{name}") for name in SHOWN),
    )


def _data(preset: Preset, engines: Sequence[str]) -> dict[str, Any]:
    try:
        return preset.data() | {"engines": refusals(engines, preset.setup.system)}
    except Unsupported as reason:
        raise InputError(f"scene {preset.scene!r}: {reason}") from None


def _text(name: str) -> str:
    return (TEMPLATES / name).read_text(encoding="utf-8")


def _json(value: Any) -> str:
    """JSON that ends no script."""
    return json.dumps(value, ensure_ascii=False, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")
