"""The sweep on a real Dask scheduler with two workers on this machine, one of them killed under way: the same store."""

from __future__ import annotations

import importlib.util
import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace

import psutil
import pytest

from engines.engine import version
from engines.process.isolation import EngineStepper
from experiments.runs import cluster
from experiments.runs.cluster import DaskExecutor, do_there
from experiments.runs.sweeps import ParameterSweep
from reference.errors import InputError
from tests.engines.process.misbehaving import Misbehaving, Still
from tests.soak.children import check_all_end, family, start, start_sweep
from tests.soak.conftest import Size
from tests.soak.stored import check_accounted_for, check_same, kept_in, rows

# What takes long here is run every few days, and with --full.
pytestmark = pytest.mark.rotating(8)

needs_dask = pytest.mark.skipif(importlib.util.find_spec("distributed") is None, reason="Dask is not installed")

HOST = "127.0.0.1"

#: Whatever is waited for is there after so long [s].
PATIENCE = 300.0

#: `springlab`, with less patience for a scheduler that is gone, and more for one that is slow.
PROGRAM = "from experiments.runs import cluster; from report.commands.main import main; cluster.PATIENCE = {}; main()"
WORDS = ("sweep", "string", "--stepper", "heun", "--over", "stiffness=100:200:200")
SWEEP = ("-c", PROGRAM.format(2.0), *WORDS)
PATIENT = ("-c", PROGRAM.format(PATIENCE), *WORDS)


class Cluster:
    """A scheduler and its workers, started as CONTRIBUTING shows."""

    def __init__(self, folder: Path, workers: int, daemons: bool) -> None:
        with socket.socket() as free:
            free.bind((HOST, 0))
            port = free.getsockname()[1]
        self.address = f"tcp://{HOST}:{port}"
        dask = (sys.executable, "-m", "dask")
        here = {"DASK_DISTRIBUTED__WORKER__DAEMON": str(daemons), "DASK_TEMPORARY_DIRECTORY": str(folder)}
        self.scheduler = start(*dask, "scheduler", "--host", HOST, "--port", str(port), "--no-dashboard")
        options = (self.address, "--nthreads", "1", "--no-dashboard", "--host", HOST)
        self.workers = [start(*dask, "worker", *options, environment=here) for _ in range(workers)]

    def end(self) -> None:
        """End all of it, whatever is left of it, and what it has started."""
        programs = [self.scheduler, *self.workers]
        left = [process for program in programs for process in family(program.pid)]
        for program in programs:
            program.kill()
            program.communicate()
        for process in left:
            if process.is_running():
                process.kill()


@contextmanager
def running(folder: Path, workers: int = 2, daemons: bool = False) -> Iterator[Cluster]:
    """A cluster for a while."""
    made = Cluster(folder, workers, daemons)
    try:
        yield made
    finally:
        made.end()


@needs_dask
def test_whatever_a_cluster_loses_nothing_is_lost(tmp_path: Path, size: Size, undisturbed: Path) -> None:
    """A worker under way: the same store. Then, with the other, Ctrl-C, and the scheduler: one line each."""
    with running(tmp_path / "dask") as made:
        lose_a_worker(made, tmp_path / "killed" / "store.sqlite", size.runs)
        interrupt(made, tmp_path / "interrupted" / "store.sqlite")
        lose_the_scheduler(made, tmp_path / "interrupted" / "store.sqlite")
    check_same(tmp_path / "killed" / "store.sqlite", undisturbed)
    check_accounted_for(tmp_path / "killed" / "store.sqlite", range(size.runs))


def lose_a_worker(made: Cluster, store: Path, runs: int) -> None:
    """Kill one when the first of a sweep is done: answers come in batches. All of it is done nevertheless."""
    begin = time.perf_counter()
    child = start_sweep(store, runs, "--cluster", made.address)
    wait_for_rows(child, store, 1)
    kill(made.workers[0].pid)
    kept = len(rows(store))
    out, err = child.communicate(timeout=600)
    assert (out, err) == (f"done {runs}\n", "")
    assert kept < runs, "the worker was killed too late"
    print(f"\n{runs} runs by two workers, one killed after {kept}, in {time.perf_counter() - begin:.1f} s")


def kill(nanny: int) -> None:
    """Kill a worker: its nanny, which would start another, and the process that works. The rest must end by itself."""
    others = family(nanny)
    (worker,) = (p for p in psutil.Process(nanny).children() if "multiprocessing.spawn" in " ".join(p.cmdline()))
    for pid in (nanny, worker.pid):
        os.kill(pid, signal.SIGKILL)
    check_all_end(others)


