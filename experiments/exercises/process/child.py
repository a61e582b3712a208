"""What the process of a submission does: sandbox itself, read the submission, call its functions, hand back arrays.

Run as a script by an isolated interpreter that finds NumPy, and this project while it begins; `sandbox` starts it.
What it tells cannot be trusted, as the submission shares the process: only numbers that the checker can compare make a
pass.
"""

from __future__ import annotations

import importlib
import json
import os
import platform
import struct
import sys
import traceback
from collections.abc import Callable, Mapping
from types import ModuleType, SimpleNamespace
from typing import Any

import numpy as np

from experiments.exercises.process import allowed_calls, library_finder, sandbox_layers
from experiments.exercises.process.returned import KINDS, Growing, parts_of, split

#: What a submission is called where its own lines are named.
NAME = "<submission>"

#: Where Python's own modules are.
LIBRARY = os.path.dirname(os.__file__)

#: What of this project is loaded before the sandbox is closed, and where it is; a submission does not find it.
OWN, ROOT = "experiments", os.path.abspath(os.path.join(__file__, *[os.pardir] * 4))

#: What is said before anything else: the sandbox stands and the submission is about to be read, or it does not stand.
READY, CLOSED = b"springlab: ready\n", b"springlab: closed\n"

#: Before a question is put once more: so many steps, each so long [s].
LATER_CALLS, LATER_DT = 10, 1.0

#: Modules that submissions may import, besides Python's own that need no compiled code: loaded before the sandbox is
#: closed, as nothing can be loaded as code then.
PRELOADED = """
    abc argparse array ast base64 bisect builtins calendar cmath collections.abc concurrent.futures contextlib copy csv
    ctypes dataclasses datetime decimal doctest enum errno fractions functools gc getpass glob hashlib heapq html
    inspect io itertools json keyword linecache locale logging math multiprocessing numbers operator os pathlib pickle
    platform pprint queue random re secrets select shutil signal socket statistics string struct subprocess sys
    tempfile textwrap threading time timeit token tokenize traceback types typing unittest uuid warnings weakref
    xml.etree.ElementTree zipfile zlib zoneinfo _strptime encodings.idna encodings.latin_1 encodings.ascii
    encodings.utf_16 encodings.cp1252 numpy.fft numpy.linalg numpy.ma numpy.polynomial numpy.random numpy.testing
    numpy.typing numpy.lib.recfunctions numpy.lib.stride_tricks
"""


def pack(value: Any) -> bytes:
    """Lists, dicts, numbers, words and arrays as bytes: a length, JSON, then the arrays one after another."""
    arrays: list[bytes] = []

    def plain(part: Any) -> Any:
        if isinstance(part, np.ndarray):
            if part.dtype.kind not in KINDS:
                raise ValueError(f"cannot hand over {part.dtype}")
            arrays.append(np.ascontiguousarray(part).tobytes())
            return {"dtype": part.dtype.str, "shape": list(part.shape)}
        if isinstance(part, Mapping):
            return {"fields": {name: plain(p) for name, p in part.items()}}
        return [plain(p) for p in part] if isinstance(part, list | tuple) else part

    head = json.dumps(plain(value)).encode()
    return struct.pack("<Q", len(head)) + head + b"".join(arrays)


def unpack(data: bytes) -> Any:
    """What was packed. Raises ValueError where the bytes are nothing of that kind, whoever wrote them."""
    try:
        (length,) = struct.unpack_from("<Q", data)
        rest = memoryview(data)[8 + length :]

        def full(part: Any) -> Any:
            nonlocal rest
            if isinstance(part, list):
                return [full(p) for p in part]
            if not isinstance(part, dict):
                return part
            if "fields" in part:
                return {name: full(p) for name, p in part["fields"].items()}
            dtype, shape = np.dtype(str(part["dtype"])), tuple(int(n) for n in part["shape"])
            if dtype.kind not in KINDS or any(n < 0 for n in shape) or len(shape) > 8:
                raise ValueError("an array of a kind that is not handed over")
            size = int(np.prod([dtype.itemsize, *shape], dtype=object))
            if size > len(rest):
                raise ValueError("an array that is cut short")
            array = np.frombuffer(rest[:size], dtype).reshape(shape).copy()
            rest = rest[size:]
            return array

        return full(json.loads(data[8 : 8 + length]))
    except (struct.error, KeyError, TypeError, AttributeError, RecursionError, OverflowError) as error:
        raise ValueError(f"not an answer: {error}") from None


