"""What the page says of a lab in sentences, and which step it offers after a blow-up."""

from __future__ import annotations

from experiments.advice.advice import rounded_down
from report.live.lab import Lab
from report.live.own_files import opened
from report.live.prediction import MS, Prediction


def suggestion(lab: Lab) -> float | None:
    """A dt [s] that is stable for all lanes; None where nothing blew up, or a shorter step would not help."""
    blown = {lane.name for lane in lab.timeline.lanes if lane.blown_up}
    limits = {name: prediction.limit for name, prediction in lab.predictions.items()}
    if not blown or any(limits.get(name) is None for name in blown):
        return None
    dt = rounded_down(0.9 * min(limit for limit in limits.values() if limit is not None))
    return dt if dt < lab.timeline.dt else None


def status(lab: Lab, company: str) -> str:
    """Time, limits and who is looking, in sentences."""
    timeline = lab.timeline
    said = [f"{timeline.opened.stem}, t = {timeline.time:.3f} s{'' if lab.playing else ', paused'}."]
    said += [_limit(name, prediction, timeline.dt) for name, prediction in lab.predictions.items()]
    if timeline.grabbed is not None:
        said.append(f"Mass {timeline.grabbed} hangs on the cursor.")
    why_not = timeline.reference.why_not
    if why_not:
        said.append(f"{why_not[0].upper()}{why_not[1:]}.")
    return " ".join([*said, company])


def _limit(name: str, prediction: Prediction, dt: float) -> str:
    if name in opened() and prediction.scheme != name:
        name = f"{name}, identified as {prediction.scheme} on a string"
    if prediction.limit is None:
        return f"{name}: {prediction.reason}."
    part = dt / prediction.limit
    return f"{name}: dt is {part:.2f} of the predicted largest stable dt, {prediction.limit / MS:.4g} ms."
