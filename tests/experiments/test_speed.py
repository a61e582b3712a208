"""How speeds are taken: which meshes on how many threads, the least of some times, and what comes of them."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from experiments import speed
from experiments.speed import ROUNDS, WORK, Timing
from reference.errors import Unsupported
from reference.outcome import Outcome
from tests.conformance.doctored import Doctored


def timing(what: str, masses: int, threads: int = 1) -> Timing:
    """With nothing but what it is of."""
    return Timing(what, threads, masses, masses, 1.0, None, None)


def test_a_mesh_is_timed_on_all_threads_where_it_is_large(monkeypatch: pytest.MonkeyPatch) -> None:
    """From 2,000 masses on; on one in any case."""
    monkeypatch.setattr(speed, "_time_kernel", lambda name, system, threads: threads)
    monkeypatch.setattr(speed.os, "cpu_count", lambda: 6)
    assert speed.time_mesh("a", SimpleNamespace(masses=range(1_999))) == [1]  # type: ignore[arg-type,comparison-overlap]
    assert speed.time_mesh("a", SimpleNamespace(masses=range(2_000))) == [1, 6]  # type: ignore[arg-type,comparison-overlap]
    monkeypatch.setattr(speed, "_time_sweep", lambda systems, masses, threads: (systems, masses, threads))
    assert speed.time_sweep(7, 3) == [(7, 3, 1), (7, 3, 6)]
    monkeypatch.setattr(speed.os, "cpu_count", lambda: None)
    assert speed.time_sweep(7, 3) == [(7, 3, 1)]


def test_a_kernel_s_speed_is_that_of_its_least_time(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of ROUNDS: ours 4 ms, tuned C's 2 ms, the copy's 1 us a step, each in another round; memory for each mass."""
    system = SimpleNamespace(masses=range(100), springs=range(300))
    steps = WORK // 100
    ours, theirs, copies = (iter([9e-3] * i + [least] + [9e-3] * ROUNDS) for i, least in enumerate((4e-3, 2e-3, 1e-6)))
    advanced: list[int] = []
    kernel = SimpleNamespace(text="text", arrays="arrays", bytes=1600, advance=lambda dt, n: advanced.append(n))
    tuned = SimpleNamespace(advance=lambda dt, n: next(theirs))
    monkeypatch.setattr(speed, "Kernel", lambda *_: kernel)
    monkeypatch.setattr(speed, "_anchor", lambda _: tuned)
    monkeypatch.setattr(speed, "bytes_per_step", lambda text, arrays: 4800)
    monkeypatch.setattr(speed, "seconds_of", lambda task: (task(), next(ours))[1])
    monkeypatch.setattr(speed, "seconds_to_copy", lambda count, threads: next(copies))
    found = speed._time_kernel("mesh", system, 2)  # type: ignore[arg-type]
    assert (found.what, found.threads, found.masses, found.springs) == ("mesh", 2, 100, 300)
    assert found.ours == pytest.approx(100 * steps / 4e-3)
    assert found.tuned == pytest.approx(100 * steps / 2e-3)
    assert found.bound == pytest.approx(100 * steps / (steps * 1e-6))
    assert (found.bytes_per_mass, found.moved_per_mass) == (16, 48)
    assert advanced == [1, *[steps] * ROUNDS]
    ours, copies = iter([4e-3] * ROUNDS), iter([1e-6] * ROUNDS)
    monkeypatch.setattr(speed, "_anchor", lambda _: None)
    assert speed._time_kernel("mesh", system, 2).tuned is None  # type: ignore[arg-type]


def test_the_anchor_s_speed_is_its_best(monkeypatch: pytest.MonkeyPatch) -> None:
    """The shortest of its times; none where it cannot be built."""
    times = iter([4e-3, 2e-3, 9e-3, 9e-3, 9e-3, 9e-3])
    made: list[bool] = []

    def tuned(_: object, as_string: bool) -> SimpleNamespace:
        made.append(as_string)
        return SimpleNamespace(advance=lambda dt, n: next(times))

    monkeypatch.setattr(speed, "TunedHeun", tuned)
    system: Any = SimpleNamespace(masses=range(20))
    assert speed._anchor_speed(system) == pytest.approx(WORK / 2e-3)
    assert made == [True]

    def refuses(*_: object, **__: object) -> None:
        raise Unsupported("no compiler")

    monkeypatch.setattr(speed, "TunedHeun", refuses)
    assert speed._anchor_speed(system) is None