def fresh(value: Any) -> Any:
    """The same arguments anew: arrays of their own, a namespace for a dict."""
    if isinstance(value, np.ndarray):
        return value.copy()
    if isinstance(value, Mapping):
        return Growing(value["growing"]) if "growing" in value else SimpleNamespace(**_fields(value))
    return value


def _fields(value: Mapping[str, Any]) -> dict[str, Any]:
    return {name: fresh(v) for name, v in value.items()}


def changed(value: Any, before: Any) -> bool:
    """Whether an argument is no longer what it was."""
    if isinstance(before, np.ndarray):
        return not np.array_equal(value, before, equal_nan=before.dtype.kind == np.asarray(value).dtype.kind == "f")
    if isinstance(before, Mapping) and "growing" not in before:
        return any(changed(getattr(value, name, None), before[name]) for name in before)
    return False


def ask(module: ModuleType, question: dict[str, Any]) -> dict[str, Any]:
    """A question's answers: of one call, or of one for each step, fed with what the last returned."""
    values: list[list[Any]] = []
    answer: dict[str, Any] = {"values": values}
    first, names = question["arguments"], question["parts"]
    arguments, returns = list(first), []
    try:
        function = getattr(module, question["function"])
        for _ in range(max(1, question["steps"])):
            given = [fresh(a) for a in arguments]
            returned = function(*given)
            values.append(parts_of(returned, names))
            if any(changed(g, a) for g, a in zip(given, arguments, strict=True)):
                answer["modified"] = True
            returns.append((split(returned, names), values[-1]))
            if question["steps"] and not all(map(_fits, values[-1], arguments)):
                break
            if question["steps"]:
                fed = [v if np.ndim(a) else v.item() for v, a in zip(values[-1], arguments, strict=False)]
                arguments = [*fed, *first[len(fed) :]]
        answer["overwritten"] = any(
            isinstance(part, np.ndarray) and changed(part, was)
            for returned, before in returns[:-1]
            for part, was in zip(returned, before, strict=True)
        )
        answer["again"] = parts_of(function(*[fresh(a) for a in first]), names)
    except BaseException as error:
        answer["error"] = story(error)
    return answer


def ask_firsts_again(module: ModuleType, questions: list[dict[str, Any]], answers: list[dict[str, Any]]) -> None:
    """Put the first question of each function once more, after all others: what differs by then is its other answer.

    A function that counts calls or adds up time may answer the same at once, and differently only later; so one that
    makes steps has made some long ones by then.
    """
    firsts = {question["function"]: i for i, question in reversed(list(enumerate(questions)))}
    for i in firsts.values():
        if "error" in answers[i]:
            continue
        _let_time_pass(module, questions[i])
        late = ask(module, {**questions[i], "steps": 0})
        if "error" in late:
            answers[i]["error"] = late["error"]
        elif pack([late["again"]]) != pack(answers[i]["values"][:1]):
            answers[i]["again"] = late["again"]


def _let_time_pass(module: ModuleType, question: dict[str, Any]) -> None:
    """Some steps of a question that are long ones, whatever comes of them: dt stands behind the state."""
    place = len(question["parts"])
    if not question["steps"]:
        return
    for _ in range(LATER_CALLS):
        given = [fresh(a) for a in question["arguments"]]
        given[place] = LATER_DT
        try:
            getattr(module, question["function"])(*given)
        except Exception:  # nothing that was asked for: such a step may overflow
            return


