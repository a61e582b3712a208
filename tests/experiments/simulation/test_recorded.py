"""Recordings of other programs: identified from the file alone, and refused by name where they are none."""

from __future__ import annotations

import io
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from experiments.simulation.recorded import read
from reference.errors import InputError
from reference.scenes import find
from tests.report.commands.terminal import springlab

#: A script that knows nothing of the lab: a mass on a spring, stepped by MuJoCo's Euler as it comes.
BARE_MUJOCO = '''
import csv, sys
import mujoco

model = mujoco.MjModel.from_xml_string("""
<mujoco>
  <option timestep="0.001" gravity="0 0 -9.81"/>
  <worldbody>
    <body pos="0 0 -0.125">
      <joint type="slide" axis="0 0 1" stiffness="200" damping="DAMPING"/>
      <geom type="sphere" size="0.01" mass="0.02" contype="0" conaffinity="0"/>
    </body>
  </worldbody>
</mujoco>""")
data = mujoco.MjData(model)
data.qpos[0] = -0.01
with open(sys.argv[1], "w", newline="") as file:
    table = csv.writer(file)
    table.writerow(["time", "mass", "x", "y", "vx", "vy"])
    for step in range(200):
        table.writerow([step * 0.001, 0, 0.0, 0.0, 0.0, 0.0])
        table.writerow([step * 0.001, 1, 0.0, -0.125 + data.qpos[0], 0.0, data.qvel[0]])
        mujoco.mj_step(model, data)
'''


@pytest.mark.rotating(3, in_turn=True)
@pytest.mark.parametrize(("damping", "named"), [("0", "kick_drift"), ("0.4", "kick_drift_implicit_damping")])
def test_what_a_bare_mujoco_script_wrote_is_identified(damping: str, named: str, tmp_path: Path) -> None:
    """Its Euler takes the damping of joints implicitly, which the manual says and the numbers show."""
    pytest.importorskip("mujoco")
    file = tmp_path / "mujoco.csv"
    script = BARE_MUJOCO.replace("DAMPING", damping)
    subprocess.run([sys.executable, "-c", script, str(file)], check=True, cwd=tmp_path)
    words = ["identify", str(file), "spring", "--set", f"damping={damping}", "--dt", "0.001", "--json"]
    document = json.loads(springlab(*words).out)
    assert document["identified_as"] == named
    assert document["stepper"] == "mujoco.csv"


@pytest.mark.rotating(3, in_turn=True)
@pytest.mark.parametrize("name", ["rk4-masses.csv", "rk4-arrays.npz"])
def test_what_simulate_wrote_is_identified(name: str, tmp_path: Path) -> None:
    """Its own files, read back: the string by RK4, and by no other."""
    words = ["--stepper", "rk4", "--duration", "0.05", "--out", str(tmp_path)]
    assert springlab("simulate", "string", *words).code == 0
    document = json.loads(springlab("identify", str(tmp_path / name), "string", "--json").out)
    assert (document["identified_as"], document["ties"]) == ("rk4", [])


def test_without_velocities_positions_alone_are_compared(tmp_path: Path) -> None:
    """A file that does not tell them."""
    from reference.stepper import catalogued

    run = catalogued()["heun"].run(find("string").system({}), 1e-3, 60).trajectory
    assert run is not None
    np.savez(tmp_path / "run.npz", time_s=run.times, positions_m=run.positions)
    document = json.loads(springlab("identify", str(tmp_path / "run.npz"), "string", "--json").out)
    assert document["identified_as"] == "heun"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "no column 'time'"),
        ("time,mass,x\n", "no column 'y'"),
        ("time,mass,x,y\n0,0,0,zero\n", "line 2: expected 4 numbers"),
        ("time,mass,x,y\n0,0,0,0\n", "expected rows for masses 0 to 1"),
        ("time,mass,x,y\n0,0,0,0\n0,1,0,-1\n", "expected three at least"),
        ("time,mass,x,y\n" + "".join(f"{t},0,0,0\n{t},1,0,-1\n" for t in (0, 1, 3)), "not even"),
        ("time,mass,x,y\n" + "".join(f"{t},0,0,0\n{t},1,0,-1\n" for t in (0, 1, 3, 6)), "not even"),
        ("time,mass,x,y\n" + "".join(f"{t},0,0,0\n{t},1,0,-1\n" for t in (0, 1, 2)), "its steps are 1 s"),
    ],
)
def test_what_is_no_recording_is_refused_in_a_line(text: str, said: str, tmp_path: Path) -> None:
    """With the file, the line, and what was expected."""
    file = tmp_path / "run.csv"
    file.write_text(text)
    found = springlab("identify", str(file), "spring", "--dt", "0.001")
    assert found.code == 2
    assert said in found.err
    assert len(found.err.strip().splitlines()) == 1


