"""Predicted limits of random systems against the dense eigenvalues of whole steps, which know nothing of the theory."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
from scipy.linalg import eig

from experiments.limits.limit_rows import Row, stability_rows
from experiments.runs.steppers import all_steppers
from reference.errors import SolverError
from reference.limit import Limit
from reference.schemes.catalogue import Scheme, schemes
from reference.state import Array
from reference.system import MassSpringSystem
from reference.theory.equilibria import Equilibrium, spring_equilibrium
from reference.theory.limits import SOLVED, stability_limit
from reference.theory.rates import Rates, rates
from reference.theory.runge_kutta import stability_polynomial
from reference.theory.step_map import resisted, step_jacobian

#: What a Jacobian that is differenced is wrong by; and growth that counts as none in the search itself (`EXACT` there;
#: `DIFFERENCED` of impulses in rounds, where motion is that nothing resists).
DIFFERENCED, NONE, ROUGHLY = 1e-9, 1e-11, 1e-8

#: Growth that is no rounding, away from a limit: of a Jacobian that is exact, and of one that is differenced.
ROUNDING = {True: 1e-9, False: 1e-7}

#: Parts of a limit well below it, at which nothing grows.
BELOW = (0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.97, 0.999)

#: How near to a limit dense eigenvalues are asked, as a part of it: as near as they can tell, 1e-8 at first. Further
#: off only in steps of less than SHORT of the fastest 1/w, where growth is lost beside 1.
APART, FURTHER, SHORT = (1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2), (0.1, 1.0), 2e-2


def random_system(seed: int) -> MassSpringSystem:
    """In two or three dimensions, with parts that nothing holds, with damping, drag and gravity or without."""
    rng = np.random.default_rng(seed)
    n, d = int(rng.integers(2, 9)), 2 + seed % 2
    positions = rng.normal(size=(n, d))
    pairs = rng.permutation([(i, j) for i in range(n) for j in range(i)])
    springs = pairs[: int(rng.integers(1, min(len(pairs), 3 * n) + 1))]
    s = len(springs)
    damped, dragged, heavy, held = rng.random(4) < [0.5, 0.5, 0.5, 0.8]
    fixed = np.arange(n) < (int(rng.integers(1, 3)) if held else 0)
    fixed[-1] = False
    lengths = np.linalg.norm(np.diff(positions[springs], axis=1)[:, 0], axis=1)
    return MassSpringSystem(
        positions=positions,
        springs=springs,
        masses=rng.uniform(0.1, 2, n),
        rest_lengths=lengths * rng.uniform(0.7, 1.2, s),
        stiffness=rng.uniform(5, 200, s) * (rng.random(s) > (0.0 if damped else 0.05)),
        damping=10 ** rng.uniform(-2, 1) * rng.random(s) * damped,
        drag=10 ** rng.uniform(-2, 1) * dragged,
        gravity=np.array(9.81 * heavy),
        fixed=fixed,
    )


def excess(scheme: Scheme, rest: Equilibrium, found: Rates, dt: float) -> float:
    """Growth in a step, from all eigenvalues of its Jacobian."""
    jacobian: Array = step_jacobian(scheme, rest, dt)
    values = resisted(np.linalg.eigvals(jacobian).astype(complex), found.unresisted, dt * found.fastest)
    return float(np.abs(values).max(initial=0.0) - 1)


def excess_and_error(scheme: Scheme, rest: Equilibrium, found: Rates, dt: float) -> tuple[float, float]:
    """Growth in a step, and by how much the eigenvalues near the unit circle can be wrong.

    An eigenvalue with left and right eigenvectors y, x of length one moves by |E| / |y* x| at most, to first order,
    where J is wrong by E; and by sqrt(|J| |E|) where it meets another one and that is less (Golub and Van Loan, *Matrix
    Computations* (2013), 7.2.2 and 7.2.3). E is n roundings of J, or what differences leave.
    """
    jacobian: Array = step_jacobian(scheme, rest, dt)
    values, left, right = eig(jacobian, left=True, right=True)
    apart = np.maximum(np.abs(np.einsum("ji,ji->i", left.conj(), right)), 1e-300)
    size = float(np.linalg.norm(jacobian, 2))
    wrong = len(jacobian) * float(np.finfo(float).eps) * size + (0.0 if scheme.linear else DIFFERENCED)
    errors = np.minimum(wrong / apart, np.sqrt(size * wrong))
    kept = resisted(values.astype(complex), found.unresisted, dt * found.fastest)
    among = np.isin(values, kept) & (np.abs(values) > 1 - 1e-3)
    return float(np.abs(kept).max(initial=0.0) - 1), float(errors[among].max(initial=wrong))


def is_torn_apart(scheme: Scheme, found: Rates) -> bool:
    """Whether a step in place may let motion grow that nothing resists: told from rounding by TORN_APART only."""
    return scheme.needs == "accelerations of one mass" and found.unresisted > 0


def told_apart(limit: Limit, scheme: Scheme, rest: Equilibrium, found: Rates) -> float:
    """How near to a limit dense eigenvalues tell stable from unstable; they tell it as the limit does.

    Just above the limit growth is more than error; just as near below, it is not.
    """
    assert limit.dt is not None
    searched = limit.certainty != "certified" and stability_polynomial(scheme) is None
    roughly = scheme.iterated and found.unresisted > 0
    none = (ROUGHLY if roughly else NONE) * max(1.0, limit.dt * found.fastest) if searched else 0.0
    short = limit.dt * found.fastest < SHORT or is_torn_apart(scheme, found)
    for apart in (*APART, *(FURTHER if short else ())):
        above, error = excess_and_error(scheme, rest, found, (1 + apart) * limit.dt)
        if above <= 2 * (error + none):
            continue
        below, error = excess_and_error(scheme, rest, found, limit.dt / (1 + apart))
        assert below <= 2 * (error + none), f"{scheme.name}: unstable at 1/{1 + apart:.10g} of its limit"
        return apart
    assert short, f"{scheme.name}: nothing grows above its limit"
    return np.inf


def check_limit(limit: Limit, scheme: Scheme, rest: Equilibrium, found: Rates) -> float | None:
    """Nothing grows below the limit, something does above; without a limit, something at all dt, or nothing at any.

    Returns:
        How near to the limit that could be told, as a part of it; None where there is none.
    """
    if found.fastest == 0:
        assert limit.reason == "nothing moves"
        return None
    rounding = ROUNDING[scheme.linear]
    if limit.dt is None:
        some = [excess(scheme, rest, found, part / found.fastest) for part in (0.03, 0.1, 0.3, 1.0, 3.0)]
        if limit.growth is not None:
            assert max(some) > 1e-12
        elif limit.reason.startswith("stable"):
            assert max(some) < 10 * rounding
        else:
            assert limit.reason.startswith(("nothing moves", "no stable step", "not computed"))
        return None
    for dt in (part * limit.dt for part in BELOW):
        if excess(scheme, rest, found, dt) > rounding:
            # in short steps slow modes are nearer to 1 than rounding tears pairs of eigenvalues apart
            growth, error = excess_and_error(scheme, rest, found, dt)
            assert growth <= 2 * error, f"{scheme.name}: unstable at {dt / limit.dt:.4g} of its limit"
    return told_apart(limit, scheme, rest, found)


def checked(seed: int) -> Iterator[tuple[Scheme, Equilibrium, Rates, Limit]]:
    """Every scheme on one random system; none where it creeps for ever."""
    try:
        rest = spring_equilibrium(random_system(seed))
    except SolverError:
        return
    found = rates(rest)
    for scheme in schemes().values():
        # what is damped until nothing counts is not linear in small perturbations
        if scheme.name in SOLVED:
            continue
        limit = stability_limit(scheme, rest, found)
        if not limit.note:  # its Jacobian drowns in rounding too
            yield scheme, rest, found, limit


@pytest.mark.rotating(7)
@pytest.mark.parametrize("seed", range(8))
def test_limits_are_those_of_dense_eigenvalues(seed: int) -> None:
    """By every scheme, on systems that share nothing. A larger sample, 300, is `make soak`'s."""
    for scheme, rest, found, limit in checked(seed):
        check_limit(limit, scheme, rest, found)


