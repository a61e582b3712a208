"""A table: a list of rows that a notebook shows, and that pandas takes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING, Any, overload

from report.plain import plain

if TYPE_CHECKING:
    from report.shown import Shown


@dataclass(frozen=True)
class Table:
    """Rows under named columns.

    >>> steps = Table("steps", ("dt [s]", "outcome"), ((0.001, "done"), (0.1, "diverged")))
    >>> steps[1]["outcome"], steps["dt [s]"]
    ('diverged', [0.001, 0.1])

    Attributes:
        title: in words; may be empty.
        columns: headings, with units where there are any.
        rows: numbers, words, or None for what there is not.
        notes: sentences below it.
    """

    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[Any, ...], ...]
    notes: tuple[str, ...] = ()

    @classmethod
    def of(cls, shown: Shown) -> Table:
        """The table that a command prints."""
        return cls(shown.title, tuple(shown.columns), tuple(map(tuple, shown.rows)), tuple(shown.notes))

    @classmethod
    def of_documents(cls, title: str, documents: Sequence[Mapping[str, Any]]) -> Table:
        """A row for each of some documents with the same keys."""
        columns = tuple(dict.fromkeys(key for document in documents for key in document))
        return cls(title, columns, tuple(tuple(document.get(key) for key in columns) for document in documents))

    def __len__(self) -> int:
        return len(self.rows)

    def __iter__(self) -> Iterator[dict[str, Any]]:
        return (dict(zip(self.columns, row, strict=True)) for row in self.rows)

    @overload
    def __getitem__(self, key: int) -> dict[str, Any]: ...
    @overload
    def __getitem__(self, key: str) -> list[Any]: ...
    def __getitem__(self, key: int | str) -> Any:
        """A row by its number, or a column by its heading. Raises IndexError, KeyError where there is none."""
        if isinstance(key, int):
            return dict(zip(self.columns, self.rows[key], strict=True))
        if key not in self.columns:
            raise KeyError(f"{key!r}: expected one of {', '.join(self.columns)}")
        return [row[self.columns.index(key)] for row in self.rows]

    def to_pandas(self) -> Any:
        """A pandas.DataFrame. Raises ImportError, in a line, where pandas is not installed."""
        return frame(list(self), self.columns)

    def __str__(self) -> str:
        cells = [list(self.columns), *([plain(value) for value in row] for row in self.rows)]
        widths = [max(len(row[i]) for row in cells) for i in range(len(self.columns))]
        lines = [
            "  ".join(text.ljust(width) for text, width in zip(row, widths, strict=True)).rstrip() for row in cells
        ]
        return "\n".join([*([self.title] if self.title else []), *lines, *self.notes])

    def _repr_html_(self) -> str:
        head = "".join(f'<th scope="col">{escape(name)}</th>' if name else "<td></td>" for name in self.columns)
        body = "".join(
            "<tr>" + "".join(f"<td>{escape(plain(value))}</td>" for value in row) + "</tr>" for row in self.rows
        )
        caption = f"<caption>{escape(self.title)}</caption>" if self.title else ""
        notes = "".join(f"<p>{escape(note)}</p>" for note in self.notes)
        return f"<table>{caption}<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>{notes}"


def frame(rows: Any, columns: Sequence[str] | None = None) -> Any:
    """A pandas.DataFrame of rows or columns. Raises ImportError, in a line, where pandas is not installed."""
    try:
        import pandas
    except ImportError:
        raise ImportError("to_pandas() needs pandas: expected it installed, by `pip install pandas`") from None
    return pandas.DataFrame(rows, columns=columns)
