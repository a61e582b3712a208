"""What advice says, in sentences and a table."""

from __future__ import annotations

from collections.abc import Sequence

from experiments.advice.advice import ADVISED, FRAMES, Advice, advise
from experiments.experiment import Result, Table
from experiments.runs.progress import Progress
from experiments.runs.steppers import installed_engines
from reference.scenes import Setup

COLUMNS = ["engine", "identified as", "ties", "at the scene's dt", "margin", "predicted limit [s]"]
COLUMNS += [
    "measured limit [s]",
    "advised dt [s]",
    "the scene with it",
    "perturbations at 1.1 of the limit",
    "steps for 1/60 s",
]
COLUMNS += ["limited by", "times as stiff at the scene's dt", "reason"]

#: A mode with this part of its energy in one spring is that spring's.
MOSTLY = 0.35


def answer(setup: Setup, progress: Progress) -> Result:
    """The advice for a scene in all installed engines, as findings and a table. Raises as `advise` does."""
    return result_of(setup, advise(setup, installed_engines(), progress))


def result_of(setup: Setup, found: Sequence[Advice]) -> Result:
    """Advice as findings, the most important first, and a table."""
    able = [advice for advice in found if advice.own.ending != "unsupported"]
    others = [advice for advice in found if advice not in able]
    sentences = [overall(setup, able), *why_limited(setup, able), *(sentence(setup, advice) for advice in able)]
    sentences += [f"{advice.engine} cannot take this scene: {advice.own.reason}." for advice in others]
    if setup.changes:
        names = ", ".join(dict.fromkeys(change.parameter for change in setup.changes))
        sentences.insert(1, f"Limits are those of the scene as it starts; while it runs, this changes: {names}.")
    failures = [f"{a.engine}: {a.own.ending}, {a.own.reason}" for a in found if a.own.ending != "done"]
    table = Table("advice", COLUMNS, [_row(setup, advice) for advice in found])
    return Result(sentences, [table], {"advice": found, "setup": setup}, failures)


def overall(setup: Setup, able: Sequence[Advice]) -> str:
    """How many engines are stable at the scene's dt, and the step that is safe in all of them."""
    limited = [advice for advice in able if advice.limit is not None]
    if not able:
        return "No installed engine can take this scene."
    if not limited:
        reasons = list(dict.fromkeys(advice.measured.reason for advice in able))
        done = sum(advice.own.ending == "done" for advice in able)
        return (
            f"At dt = {setup.dt:g} s {done} of {len(able)} engine settings come to the scene's end. "
            f"For none was a limit measured: {'; '.join(reasons)}."
        )
    stable = [a for a in limited if setup.dt <= (a.limit or 0) and a.own.ending == "done"]
    start = f"At dt = {setup.dt:g} s {len(stable)} of {len(limited)} engine settings with a limit are stable here"
    steps = [advice.advised for advice in limited if advice.advised]
    if not steps:
        return f"{start}; no step is known to be safe."
    return f"{start}; {'all of them' if len(steps) == len(limited) else f'{len(steps)}'} are at dt = {min(steps):g} s."


def why_limited(setup: Setup, able: Sequence[Advice]) -> list[str]:
    """What limits the step, how many steps a frame takes, how much stiffer springs could be: of those that know."""
    said = []
    known = [advice for advice in able if advice.reasons is not None and advice.reasons.mode is not None]
    causes: dict[str, list[str]] = {}
    for advice in known:
        causes.setdefault(limited_by(advice), []).append(advice.engine)
    for cause, engines in causes.items():
        who = "the step" if len(causes) == 1 else ", ".join(engines)
        said.append(f"By theory {who} is limited by {cause}.")
    frames = [(a.substeps, a.engine) for a in able if a.substeps is not None]
    if frames:
        least, most = min(frames), max(frames)
        also = "" if least[0] == most[0] else f" ({least[1]}) to {most[0]} ({most[1]})"
        said.append(f"A frame of 1/{FRAMES} s takes {least[0]}{also} steps, each at {ADVISED:g} of the limit.")
    stiff = [(a.reasons.stiffest, a.engine) for a in able if a.reasons is not None and a.reasons.stiffest is not None]
    bounded = [(times, engine) for times, engine in stiff if 0 < times < float("inf")]
    if bounded:
        softest, stiffest = min(bounded), max(bounded)
        also = "" if softest[0] == stiffest[0] else f" ({softest[1]}) to {stiffest[0]:.3g} ({stiffest[1]})"
        said.append(
            f"With dt = {setup.dt:g} s all springs could be {softest[0]:.3g}{also} times as stiff, by theory, before "
            "that is the limit."
        )
    return said


