"""Gradescope: results in its format, and a zip that makes them there.

The format is that of Gradescope's autograder specifications (readthedocs, "Output format"): tests with score,
max_score, status, output and visibility. The zip carries what a check needs of springlab, and asks for nothing but the
ordinary package index.
"""

from __future__ import annotations

import json
import sys
import zipfile
from collections.abc import Iterator, Mapping
from importlib import metadata
from io import BytesIO
from pathlib import Path
from typing import Any

from experiments.exercises.exercise import Exercise, find
from experiments.exercises.grading import Grade, grade
from experiments.exercises.handed_in.submission import Submission, files_of, read
from experiments.exercises.process.sandbox import Limits
from experiments.exercises.process.sandbox_errors import NotGradedError
from experiments.exercises.teaching.words import UNSEEN, paragraphs
from experiments.exercises.teaching.writing import write_anew
from reference.errors import InputError

#: The checker's own packages; a submission's process has NumPy alone.
PACKAGES = ("numpy", "numba", "scipy")

#: What of springlab the zip carries.
CARRIED = (
    "reference/**/*.py",
    "engines/__init__.py",
    "engines/own/__init__.py",
    "engines/own/c_file.py",
    "experiments/__init__.py",
    "experiments/exercises/**/*.py",
    "experiments/exercises/c/*.[ch]",
    "experiments/exercises/e*/*.*",
)

#: Makes the environment, once, when the image is built.
SETUP = """#!/usr/bin/env bash
# Run once by Gradescope, as root, to build the image. Needs the package indexes of apt and pip, nothing else.
set -euo pipefail
cd "$(dirname "${{BASH_SOURCE[0]}}")"
python=python3
if ! $python -c 'import sys; sys.exit(sys.version_info < (3, 11))'; then
    apt-get update -q
    apt-get install -yq --no-install-recommends python3.11 python3.11-venv
    python=python3.11
fi
$python -m venv --help >/dev/null || {{ apt-get update -q && apt-get install -yq python3-venv; }}
$python -m venv ../springlab-venv
{compiler}../springlab-venv/bin/python -m pip install --quiet --disable-pip-version-check {packages}
"""

#: Of an exercise that can be done in C: the compiler.
COMPILER = "command -v cc >/dev/null || { apt-get update -q && apt-get install -yq gcc libc6-dev; }\n"

#: Grades one submission: run in the folder that has source, submission and results.
RUN = """#!/usr/bin/env bash
# Run by Gradescope for every submission: source, submission and results stand beside this file.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
mkdir -p results
chmod -R go-rwx source
python="${SPRINGLAB_PYTHON:-$PWD/springlab-venv/bin/python}"
PYTHONPATH="$PWD/source" exec "$python" -m experiments.exercises.teaching.gradescope submission results/results.json \
source/exercise.json
"""


def results(submission: Submission, given: Grade) -> dict[str, Any]:
    """A grade in Gradescope's format: the public check is seen at once, the hidden one when grades are published."""
    said = "\n".join(paragraphs(submission, Grade(given.public, None, given.seconds)))
    if given.hidden is not None:
        said = said.replace(UNSEEN, "The hidden one is told later.")
    tests = [_test("Public check", "1", given.public.right, given.public.passed, "visible", said)]
    if given.hidden is not None:
        said = "\n".join(paragraphs(submission, given))
        tests.append(_test("Hidden check", "2", given.hidden.right, given.hidden.passed, "after_published", said))
    return {
        "score": round(given.score, 2),
        "execution_time": round(given.seconds, 2),
        "output": f"Exercise {submission.exercise.number}: {submission.exercise.title}",
        "output_format": "text",
        "visibility": "visible",
        "stdout_visibility": "hidden",
        "tests": tests,
        "extra_data": {
            "outcome": given.verdict.outcome,
            "finding": given.verdict.name,
            "walls": list(given.public.layers),
        },
    }


def _test(name: str, number: str, right: bool, passed: tuple[bool, ...], visibility: str, said: str) -> dict[str, Any]:
    return {
        "name": name,
        "number": number,
        "score": round(100 * sum(passed) / max(1, len(passed)), 2),
        "max_score": 100.0,
        "status": "passed" if right else "failed",
        "output_format": "text",
        "visibility": visibility,
        "output": said,
    }


