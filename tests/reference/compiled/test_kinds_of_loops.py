"""Which loops a system gets, by which arrays and in which order; and what the text says of threads."""

from __future__ import annotations

import os
import sys
import warnings
from dataclasses import replace
from typing import Any

import numba
import numpy as np
import pytest

from reference.collisions.round_masses import Collisions
from reference.compiled import kernels, runs
from reference.compiled.kernels import Kernel, _noalias, arrays_of, lists, loops_for
from reference.compiled.loops import Loops
from reference.compiled.mesh_loops import MeshLoops
from reference.compiled.run_loops import RunLoops
from reference.compiled.sweep import _in_lanes, _out_of_lanes, _per_system, _use_threads, sweep
from reference.compiled.tracing import trace, why_not_compiled
from reference.errors import Unsupported
from reference.motion import Motion
from reference.schemes.catalogue import Scheme, find, schemes
from reference.simulate import simulate
from reference.springs.kinds import NonlinearSprings
from reference.state import State
from reference.system import MassSpringSystem
from tests.reference.compiled.test_loops_interpreted import interpreted
from tests.reference.systems import moving_string

HEUN, EULER = find("heun"), find("euler")
STRING = moving_string(3, drag=0.02)


def mesh(springs: Any, masses: int = 4) -> MassSpringSystem:
    """Masses on a parabola, the first one held, of unequal springs."""
    x = np.arange(float(masses))
    return MassSpringSystem(
        positions=np.stack([x, x**2], axis=1),
        springs=np.array(springs),
        masses=np.array(0.1 + x, dtype=np.float64),
        rest_lengths=np.arange(1.0, 1 + len(springs)),
        stiffness=np.arange(10.0, 10 + len(springs)),
        gravity=np.array([0.5, -9.81]),
        fixed=x == 0,
    )


# --- Which loops ---


@pytest.mark.parametrize(
    ("springs", "string"),
    [
        ([[0, 1], [1, 2], [2, 3]], True),
        ([[0, 1], [1, 2]], False),  # a mass too many
        ([[0, 1], [0, 2], [0, 3]], False),  # a star
        ([[0, 1], [2, 1], [2, 3]], False),  # one named from the other end
        ([[0, 1], [1, 2], [2, 3], [0, 3]], False),
    ],
)
def test_a_string_is_a_row_of_springs_from_each_mass_to_the_next(springs: Any, string: bool) -> None:
    """It needs no lists; its forces have a zero at either end; of others there are as many as springs."""
    system = mesh(springs)
    loops = loops_for(HEUN, system)
    assert type(loops) is Loops
    assert loops.string == string
    arrays, s = arrays_of(system, loops), len(springs)
    assert len(arrays["force0"]) == len(arrays["force1"]) == (s + 2 if string else s)
    assert arrays["divisor"].tolist() == [np.inf, 1.1, 2.1, 3.1]
    assert arrays["weight0"].tolist() == pytest.approx((0.5 * system.masses).tolist())
    assert arrays["weight1"].tolist() == pytest.approx((-9.81 * system.masses).tolist())
    listed = lists(system, loops)
    assert [array.tolist() for array in listed[:2]] == ([] if string else np.array(springs).T.tolist())
    assert len(listed) == (0 if string else 5)
    assert [name for name in ("a0_0", "a0_1", "a1_0") if name in arrays] == ["a0_0", "a0_1"]


@pytest.mark.parametrize(
    ("fields", "said"),
    [
        ({"collisions": Collisions(np.array(0.01))}, "masses that collide"),
        ({"rest_lengths": np.array([1.0, 0.0, 1.0])}, "springs of rest length 0"),
        ({"pulls": np.array([[0.0, 0.0], [0.0, 0.0], [0.0, 1.0], [0.0, 0.0]])}, "masses that a force pulls"),
        ({"nonlinear": NonlinearSprings(hardening=np.array([0.0, 1.0, 0.0]))}, "springs with hardening"),
    ],
)
def test_what_has_no_compiled_loops_is_refused(fields: Any, said: str) -> None:
    """One spring or mass of the kind is enough."""
    with pytest.raises(Unsupported, match=f"no compiled loops of {said}: they run as written"):
        loops_for(HEUN, replace(mesh([[0, 1], [1, 2], [2, 3]]), **fields))


