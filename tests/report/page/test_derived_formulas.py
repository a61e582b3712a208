"""What is kept of engines' formulas: what is derived now, and the same as a scheme that each claims to be."""

from __future__ import annotations

import json

import pytest

from engines.engine import find, registry, version
from report.page.derived_formulas import FILE, derived_of, formulas_of

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
