"""The page on engines of games is what runs make of it: its predicted numbers, its string, its cloth."""

from __future__ import annotations

import pytest

from report import players


@pytest.mark.rotating(3)
def test_the_page_is_as_it_would_be_written_now() -> None:
    """But for what engines that may not be here measured: those cells are left out on both sides."""
    kept = players.PAGE.read_text(encoding="utf-8").splitlines()
    made = players.page(measure=False).splitlines()
    assert len(kept) == len(made)
    for one, other in zip(kept, made, strict=True):
        cells, others = one.split(" | "), other.split(" | ")
        left = {6: 4, 5: 1}.get(len(cells), len(cells))
        assert cells[:left] == others[:left]


def test_what_was_measured_is_what_was_predicted() -> None:
    """In every row of the page that has both: to 1 %, or the last figure that is told."""
    rows = [line.strip("| ").split(" | ") for line in players.PAGE.read_text(encoding="utf-8").splitlines()]
    both = [row for row in rows if len(row) == 6 and row[0].startswith("`") and row[4] != "-"]
    assert len({row[0] for row in both}) >= 6
    for _, _, hertz, ratio, measured_hertz, measured_ratio in both:
        assert float(measured_hertz) == pytest.approx(float(hertz), rel=0.01)
        assert float(measured_ratio) == pytest.approx(float(ratio), rel=0.01, abs=2e-4)


def test_sentences_follow_the_numbers() -> None:
    """Shown to change with them."""
    assert "farther from the true motion in single" in players.of_substeps([["1", "1", "1"], ["20", "2", "0.5"]])
    assert "nearer to the true motion in single" in players.of_substeps([["1", "1", "1"], ["20", "0.5", "0.5"]])
    held, torn = ["`kick_drift`", "holds", "holds"], ["`xpbd_jacobi`", "holds", "tears"]
    assert "longer steps than `xpbd_jacobi`." in players.of_cloth([held, torn])
    assert players.of_cloth([held, held]).startswith("None")


def test_of_engines_that_are_not_run_nothing_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    """Though they are here, in a version; and they are not run."""
    monkeypatch.setattr(players.EngineStepper, "version", "9.9")
    monkeypatch.setattr(players.EngineStepper, "run", lambda *_: pytest.fail("it was run"))
    rows = players.engines_table(measure=False)
    assert {cell for row in rows for cell in row[2:]} == {"-"}
    assert all(row[1].endswith(" 9.9") for row in rows)
