"""The parts of README.md that are made from the project: `python -m report.readme` writes them."""

from __future__ import annotations

from pathlib import Path

from engines.engine import registry

README = Path(__file__).parents[1] / "README.md"
BEGIN, END = "<!-- engines: written by `python -m report.readme` -->\n", "<!-- end of engines -->"


def engine_table() -> str:
    """The engines and the schemes they are identified with, as a Markdown table."""
    cases = ("plain", "damping", "drag")
    lines = ["| engine | undamped | damped springs | drag |", "| --- | --- | --- | --- |"]
    for engine in registry().values():
        schemes = [f"`{engine.identified_as[case]}`" if case in engine.identified_as else "-" for case in cases]
        lines.append(f"| `{engine.name}` | " + " | ".join(schemes) + " |")
    return "\n".join(lines) + "\n"


def with_engine_table(text: str) -> str:
    """README's text with the table between its two marks."""
    before, _, rest = text.partition(BEGIN)
    _, _, after = rest.partition(END)
    return f"{before}{BEGIN}\n{engine_table()}\n{END}{after}"


if __name__ == "__main__":
    README.write_text(with_engine_table(README.read_text(encoding="utf-8")), encoding="utf-8")
