"""The environments of other versions: each a folder in the user's cache, with its own Python, that version and NumPy.

Of the lab it sees the rooms `reference` and `engines`, and nothing of what else is installed beside the lab. It is made
by uv where there is one, else by venv and the pip beside the lab, and used again. What was not finished is never taken
for an environment.
"""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

import numpy as np

from engines.process.packages import APART
from reference.cache import cache_folder
from reference.errors import InputError

#: The lab's rooms that an environment sees, and the folder they are in.
ROOMS, LAB = ("reference", "engines"), Path(__file__).parents[2]

#: The NumPy asked for: the newest that goes with the engine, up to the one running here; or else, where the engine then
#: cannot be imported, one from before NumPy 2, which engines made for it do not always say they need.
NUMPY = (f"numpy<={np.__version__}", "numpy<2")

#: In a folder's name: it is not finished.
UNFINISHED = ".unfinished-"


def environment(package: str, version: str) -> Path:
    """The Python of the environment with a version of a package, made now if there is none.

    Args:
        version: such as 1.2.3; or the file of a wheel of the package.

    Raises:
        InputError: where that version cannot be installed; with the reason, shortened.
    """
    if not version.endswith(".whl") and not re.fullmatch(r"\d[\w.!+-]*", version):
        raise InputError(f"{package} version {version!r}: expected one such as 1.2.3, or the file of a wheel")
    folder = cache_folder("environments")
    home = _home(folder, package, version)
    with _locked(folder / f"{home.name}.lock"):
        for dead in _dead(folder, home):
            shutil.rmtree(dead, ignore_errors=True)
        if not home.exists():
            unfinished = Path(tempfile.mkdtemp(prefix=f"{home.name}{UNFINISHED}", dir=folder))
            try:
                _make(unfinished, package, version)
                unfinished.rename(home)
            finally:
                shutil.rmtree(unfinished, ignore_errors=True)
    return _python(home)


def kept(package: str, version: str) -> Path | None:
    """The Python of an environment that was made before; None where there is none, and nothing is made."""
    python = _python(_home(cache_folder("environments"), package, version))
    return python if python.exists() else None


def _home(folder: Path, package: str, version: str) -> Path:
    """Where an environment is, or would be."""
    label = _label_of_wheel(package, Path(version)) if version.endswith(".whl") else version
    return folder / f"{package}-{label}-{_digest(_other_python(package))}"


def _other_python(package: str) -> str | None:
    """The Python that a package has wheels for, where it is not the lab's own."""
    other = APART[package].python if package in APART else None
    return None if other == f"{sys.version_info.major}.{sys.version_info.minor}" else other


def numpy_version() -> str:
    """Which NumPy an environment came to have: a task to be done there."""
    return f"{np.__version__.split('.')[0]}.x"


def version_of_wheel(name: str) -> str:
    """The version in a wheel's file name; of anything else, which is a version, itself.

    >>> version_of_wheel("dist/mujoco-4.1.0-cp311-cp311-linux_x86_64.whl"), version_of_wheel("4.0.0")
    ('4.1.0', '4.0.0')
    """
    return Path(name).name.split("-")[1] if name.endswith(".whl") and name.count("-") >= 4 else name


def version_numbers(version: str) -> tuple[int, ...]:
    """What versions, or the files of wheels, are put in order by.

    >>> version_numbers("3.17.0") > version_numbers("3.2.7")
    True
    """
    return tuple(int(n) for n in re.findall(r"\d+", version_of_wheel(version)))


def _label_of_wheel(package: str, wheel: Path) -> str:
    """Its version and the digest of what is in it: a wheel that is built again is another one."""
    if not wheel.is_file():
        raise InputError(f"{package} version {str(wheel)!r}: expected a file that is there")
    named = wheel.name.partition("-")[0]
    if re.sub(r"[-_.]+", "-", named).lower() != re.sub(r"[-_.]+", "-", package).lower():
        raise InputError(f"{package} version {str(wheel)!r}: expected a wheel of {package}")
    return f"{version_of_wheel(wheel.name)}-{hashlib.sha256(wheel.read_bytes()).hexdigest()[:8]}"


