"""The largest stable dt that theory predicts, for a page that must not wait: the last question asked is answered.

The same limit that `stability` and the report give (`reference.theory.limits`), about the equilibrium of the scene.
"""

from __future__ import annotations

import threading
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace

import numpy as np

from reference.errors import InputError, SolverError
from reference.schemes.catalogue import Scheme
from reference.system import MassSpringSystem
from reference.theory.equilibria import Equilibrium, equilibrium_on_obstacles, spring_equilibrium
from reference.theory.limits import growth, stability_limit
from reference.theory.rates import rates
from report.live.stepping import scheme_behind

#: A millisecond [s]: dt on the page is in milliseconds.
MS = 1e-3

#: Up to this number of coordinates growth at the page's dt is told too: it takes the whole Jacobian of a step.
GROWTH_UP_TO = 300

#: Up to this number where masses rest on obstacles is looked for.
ON_OBSTACLES_UP_TO = 200

#: The most coordinates of which a page looks for a limit: those of larger scenes take many seconds.
MOST = 4_000


@dataclass(frozen=True)
class Prediction:
    """What theory says of one stepper at one dt.

    Attributes:
        limit: the largest stable dt [s]; None where there is none.
        reason: why there is none; empty where there is one.
        growth: by what the worst perturbation is multiplied in a step of the dt asked for; NaN where unknown.
        scheme: the one it was predicted for.
        fastest: omega, the largest rate of the motion about the rest [1/s]; NaN where unknown.
    """

    limit: float | None
    reason: str
    growth: float
    scheme: str
    fastest: float = np.nan

    def of(self, dt: float) -> str:
        """What it says of a dt [s], which is the one it was asked for."""
        grows = f" The fastest mode grows {percent(self.growth - 1)} a step." if self.growth > 1 + 1e-6 else ""
        if self.limit is None:
            return f"Theory knows no largest stable dt here: {self.reason}.{grows}"
        times = f"dt = {dt / MS:.4g} ms is {dt / self.limit:.3g} times the predicted largest stable dt, "
        times += f"{self.limit / MS:.4g} ms."
        if dt <= self.limit:
            return f"{times} That limit is for small swings about the rest, and these are large."
        if np.isfinite(self.fastest):
            times += f" dt times omega is {dt * self.fastest:.3g}, over {self.limit * self.fastest:.3g}."
        return times + grows


def percent(part: float) -> str:
    """A part as people say it; beyond a doubling, as a factor."""
    if not np.isfinite(part):
        return "without bound"
    return f"{100 * part:.2g} %" if part < 1 else f"{1 + part:.3g}-fold"


def predict(name: str, system: MassSpringSystem, dt: float) -> Prediction:
    """The prediction for a stepper on a system; in free fall in the frame that falls with it.

    Of a scheme on obstacles about the rest there; of engines, whose contacts are their own, and of large
    systems without obstacles.
    """
    try:
        scheme = scheme_behind(name, system)
    except InputError as error:
        return Prediction(None, str(error), np.nan, name)
    still = replace(system, velocities=np.zeros_like(system.velocities))
    coordinates = int((~system.fixed).sum()) * system.dimension
    contacts = bool(system.obstacles) and coordinates <= ON_OBSTACLES_UP_TO and scheme.name == name
    if coordinates > MOST:
        return Prediction(None, f"not looked for, of {coordinates} coordinates; `stability` does", np.nan, scheme.name)
    if contacts:
        with suppress(SolverError, InputError, ArithmeticError):
            return _about(equilibrium_on_obstacles(still)[0], scheme, dt, coordinates)
    try:
        rest = spring_equilibrium(replace(still, obstacles=()))
        return _about(rest, scheme, dt, coordinates)
    except (SolverError, InputError, ArithmeticError, np.linalg.LinAlgError) as error:
        return Prediction(None, str(error), np.nan, scheme.name)


def _about(rest: Equilibrium, scheme: Scheme, dt: float, coordinates: int) -> Prediction:
    found = rates(rest)
    limit = stability_limit(scheme, rest, found)
    grows = growth(scheme, rest, dt) if coordinates <= GROWTH_UP_TO else np.nan
    return Prediction(limit.dt if limit.exact else None, limit.remark, grows, scheme.name, found.fastest)


class Predictor:
    """Predictions made in a thread of its own, for the last question only.

    Attributes:
        found: by stepper, for the last question that has been answered.
    """

    def __init__(self) -> None:
        self.found: Mapping[str, Prediction] = {}
        self._question: tuple[tuple[str, ...], MassSpringSystem, float] | None = None
        self._asked = threading.Condition()
        self._busy = self._ended = self._stale = False
        threading.Thread(target=self._answer, daemon=True).start()

    def ask(self, names: Sequence[str], system: MassSpringSystem, dt: float) -> None:
        """What is the limit of these steppers, on this system? At once: the answer comes to be found."""
        with self._asked:
            self._question = (tuple(names), system, dt)
            self._asked.notify_all()

    def forget(self) -> None:
        """Another system comes: what is known, or is just being found out, is not of that one."""
        with self._asked:
            self.found, self._question, self._stale = {}, None, self._busy

    def wait(self, seconds: float) -> None:
        """Until the last question is answered, but not longer than that."""
        with self._asked:
            self._asked.wait_for(lambda: self._question is None and not self._busy, seconds)

    def end(self) -> None:
        """No more questions."""
        with self._asked:
            self._ended = True
            self._asked.notify_all()

    def _answer(self) -> None:
        while True:
            with self._asked:
                self._asked.wait_for(lambda: self._question is not None or self._ended)
                if self._ended or self._question is None:
                    return
                names, system, dt = self._question
                self._question, self._busy = None, True
            with np.errstate(all="ignore"):
                found = {name: predict(name, system, dt) for name in dict.fromkeys(names)}
            with self._asked:
                if not self._stale:
                    self.found = found
                self._busy = self._stale = False
                self._asked.notify_all()