def test_what_it_takes_to_begin_is_no_part_of_a_sweep(monkeypatch: pytest.MonkeyPatch) -> None:
    """1 s, and 1 ms for each step: 5 systems of 3 masses in 200 steps take 0.2 s; the quicker of two times counts."""
    slower = iter([0.0, 5.0, 7.0, 0.0])
    monkeypatch.setattr(speed, "sweep", lambda system, heun, dt, count, threads: (count, threads))
    monkeypatch.setattr(speed, "seconds_of", lambda task: 1 + 1e-3 * task()[0] + next(slower))
    monkeypatch.setattr(speed, "_anchor_speed", lambda system: 3.0 * len(system.masses))
    found = speed._time_sweep(5, 3, 2)
    assert (found.what, found.threads, found.masses, found.springs) == ("sweep of 5 strings", 2, 3, 3)
    assert found.ours == pytest.approx(5 * 3 * 200 / 0.2)
    assert found.tuned == 12.0
    tries = iter([3.0, 2.0, *[4.0] * ROUNDS])
    monkeypatch.setattr(speed, "seconds_of", lambda task: next(tries))
    numpy = speed.time_numpy(3)
    assert (numpy.ours, numpy.tuned, numpy.masses, numpy.threads) == (3 * 2_000 / 2.0, 12.0, 3, 1)


def test_an_adapter_is_timed_on_ten_masses_and_on_a_hundred(monkeypatch: pytest.MonkeyPatch) -> None:
    """With its own step first; or why it was not."""
    monkeypatch.setattr(
        speed,
        "isolated",
        lambda f, engine, system, dt: (3e-3, 2e-3) if len(system.masses) > 11 else Outcome("crashed", "why"),
    )
    name = Doctored().name
    assert speed.time_adapter(Doctored()) == [
        [name, 10, None, None, None, "why"],
        [name, 100, 3e-3, 2e-3, 1.5, ""],
    ]


def test_all_that_is_timed_is_in_the_tables_in_turn(monkeypatch: pytest.MonkeyPatch) -> None:
    """Meshes with the memory of large ones, the renumbered string, the sweep, adapters, and NumPy last."""
    large = speed.LARGE
    made = {"small": large - 1, "large": large}
    renumbered: list[Any] = []

    def mesh(name: str, system: Any) -> list[Timing]:
        if name not in made:
            renumbered.append(system)
        return [timing(name, made.get(name, 201)), timing(name, made.get(name, 201), 2)]

    monkeypatch.setattr(speed, "cases", lambda: {name: (lambda: None) for name in made})
    monkeypatch.setattr(speed, "time_mesh", mesh)
    monkeypatch.setattr(speed, "peak_per_mass", lambda name: 7.0 if name == "large" else -1.0)
    monkeypatch.setattr(speed, "time_sweep", lambda: [timing("sweep", 20)])
    monkeypatch.setattr(speed, "time_numpy", lambda: timing("NumPy", 20))
    monkeypatch.setattr(speed, "registry", lambda: {"a": "an engine", "b": "another"})
    monkeypatch.setattr(speed, "time_adapter", lambda engine: [[engine, 10], [engine, 100]])
    monkeypatch.setattr(speed, "result_of", lambda *given: given)
    rows, adapters = speed.run(lambda _: None)  # type: ignore[misc]
    found = [(row.what, row.threads, row.peak_per_mass) for row in rows]  # type: ignore[attr-defined]
    assert found == [
        ("small", 1, None),
        ("small", 2, None),
        ("large", 1, 7.0),
        ("large", 2, 7.0),
        ("string 200, renumbered at random", 1, None),
        ("string 200, renumbered at random", 2, None),
        ("sweep", 1, None),
        ("NumPy", 1, None),
    ]
    assert adapters == [["an engine", 10], ["an engine", 100], ["another", 10], ["another", 100]]  # type: ignore[comparison-overlap]
    (string,) = renumbered
    assert string.fixed[0]
    assert np.abs(np.diff(string.springs, axis=1)).max() > 1