def _make(home: Path, package: str, version: str) -> None:
    uv = shutil.which("uv")
    python = str(_python(home))
    wanted = str(Path(version).resolve()) if version.endswith(".whl") else f"{package}=={version}"
    known, other = APART.get(package), _other_python(package)
    module, beside = (known.module, known.beside) if known else (package, ())
    if uv:
        _call(wanted, uv, "venv", "--quiet", "--clear", "--python", other or sys.executable, str(home))
        install = [uv, "pip", "install", "--quiet", "--python", python]
    elif other:
        _call(wanted, str(_found(other)), "-m", "venv", str(home))
        install = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    else:
        # By the pip that is here: a new one in every environment would take longer than the rest.
        _call(wanted, sys.executable, "-m", "venv", "--without-pip", str(home))
        pip = [sys.executable, "-m", "pip", "--python", python]
        install = [*pip, "install", "--quiet", "--disable-pip-version-check"]
    if known and known.npm:
        _make_for_node(home, package, version, install)
    for numpy in NUMPY if not (known and known.npm) else ():
        _call(wanted, *install, wanted, *beside, numpy)
        if subprocess.run([python, "-c", f"import {module}"], capture_output=True, cwd=home).returncode == 0:
            break
    (packages,) = home.glob("lib/python*/site-packages")
    for room in ROOMS:
        (packages / room).symlink_to(LAB / room)


def _make_for_node(home: Path, package: str, version: str, install: Sequence[str]) -> None:
    """NumPy for what tells Node what to do, and the package, as npm has it."""
    wanted = f"{package}@{version}"
    if not (shutil.which("node") and shutil.which("npm")):
        raise InputError(f"{wanted} cannot be installed: expected node and npm on the path")
    _call(wanted, *install, NUMPY[0])
    _call(wanted, "npm", "install", "--silent", "--no-save", "--no-audit", "--no-fund", "--prefix", str(home), wanted)


def _found(version: str) -> Path:
    """An interpreter of another version: on the path, or among pyenv's. Raises InputError where there is none."""
    pyenv = Path(os.environ.get("PYENV_ROOT") or Path.home() / ".pyenv") / "versions"
    for python in [Path(f"python{version}"), *sorted(pyenv.glob(f"{version}.*/bin/python"))]:
        with suppress(OSError):
            if subprocess.run([python, "--version"], capture_output=True).returncode == 0:
                return python
    raise InputError(f"Python {version} is not installed: expected python{version} on the path")


def _call(wanted: str, *words: str) -> None:
    """Run a program. Raises InputError with what it said of what was wanted."""
    plain = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    done = subprocess.run(words, capture_output=True, text=True, env=plain, stdin=subprocess.DEVNULL)
    if done.returncode:
        raise InputError(f"{wanted} cannot be installed: {_reason(done.stderr or done.stdout)}")


def _reason(said: str) -> str:
    """What uv or pip mean, from all they say."""
    words = " ".join(said.split())
    meant = re.search(
        r"Because (.*?)(?: and you require|, we can conclude)|ERROR: (No matching .*?)(?: ERROR|$)", words
    )
    return next(filter(None, meant.groups()))[:200] if meant else words[-200:]


def _python(home: Path) -> Path:
    return home / "bin" / "python"


def _digest(other: str | None = None) -> str:
    """Of what an environment depends on beside its package: its Python, NumPy, and where the lab is."""
    return hashlib.sha256(f"{other or sys.version} {NUMPY} {LAB}".encode()).hexdigest()[:8]


def _dead(folder: Path, home: Path) -> Iterator[Path]:
    """What nobody is at work on or can use: begun for this home, or with a lab or a Python that is gone."""
    for found in filter(Path.is_dir, folder.iterdir()):
        name, unfinished, _ = found.name.partition(UNFINISHED)
        if unfinished:
            usable = name != home.name
        else:
            labs = found.glob("lib/python*/site-packages/engines")  # from Python 3.13 on links to nothing, too
            usable = _python(found).exists() and any(lab.exists() for lab in labs)
        if not usable:
            yield found


@contextmanager
def _locked(file: Path) -> Iterator[None]:
    """One process and thread at a time; the lock of one that is killed is gone with it."""
    import fcntl

    with file.open("w") as opened:
        fcntl.flock(opened, fcntl.LOCK_EX)
        yield