def interrupt(made: Cluster, store: Path) -> None:
    """Ctrl-C in the middle of `springlab sweep`."""
    child = start(sys.executable, *SWEEP, "--store", str(store), "--cluster", made.address)
    wait_for_rows(child, store, 1)
    os.killpg(child.pid, signal.SIGINT)
    out, err = child.communicate(timeout=600)
    assert (child.returncode, out) == (130, "")
    assert err == f"springlab: interrupted; what is done is kept in {store}: the same command goes on\n"


def lose_the_scheduler(made: Cluster, store: Path) -> None:
    """Kill it in the middle of `springlab sweep`: no traceback, exit code 2, and what was done is kept."""
    before = len(rows(store))
    child = start(sys.executable, *SWEEP, "--store", str(store), "--cluster", made.address)
    wait_for_rows(child, store, before + 1)
    made.scheduler.kill()
    out, err = child.communicate(timeout=600)
    assert (child.returncode, out) == (2, ""), err
    assert err.startswith(f"springlab: --cluster {made.address}: lost the scheduler")
    assert len(err.splitlines()) == 1, err
    assert len(rows(store)) > before


def wait_for_rows(child: subprocess.Popen[str], store: Path, count: int) -> None:
    """Until so many runs are in a store."""
    deadline = time.monotonic() + PATIENCE
    while kept_in(store) < count:
        assert child.poll() is None, child.communicate()
        assert time.monotonic() < deadline
        time.sleep(0.05)


def test_a_worker_that_may_not_start_processes_says_how_to_start_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """Dask's usual ones may not."""
    monkeypatch.setattr(cluster.multiprocessing, "current_process", lambda: SimpleNamespace(daemon=True))
    with pytest.raises(InputError, match="expected DASK_DISTRIBUTED__WORKER__DAEMON=False"):
        do_there([])


@needs_dask
def test_workers_that_may_not_start_processes_are_one_line(tmp_path: Path, request: pytest.FixtureRequest) -> None:
    """On a real cluster, with --full."""
    if not request.config.getoption("--full"):
        pytest.skip("--full starts a cluster of such workers")
    with running(tmp_path / "dask", workers=1, daemons=True) as made:
        words = (sys.executable, *PATIENT, "--store", str(tmp_path / "store.sqlite"), "--cluster", made.address)
        child = start(*words)
        out, err = child.communicate(timeout=600)
    assert (child.returncode, out) == (2, ""), err
    assert "expected DASK_DISTRIBUTED__WORKER__DAEMON=False" in err
    assert len(err.splitlines()) == 1, err


def test_a_worker_with_other_versions_says_which() -> None:
    """It does nothing: its answers would be kept under a key that is not theirs."""
    task = next(ParameterSweep("string", [EngineStepper(Misbehaving(Still))], {"stiffness": [100.0]}, {}).tasks())
    here = version(Misbehaving(Still))
    with pytest.raises(
        InputError, match=f"^a worker of the cluster has Still in version {here}: expected 0.1, as here$"
    ):
        do_there([(task, "another", "0.1")])
    with pytest.raises(InputError, match=r"has another springlab, NumPy, Numba, SciPy or processor than we have$"):
        do_there([(task, "another", here)])


def test_without_dask_one_line_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    """It is an extra."""
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(
        InputError, match=r"^--cluster: Dask is not installed; expected the extra springlab\[cluster\]$"
    ):
        DaskExecutor("tcp://127.0.0.1:8786")


@needs_dask
@pytest.mark.parametrize("address", ["", "nonsense", "http://127.0.0.1:8786", "tcp://127.0.0.1", "tcp://:8786"])
def test_an_address_that_is_none_is_refused(address: str) -> None:
    """Before anybody is asked."""
    with pytest.raises(InputError, match="expected tcp://HOST:PORT of a Dask scheduler"):
        DaskExecutor(address)


@needs_dask
@pytest.mark.parametrize("host", [HOST, "nowhere.invalid"])
def test_nobody_there_is_one_line(monkeypatch: pytest.MonkeyPatch, host: str) -> None:
    """After as long as it is ready to wait."""
    monkeypatch.setattr(cluster, "PATIENCE", 1.0)
    with pytest.raises(InputError, match=f"^--cluster tcp://{host}:9: found no scheduler with workers within 1 s$"):
        DaskExecutor(f"tcp://{host}:9")
