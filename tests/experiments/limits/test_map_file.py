"""A map as a file: every point with its own growth, x and y under their names."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest

from experiments.limits.stability_map import write_map
from tests.experiments.canned.maps import field


def test_every_point_has_its_growth_under_the_names_of_the_axes(tmp_path: Path) -> None:
    """One growth for each point here, so that no two are taken for one another; x goes first."""
    found = field()
    growth = np.arange(found.growth.size, dtype=float).reshape(found.growth.shape)
    file = tmp_path / "map.csv"
    write_map(type(found)(**{**vars(found), "growth": growth}), file)
    with file.open(newline="", encoding="utf-8") as opened:
        reader = csv.DictReader(opened)
        assert reader.fieldnames == ["dt [s]", "drag [N s/m]", "measured growth in a step [1]"]
        rows = [{name: float(value) for name, value in row.items()} for row in reader]
    assert len(rows) == growth.size
    for row in rows:
        i = int(np.argmin(np.abs(found.x_values - row["dt [s]"])))
        j = int(np.argmin(np.abs(found.y_values - row["drag [N s/m]"])))
        assert (row["dt [s]"], row["drag [N s/m]"]) == pytest.approx((found.x_values[i], found.y_values[j]))
        assert row["measured growth in a step [1]"] == growth[j, i]