@pytest.mark.parametrize(("threads", "chunks"), [(False, 1), (True, 3)])
@pytest.mark.parametrize("kind", [RunLoops, MeshLoops])
def test_blocks_are_shared_out_among_as_many_chunks_as_processors(
    monkeypatch: pytest.MonkeyPatch, kind: type[RunLoops], threads: bool, chunks: int
) -> None:
    """With threads; without there is one chunk, and one where nobody knows how many processors there are."""
    for name, value in {"LARGE": 0, "LONG": 0 if kind is RunLoops else 1000, "BLOCK": 2}.items():
        monkeypatch.setattr(runs, name, value)
    monkeypatch.setattr(os, "cpu_count", lambda: 3)
    system = mesh([[i, i + 1] for i in range(11)], masses=12)
    loops = loops_for(EULER, system, threads=threads)
    assert type(loops) is kind
    assert not loops.string
    assert len(arrays_of(system, loops)["edges"]) == chunks + 1
    monkeypatch.setattr(os, "cpu_count", lambda: None)
    assert len(arrays_of(system, loops)["edges"]) == 2


def test_threads_are_in_the_text_where_there_are_some() -> None:
    """Of one system its loops over springs and masses; of many those over blocks of them, and nothing within."""
    program = trace(EULER)
    one, spread = (Loops(program, 2, string=True, threads=threads).text() for threads in (False, True))
    assert ("prange(" in one, "parallel=True" in one) == (False, False)
    assert ("for j in prange(s)" in spread, "for i in prange(n)" in spread) == (True, True)
    assert "parallel=True" in spread
    many, shared = (Loops(program, 2, string=True, lanes=True, threads=threads).text() for threads in (False, True))
    assert ("prange(" in many, "parallel=True" in many) == (False, False)
    before, after = shared.split("def sweep(")
    assert before.count("parallel=True") == 1  # that of sweep
    assert "in prange" not in before
    assert "for q in prange(len(blocks)):" in after
    runs_alone, runs_spread = (RunLoops(program, 2, string=False, threads=threads).text() for threads in (False, True))
    assert ("for c in range(" in runs_alone, "parallel=True" in runs_alone) == (True, False)
    assert ("for c in prange(" in runs_spread, "parallel=True" in runs_spread) == (True, True)
    known, unknown = (Loops(program, 2, string=True, noalias=noalias).text() for noalias in (True, False))
    assert ("noalias=True" in known, "noalias" in unknown) == (True, False)


