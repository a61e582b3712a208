"""The page: the lab's definitions and the page's own scripts, style and words, in one file that asks for nothing."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from reference.errors import InputError, Unsupported
from report.browser.programs import script

if TYPE_CHECKING:
    from report.browser.presets import Preset

#: The page's own files, and those it shares with the report's page.
TEMPLATES = Path(__file__).parents[1] / "templates"

#: What computes, without looking at a page: this also runs in a worker, and in Node.
PHYSICS = ("memory.js", "stepping.js", "eigen.js", "rest.js", "contacts.js", "limits.js")

#: What shows it, in the order in which it is read.
SHOWN = ("lab.js", "view.js", "driven.js", "plots.js", "link.js", "lessons.js", "hands.js", "page.js")


def physics() -> str:
    """The text of all that computes."""
    return script() + "".join(_text(f"browser/{name}") for name in PHYSICS)


def lab_page(presets: Sequence[Preset]) -> str:
    """The whole file.

    Raises:
        InputError: for an unknown scene, one that makes no sense, or one with something the page cannot do.
    """
    import jinja2

    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(TEMPLATES), autoescape=False, undefined=jinja2.StrictUndefined
    )
    scenes = [_data(preset) for preset in presets]
    first = f"s={'string' if 'string' in {scene['name'] for scene in scenes} else scenes[0]['name']}&w=kick_drift"
    words = f"const WORDS = {_json(json.loads(_text('browser/words.json')))};\n"
    read = 'const DATA = JSON.parse(document.getElementById("data").textContent);\n'
    return environment.get_template("browser/lab.html.j2").render(
        style=_text("base.css") + _text("browser/lab.css"),
        data=_json({"scenes": scenes, "first": first}),
        physics=physics(),
        page=read + words + "".join(_text(f"browser/{name}") for name in SHOWN),
    )


def _data(preset: Preset) -> dict[str, Any]:
    try:
        return preset.data()
    except Unsupported as reason:
        raise InputError(f"scene {preset.scene!r}: {reason}") from None


def _text(name: str) -> str:
    return (TEMPLATES / name).read_text(encoding="utf-8")


def _json(value: Any) -> str:
    """JSON that ends no script."""
    return json.dumps(value, ensure_ascii=False, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")