def limited_by(advice: Advice) -> str:
    """The spring or the springs that the first mode to grow strains most; empty where that is not known."""
    if advice.reasons is None or advice.reasons.mode is None:
        return ""
    mode, system = advice.reasons.mode, advice.reasons.system
    if mode.shares[mode.spring] < MOSTLY:
        return f"a swing of many springs at {mode.frequency:.3g} Hz, half of its energy in {mode.springs} of them"
    a, b = system.springs[mode.spring]
    share = mode.shares[mode.spring]
    return (
        f"spring {mode.spring} (masses {a} and {b}, {system.stiffness[mode.spring]:g} N/m): {share:.0%} of the energy "
        f"of a swing at {mode.frequency:.3g} Hz"
    )


def sentence(setup: Setup, advice: Advice) -> str:
    """What one engine does at the scene's dt, and what to use."""
    name, dt, limit = advice.engine, setup.dt, advice.limit
    if advice.on_rods:
        name = f"{name}, which puts rods for springs,"
    if limit is None:
        ended = "comes to the scene's end" if advice.own.ending == "done" else f"{_bad(advice)} ({advice.own.reason})"
        theory = f"; {advice.predicted.dt:.2g} s is predicted" if advice.predicted.dt else ""
        use = f": use dt = {advice.advised:g} s or less" if advice.advised else ""
        return f"{name} at dt = {dt:g} s {ended}; no limit was measured ({advice.measured.reason}){theory}{use}."
    use = f"use dt = {advice.advised:g} s or less" if advice.advised else "no step is known to be safe"
    if dt > limit:
        ended = "comes to the scene's end, though" if advice.own.ending == "done" else f"{_bad(advice)}:"
        return f"{name} at dt = {dt:g} s {ended} it is {dt / limit:.2f} times the limit, {limit:.3g} s; {use}."
    if advice.own.ending != "done":
        said = f"{name} at dt = {dt:g} s {_bad(advice)}, though the limit at rest is {limit:.3g} s"
        return f"{said} ({advice.own.reason}): {use}."
    if ADVISED * limit < dt:
        return f"{name} at dt = {dt:g} s is stable, but only just, by {limit / dt - 1:.1%}: {use}."
    if advice.advised is None or advice.advised <= dt:
        said = f"{name} at dt = {dt:g} s is stable, at rest with margin {limit / dt:.2f}"
        return f"{said}; but the scene itself blows up with longer steps: {use}."
    return (
        f"{name} at dt = {dt:g} s is stable with margin {limit / dt:.2f}: its limit is {limit:.3g} s, and "
        f"dt = {advice.advised:g} s still works."
    )


def _bad(advice: Advice) -> str:
    return {"diverged": "blows up", "crashed": "crashes", "timed out": "takes too long"}[advice.own.ending]


def _row(setup: Setup, advice: Advice) -> list[object]:
    margin = None if advice.limit is None else advice.limit / setup.dt
    confirmed = advice.confirmed.ending if advice.confirmed else None
    grows = {None: None, True: "grow", False: "do not grow"}[advice.grows]
    reasons = [advice.own.reason, advice.predicted.remark, advice.measured.remark]
    said = "; ".join(dict.fromkeys(reason for reason in reasons if reason))
    limits = [advice.predicted.dt, advice.measured.dt]
    stiffest = advice.reasons.stiffest if advice.reasons else None
    why = [advice.substeps, limited_by(advice) or None, stiffest, said]
    named = [advice.engine, advice.scheme, ", ".join(advice.ties)]
    return [*named, advice.own.ending, margin, *limits, advice.advised, confirmed, grows, *why]