def test_no_more_threads_are_asked_for_than_there_are(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of a system and of many; of one thread nothing is asked where there is but one; all where no number is given."""
    asked: list[int] = []
    monkeypatch.setattr(numba, "set_num_threads", asked.append)
    monkeypatch.setattr(kernels, "compiled", interpreted)
    most = numba.config.NUMBA_NUM_THREADS
    for threads in (1, 2, 10**6):
        Kernel(STRING, EULER, threads).advance(1e-3, 1)
    assert asked == [min(2, most), most]
    for given in (None, 1, 10**6):
        _use_threads(given)
    assert asked[2:] == [most, 1, most]


@pytest.mark.parametrize("half", ["positions", "velocities"])
def test_a_scheme_that_makes_half_a_state_of_something_else_is_not_compiled(half: str) -> None:
    """Positions, or velocities, that are none of what it was given: it runs as it is written."""

    def other(motion: Motion, state: State, dt: float) -> State:
        end = state.kick(dt * motion.acceleration(state))
        object.__setattr__(end, half, np.zeros((4, 2)))
        return end

    with pytest.raises(Unsupported, match="its states are not made of the one it was given"):
        trace(Scheme(other, 1))


def test_a_stage_that_is_not_where_masses_are_is_gone_to_first() -> None:
    """Drift-kick takes its forces at new places, with the velocities there were; kick-drift where it is."""
    assert Loops(trace(find("kick_drift")), 2, string=True)._start("n") == []
    moved = Loops(trace(find("drift_kick")), 2, string=True)._start("n")
    assert moved == [
        "for i in range(n):",
        "    new_xs0 = (x0[i] + (c0 * v0[i]))",
        "    xs0[i] = new_xs0",
        "    new_xs1 = (x1[i] + (c0 * v1[i]))",
        "    xs1[i] = new_xs1",
    ]


def test_numba_is_told_of_arrays_apart_if_it_can_be(monkeypatch: pytest.MonkeyPatch) -> None:
    """This one can; one without the way in is not told, and nothing fails."""
    assert _noalias.__wrapped__()
    monkeypatch.setitem(sys.modules, "numba.core.options", None)
    assert not _noalias.__wrapped__()


# --- In which order ---


def test_springs_are_taken_block_by_block_and_those_between_chunks_before_all(monkeypatch: pytest.MonkeyPatch) -> None:
    """Blocks of four masses, two chunks of two: a spring is its lower mass's block's, in the order it was given in."""
    monkeypatch.setattr(runs, "BLOCK", 4)
    near = [[i, i + 1] for i in range(15)]
    across, beside = [3, 12], [1, 6]
    springs = [across, *near[::-1], beside]
    blocks = runs.blocks_of(mesh(springs, masses=16), 2)
    assert blocks.edges.tolist() == [0, 2, 4]
    taken = [springs[j] for j in blocks.order]
    between = [blocks.first[b : b + 2].tolist() for b in range(5)]
    by_block = [taken[begin:end] for begin, end in between]
    assert by_block[0] == [*near[3::-1], beside]
    assert by_block[1] == near[6:3:-1]
    assert by_block[2] == near[11:7:-1]
    assert by_block[3] == near[14:11:-1]
    assert by_block[4] == [across, near[7]]
    assert sorted(blocks.place.tolist()) == sorted(set(blocks.place.tolist()))  # each has a place of its own
    one = runs.blocks_of(mesh(springs, masses=16), 1)
    assert one.first[-1] - one.first[-2] == 0


def test_equal_homes_keep_the_order_that_springs_were_given_in(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of many springs in one block, too: runs are to stay whole."""
    monkeypatch.setattr(runs, "BLOCK", 64)
    springs = [[i, j] for i in (70, 3) for j in range(i + 1, i + 40)]
    order = runs.blocks_of(mesh(springs, masses=128), 1).order
    assert order.tolist() == [*range(39, 78), *range(39)]


def test_a_run_ends_where_ends_or_numbers_do_not_go_on() -> None:
    """Another pair, another stiffness, another damping: each begins one."""
    system = mesh([[0, 2], [1, 3], [2, 4], [3, 5], [5, 6], [6, 7]], masses=8)
    alike = replace(system, stiffness=np.full(6, 5.0), damping=np.zeros(6))
    assert runs._begins(alike, np.arange(6)).tolist() == [True, False, False, False, True, False]
    numbers = np.array([5.0, 5.0, 7.0, 7.0, 7.0, 7.0])
    for other in (replace(alike, stiffness=numbers), replace(alike, damping=numbers)):
        assert runs._begins(other, np.arange(6)).tolist() == [True, False, True, False, True, False]


@pytest.mark.parametrize(
    ("where", "sign", "goes_on"),
    [
        ([0, 4, 1, 5, 2, 6, 3, 7], [1, -1] * 4, [False, True, True, True]),
        ([0, 4, 1, 5, 9, 6, 3, 7], [1, -1] * 4, [False, True, False, False]),  # the third's first force is elsewhere
        ([0, 4, 1, 5, 2, 9, 3, 10], [1, -1] * 4, [False, True, False, True]),  # its second
        ([0, 4, 1, 5, 2, 6, 3, 7], [1, -1, 1, -1, 1, 1, 1, 1], [False, True, False, True]),  # the other end of it
    ],
)
def test_a_mass_goes_on_with_a_row_where_all_its_forces_do(where: Any, sign: Any, goes_on: list[bool]) -> None:
    """Each one place further and with the same sign; a block begins a row of its own, and so does another number."""
    found = np.zeros(4, dtype=bool)
    runs.which_go_on(np.array([0, 2, 4, 6, 8]), np.array(where), np.array(sign, float), 8, found)
    assert found.tolist() == goes_on
    in_blocks = np.zeros(4, dtype=bool)
    runs.which_go_on(np.array([0, 2, 4, 6, 8]), np.array(where), np.array(sign, float), 2, in_blocks)
    assert in_blocks.tolist() == [False, goes_on[1], False, goes_on[3]]
    uneven = np.zeros(3, dtype=bool)
    runs.which_go_on(np.array([0, 2, 5, 8]), np.arange(8), np.ones(8), 8, uneven)
    assert uneven.tolist() == [False, False, False]


# --- Many systems ---


def test_lanes_hold_systems_and_give_them_back() -> None:
    """Eighteen systems of three numbers: two blocks, the second filled up with the last one."""
    array = np.arange(54.0).reshape(18, 3)
    lanes = _in_lanes(array, 18, 2)
    assert lanes.shape == (2, 3, 16)
    assert lanes[0, :, 5].tolist() == array[5].tolist()
    assert lanes[1, :, 1].tolist() == lanes[1, :, 15].tolist() == array[17].tolist()
    assert _out_of_lanes(lanes, 18).tolist() == array.tolist()


def test_weights_are_made_anew_where_masses_or_gravity_differ() -> None:
    """Gravity pulls down the second axis, then alone; a held mass is divided by infinity."""
    system = mesh([[0, 1], [1, 2], [2, 3]])
    assert _per_system(system, {"stiffness": np.array([1.0, 2.0])}, 2).keys() == {"stiffness"}
    heavy = _per_system(system, {"mass": np.array([1.0, 3.0])}, 2)
    assert heavy.keys() == {"divisor", "weight0", "weight1"}
    assert heavy["divisor"].tolist() == [[np.inf, 1.0, 1.0, 1.0], [np.inf, 3.0, 3.0, 3.0]]
    assert heavy["weight0"].tolist() == [[0.5] * 4, [1.5] * 4]
    assert heavy["weight1"][1].tolist() == pytest.approx([-3 * 9.81] * 4)
    falling = _per_system(system, {"gravity": np.array([2.0, 4.0])}, 2)
    assert falling["divisor"].tolist() == [[np.inf, 1.1, 2.1, 3.1]] * 2
    assert not falling["weight0"].any()
    assert falling["weight1"].tolist() == [(-2 * system.masses).tolist(), (-4 * system.masses).tolist()]


def test_distances_are_measured_from_where_it_is_said_along_every_axis() -> None:
    """Unmoved systems, each beside its own place: the largest distance of a mass, of every system."""
    still = np.stack([STRING.positions + np.array([0.3, 0.4]), STRING.positions])
    resting = replace(STRING, velocities=np.zeros_like(STRING.positions), gravity=np.zeros(2), stiffness=np.zeros(3))
    swept = sweep(resting, EULER, np.full(2, 1e-3), 1, still=still, limit=0.4)
    assert swept.distances[0].tolist() == pytest.approx([0.5, 0.0], abs=1e-12)
    assert swept.blown_up.tolist() == [True, False]


@pytest.mark.parametrize("lanes", [False, True])
@pytest.mark.parametrize("scheme", [s for s in schemes().values() if why_not_compiled(s) is None], ids=lambda s: s.name)
def test_numbers_that_a_scheme_has_written_out_are_numbers_in_its_loops(scheme: Scheme, lanes: bool) -> None:
    """The 2 of RK4 is no coefficient of dt, of which each system of a sweep has its own: `2[w]` is no program."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # a number with an index is but warned of
        compile(loops_for(scheme, STRING, lanes=lanes).text(), scheme.name, "exec")


def test_a_sweep_by_a_scheme_with_numbers_of_its_own_is_its_function() -> None:
    """RK4 on two strings with steps of their own, to the last bits."""
    dt = np.array([1e-3, 3e-3])
    swept = sweep(STRING, find("rk4"), dt, 3, threads=1)
    for k, h in enumerate(dt.tolist()):
        run = simulate(STRING, find("rk4"), h, 3 * h)
        assert swept.positions[k] == pytest.approx(run.positions[-1], rel=1e-14)
        assert swept.velocities[k] == pytest.approx(run.velocities[-1], rel=1e-12)
