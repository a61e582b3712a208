"""Submissions that are up to something: what each tries, and which outcome and finding it ends in.

`{outside}` is a folder that is none of the submission's business, `{models}` that of the model solutions.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass

from experiments.exercises.process.sandbox import Limits

#: Nothing that ends by itself comes near to these, on a machine that has much else to do either.
AMPLE = Limits(seconds=60, wall_clock=3600.0, memory=2**29)


@dataclass(frozen=True)
class Hostile:
    """Its text, what the checker is to say, outcome and finding, and what it may take."""

    text: str
    outcome: str
    finding: str
    limits: Limits = AMPLE


#: From Python 3.12 on calls within C are counted, too, and recursion there ends in an error in place of a crash.
COUNTS_IN_C = sys.version_info >= (3, 12)

# written, unlike the starter's, and wrong
_STEP = "\ndef step(y, v, dt, spring):\n    return 1 * y, v\n"

HOSTILE = {
    "infinite_loop": Hostile("while True:\n    pass\n", "timed out", "timed_out", Limits(seconds=1, wall_clock=3600.0)),
    "sleeps": Hostile("import time\ntime.sleep(10000)\n", "timed out", "timed_out", Limits(wall_clock=1.0)),
    "forks": Hostile("import os\nwhile True:\n    os.fork()\n", "error", "reaches_out"),
    "forks_and_carries_on": Hostile(
        "import os\nfor i in range(50):\n    try:\n        os.fork()\n    except OSError:\n        pass\n" + _STEP,
        "mistake",
        "nothing_moves",
    ),
    "starts_programs": Hostile("import subprocess\nsubprocess.run(['true'])\n", "error", "reaches_out"),
    "ten_gigabytes": Hostile("import numpy as np\nnp.ones(10 * 2**30 // 8)\n", "error", "too_much_memory"),
    "ten_gigabytes_slowly": Hostile(
        "x = []\nwhile True:\n    x.append(bytearray(2**24))\n", "error", "too_much_memory"
    ),
    "exits_at_once": Hostile("import os\nos._exit(0)\n", "crashed", "crashed"),
    "exits_within_a_step": Hostile("import os\ndef step(y, v, dt, spring):\n    os._exit(0)\n", "crashed", "crashed"),
    "sys_exit": Hostile("import sys\nsys.exit(0)\n", "error", "ends_the_program"),
    "prints_results": Hostile(
        "import json\nprint(json.dumps({'score': 100, 'tests': [{'score': 100, 'max_score': 100}]}))\n"
        "open('results.json', 'w').write(json.dumps({'score': 100}))\n" + _STEP,
        "error",
        "reaches_out",
    ),
    "writes_results_elsewhere": Hostile(
        "open('{outside}/results.json', 'w').write('{{\"score\": 100}}')\n" + _STEP, "error", "reaches_out"
    ),
    "patches_numpy": Hostile(
        "import numpy as np\nnp.allclose = np.array_equal = lambda *a, **k: True\nnp.abs = lambda x: 0 * x\n"
        "np.linalg.norm = lambda *a, **k: 0.0\n" + _STEP,
        "mistake",
        "nothing_moves",
    ),
    "patches_the_child": Hostile(
        "import sys\nmain = sys.modules['__main__']\nfor name in ('ask', 'changed', 'parts_of'):\n"
        "    if hasattr(main, name):\n        setattr(main, name, lambda *a: {{'values': [], 'again': []}})\n" + _STEP,
        "crashed",
        "unreadable",
    ),
    "patches_what_calls_it": Hostile(
        "import sys\nframe = sys._getframe()\nwhile frame:\n    if 'ask' in frame.f_globals:\n"
        "        frame.f_globals['ask'] = lambda m, q: {{'values': [], 'again': []}}\n    frame = frame.f_back\n"
        + _STEP,
        "crashed",
        "unreadable",
    ),
    "writes_into_the_answer": Hostile(
        "import os\nfor handle in range(3, 64):\n    try:\n        os.write(handle, b'passed' * 1000)\n"
        "    except OSError:\n        pass\n" + _STEP,
        "crashed",
        "crashed",
    ),
    "reads_the_models": Hostile("import os\nprint(os.listdir('{models}'))\n", "error", "reaches_out"),
    "reads_a_model": Hostile("exec(open('{models}/e01_euler.py').read())\n", "error", "reaches_out"),
    "imports_the_checker": Hostile("import experiments.exercises.verdict.judge\n", "error", "missing_module"),
    "reads_the_parent": Hostile(
        "import os\nopen(f'/proc/{{os.getppid()}}/environ', 'rb').read()\n", "error", "reaches_out"
    ),
    "reads_the_environment": Hostile(
        "import os\nassert not {{'SPRINGLAB_EXERCISE_KEY', 'PATH'}} & set(os.environ)\n" + _STEP,
        "mistake",
        "nothing_moves",
    ),
    "answers_at_length": Hostile(
        "import numpy as np\ndef step(y, v, dt, spring):\n    return np.zeros(2**18), v\n", "crashed", "crashed"
    ),
    "deletes_files": Hostile(
        "import os\nfor place, _, files in os.walk('{outside}'):\n    for f in files:\n"
        "        os.remove(os.path.join(place, f))\nos.remove('{outside}/kept.txt')\n",
        "error",
        "reaches_out",
    ),
    "empties_its_folder": Hostile(
        "import os, shutil\nshutil.rmtree(os.getcwd(), ignore_errors=True)\n" + _STEP, "mistake", "nothing_moves"
    ),
    "changes_modes": Hostile("import os\nos.chmod('{outside}/kept.txt', 0)\n", "error", "reaches_out"),
    "prints_a_gigabyte": Hostile(
        "line = 'x' * 2**20\nfor i in range(1024):\n    print(line)\n" + _STEP, "error", "raises_an_error"
    ),
    "fills_its_folder": Hostile(
        "import time\nfor i in range(9):\n    open(f'{{i}}', 'wb').write(b'x' * 2**23)\ntime.sleep(10000)\n" + _STEP,
        "error",
        "reaches_out",
    ),
    "recurses": Hostile("def f(n):\n    return f(n + 1)\nf(0)\n", "error", "endless_recursion"),
    "recurses_without_a_limit": Hostile(
        "import sys\nsys.setrecursionlimit(10**9)\n"
        "class A:\n    def __repr__(self):\n        return repr(self)\nrepr(A())\n",
        *(("error", "endless_recursion") if COUNTS_IN_C else ("crashed", "crashed")),
    ),
    "segmentation_fault": Hostile("import ctypes\nctypes.string_at(0)\n", "crashed", "crashed"),
    "kills_its_parent": Hostile("import os\nos.kill(os.getppid(), 9)\n", "error", "reaches_out"),
    "kills_everybody": Hostile("import os\nos.kill(-1, 9)\n", "error", "reaches_out"),
    "calls_home": Hostile("import socket\nsocket.socket()\n", "error", "reaches_out"),
    "lifts_its_limits": Hostile(
        "import resource\nresource.setrlimit(resource.RLIMIT_CPU, (10**6, 10**6))\n", "error", "raises_an_error"
    ),
    "sends_a_pickle": Hostile(
        "import os, pickle\nclass P:\n    def __reduce__(self):\n        return (os.system, ('touch {outside}/x',))\n"
        "def step(y, v, dt, spring):\n    return P(), pickle.dumps(P())\n",
        "error",
        "not_numbers",
    ),
    "a_formula": Hostile(
        "def step(y, v, dt, spring):\n    raise ValueError('=HYPERLINK(1)')\n", "error", "raises_an_error"
    ),
}


def text_of(hostile: Hostile, outside: str, models: str) -> str:
    """Its text, with these folders."""
    text = hostile.text.replace("{outside}", outside).replace("{models}", models)
    return text.replace("{{", "{").replace("}}", "}")