def refused(reason: str) -> dict[str, Any]:
    """What is said of a submission that cannot be graded."""
    test = _test("Public check", "1", False, (), "visible", reason)
    return {"score": 0.0, "output": reason, "visibility": "visible", "stdout_visibility": "hidden", "tests": [test]}


def not_graded(reason: str) -> dict[str, Any]:
    """What is said where the submission is not to blame: no score, which Gradescope shows as a failed autograder."""
    words = f"This was not graded, which is not your fault: {reason}. Hand it in again, or tell your teacher."
    return {"output": words, "visibility": "visible", "stdout_visibility": "hidden"}


def grade_folder(folder: Path, settings: Mapping[str, Any]) -> dict[str, Any]:
    """The results of the one submission in a folder.

    Args:
        settings: exercise (its name), key, exposed (`sandbox.Limits`), keyed (`submission.read`).
    """
    exercise = find(str(settings["exercise"]))
    try:
        files = files_of([folder])
        named = [f for f in files if Path(f[1]).stem == exercise.name] or files
        if len(named) != 1:
            raise InputError(f"{len(named)} files: expected one, {exercise.name}.py{_or_c(exercise)}")
        ((path, name),) = named
        submission = read(path, name, exercise, bool(settings.get("keyed", True)))
    except InputError as error:
        return refused(str(error))
    try:
        limits = Limits(exposed=bool(settings.get("exposed", False)))
        return results(submission, grade(submission, settings["key"], limits))
    except NotGradedError as error:
        return not_graded(str(error))


def _or_c(exercise: Exercise) -> str:
    return "" if exercise.starter_in_c is None else f" or {exercise.name}.c"


def write_zip(exercise: Exercise, key: str, file: Path, exposed: bool = False, keyed: bool = True) -> None:
    """Write the autograder of an exercise.

    Args:
        key: of its hidden check.
        exposed: whether it grades even where nothing keeps submissions from files and processes.
        keyed: whether the exercise was handed out with the key.
    """
    content = BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        settings = {"exercise": exercise.name, "key": key, "exposed": exposed, "keyed": keyed}
        packages = " ".join(f"{name}=={metadata.version(name)}" for name in PACKAGES)
        _add(
            archive,
            "setup.sh",
            SETUP.format(packages=packages, compiler=COMPILER if exercise.starter_in_c else ""),
            executable=True,
        )
        _add(archive, "run_autograder", RUN, executable=True)
        _add(archive, "exercise.json", json.dumps(settings) + "\n")
        for name, path in sorted(set(_carried(exercise))):
            _add(archive, name, path.read_text(encoding="utf-8"))
    write_anew(file, content.getvalue())


def _carried(exercise: Exercise) -> Iterator[tuple[str, Path]]:
    root = Path(__file__).parents[3]
    for pattern in CARRIED:
        for path in root.glob(pattern):
            if path.is_file():
                yield path.relative_to(root).as_posix(), path
    if root not in exercise.folder.parents:
        for path in exercise.folder.iterdir():
            yield f"experiments/exercises/{exercise.folder.name}/{path.name}", path


def _add(archive: zipfile.ZipFile, name: str, text: str, executable: bool = False) -> None:
    entry = zipfile.ZipInfo(name, (2020, 1, 1, 0, 0, 0))
    entry.compress_type = zipfile.ZIP_DEFLATED
    entry.external_attr = (0o100755 if executable else 0o100644) << 16
    archive.writestr(entry, text)


def main(folder: str, out: str, settings: str) -> None:
    """What run_autograder calls."""
    try:
        found = grade_folder(Path(folder), json.loads(Path(settings).read_text(encoding="utf-8")))
    except Exception as error:  # a result that says so is better than none
        found = not_graded(f"the checker itself failed, {type(error).__name__}")
        print(f"{type(error).__name__}: {error}", file=sys.stderr)
    Path(out).write_text(json.dumps(found, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:4])