def _fits(value: Any, argument: Any) -> bool:
    """Whether what was returned can be what the next step is given: of the same shape, no whole numbers for others."""
    before = np.asarray(argument)
    return value.shape in (before.shape, (1,) * (not before.ndim)) and (value.dtype.kind == "f") >= (
        before.dtype.kind == "f"
    )


def story(error: BaseException) -> dict[str, Any]:
    """An exception, with the line of the submission it came from."""
    lines = [f.lineno for f in traceback.extract_tb(error.__traceback__) if f.filename == NAME]
    line = error.lineno if isinstance(error, SyntaxError) and error.filename == NAME else lines[-1] if lines else None
    line = line or getattr(error, "line", None)  # of a C submission
    words = error.msg if isinstance(error, SyntaxError) else str(error)
    return {"type": type(error).__name__, "words": str(words)[:300], "line": line}


def read_all(handle: int) -> bytes:
    """A file from its beginning."""
    os.lseek(handle, 0, os.SEEK_SET)
    return b"".join(iter(lambda: os.read(handle, 2**20), b""))


def main() -> None:
    """Standard input has the task, standard output takes the answer; what the submission prints goes elsewhere.

    READY goes to a file of its own, which is closed before the submission is read, once the sandbox stands: whatever
    ends the process before that is no fault of the submission. It is not read at all where a layer is missing, unless
    that was asked for.
    """
    task = unpack(read_all(0))
    out = os.dup(1)
    os.dup2(2, 1)
    preload()
    compiled = task.get("library")
    searching = "c.switched" if compiled else "repair.source_search"
    search = importlib.import_module(f"{OWN}.exercises.{searching}").search if task.get("search") else None
    c_calls = importlib.import_module(f"{OWN}.exercises.c.calls") if compiled else None
    library = library_finder.LibraryFinder(os.open(LIBRARY, os.O_RDONLY), LIBRARY)
    wanted = sandbox_layers.wanted()
    calls = allowed_calls.filter_of(platform.machine(), os.getpid(), bool(compiled))
    active = sandbox_layers.apply(task["readable"], task["seconds"], task["memory"], task["parent"], calls)
    sys.path[:] = [path for path in sys.path if path not in (ROOT, *task["hidden"])]
    if not os.access(LIBRARY, os.R_OK):
        sys.meta_path.append(library)
    for name in [name for name in sys.modules if name.split(".")[0] == OWN]:
        del sys.modules[name]
    np.seterr(all="ignore")
    missing = [name for name in wanted if name not in active]
    stands = not missing or task["exposed"]
    os.write(task["mark"], (READY if stands else CLOSED) + pack({"layers": active, "missing": missing}))
    os.close(task["mark"])
    if stands:
        os.write(out, pack(answered(task, search, c_calls)))
    os._exit(0)  # at once: threads and exit functions of the submission have nothing more to say


def preload() -> None:
    """All modules that submissions import, as no code can be loaded later."""
    for name in PRELOADED.split():
        try:
            importlib.import_module(name)
        except ImportError:  # not in this Python
            continue


def answered(task: Mapping[str, Any], search: Callable[..., Any] | None = None, c_calls: Any = None) -> dict[str, Any]:
    """What the submission answers, or what reading it raised; and what a search for small changes finds.

    Args:
        c_calls: the module by which a compiled C submission is called.
    """
    module = ModuleType("submission")
    module.__file__ = os.path.join(task["folder"], "submission.py")  # files of the exercise are beside it
    sys.modules["submission"] = module
    try:
        if task.get("library"):
            module = c_calls.module_of(task["library"], task["exercise"], task["lines"])
        else:
            exec(compile(task["source"], NAME, "exec"), module.__dict__)
        names = [name for name in module.__dict__ if not name.startswith("_")]
        answers = [ask(module, question) for question in task["questions"]]
        ask_firsts_again(module, task["questions"], answers)
        found = {"names": names, "answers": answers}
    except BaseException as error:
        return {"error": story(error)}
    if search is not None:
        found["search"] = search({**task, **task["search"]}, fresh, changed)
    return found


if __name__ == "__main__":
    main()
