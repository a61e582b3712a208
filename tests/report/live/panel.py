"""The panel of a viewer without a browser: what there is on it by its label, to be looked at and moved."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any
from unittest.mock import MagicMock


class Part(SimpleNamespace):
    """One thing on the panel, with a value."""

    def on_update(self, told: Any) -> None:
        """Who is told of a new value."""
        self.told = told

    on_click = on_update

    def remove(self) -> None:
        """It is there no more."""

    def move(self, value: Any = None, by: str | None = "viewer") -> None:
        """As a viewer does, or, by None, as the page itself."""
        self.value = value
        asyncio.run(self.told(SimpleNamespace(client=by, target=self)))


class Panel:
    """In place of viser's gui: parts by their labels, the last one of each."""

    def __init__(self) -> None:
        self.parts: dict[str, Part] = {}
        self.client: Any = SimpleNamespace(gui=self)
        self.main_panel, self.set_panel_label = MagicMock(), MagicMock()

    def __getattr__(self, name: str) -> Callable[..., Any]:
        """add_button, add_slider and so on."""
        if not name.startswith("add_"):
            raise AttributeError(name)

        def add(label: str, *values: Any, initial_value: Any = None, visible: bool = True, **how: Any) -> Part:
            first = values[-1] if values else None
            value = first if initial_value is None else initial_value
            # what has a content of its own is known by its kind
            known = name.removeprefix("add_") if name in ("add_html", "add_markdown", "add_multi_slider") else label
            known = known if known not in self.parts or known == label else f"{known} {len(self.parts)}"
            options = tuple(first) if isinstance(first, list | tuple) else ()
            part = Part(
                options=options,
                value=value,
                values=values,
                visible=visible,
                content=label,
                label=label,
                kind=name,
                **how,
            )
            self.parts[known] = part
            return part

        return add

    def add_folder(self, name: str) -> Folder:
        """One that can be entered again."""
        return Folder()

    def add_panel(self) -> Any:
        """Beside the main one."""
        return SimpleNamespace(add_tab=lambda name: Folder(), dock_left=lambda: None, set_width=lambda width: None)


class Folder:
    """What is put into it is on the panel."""

    def __enter__(self) -> Folder:
        return self

    def __exit__(self, *_: object) -> None: ...
