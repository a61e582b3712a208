"""MuJoCo's tendons: what collides, and which systems are too large for an interactive run."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from engines.engine import Unsupported, find, version
from engines.mujoco.common import mujoco_module
from engines.mujoco.obstacles import BEAD
from engines.mujoco.tendons import ENGINES, _write_law, tendon_spec
from engines.process.isolation import isolated
from reference.collisions.round_masses import Collisions
from reference.scenes import find as find_scene
from reference.springs.kinds import NonlinearSprings

pytestmark = pytest.mark.skipif(version(find("mujoco_tendons")) is None, reason="mujoco is not installed")

DT = 2e-3


def balls(radii: list[float]) -> list[tuple[int, float, list[float], float, float]]:
    """Of each ball: its body, its radius, where its centre is in that, the width and the time of its contacts."""
    string = find_scene("string").system({"masses": 3})
    system = replace(string, positions=string.positions + np.array([0.3, -0.7]), collisions=Collisions(np.array(radii)))
    model = tendon_spec(mujoco_module(), system, False, DT).compile()
    rows = zip(model.geom_bodyid, model.geom_size, model.geom_pos, model.geom_solimp, model.geom_solref, strict=True)
    return [(int(i), float(size[0]), at.tolist(), float(imp[2]), float(ref[0])) for i, size, at, imp, ref in rows]


@pytest.mark.parametrize("radii", [[0.01, 0.02, 0.0, 0.04], [0.0, 0.02, 0.03, 0.0]])
def test_what_collides_has_a_ball_of_its_radius(radii: list[float]) -> None:
    """Around its body, or, held, where it is in the world, body 0; what has no radius has none.

    Impedance rises over a thousandth of the largest radius, in a time of 2 dt.
    """
    found = isolated(balls, radii)
    assert isinstance(found, list), found
    assert [i for i, *_ in found] == np.flatnonzero(radii).tolist()
    for i, radius, at, width, time in found:
        assert radius == pytest.approx(radii[i])
        assert at == pytest.approx([0.3, -0.7, 0.0] if i == 0 else [0.0, 0.0, 0.0])
        assert (width, time) == pytest.approx((BEAD * max(radii), 2 * DT))


def test_nested_tendons_alone_are_slow_on_large_systems() -> None:
    """Bodies within bodies take a time as the number to the third power, so they have a bound."""
    bounds = {engine.name: engine.interactive_up_to is not None for engine in ENGINES}
    assert bounds == {engine.name: engine.settings["nested"] for engine in ENGINES}
    assert set(bounds.values()) == {True, False}


def test_one_spring_that_hardens_is_too_much_for_an_old_mujoco() -> None:
    """Its models have no numbers for it; springs that go slack they have. Later ones have k3 of each spring."""
    string = find_scene("string").system({"masses": 3})
    hardening = replace(string, nonlinear=NonlinearSprings(hardening=np.array([0.0, 5.0, 0.0])))
    slack = replace(string, nonlinear=NonlinearSprings(tension_only=np.array([False, True, False])))
    old = SimpleNamespace(tendon_lengthspring=np.ones((3, 2)))
    with pytest.raises(Unsupported, match="hardening needs 3"):
        _write_law(old, hardening)
    _write_law(old, slack)
    assert old.tendon_lengthspring.tolist() == [[1.0, 1.0], [0.0, 1.0], [1.0, 1.0]]
    new = SimpleNamespace(tendon_lengthspring=np.ones((3, 2)), tendon_stiffnesspoly=np.full((3, 2), 7.0))
    _write_law(new, hardening)
    assert new.tendon_stiffnesspoly.tolist() == [[7.0, 0.0], [7.0, 5.0], [7.0, 0.0]]
    _write_law(new, string)
    assert not new.tendon_stiffnesspoly[:, 1].any()
