"""A class's marks in the columns that learning platforms read back: Moodle, Canvas, Brightspace."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from experiments.exercises.teaching.table_file import written

Row = Mapping[str, str]


def moodle(row: Row, title: str) -> dict[str, str]:
    """Moodle's grade import: a column that it knows users by, grade and feedback."""
    return {"Full name": row["student"], "Grade": row["mark"], "Maximum Grade": "100", "Feedback comments": words(row)}


def canvas(row: Row, title: str) -> dict[str, str]:
    """Canvas' gradebook import: students and one column for each assignment."""
    return {
        "Student": row["student"],
        "ID": "",
        "SIS User ID": "",
        "SIS Login ID": "",
        "Section": "",
        title: row["mark"],
    }


def brightspace(row: Row, title: str) -> dict[str, str]:
    """Brightspace's import of points: a user name and a column for each item, its line ended by #."""
    return {"Username": row["student"], f"{title} Points Grade": row["mark"], "End-of-Line Indicator": "#"}


#: By name.
PLATFORMS: Mapping[str, Callable[[Row, str], dict[str, str]]] = {
    function.__name__: function for function in (moodle, canvas, brightspace)
}


def words(row: Row) -> str:
    """What a student is told, on one line; not the change that would mend it."""
    told = (row["words"], row["seen"], f"Look at {row['look_at']}." if row["look_at"] else "")
    return " ".join(filter(None, told)) or row["outcome"]


def table(rows: Sequence[Row], platform: str, title: str) -> str:
    """The CSV of one exercise."""
    made = [PLATFORMS[platform](row, title) for row in rows]
    return written(list(made[0]) if made else [], made)
