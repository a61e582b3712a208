"""Wrong answers about a truss, by closed forms of a triangle; and what bridges are asked about."""

from __future__ import annotations

from math import pi, sqrt
from typing import Any

import numpy as np
import pytest

from experiments.exercises.exercise import find
from experiments.exercises.solutions.bridges import moved, some_bridge, turned_about
from experiments.exercises.solutions.links import namespace
from experiments.exercises.verdict.answer_catalogue import catalogue_of

SOLVED = find("bridge").solutions


def triangle(apex: tuple[float, float], right: float, **fields: Any) -> Any:
    """Joints 0 on a pin at the origin, 1 on a roller to its right, 2 above; members 0-1, 0-2 and 2-1."""
    joints = np.array([[0.0, 0.0], [right, 0.0], apex])
    members = np.array([[0, 1], [0, 2], [2, 1]])
    return namespace({"joints": joints, "members": members, "pinned": 0, "roller": 1, **fields})


#: Statics: the apex at (1, 3) carries 3 kg, which is W = 6 N; of the other two nothing gets into the members.
LOADED = triangle((1.0, 3.0), 4.0, masses=np.array([5.0, 1.0, 3.0]), gravity=2.0, stiffness=np.array([1.0, 2.0, 3.0]))
W = 6.0

#: The tie 0-1 is pulled by W/4, the struts are pressed.
TIE, STEEP, FLAT = W / 4, -W * sqrt(10) / 4, -W * sqrt(2) / 4


@pytest.mark.parametrize(
    ("wrong", "member", "force"),
    [
        ({}, 1, STEEP),
        ({"choice": "tension"}, 0, TIE),
        ({"choice": "compression"}, 1, STEEP),
        ({"choice": "length"}, 2, FLAT),
        ({"choice": "stiffness"}, 2, FLAT),
        ({"sign": -1.0}, 1, -STEEP),
        ({"told": "size"}, 1, -STEEP),
        ({"told": "size", "choice": "tension"}, 0, TIE),
        ({"first": 1}, 2, STEEP),
        ({"load": "m"}, 1, STEEP / 2),
        ({"load": "m g/2"}, 1, STEEP / 2),
        ({"load": "mean"}, 1, STEEP),
        ({"load": "m 9.81"}, 1, STEEP * 9.81 / 2),
        # what is solved for is the force by the member's length
        ({"in_joints": "separation"}, 1, STEEP / sqrt(10)),
    ],
    ids=str,
)
def test_the_member_that_carries_most(wrong: dict[str, Any], member: int, force: float) -> None:
    """By the method of joints, at the apex: F / sqrt(10) along 0-2, F / sqrt(2) along 2-1."""
    found = SOLVED["heaviest"](LOADED, **wrong)
    assert found == (member, pytest.approx(force))
    stiffest = namespace({**vars(LOADED), "stiffness": np.array([1.0, 3.0, 2.0])})
    other = SOLVED["heaviest"](stiffest, **wrong)
    assert other == ((1, pytest.approx(STEEP)) if wrong.get("choice") == "stiffness" else found)


def test_loads_that_are_spread_evenly_have_the_mean_mass() -> None:
    """Of masses of 5, 1 and 6 kg: 4 kg at the apex in place of 6."""
    bridge = namespace({**vars(LOADED), "masses": np.array([5.0, 1.0, 6.0])})
    assert SOLVED["heaviest"](bridge)[1] == pytest.approx(2 * STEEP)
    assert SOLVED["heaviest"](bridge, load="mean")[1] == pytest.approx(STEEP * 4 / 3)


def test_a_roller_that_is_turned_leaves_forces_that_fit_best() -> None:
    """Of least squares, as numpy.linalg.lstsq has them: the equations of the joints' rows, by hand."""
    a, b = np.array([1.0, 3.0]) / sqrt(10), np.array([3.0, -3.0]) / sqrt(18)
    rows = np.array(
        [
            [1.0, a[0], 0.0, 1.0, 0.0, 0.0],
            [0.0, a[1], 0.0, 0.0, 1.0, 0.0],
            [-1.0, 0.0, -b[0], 0.0, 0.0, 1.0],
            [0.0, 0.0, -b[1], 0.0, 0.0, 0.0],
            [0.0, -a[0], b[0], 0.0, 0.0, 0.0],
            [0.0, -a[1], b[1], 0.0, 0.0, 0.0],
        ]
    )
    forces = (np.linalg.pinv(rows) @ np.array([0.0, 10.0, 0.0, 2.0, 0.0, 6.0]))[:3]
    member = int(np.abs(forces).argmax())
    assert SOLVED["heaviest"](LOADED, held="turned") == (member, pytest.approx(forces[member]))


#: Dynamics: a right angle at the apex (1, 1), struts of 2 q, a tie of q, 1 kg at each joint: in the directions
#: x of joint 1, and of joint 2 along 2-1 and along 0-2, the squares of frequencies are q times those of
#: [[2, 2^0.5, 0], [2^0.5, 2, 0], [0, 0, 2]].
Q = 50.0
SWINGING = triangle((1.0, 1.0), 2.0, masses=np.ones(3), gravity=9.81, stiffness=Q * np.array([1.0, 2.0, 2.0]))

