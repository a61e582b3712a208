"""A plot that a notebook shows and a script saves."""

from __future__ import annotations

import base64
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from report.figures import Picture


@dataclass(frozen=True)
class Plot:
    """A figure with its alternative text.

    Attributes:
        alt: what it shows, in words.
    """

    _picture: Picture

    @property
    def alt(self) -> str:
        """What it shows, in words."""
        return self._picture.alt

    @property
    def figure(self) -> Any:
        """The matplotlib.figure.Figure, to be changed or added to."""
        return self._picture.figure

    def save(self, file: str | Path) -> Path:
        """Write it to a file whose name says how: .svg, .png, .pdf. Returns the file; raises OSError, ValueError."""
        file = Path(file)
        if file.suffix == ".svg":
            file.write_text(self._picture.svg(), encoding="utf-8")
        else:
            self.figure.savefig(file, dpi=160)
        return file

    def _repr_html_(self) -> str:
        # as an image: two figures in one page would have parts by the same name
        data = base64.b64encode(self._picture.svg().encode()).decode()
        style = "max-width:100%;background:#fff"
        return f'<img alt="{escape(self.alt)}" style="{style}" src="data:image/svg+xml;base64,{data}">'
