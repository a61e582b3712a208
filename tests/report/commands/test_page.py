"""`springlab page`: what it writes, and what it says of what it cannot write."""

from __future__ import annotations

import webbrowser
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from reference.errors import InputError
from report.commands.page import page_command


def test_a_scene_of_one_s_own_is_written(tmp_path: Path) -> None:
    """With its name, its changes, and its command."""
    own = tmp_path / "my_scene.toml"
    own.write_text('scene = "spring"\n[[changes]]\ntime = 0.2\nparameter = "stiffness"\nvalue = 100.0\n')
    out = tmp_path / "lab.html"
    done = CliRunner().invoke(page_command, [str(own), "--out", str(out)], catch_exceptions=False)
    assert done.exit_code == 0
    text = out.read_text(encoding="utf-8")
    assert '"name":"my_scene"' in text
    assert '"changes":[{"time":0.2,"parameter":"stiffness","value":100.0}]' in text
    assert "http" not in text.replace("http-equiv", "")
    assert "wasm-unsafe-eval" not in text  # only engines that it carries need that


#: Masses that collide, which the page cannot do.
ROUND = 'scene = "string"\n[parameters]\nradii = 0.01\n'


@pytest.mark.parametrize(("scene", "said"), [("rope.toml", "rope"), ("strng", "strng")])
def test_what_cannot_be_is_refused_by_name(scene: str, said: str, tmp_path: Path) -> None:
    """In one line, and nothing is written."""
    (tmp_path / "rope.toml").write_text(ROUND, encoding="utf-8")
    out, given = tmp_path / "lab.html", tmp_path / scene if scene.endswith("toml") else scene
    with pytest.raises(InputError, match=said):
        CliRunner().invoke(page_command, [str(given), "--out", str(out)], catch_exceptions=False)
    assert not out.exists()


def test_the_file_is_opened_where_that_is_asked_for(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """And only there; each engine and each recording that is named is on the page, a scene that is named twice once."""
    opened: list[str] = []
    asked: list[tuple[list[str], list[str], tuple[str, ...]]] = []

    def lab_page(presets: Any, engines: tuple[str, ...]) -> str:
        asked.append(([p.scene for p in presets], [r.stepper for p in presets[:1] for r in p.recordings], engines))
        return "\N{LATIN SMALL LETTER A WITH DIAERESIS}" * 622_500

    monkeypatch.setattr(webbrowser, "open", opened.append)
    monkeypatch.setattr("report.browser.lab_page.lab_page", lab_page)
    out = tmp_path / "lab.html"
    words = ["spring", "chain", "spring", "--out", str(out)]
    words += ["--record", "pymunk_springs", "--record", "heun", "--with", "one", "--with", "two"]
    for more, shown in ([], []), (["--open"], [out.resolve().as_uri()]):
        done = CliRunner().invoke(page_command, [*words, *more], catch_exceptions=False)
        assert done.output == f"written: {out} (1.25 MB)\n"  # each letter is two bytes
        assert opened == shown
    assert asked == [(["spring", "chain"], ["pymunk_springs", "heun"], ("one", "two"))] * 2
    with pytest.raises(InputError, match="expected a SCENE with it"):
        CliRunner().invoke(page_command, ["--record", "heun", "--out", str(out)], catch_exceptions=False)