#: With k / L for stiffness: struts of 2 p, p = q / 2^0.5, and a tie of p / 2^0.5.
P, TIE_SHARE = Q / sqrt(2), 1 / sqrt(2)
OF_EA = P * ((3 + TIE_SHARE) + sqrt((TIE_SHARE - 1) ** 2 + 8)) / 2


@pytest.mark.parametrize(
    ("wrong", "limit"),
    [
        ({}, 2 / sqrt(Q * (2 + sqrt(2)))),
        ({"mode": "lowest"}, 2 / sqrt(Q * (2 - sqrt(2)))),
        ({"mode": "one"}, 2 / sqrt(2 * Q)),
        ({"mode": "four"}, 2 / sqrt(8 * Q)),
        ({"factor": "1"}, 1 / sqrt(Q * (2 + sqrt(2)))),
        ({"factor": "period"}, 2 * pi / sqrt(Q * (2 + sqrt(2)))),
        ({"rate": "square"}, 2 / (Q * (2 + sqrt(2)))),
        # all other modes but one are shared by the two ways of holding it: eigenvalues of products of ways
        ({"held": "pin"}, 2 / sqrt(Q * (5 + sqrt(13)) / 2)),
        ({"held": "both pinned"}, 2 / sqrt(2 * Q)),
        ({"held": "none"}, 2 / sqrt(Q * (3 + sqrt(3)))),
        ({"held": "turned"}, 2 / sqrt(3 * Q)),
        # lengths of 2^0.5 twice, struts count twice, the tie four times
        ({"in_stiffness": "separation"}, 2 / sqrt(8 * Q)),
        ({"material": "EA"}, 2 / sqrt(OF_EA)),
    ],
    ids=str,
)
def test_the_largest_step(wrong: dict[str, Any], limit: float) -> None:
    """2 over the highest frequency, in closed form."""
    assert SOLVED["largest_dt"](SWINGING, **wrong) == pytest.approx(limit, rel=1e-12)


@pytest.mark.parametrize(
    ("inertia", "mass"), [("own", 4.0), ("forgotten", 1.0), ("mean", 9.5 / 3)], ids=["own", "forgotten", "mean"]
)
def test_which_masses_swing(inertia: str, mass: float) -> None:
    """Of 4 kg on both joints that move, and 1.5 kg on the pin, which does not swing."""
    bridge = namespace({**vars(SWINGING), "masses": np.array([1.5, 4.0, 4.0])})
    limit = 2 / sqrt(Q * (2 + sqrt(2)) / mass)
    assert SOLVED["largest_dt"](bridge, inertia=inertia) == pytest.approx(limit, rel=1e-12)
    assert SOLVED["largest_dt"](bridge, mode="one") == pytest.approx(2 / sqrt(2 * Q / 1.5))
    assert SOLVED["largest_dt"](bridge, mode="four") == pytest.approx(1 / sqrt(2 * Q / 1.5))


def test_numbers_of_joints_do_not_matter() -> None:
    """Pin and roller are wherever they are; a bridge that nothing holds moves as a whole, at no frequency."""
    order = np.array([2, 0, 1])  # joint i gets number order[i]
    for given, name, wrong in (
        (LOADED, "heaviest", {}),
        (LOADED, "heaviest", {"held": "turned"}),
        *((SWINGING, "largest_dt", {"held": held}) for held in ("all", "pin", "both pinned", "none", "turned")),
    ):
        fields = {n: np.empty_like(getattr(given, n)) for n in ("joints", "masses")}
        for n, array in fields.items():
            array[order] = getattr(given, n)
        fields |= {"members": order[given.members], "pinned": 2, "roller": 0}
        other = namespace({**vars(given), **fields})
        assert SOLVED[name](other, **wrong) == pytest.approx(SOLVED[name](given, **wrong), rel=1e-12)
    free = namespace(some_bridge(np.random.default_rng(1), 4, 9.81, 0))
    assert SOLVED["largest_dt"](free, held="none", mode="lowest") > 100 * SOLVED["largest_dt"](free, mode="lowest")


