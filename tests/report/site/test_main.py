"""`python -m report.site` without Sphinx: what it asks of it, and what it does with the answer."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from click.testing import CliRunner

from reference.errors import InputError
from report.site import __main__ as site


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[list[str]]:
    """The words that Sphinx was called with, the first of which is its answer; pages are few."""
    asked: list[list[str]] = [["0"]]

    def run(words: list[str]) -> Any:
        source, out = Path(words[-2]), Path(words[-1])
        assert (source / "made.md").read_text(encoding="utf-8") == "made"
        assert (source / "own.md").exists()
        assert not out.exists()  # what stood there is gone
        out.mkdir(parents=True)
        (out / "index.html").write_text("<pre>a</pre>", encoding="utf-8")
        asked.append(words)
        return SimpleNamespace(returncode=int(asked[0][0]))

    monkeypatch.setattr(site, "write_sources", lambda folder: (folder / "own.md").write_text("own"))
    monkeypatch.setattr(site, "PAGES", {"made": lambda: "made"})
    monkeypatch.setattr(site.subprocess, "run", run)
    monkeypatch.setattr(site, "lab_page", lambda presets: "lab")
    return asked


@pytest.mark.parametrize("notebooks", [True, False])
def test_notebooks_are_run_unless_told_otherwise(asked: list[list[str]], notebooks: bool, tmp_path: Path) -> None:
    """A warning is an error; what stood in the folder is gone, and pages are mended. The lab is beside them."""
    out = tmp_path / "out"
    for _ in range(2):  # a folder that is not there, and one that is
        done = CliRunner().invoke(site.main, ["--out", str(out), *([] if notebooks else ["--no-notebooks"])])
        assert done.exit_code == 0, done.output
    assert {"-W", "--keep-going"} <= {*asked[-1]}
    assert ("nb_execution_mode=off" in asked[-1]) is not notebooks
    assert '<pre tabindex="0">' in (out / "index.html").read_text(encoding="utf-8")
    assert (out / "lab.html").read_text(encoding="utf-8") == "lab"
    assert done.output == f"written: {out / 'index.html'}\n"


def test_a_warning_is_the_exit_code_and_no_lab_is_written(asked: list[list[str]], tmp_path: Path) -> None:
    """Nor is it said to be."""
    asked[0] = ["3"]
    done = CliRunner().invoke(site.main, ["--out", str(tmp_path / "out")])
    assert (done.exit_code, done.output) == (3, "")
    assert not (tmp_path / "out" / "lab.html").exists()


def test_bad_input_is_one_line(asked: list[list[str]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As of every command."""

    def fails(folder: Path) -> None:
        raise InputError("a.md: (b.md): expected a file that is there")

    monkeypatch.setattr(site, "write_sources", fails)
    done = CliRunner().invoke(site.main, ["--out", str(tmp_path / "out")])
    assert (done.exit_code, done.output) == (2, "springlab: a.md: (b.md): expected a file that is there\n")
