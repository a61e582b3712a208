"""What is said of what was derived: at which dt, where that is not the same at every dt."""

from __future__ import annotations

from engines.own.stepper import stepper_of
from reference.derivation.explanation import explain
from report.derived import property_lines, sections
from tests.reference.derivation.test_over_dts import told


def test_what_is_derived_at_one_dt_is_marked_with_it() -> None:
    """Heun up to 0.05 s, Euler above: the tableau, the matrix and the order are Euler's, and no limits follow."""
    found = told(lambda dt: dt <= 0.05)
    assert found.limits == (None, None)
    titles = [title for title, _ in sections(found) if title.startswith("Derived")]
    assert len(titles) == 3
    assert all(title.endswith((", at dt = 0.0625 s", ", at dt = 0.25 and 0.125 s")) for title in titles)
    lines = list(property_lines(found))
    assert any(line.startswith("Order 1, by the conditions on its tableau, at dt = 0.25 and") for line in lines)
    assert not any(line.startswith(("Stable", "Unstable")) for line in lines)


def test_periods_are_marked_too() -> None:
    """Drift-kick below 0.01 s, kick-drift above: the periods told are those of kick-drift, at 0.0625 s."""

    def step(x, v, dt, system):  # type: ignore[no-untyped-def]
        a = system.acceleration(x, v)
        drifted = x + dt * v if dt < 1e-2 else x
        v = v + dt * (system.acceleration(drifted, v) if dt < 1e-2 else a)
        return (drifted, v) if dt < 1e-2 else (x + dt * v, v)

    found = explain(stepper_of(step))
    assert found.identification.identified_as == "drift_kick"
    periods = [line for line in property_lines(found) if line.startswith("At h w")]
    assert periods
    assert all(line.endswith(", at dt = 0.0625 s") for line in periods)