@pytest.mark.parametrize("hidden", [False, True])
def test_in_one_bridge_a_slanting_member_carries_most_and_in_others_none(hidden: bool) -> None:
    """From the bottom to the top; and two bridges that lean, below height 0: a member to the right, one to the left."""
    asked = find("bridge").questions(np.random.default_rng(4), hidden, "ada")
    assert [q.function for q in asked] == ["heaviest", "largest_dt"] * (len(asked) // 2)
    assert [q.arguments for q in asked[::2]] == [q.arguments for q in asked[1::2]]
    panels = [*((3, 6, 4) if hidden else (4, 5)), 3, 3]
    bridges = [q.arguments[0] for q in asked[::2]]
    assert [len(b["members"]) for b in bridges] == [4 * n - 1 for n in panels]
    assert [b["gravity"] for b in bridges] == ([9.81, 1.62, 9.81] if hidden else [9.81, 1.62]) + [1.62, 1.62]
    for i, bridge in enumerate(bridges):
        member = bridge["members"][SOLVED["heaviest"](namespace(bridge))[0]]
        way = bridge["joints"][member[1]] - bridge["joints"][member[0]]
        if i < len(bridges) - 2:
            top = bridge["joints"][member, 1] > 0
            assert (top[0] != top[1]) == (i == 0)
            assert asked[2 * i].about == f"bridge of {len(bridge['members'])} members"
        else:
            assert (way[0] > 0) == (i == len(bridges) - 2)
            assert (bridge["joints"][:, 1] < 0).all()
            assert asked[2 * i].about == "bridge that leans, below height 0"
    light = [int(np.argmin(b["masses"])) for b in bridges]
    assert light[:2] == [bridges[0]["pinned"], bridges[1]["roller"]]
    leaning = [b["joints"][b["roller"]] - b["joints"][b["pinned"]] for b in bridges[-2:]]
    assert [np.arctan2(y, x) for x, y in leaning] == pytest.approx([0.12, -0.15])


@pytest.mark.parametrize("seed", range(3))
def test_a_bridge_is_a_warren_truss_with_its_top_out_of_line(seed: int) -> None:
    """Numbered anyhow: the bottom at height 0 in equal steps, the top within 0.3 m of one height; all joints loaded."""
    bridge = some_bridge(np.random.default_rng(seed), 5, 1.62, 2)
    joints, masses = bridge["joints"], bridge["masses"]
    bottom = joints[joints[:, 1] == 0]
    top = joints[joints[:, 1] > 0]
    steps = np.diff(np.sort(bottom[:, 0]))
    assert (len(bottom), len(top), len(bridge["members"])) == (6, 5, 19)
    assert steps == pytest.approx(np.full(5, steps[0]))
    assert 2 <= steps[0] <= 4
    middle = np.sort(bottom[:, 0])[:-1] + steps / 2
    assert 0.05 < np.abs(np.sort(top[:, 0]) - middle).max() <= 0.3
    assert 0.1 < np.ptp(top[:, 1]) <= 0.6
    assert (joints[bridge["pinned"]] == [0.0, 0.0]).all()
    assert joints[bridge["roller"]] == pytest.approx([5 * steps[0], 0.0])
    light = int(np.argmin(masses))
    assert 50 <= masses[light] <= 100
    assert joints[light] == pytest.approx([2 * steps[0], 0.0])
    assert np.delete(masses, light).min() >= 500
    assert masses.max() <= 4000
    assert ((bridge["stiffness"] >= 1e7) & (bridge["stiffness"] <= 3e7)).all()
    assert bridge["gravity"] == 1.62
    # every joint of a Warren truss is the end of at least two members
    assert np.bincount(bridge["members"].ravel(), minlength=11).min() >= 2


def test_a_bridge_that_is_moved_is_the_same_elsewhere() -> None:
    """Turned, its members' ends mixed; lengths and the one it is made of stay."""
    bridge = some_bridge(np.random.default_rng(1), 6, 9.81, 0)
    before = bridge["members"].tolist()
    other = moved(np.random.default_rng(2), bridge, 0.5)
    assert bridge["members"].tolist() == before
    lengths = [
        np.linalg.norm(b["joints"][b["members"][:, 0]] - b["joints"][b["members"][:, 1]], axis=1)
        for b in (bridge, other)
    ]
    assert lengths[0] == pytest.approx(lengths[1])
    mixed = (other["members"] != bridge["members"]).all(axis=1)
    assert 0.2 < mixed.mean() < 0.8
    assert other["members"][mixed].tolist() == bridge["members"][mixed][:, ::-1].tolist()
    across = other["joints"][bridge["roller"]] - other["joints"][bridge["pinned"]]
    assert np.arctan2(across[1], across[0]) == pytest.approx(0.5)
    assert ((other["joints"][bridge["pinned"]] >= -9) & (other["joints"][bridge["pinned"]] <= -7)).all()


@pytest.mark.parametrize("rightwards", [False, True])
def test_one_member_is_turned_about(rightwards: bool) -> None:
    """Only that, and only where it has to be; not in the bridge that was given."""
    bridge = some_bridge(np.random.default_rng(1), 3, 9.81, 0)
    before = bridge["members"].tolist()
    for member in range(len(before)):
        turned = turned_about(bridge, member, rightwards)["members"]
        a, b = bridge["joints"][turned[member], 0]
        assert (b > a) == rightwards
        assert sorted(turned[member].tolist()) == sorted(before[member])
        assert np.delete(turned, member, axis=0).tolist() == before[:member] + before[member + 1 :]
        assert bridge["members"].tolist() == before


def test_the_mistakes_are_told_apart_in_both_functions() -> None:
    """Questions are drawn until they are: the catalogue that students are asked from."""
    assert catalogue_of(find("bridge"), "", "sesame").all_differ()