@pytest.mark.rotating(2)
@pytest.mark.parametrize("part", [0.9, 1.1])
def test_a_limit_that_is_off_is_caught(part: float) -> None:
    """Shown to fail: ten per cent too short or too long, of the schemes that have a limit."""
    caught = 0
    for scheme, rest, found, limit in checked(4):
        if limit.dt is None or is_torn_apart(scheme, found):
            continue
        with pytest.raises(AssertionError):
            check_limit(Limit(part * limit.dt), scheme, rest, found)
        caught += 1
    assert caught >= 5


def test_many_more_systems(request: pytest.FixtureRequest) -> None:
    """300, under --full."""
    if not request.config.getoption("--full"):
        pytest.skip("--full looks at 300 systems")
    for seed in range(300):
        for scheme, rest, found, limit in checked(seed):
            check_limit(limit, scheme, rest, found)


#: What schemes are called among steppers.
SCHEMES = ("scheme", "in_place", "engine_scheme")

#: A limit is measured to 4e-5 of itself by a scheme's runs, 1e-4 by an engine's: it is between two of its rungs, and
#: growth is seen a little beyond.
MEASURED, BY_ENGINES = 1e-4, 1.5e-4


def check_measured(row: Row) -> bool:
    """Within MEASURED of what is predicted; or it says why it could not be measured.

    Returns:
        Whether it was.
    """
    # what an iteration that stops early leaves of the damping moves limits: by five in a hundred, it was seen
    if row.outcome == "unsupported" or not row.predicted.exact or row.stepper in SOLVED:
        return False
    assert row.outcome == "done", f"{row.stepper} {row.outcome}: {row.measured.reason}"
    if row.relative_difference is None:
        assert row.predicted.dt is not None
        too_slow = row.measured.reason.startswith("not measured") or "in longer runs" in row.measured.reason
        assert too_slow, f"{row.stepper}: predicted {row.predicted.dt:.6g} s, measured {row.measured.remark}"
        return False
    allowed = BY_ENGINES if row.kind == "engine" else MEASURED
    assert abs(row.relative_difference) < allowed, f"{row.stepper}: {row.relative_difference:.2g} off"
    return True


def measured(seed: int, kinds: tuple[str, ...]) -> int:
    """How many limits of steppers were measured as predicted on one random system; none where it creeps for ever."""
    steppers = [stepper for stepper in all_steppers().values() if stepper.kind in kinds]
    try:
        rows = stability_rows(random_system(seed), steppers, lambda _: None)
    except SolverError:
        return 0
    return sum(check_measured(row) for row in rows)


@pytest.mark.rotating(5)
@pytest.mark.parametrize(("seed", "kinds"), [(0, SCHEMES), (1, SCHEMES), (0, ("engine",))])
def test_measured_limits_are_those_predicted(seed: int, kinds: tuple[str, ...]) -> None:
    """By every scheme, in two dimensions and in three, and by every engine that takes the system."""
    assert measured(seed, kinds) >= 5


def test_measured_limits_of_many_more_systems(request: pytest.FixtureRequest) -> None:
    """300, by every scheme and engine, under --full: two hours of processor time."""
    if not request.config.getoption("--full"):
        pytest.skip("--full measures limits on 300 systems")
    assert sum(measured(seed, (*SCHEMES, "engine")) for seed in range(300)) > 5000