def spoilt(how: str) -> bytes:
    """An NPZ file that is none, or not of arrays of numbers."""
    made = io.BytesIO()
    time = np.array(0.0) if how == "a single time" else np.arange(4) * 1e-3
    np.savez(made, time_s=time, positions_m=np.zeros((4, 2, 2)) + (1j if how == "complex" else 0))
    data = bytearray(made.getvalue())
    if how == "a wrong byte":
        data[120] ^= 0xFF
    if how == "an array alone":
        made = io.BytesIO()
        np.save(made, time)
        return made.getvalue()
    return bytes(data[:200] if how == "cut off" else data)


@pytest.mark.parametrize(
    ("how", "said"),
    [
        ("cut off", "expected an NPZ file, as numpy.savez writes it"),
        ("an array alone", "expected an NPZ file, as numpy.savez writes it"),
        ("a wrong byte", "expected an NPZ file of arrays of numbers: Bad CRC-32"),
        ("a single time", "expected an NPZ file of arrays of numbers: one holds a single one"),
        ("complex", "expected an NPZ file of arrays of numbers: one holds complex numbers"),
    ],
)
def test_a_spoilt_npz_file_is_refused_in_a_line(how: str, said: str, tmp_path: Path) -> None:
    """Four ended with an error of a library's; of complex numbers the real part was taken."""
    file = tmp_path / "run.npz"
    file.write_bytes(spoilt(how))
    found = springlab("identify", str(file), "spring", "--dt", "0.001")
    assert found.code == 2
    assert said in found.err
    assert len(found.err.strip().splitlines()) == 1


@pytest.mark.parametrize(("extent", "code"), [(0.1, 2), (1e-9, 0)])
def test_a_recording_in_more_dimensions_than_the_scene_is_refused(extent: float, code: int, tmp_path: Path) -> None:
    """What differs along an axis that the scene has not is told; noise there changes no length, and is left out."""
    file = tmp_path / "run.csv"
    rows = (f"{t * 1e-3},0,0,0,0\n{t * 1e-3},1,0,-0.13,{extent * t}\n" for t in range(4))
    file.write_text("time,mass,x,y,z\n" + "".join(rows))
    found = springlab("identify", str(file), "spring")
    assert found.code == code
    assert ("its positions differ along z: expected the scene's axes, x, y, only" in found.err) == (code == 2)


def table_of(*frames: tuple[float, float, float], head: str = "time,mass,x,y", more: str = "") -> str:
    """A file of the spring's two masses: at each time where the second is, and what else stands in each row."""
    rows = (f"{t},0,0,0{more}\n{t},1,{x},{y}{more}\n" for t, x, y in frames)
    return f"{head}\n" + "".join(rows)


STILL = [(t * 1e-3, 0.0, -0.125) for t in range(4)]


def test_velocities_are_taken_where_all_of_them_are_told(tmp_path: Path) -> None:
    """Of a file that has one of two they are not known; columns may stand in any order."""
    system, file = find("spring").system({}), tmp_path / "run.csv"
    file.write_text(table_of(*STILL, head="time,mass,x,y,vy", more=",2"))
    assert np.isnan(read(file, system).velocities).all()
    file.write_text(table_of(*STILL, head="time,mass,x,y,vy,vx", more=",2,3"))
    assert np.array_equal(read(file, system).velocities, np.broadcast_to([3.0, 2.0], (4, 2, 2)))


def test_a_recording_may_end_with_what_is_no_number_and_not_begin_with_it(tmp_path: Path) -> None:
    """A run that blew up is one."""
    system, file = find("spring").system({}), tmp_path / "run.csv"
    file.write_text(table_of(*STILL[:-1], (3e-3, np.nan, 0.0)))
    assert np.isnan(read(file, system).positions[-1]).any()
    file.write_text(table_of((0.0, np.nan, 0.0), *STILL[1:]))
    with pytest.raises(InputError, match="it begins with what is not a number"):
        read(file, system)


def test_one_row_that_is_not_in_its_place_is_seen(tmp_path: Path) -> None:
    """All others are."""
    file = tmp_path / "run.csv"
    file.write_text(table_of(*STILL).replace("0.002,1,", "0.002,0,"))
    with pytest.raises(InputError, match="expected rows for masses 0 to 1 at every time, in this order"):
        read(file, find("spring").system({}))


def test_objects_are_not_unpacked(tmp_path: Path) -> None:
    """An array of Python's objects is a pickle, which may do anything when it is read."""
    file = tmp_path / "run.npz"
    np.savez(file, time_s=np.arange(4) * 1e-3, positions_m=np.zeros((4, 2, 2)).astype(object))
    with pytest.raises(InputError, match="expected an NPZ file of arrays of numbers: Object arrays"):
        read(file, find("spring").system({}))
