"""What is kept of engines' formulas: what is derived now, and the same as a scheme that each claims to be."""

from __future__ import annotations

import json
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from engines.engine import find, registry, version
from report.page import derived_formulas
from report.page.derived_formulas import FILE, _near, _same, derived_of, formulas_of

KEPT = json.loads(FILE.read_text(encoding="utf-8"))


@pytest.mark.parametrize("name", ["pymunk_springs", "mujoco_tendons_implicit"])
def test_what_is_kept_is_what_is_derived(name: str) -> None:
    """Of two engines that are quick to start, in the version that was kept."""
    engine = find(name)
    if version(engine) != KEPT[name]["version"]:
        pytest.skip(f"{name}: formulas are kept of version {KEPT[name]['version']}")
    assert {**derived_of(engine), "on": KEPT[name]["on"]} == KEPT[name]
    assert formulas_of(engine) == KEPT[name]["lines"]


@pytest.mark.parametrize("name", [name for name, kept in KEPT.items() if "reason" not in kept])
def test_each_agrees_with_a_scheme_that_it_claims_to_be(name: str) -> None:
    """The formulas beside the name say the same as the name."""
    assert name in registry()
    assert KEPT[name]["same_as"]
    assert set(KEPT[name]["same_as"]) <= set(registry()[name].identified_as.values())


def test_another_version_has_none() -> None:
    """What was derived of one version is not shown of another."""
    engine = find("pymunk_springs")
    assert formulas_of(type(engine)(package="numpy")) == ()


def test_a_claim_without_formulas_is_not_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    """One with others is not, either; what an engine does not have, damping or drag, is not asked."""

    def matrix(off: float = 0.0, damped: bool = True, dragged: bool = True) -> Any:
        at = lambda a, b, d: a + 2 * b + 4 * d + off  # noqa: E731
        some = SimpleNamespace(a=np.array([1.0, 2.0]), b=np.array([0.5, 1.0]), d=np.array([0.25, 0.75]))
        return SimpleNamespace(at=at, samples=some, damped=damped, dragged=dragged)

    known: dict[str, Any] = {"right": matrix(), "near": matrix(0.9e-9), "other": matrix(1.1e-9), "none": None}
    monkeypatch.setattr(derived_formulas, "_matrix_of", known.get)
    assert {name: _same(matrix(), name) for name in known} == {
        "right": True,
        "near": True,
        "other": False,
        "none": False,
    }
    for damped, dragged in ((False, True), (True, False)):
        asked: list[tuple[float, float]] = []
        seen = matrix(damped=damped, dragged=dragged)
        seen.at = lambda a, b, d, asked=asked: asked.append((b.max(), d.max())) or 0 * a
        known["right"].at = lambda a, b, d, asked=asked: asked.append((b.max(), d.max())) or 0 * a
        assert _same(seen, "right")
        assert asked == [(1.0 * damped, 0.75 * dragged)] * 2


def test_an_engine_without_formulas_is_told_how_near_it_is_to_the_nearest_claim(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The largest of all entries, at the oscillators where it was measured."""
    measured = np.array([[[1.0, 2.0], [3.0, 4.0]]])

    def off(by: float) -> Any:
        return SimpleNamespace(at=lambda *at: measured + by * np.array([[[0.0, -1.0], [0.5, 0.0]]]))

    known = {"far": off(0.5), "near": off(0.03), "none": None}
    monkeypatch.setattr(derived_formulas, "_matrix_of", known.get)
    monkeypatch.setattr("reference.derivation.oscillators.runs_of", lambda stepper: stepper)
    monkeypatch.setattr("reference.derivation.oscillators.one_by_one", lambda *asked, aside: measured)
    near = lambda *claims: _near(SimpleNamespace(claims=claims))  # type: ignore[arg-type]  # noqa: E731
    assert near("far", "none", "near") == {"near": "near", "within": "0.03"}
    assert near("none") == {}
