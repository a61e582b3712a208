"""What the MuJoCo adapters share: the import, and the safety nets and features that are switched off."""

from __future__ import annotations

import importlib
from types import ModuleType
from typing import Any

import numpy as np

from engines.engine import Unsupported
from reference.state import Array

#: Parts of the step the lab does without. Autoreset would hide a blow-up by starting over; the others are for things
#: there are none of (contacts, motors, sensors), and cost time.
OFF = ("AUTORESET", "CONTACT", "CONSTRAINT", "ACTUATION", "SENSOR")

#: The smallest mass [kg] or moment of inertia [kg m^2] taken: MuJoCo silently raises any below its mjMINVAL of 1e-15.
SMALLEST_INERTIA = 1e-14


def mujoco_module() -> ModuleType:
    """MuJoCo, kept from writing its warnings to a file in the working directory. A blow-up shows in the state."""
    mujoco = importlib.import_module("mujoco")
    mujoco.set_mju_user_warning(lambda message: None)
    return mujoco


def without(mujoco: ModuleType, parts: tuple[str, ...]) -> int:
    """The disable flags for parts of MuJoCo's step, by the ends of their names."""
    return sum(int(getattr(mujoco.mjtDisableBit, f"mjDSBL_{part}")) for part in parts)


def check_inertia(what: str, values: Array, unit: str) -> None:
    """Raise Unsupported where a mass or moment of inertia is too small for MuJoCo to be exact."""
    smallest = float(values.min(initial=np.inf))
    if smallest < SMALLEST_INERTIA:
        raise Unsupported(f"{what} = {smallest:g} {unit}: MuJoCo needs {SMALLEST_INERTIA:g} {unit} or more")


def update_constants(mujoco: ModuleType, model: Any) -> None:
    """Let MuJoCo compute again what it keeps of the masses; in scratch memory, so that no state is touched."""
    mujoco.mj_setConst(model, mujoco.MjData(model))
