"""Engines that a page carries, so that they step in it: those that are WebAssembly, as their packages of npm have them.

What steps in the page is then the very program that the lab runs under Node, told the same by the same script.
"""

from __future__ import annotations

import base64
import gzip
import json
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from engines.jolt.soft_body import ENGINES, HOST, PACKAGE, JoltSoftBody, check
from engines.process.available import how_to_install, interpreter
from reference.errors import InputError, Unsupported
from reference.line import system_in_plane
from reference.system import MassSpringSystem

#: Those that a page can carry, by name.
CARRIED = {engine.name: engine for engine in ENGINES}


def engine_script() -> str:
    """What tells the engine what to do, as a script of the page."""
    return HOST.with_name("soft_body.mjs").read_text(encoding="utf-8").replace("export function", "function")


def carried_engines(names: Sequence[str]) -> dict[str, Any]:
    """The engines as the page reads them: what each is, and their program.

    Raises:
        InputError: for a name of none that a page can carry, and where its package is not installed.
    """
    engines = [_found(name) for name in dict.fromkeys(names)]
    if not engines:
        return {}
    (package,) = {engine.package for engine in engines}
    home = _package_folder(package)
    told = json.loads((home / "package.json").read_text(encoding="utf-8"))
    program = (home / "dist" / Path(PACKAGE).name).read_bytes()
    return {
        "engines": [_data(engine, told["version"]) for engine in engines],
        "program": base64.b64encode(gzip.compress(program, 9, mtime=0)).decode(),
        "licence": (home / "LICENSE").read_text(encoding="utf-8"),
    }


def refusals(names: Iterable[str], system: MassSpringSystem) -> dict[str, str]:
    """Why engines cannot run a system; empty of those that can."""
    said = {}
    for name in names:
        try:
            check(CARRIED[name], system_in_plane(system))
        except Unsupported as reason:
            said[name] = str(reason)
        else:
            said[name] = ""
    return said


def _data(engine: JoltSoftBody, version: str) -> dict[str, Any]:
    settings = ", ".join(f"{name} = {value}" for name, value in engine.settings.items())
    about = {"name": engine.name, "package": engine.package, "version": version, "precision": engine.precision}
    return {**about, "substeps": engine.substeps, "settings": settings, "semantics": engine.semantics}


def _found(name: str) -> JoltSoftBody:
    if name not in CARRIED:
        raise InputError(f"--with {name}: expected one of {', '.join(CARRIED)}; --record lays a run of any other over")
    return CARRIED[name]


def _package_folder(package: str) -> Path:
    python = interpreter(package)
    if python is None:
        raise InputError(how_to_install(package))
    return python.parents[1] / Path(PACKAGE).parents[1]
