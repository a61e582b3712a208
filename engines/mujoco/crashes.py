"""Ways to break MuJoCo, and what its safety net hides."""

from __future__ import annotations

from typing import Any

import numpy as np

from engines.crash_cases import RESET, crash_case, numbers

#: A mass on a tendon between two sites.
SPRING = """
<mujoco>
  <worldbody>
    <body><joint type="slide"/><joint type="slide" axis="0 1 0"/><geom size="0.1" mass="1"/><site name="mass"/></body>
    <site name="anchor" pos="1 0 0"/>
  </worldbody>
  <tendon><spatial stiffness="10"><site site="anchor"/><site site="mass"/></spatial></tendon>
</mujoco>"""


def _mujoco_spring() -> tuple[Any, Any]:
    """A mass on a tendon, as model and data; MuJoCo as it comes, with its safety net."""
    import mujoco

    model = mujoco.MjModel.from_xml_string(SPRING)
    return model, mujoco.MjData(model)


def _mujoco_steps(model: Any, data: Any, steps: int = 10) -> str:
    """Step, and see whether time, too, goes on."""
    import mujoco

    begin = float(data.time)
    for _ in range(steps):
        mujoco.mj_step(model, data)
    passed = steps * model.opt.timestep
    return RESET if data.time - begin < 0.99 * passed else numbers([*data.qpos, *data.qvel])


@crash_case("mujoco")
def a_velocity_beyond_all() -> str:
    """Let a mass move at 1e300 m/s, with the safety net that MuJoCo comes with."""
    model, data = _mujoco_spring()
    _mujoco_steps(model, data)
    data.qvel[0] = 1e300
    return _mujoco_steps(model, data)


@crash_case("mujoco")
def a_position_that_is_not_finite() -> str:
    """Put a mass at NaN, with the safety net that MuJoCo comes with."""
    model, data = _mujoco_spring()
    _mujoco_steps(model, data)
    data.qpos[0] = np.nan
    return _mujoco_steps(model, data)


@crash_case("mujoco")
def the_same_without_the_safety_net() -> str:
    """Put a mass at NaN, with autoreset off."""
    import mujoco

    model, data = _mujoco_spring()
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_AUTORESET)
    data.qpos[0] = np.nan
    return _mujoco_steps(model, data)


@crash_case("mujoco")
def a_step_too_long() -> str:
    """Step a spring far beyond its largest stable dt, with the safety net that MuJoCo comes with."""
    model, data = _mujoco_spring()
    model.opt.timestep = 5.0
    return _mujoco_steps(model, data, 100)


@crash_case("mujoco")
def an_index_beyond_the_model() -> str:
    """Hang a tendon on site 1073741824 of two."""
    model, data = _mujoco_spring()
    model.wrap_objid[0] = 2**30
    return _mujoco_steps(model, data)


@crash_case("mujoco")
def a_joint_that_is_its_own_parent() -> str:
    """Let a chain of joints go in a circle."""
    model, data = _mujoco_spring()
    model.dof_parentid[1] = 1
    return _mujoco_steps(model, data)
