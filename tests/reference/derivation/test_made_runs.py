"""What is derived of runs that are made here, from 2 x 2 matrices and errors of one's own choosing."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction

import numpy as np
import pytest

from reference.derivation.explanation import _rounds_to_single, _swapped
from reference.derivation.fit import Samples
from reference.derivation.formula import ONE, Formula
from reference.derivation.oscillators import ASIDE, DT, Run, Runs, end_of, matrices_at, oscillator, rows_of_steps
from reference.derivation.pasts import MANY, after_many, pasts
from reference.derivation.seen import NOTHING, forces_of
from reference.derivation.step_matrix import COARSER, RODS, SOFTER, StepMatrix, step_matrix
from reference.derivation.substeps import as_whole, of_substeps
from reference.derivation.swings import are_rods, swing_matrices
from reference.errors import Unsupported
from reference.outcome import Outcome
from reference.state import Array, Trajectory
from reference.system import MassSpringSystem

#: m11, m12, m21, m22 from a, b and d, each shape (n,).
Rule = Callable[[Array, Array, Array], Sequence[Array | float]]


def kick_drift(a: Array, b: Array, d: Array) -> Sequence[Array | float]:
    """As textbooks have it."""
    return 1 - a, 1 - b - d, -a, 1 - b - d


def runs_of(rule: Rule, refused: Callable[[MassSpringSystem], str] = lambda system: "") -> Runs:
    """A stepper that multiplies (x, h v) of oscillators by the matrix of a rule, under gravity; some it refuses."""

    def run(asked: Run) -> Outcome:
        system, h, steps = asked
        if reason := refused(system):
            return Outcome("unsupported", reason)
        mass = system.masses[1::2]
        a, b, d = system.stiffness * h**2 / mass, system.damping * h / mass, system.drag * h / mass
        entries = [np.broadcast_to(entry, a.shape) for entry in rule(a, b, d)]
        matrices = np.stack(entries, axis=1).reshape(-1, 2, 2)
        x, v = [system.start.positions], [system.start.velocities]
        for _ in range(steps):
            now = np.stack([-1.0 - x[-1][1::2, 0], -h * v[-1][1::2, 0]], axis=1)
            moved = (matrices @ now[:, :, None])[:, :, 0] - system.gravity[0] * h**2
            x.append(x[0].copy())
            v.append(v[0].copy())
            x[-1][1::2, 0], v[-1][1::2, 0] = -1.0 - moved[:, 0], -moved[:, 1] / h
        return Outcome("done", "", Trajectory(h * np.arange(steps + 1.0), np.stack(x), np.stack(v)))

    return lambda asked: [run(each) for each in asked]


def together(system: MassSpringSystem) -> str:
    """For who steps one mass only."""
    return "one mass only" if len(system.masses) > 2 else ""


def resisted(system: MassSpringSystem) -> str:
    """For who knows neither damping nor drag."""
    return "nothing resists" if system.damping.any() or np.any(system.drag) else ""


# --- Step matrices ---


def test_a_matrix_is_seen_side_by_side_and_one_by_one() -> None:
    """The same from both; of another at another h with the same a, b and d that h is told."""
    text = [["1 - a", "1 - b - d"], ["-a", "1 - b - d"]]
    for refused in (lambda system: "", together):
        found = step_matrix(runs_of(kick_drift, refused))
        assert (found.text(), found.damped, found.dragged, found.only_at) == (text, True, True, None)
        assert (found.softer, found.coarser, found.substeps, found.left_out) == (1.0, 1.0, 1, ())
    unlike = Samples(np.array([0.5, 1.5]), np.array([0.25, 0.5]), np.array([0.125, 0.75]))
    expected = np.stack(np.broadcast_arrays(*kick_drift(unlike.a, unlike.b, unlike.d)), axis=1).reshape(2, 2, 2)
    for refused in (lambda system: "", together):
        measured = matrices_at(runs_of(kick_drift, refused), unlike)
        np.testing.assert_allclose(measured, expected, atol=1e-14)
        rows = rows_of_steps(runs_of(kick_drift, refused), unlike, 3)
        assert rows.shape == (2, 4, 2)
        np.testing.assert_allclose(rows[:, 3], np.linalg.matrix_power(expected, 3)[:, 0].T, atol=1e-14)


def test_an_oscillator_is_what_it_says() -> None:
    """A mass of 1 kg, displaced and moving away from its anchor, which is held; its numbers are over dt."""
    system = oscillator(0.5, 0.25, 0.125, x=0.03, v=0.7, dt=0.5, gravity=-9.81)
    assert (system.fixed.tolist(), system.masses.tolist(), system.springs.tolist()) == ([True, False], [1, 1], [[0, 1]])
    assert (system.positions.tolist(), system.start.velocities.tolist()) == ([[0.0], [-1.03]], [[0.0], [-0.7]])
    assert (system.stiffness.tolist(), system.damping.tolist(), system.drag) == ([2.0], [0.5], 0.25)
    assert (system.rest_lengths.tolist(), system.gravity.tolist()) == ([1.0], [-9.81])


@pytest.mark.rotating(3, in_turn=True)
def test_what_is_refused_is_told_and_the_rest_is_seen() -> None:
    """Drag alone; damping and drag together; oscillators side by side, where many are needed one by one."""
    found = step_matrix(runs_of(kick_drift, lambda system: "no drag" if np.any(system.drag) else ""))
    assert (found.damped, found.dragged) == (True, False)
    assert found.left_out == ("no drag in its step matrix: no drag",)
    assert found.text() == [["1 - a", "1 - b"], ["-a", "1 - b"]]
    undamped = step_matrix(runs_of(kick_drift, lambda system: "no damping" if system.damping.any() else ""))
    assert (undamped.damped, undamped.dragged) == (False, True)
    assert undamped.left_out == ("no damping in its step matrix: no damping",)
    assert undamped.text() == [["1 - a", "1 - d"], ["-a", "1 - d"]]
    neither = step_matrix(runs_of(kick_drift, resisted))
    assert (neither.damped, neither.dragged, neither.text()) == (False, False, [["1 - a", "1"], ["-a", "1"]])
    assert neither.left_out == ("no damping and no drag in its step matrix: nothing resists",)
    each = lambda s: "its springs do not" if s.damping.any() else "no air" if np.any(s.drag) else ""  # noqa: E731
    assert step_matrix(runs_of(kick_drift, each)).left_out == (
        "no damping in its step matrix: its springs do not",
        "no drag in its step matrix: no air",
    )
    falling = step_matrix(runs_of(kick_drift, lambda system: "" if system.gravity.any() else "only under gravity"))
    assert (falling.damped, falling.dragged, falling.text()) == (False, False, [["1 - a", "1"], ["-a", "1"]])
    both = lambda system: "not both" if system.damping.any() and np.any(system.drag) else ""  # noqa: E731
    assert step_matrix(runs_of(kick_drift, both)).left_out == ("no drag in its step matrix: not both",)

    def fourth(a: Array, b: Array, d: Array) -> Sequence[Array | float]:
        z = np.zeros((len(a), 2, 2))
        z[:, 0, 1], z[:, 1, 0], z[:, 1, 1] = 1.0, -a, -b - d
        powers = [np.broadcast_to(np.eye(2), z.shape), z, z @ z / 2, z @ z @ z / 6, z @ z @ z @ z / 24]
        return list(np.stack(powers).sum(axis=0).reshape(-1, 4).T)

    many = step_matrix(runs_of(fourth, together))
    assert many.text()[0][0].startswith("1 - a/2 + a b/6 + a d/6 + a^2/24")
    assert (many.exact, len(many.samples.a)) == (True, 160)


def test_a_step_that_cannot_be_halved_is_not_said_to_ask_for_h() -> None:
    """What it would do at half of it nobody knows."""
    stiff = lambda system: "too stiff" if system.stiffness.max() > 2.1 / DT**2 else ""  # noqa: E731
    by_h = lambda a, b, d: (1.0, 1.0, -a, 1.0 - b - d)  # noqa: E731
    assert step_matrix(runs_of(by_h, stiff)).only_at is None


@pytest.mark.rotating(3, in_turn=True)
def test_a_matrix_of_few_digits_is_seen_coarsely() -> None:
    """Off by 1e-10, as what is differenced is: its fractions are found all the same, and that it is so is told."""

    def rough(a: Array, b: Array, d: Array) -> Sequence[Array | float]:
        return [np.asarray(entry) + 1e-10 * np.sin(1e6 * a + i) for i, entry in enumerate(kick_drift(a, b, d))]

    found = step_matrix(runs_of(rough, resisted))
    assert (found.text()[0], found.coarser, found.softer) == (["1 - a", "1"], COARSER, 1.0)
    with pytest.raises(Unsupported, match="to the digits of single precision"):
        step_matrix(runs_of(lambda a, b, d: (np.sqrt(1 + 40 * a), 1.0, -a, 1.0), resisted), "single")


@pytest.mark.rotating(3, in_turn=True)
def test_a_matrix_of_soft_springs_only_is_seen_of_these() -> None:
    """As of iterations that converge there only; but not where its numbers are no fractions there."""

    def of(factor: float) -> Rule:
        def soft(a: Array, b: Array, d: Array) -> Sequence[Array | float]:
            return np.where(a <= 0.25, 1 - factor * a, np.cos(9 * a)), 1.0, -a, 1 - b - d

        return soft

    found = step_matrix(runs_of(of(0.5), resisted))
    assert (found.text(), found.softer, found.coarser) == ([["1 - a/2", "1"], ["-a", "1"]], SOFTER, 1.0)
    with pytest.raises(Unsupported, match=r"no small rational function of a, b and d gives m11 of its step matrix$"):
        step_matrix(runs_of(of(0.123456789), resisted))


@pytest.mark.parametrize(
    ("rule", "said"),
    [
        (lambda a, b, d: (1e4 * a, 1.0, -a, 1.0), "a step multiplies an oscillator by up to 2e"),
        (lambda a, b, d: (1.0, 0.0, 0.0, 1.0), "a step changes nothing"),
        (lambda a, b, d: (1.0, 1.0, 0.0, 1.0), RODS),
        (lambda a, b, d: (np.cos(a**0.5), np.sin(a**0.5) / a**0.5, np.sin(a), 2.0), "gives m11, m12, m21 of its step"),
    ],
)
def test_why_there_is_no_matrix(rule: Rule, said: str) -> None:
    """It diverges; it changes nothing; nothing depends on stiffness; some entries follow no formula."""
    with pytest.raises(Unsupported, match=said):
        step_matrix(runs_of(rule, lambda system: "one axis only" if system.dimension > 1 else resisted(system)))


@pytest.mark.rotating(3, in_turn=True)
def test_a_true_motion_is_told_as_that() -> None:
    """Of undamped oscillators: cosine and sine of the root of a, to 1e-16."""

    def true(a: Array, b: Array, d: Array) -> Sequence[Array | float]:
        w = np.sqrt(a)
        return np.cos(w), np.sin(w) / w, -w * np.sin(w), np.cos(w)

    with pytest.raises(Unsupported, match=r"a step is an oscillator's true motion, to .* of it"):
        step_matrix(runs_of(true, resisted))


def test_sub_steps_are_taken_apart() -> None:
    """Three of kick-drift, in a/9 and b/3: the matrix of one, and the whole again."""
    at = Samples(*(np.random.default_rng(2).uniform(0.05, 0.9, (3, 60))))
    one = np.stack(np.broadcast_arrays(*kick_drift(at.a / 9, at.b / 3, at.d / 3)), axis=1).reshape(-1, 2, 2)
    whole = as_whole(one, 3)
    # (x, h v) in place of (x, h v/3)
    scale = np.diag([1.0, 3.0])
    np.testing.assert_allclose(whole, scale @ one @ one @ one @ np.linalg.inv(scale), atol=1e-14)
    found = of_substeps(at, whole, 1e-13)
    assert found is not None
    assert (found[0], [str(entry) for entry in found[1]]) == (3, ["1 - a", "1 - b - d", "-a", "1 - b - d"])
    assert of_substeps(at, whole, 1e-13, counts=(4, 2)) is None
    assert of_substeps(at, np.where(whole == whole[0, 0, 0], np.inf, whole), 1e-13) is None
    # one eigenvector only: nothing is told of roots
    assert of_substeps(at, np.tile([[1.0, 1.0], [0.0, 1.0]], (60, 1, 1)), 1e-13) is None


def test_forces_are_not_looked_for_where_stiffness_is_divided_by() -> None:
    """In whichever entry: the runs are not asked for."""

    def none(asked: Sequence[Run]) -> list[Outcome]:
        raise AssertionError

    a = (1, 0, 0, 0, 0)
    plain, divided = Formula({ONE: Fraction(1)}), Formula({ONE: Fraction(1)}, {ONE: Fraction(1), a: Fraction(1)})
    at = Samples(np.zeros(1), np.zeros(1), np.zeros(1))
    for i in range(4):
        m11, m12, m21, m22 = (divided if i == j else plain for j in range(4))
        reasons: list[str] = []
        matrix = StepMatrix((m11, m12, m21, m22), False, False, at, np.zeros((1, 2, 2)))
        assert (forces_of(none, matrix, reasons), reasons) == (NOTHING, [])


# --- Swings ---


def pendulum(rule: Rule, by_stiffness: float = 0.0) -> Runs:
    """A stepper of rods: (q, h q') of a mass under gravity is multiplied; a stiffness may add to the angle."""

    def run(asked: Run) -> Outcome:
        system, h, steps = asked
        if system.dimension == 1:
            return Outcome("unsupported", "no motion along a line")
        a, d = -system.gravity[1] * h**2, system.drag * h
        m11, m12, m21, m22 = (float(entry) for entry in rule(a, 0.0, d))  # type: ignore[arg-type]
        x, v = system.positions.copy(), system.start.velocities.copy()
        q, rate = np.arctan2(x[1, 0], -x[1, 1]), v[1] @ [-x[1, 1], x[1, 0]]
        path = [(x, v)]
        for _ in range(steps):
            q, rate = m11 * q + m12 * h * rate + by_stiffness * system.stiffness[0], (m21 * q + m22 * h * rate) / h
            there = np.array([[0.0, 0.0], [np.sin(q), -np.cos(q)]])
            path.append((there, rate * np.array([[0.0, 0.0], [np.cos(q), np.sin(q)]])))
        places, speeds = (np.stack(each) for each in zip(*path, strict=True))
        return Outcome("done", "", Trajectory(h * np.arange(steps + 1.0), places, speeds))

    return lambda asked: [run(each) for each in asked]


@pytest.mark.rotating(3, in_turn=True)
def test_small_swings_have_the_matrix_that_a_pendulum_is_multiplied_by() -> None:
    """Of angles and rates, at a = h^2 g/L and d; who moves by a stiffness is no rod."""
    at = Samples(np.array([0.5, 1.5]), np.zeros(2), np.array([0.25, 0.75]))
    lopsided: Rule = lambda a, b, d: (1 - a, 1 - d, -a / 2, 1 - 2 * d)  # noqa: E731
    expected = np.stack(np.broadcast_arrays(*lopsided(at.a, at.b, at.d)), axis=1).reshape(2, 2, 2)
    np.testing.assert_allclose(swing_matrices(pendulum(lopsided), at), expected, atol=1e-11)
    found = step_matrix(pendulum(lopsided))
    assert (found.of_swings, found.damped, found.dragged) == (True, False, True)
    assert found.text() == [["1 - a", "1 - d"], ["-a/2", "1 - 2 d"]]
    with pytest.raises(Unsupported, match="no motion along a line"):
        step_matrix(pendulum(lopsided, 1e-12))
    assert are_rods(pendulum(lopsided))
    assert not are_rods(pendulum(lopsided, 1e-12))


# --- Velocities that are not told ---


def untold(runs: Runs, where: tuple[int, ...]) -> Runs:
    """The same, one of whose velocities is no number."""

    def spoiled(asked: Sequence[Run]) -> list[Outcome]:
        outcomes = runs(asked)
        for outcome in outcomes:
            assert outcome.trajectory is not None
            outcome.trajectory.velocities[where] = np.nan
        return outcomes

    return spoiled


def test_a_velocity_that_is_no_number_is_none() -> None:
    """One of two is enough; the reason is the run's own where it has one."""
    bad = untold(runs_of(kick_drift), (-1, 1, 0))
    (outcome,) = bad([Run(oscillator(0.5, 0.0, 0.0, ASIDE), DT)])
    with pytest.raises(Unsupported, match=r"^it tells no velocities$"):
        end_of(outcome)
    with pytest.raises(Unsupported, match=r"^it blew up$"):
        end_of(Outcome("diverged", "it blew up", outcome.trajectory))
    with pytest.raises(Unsupported, match=r"^it tells no velocities$"):
        pasts(bad, "double", damped=False, dragged=False)
    with pytest.raises(Unsupported, match=r"^it crashed$"):
        pasts(lambda asked: [Outcome("crashed", "it crashed")] * len(asked), "double", damped=True, dragged=True)


def test_a_position_that_is_no_number_is_none() -> None:
    """As of a velocity; and a run that ends before its steps are made has none to look at."""

    def spoiled(asked: Sequence[Run]) -> list[Outcome]:
        outcomes = runs_of(kick_drift)(asked)
        for outcome in outcomes:
            assert outcome.trajectory is not None
            outcome.trajectory.positions[-1, 1, 0] = np.nan
        return outcomes

    def short(asked: Sequence[Run]) -> list[Outcome]:
        return runs_of(kick_drift)([run._replace(steps=1) for run in asked])

    (outcome,) = spoiled([Run(oscillator(0.5, 0.0, 0.0, ASIDE), DT)])
    with pytest.raises(Unsupported, match=r"^it tells no positions$"):
        end_of(outcome)
    for runs in (spoiled, short):
        with pytest.raises(Unsupported, match=r"^it tells no "):
            pasts(runs, "double", damped=False, dragged=False)


# --- Pasts ---


def counting(first: int) -> Runs:
    """Kick-drift, but for a hundredth of the displacement from a step of a run on."""

    def runs(asked: Sequence[Run]) -> list[Outcome]:
        outcomes = runs_of(kick_drift)(asked)
        for outcome in outcomes:
            assert outcome.trajectory is not None
            outcome.trajectory.positions[first:, 1] += 0.01 * ASIDE
        return outcomes

    return runs


def test_a_memory_of_many_steps_is_seen_after_many() -> None:
    """What a step does after a thousand others: not among the first five, and by a hundredth then."""
    few = pasts(counting(MANY), "double", damped=False, dragged=False)
    assert (few.one_step, few.steps, few.apart) == (True, 5, 0.0)
    many = after_many(counting(MANY), "double", few)
    assert (many.one_step, many.deterministic, many.steps) == (False, True, MANY)
    assert many.apart == pytest.approx(0.01, rel=1e-6)
    none = after_many(runs_of(kick_drift), "double", few)
    assert (none.one_step, none.apart, none.steps) == (True, 0.0, MANY)
    assert after_many(runs_of(lambda a, b, d: (1.1, 0.0, 0.0, 1.1)), "double", few) == few  # it grows too far


# --- What is looked at before all ---


def test_numbers_of_single_precision_are_seen_as_such() -> None:
    """All of them; one of two that is not, or is nothing, tells nothing."""

    def single(which: str) -> Runs:
        def runs(asked: Sequence[Run]) -> list[Outcome]:
            outcomes = runs_of(kick_drift)(asked)
            for outcome in outcomes:
                assert outcome.trajectory is not None
                for name in which.split():
                    values = getattr(outcome.trajectory, name)
                    values[:] = values.astype(np.float32)
            return outcomes

        return runs

    assert _rounds_to_single(single("positions velocities"))
    assert not _rounds_to_single(single("positions"))
    assert not _rounds_to_single(single("velocities"))
    assert not _rounds_to_single(runs_of(lambda a, b, d: (0.0, 0.0, 0.0, 0.0)))
    assert not _rounds_to_single(lambda asked: [Outcome("crashed", "gone")])


@pytest.mark.parametrize(
    ("place", "speed", "swapped"), [(0.0, -1.0, True), (0.0, 0.0, False), (-1.0, -1.0, False), (-1.0, 0.0, False)]
)
def test_an_exchanged_pair_is_seen_from_rest(place: float, speed: float, swapped: bool) -> None:
    """Where the velocity stands, and the position: both."""
    x, v = np.array([[[0.0], [-1.0]], [[0.0], [place]]]), np.array([[[0.0], [0.0]], [[0.0], [speed]]])
    assert _swapped(Outcome("done", "", Trajectory(np.array([0.0, DT]), x, v))) == swapped
    assert not _swapped(Outcome("done", "", Trajectory(np.array([0.0]), x[:1], v[:1])))
    assert not _swapped(Outcome("crashed", "gone"))
