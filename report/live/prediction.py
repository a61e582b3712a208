"""The largest stable dt that theory predicts, for a page that must not wait: the last question asked is answered.

Small systems are pushed about their rest, by the whole Jacobian of a step (`reference.stability`). Of large ones the
fastest mode about their start is taken alone, as one mass on one spring with the same frequency and damping: what
limits a step is the fastest mode, and where damping is spread as masses or stiffness are, that is no approximation.
"""

from __future__ import annotations

import threading
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from reference.assembly import assemble, spring_blocks
from reference.catalogue import Scheme
from reference.errors import SolverError
from reference.stability import Equilibrium, growth, spring_equilibrium, stability_limit
from reference.system import MassSpringSystem
from report.live.stepping import scheme_behind

#: Up to so many coordinates the whole Jacobian takes less than a tenth of a second.
WHOLE_UP_TO = 60


@dataclass(frozen=True)
class Prediction:
    """What theory says of one stepper at one dt.

    Attributes:
        limit: the largest stable dt [s]; None where there is none.
        reason: why there is none; empty where there is one.
        growth: by what the worst push is multiplied in a step of the dt asked for; not a number where unknown.
        scheme: the one it was predicted for.
    """

    limit: float | None
    reason: str
    growth: float
    scheme: str

    def of(self, dt: float) -> str:
        """What it says of a dt [s], which is the one it was asked for."""
        grows = f" The fastest mode grows {percent(self.growth - 1)} a step." if self.growth > 1 + 1e-6 else ""
        if self.limit is None:
            return f"Theory knows no largest stable dt here: {self.reason}.{grows}"
        times = f"dt = {dt:.4g} s is {dt / self.limit:.3g} times the predicted largest stable dt, {self.limit:.4g} s."
        if dt <= self.limit:
            return f"{times} That limit is for small swings about the rest, and these are large."
        return times + grows


def percent(part: float) -> str:
    """A part as people say it; beyond a doubling, as a factor."""
    if not np.isfinite(part):
        return "without bound"
    return f"{100 * part:.2g} %" if part < 1 else f"{1 + part:.3g}-fold"


def predict(name: str, system: MassSpringSystem, dt: float) -> Prediction:
    """The prediction for a stepper on a system, without its obstacles; in free fall without its weight."""
    scheme = scheme_behind(name, system)
    alone = replace(system, obstacles=(), velocities=np.zeros_like(system.velocities))
    if not alone.fixed.any():
        alone = replace(alone, gravity=0 * alone.gravity)
    try:
        rest = _rest(scheme, alone)
        limit = stability_limit(scheme, rest)
        return Prediction(limit.dt, limit.reason, growth(scheme, rest, dt), scheme.name)
    except (SolverError, np.linalg.LinAlgError) as error:
        return Prediction(None, str(error), np.nan, scheme.name)


def _rest(scheme: Scheme, system: MassSpringSystem) -> Equilibrium:
    """What is pushed: the system at rest, or its fastest mode alone."""
    coordinates = int((~system.fixed).sum()) * system.dimension
    if coordinates <= WHOLE_UP_TO:
        return spring_equilibrium(system)
    if scheme.kind == "in_place":
        raise SolverError(f"not predicted: it depends on the order of {coordinates} coordinates")
    return spring_equilibrium(fastest_mode(system))


def fastest_mode(system: MassSpringSystem) -> MassSpringSystem:
    """One mass of 1 kg on one spring that moves as the fastest mode of a system about its start.

    With K phi = w^2 M phi, phi M phi = 1: its stiffness is w^2, its damping phi C phi, its drag Cd phi phi.
    """
    from scipy.sparse import diags_array
    from scipy.sparse.linalg import eigsh

    by_position, by_velocity = spring_blocks(system, system.start)
    # Drag is told apart from the damping of springs.
    by_velocity = replace(by_velocity, masses=0 * by_velocity.masses)
    stiffness, damping = (-assemble(system, blocks, sparse=True) for blocks in (by_position, by_velocity))
    scale = diags_array(np.repeat(system.masses[~system.fixed], system.dimension) ** -0.5)
    start = np.random.default_rng(0).normal(size=stiffness.shape[0])
    square, mode = eigsh(scale @ stiffness @ scale, 1, which="LA", v0=start, tol=1e-9)
    phi = scale @ mode[:, 0]
    return MassSpringSystem(
        positions=np.array([[0.0, 0.0], [1.0, 0.0]]),
        springs=np.array([[0, 1]]),
        masses=np.array(1.0),
        rest_lengths=np.array(1.0),
        stiffness=np.array(max(float(square[0]), 0.0)),
        damping=np.array(max(float(phi @ (damping @ phi)), 0.0)),
        drag=system.drag * float(phi @ phi),
        gravity=np.array(0.0),
        fixed=np.array([True, False]),
    )


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
            found = {name: predict(name, system, dt) for name in dict.fromkeys(names)}
            with self._asked:
                if not self._stale:
                    self.found = found
                self._busy = self._stale = False
                self._asked.notify_all()
