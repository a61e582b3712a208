"""An engine that stays: it goes on from where it is, and however it ends, it says why and is gone."""

from __future__ import annotations

import os
from collections.abc import Callable

import psutil
import pytest

from engines.engine import CAPABILITIES
from engines.process.session import EngineStopped, Session, end_sessions
from tests.conformance.doctored import Doctored, KickDrift
from tests.engines.process import misbehaving
from tests.engines.process.misbehaving import Misbehaving
from tests.reference.systems import moving_string
from tests.soak.children import check_all_end

STRING = moving_string(4, damping=0.05, drag=0.02)
DT = 1e-3


def test_it_goes_on_a_few_steps_at_a_time() -> None:
    """As in this process, to the bit; with a parameter that changes, and from another state with another dt."""
    here = KickDrift(STRING, DT)
    session = Session(Doctored(KickDrift), STRING, DT)
    for steps in (3, 0, 5):
        for _ in range(steps):
            here.step()
        x, v = session.advance(steps)
        assert (x.tolist(), v.tolist()) == (here.x.tolist(), here.v.tolist())
        here.change("stiffness", 150.0)
        session.change("stiffness", 150.0)
    assert session.pid not in (None, os.getpid())
    again = KickDrift(STRING, 2 * DT)
    again.step()
    session.restart(STRING, 2 * DT)
    assert session.advance(1)[0].tolist() == again.x.tolist()
    session.end()
    assert session.pid is None


DRAGLESS = Doctored(KickDrift, frozenset(CAPABILITIES) - {"drag"})


@pytest.mark.parametrize(
    ("use", "ending", "reason"),
    [
        (lambda: Session(DRAGLESS, STRING, DT), "unsupported", f"KickDrift cannot do {CAPABILITIES['drag']}"),
        (
            lambda: Session(Doctored(KickDrift), STRING, DT).change("stifness", 1.0),
            "unsupported",
            "unknown parameter 'stifness': did you mean 'stiffness'?",
        ),
        (lambda: Session(Misbehaving(misbehaving.Segfaults), STRING, DT).advance(1), "crashed", "killed by SIGSEGV"),
        (
            lambda: Session(Misbehaving(misbehaving.Hangs), STRING, DT, time_limit=1.0).advance(1),
            "timed out",
            "no answer within 1 s",
        ),
        (
            lambda: Session(Misbehaving(misbehaving.Raises), STRING, DT).advance(1),
            "crashed",
            "ZeroDivisionError: mass 3 is zero and cannot be divided by",
        ),
    ],
    ids=["cannot start", "cannot change", "crash", "hang", "exception"],
)
def test_its_end_has_a_reason(use: Callable[[], object], ending: str, reason: str) -> None:
    """Whatever was asked."""
    with pytest.raises(EngineStopped) as caught:
        use()
    assert (caught.value.outcome.ending, caught.value.outcome.reason) == (ending, reason)


def test_what_has_ended_ends_once_and_answers_no_more() -> None:
    """By itself, and with all others at the end of the program."""
    first, second = (Session(Doctored(KickDrift), STRING, DT) for _ in range(2))
    third = Session(Misbehaving(misbehaving.Raises), STRING, DT)
    processes = [psutil.Process(session.pid) for session in (first, second, third)]
    with pytest.raises(EngineStopped):
        third.advance(1)
    assert third.pid is None
    first.end()
    first.end()
    with pytest.raises(EngineStopped, match="the engine is no more"):
        first.advance(1)
    assert second.advance(1)
    end_sessions()
    assert second.pid is None
    check_all_end(processes)
