"""A hundred more submissions that are up to something, by what they ask the kernel for, or write in place of an answer.

Each of those that ask is refused, which they take note of, and goes on with a step in which nothing moves; where it is
not refused it says "through". `{outside}` is a folder that is none of its business.
"""

from __future__ import annotations

from experiments.exercises.process.sandbox import Limits
from tests.experiments.exercises.process.hostile import Hostile

# written, unlike the starter's, and wrong
_STEP = "\ndef step(y, v, dt, spring):\n    return 1 * y, v\n"

#: By kind: the calls of x86-64 with their arguments, as Python's ctypes takes them.
CALLS = {
    "devices": [
        "133, b'disk', 0o60666, 0x800",
        "259, -100, b'disk', 0o60666, 0x800",
        "165, b'/', b'/mnt', b'', 4096, 0",
    ],
    "attributes": [
        "188, b'{outside}/kept.txt', b'user.a', b'b', 1, 0",
        "463, -100, b'{outside}/kept.txt', 0, b'user.a', 0, 0",
        "469, -100, b'{outside}/kept.txt', 0, 0, 0",
        "90, b'{outside}/kept.txt', 0",
        "452, -100, b'{outside}/kept.txt', 0, 0",
        "92, b'{outside}/kept.txt', 1, 1",
        "280, -100, b'{outside}/kept.txt', 0, 0",
    ],
    "flags of files": ["16, 0, 0x40086602, 0", "16, 0, 0xC0045877, 0", "16, 0, 0x5412, b'x'"],
    "watching": ["253", "294, 0", "300, 0, 0", "301, 3, 1, 2, -100, b'/'", "254, 0, b'/', 2"],
    "shared memory": [
        "29, 0, 4096, 0o1666",
        "30, 0, 0, 0",
        "31, 0, 0, 0",
        "64, 1, 1, 0o1666",
        "68, 1, 0o1666",
        "240, b'q', 66, 438, 0",
    ],
    "new files": [
        "83, b'folder', 0o300",
        "258, -100, b'folder', 0o300",
        "85, b'file', 0o666",
        "2, b'file', 65, 438",
        "257, -100, b'file', 65, 438",
        "437, -100, b'file', b'', 24",
    ],
    "names of files": [
        "82, b'a', b'{outside}/kept.txt'",
        "86, b'{outside}/kept.txt', b'a'",
        "88, b'/etc/passwd', b'a'",
        "87, b'{outside}/kept.txt'",
        "84, b'{outside}'",
        "316, -100, b'a', -100, b'b', 2",
        "133, b'pipe', 0o10666, 0",
    ],
    "sizes of files": ["76, b'{outside}/kept.txt', 0", "77, 0, 0", "285, 0, 0, 0, 4096"],
    "other programs": [
        "57",
        "58",
        "59, b'/bin/true', 0, 0",
        "322, -100, b'/bin/true', 0, 0, 0",
        "56, 17, 0, 0, 0, 0",
        "435, b'', 88",
    ],
    "other processes": [
        "62, os.getppid(), 0",
        "62, -1, 0",
        "200, os.getppid(), 0",
        "234, os.getppid(), os.getppid(), 0",
        "101, 16, os.getppid(), 0, 0",
        "310, os.getppid(), 0, 0, 0, 0, 0",
        "434, os.getppid(), 0",
        "424, 0, 9, 0, 0",
        "129, os.getppid(), 9, 0",
        "312, os.getppid(), os.getppid(), 0, 0, 0",
    ],
    "signals by files": [
        "72, 0, 8, os.getppid()",
        "72, 0, 10, 9",
        "72, 0, 15, 0",
        "72, 0, 4, 0o20000",
        "72, 0, 1024, 0",
    ],
    "limits and priorities": [
        "160, 7, b''",
        "302, os.getppid(), 7, b'x' * 16, 0",
        "141, 0, 0, -20",
        "203, 0, 8, b'x' * 8",
        "144, 0, 1, b'x' * 4",
        "251, 1, 0, 0",
    ],
    "its own end": ["157, 1, 0, 0, 0, 0", "157, 38, 0, 0, 0, 0", "157, 4, 1, 0, 0, 0", "37, 1", "38, 0, 0, 0"],
    "memory as code": [
        "9, 0, 4096, 7, 34, -1, 0",
        "10, 4096, 4096, 7",
        "329, 4096, 4096, 7, -1",
        "319, b'x', 0",
        "447, 0",
        "323, 1",
    ],
    "users": ["105, 0", "117, 0, 0, 0", "116, 0, 0", "126, b'x' * 8, b'x' * 24", "272, 0x10000000", "308, 0, 0"],
    "network": ["41, 1, 1, 0", "53, 1, 1, 0, b'x' * 8", "42, 0, 0, 0", "425, 8, b'x' * 120", "288, 0, 0, 0, 0"],
    "the machine": [
        "169, 0xFEE1DEAD, 672274793, 0",
        "164, 0, 0",
        "227, 0, b'x' * 16",
        "170, b'h', 1",
        "103, 3, 0, 0",
        "175, 0, 0, b''",
        "161, b'/'",
        "155, b'/', b'/'",
        "80, b'/'",
    ],
    "the kernel's own": [
        "321, 0, 0, 0",
        "298, b'x' * 64, 0, -1, -1, 0",
        "248, b'user', b'a', b'b', 1, -1",
        "250, 0, -1, 0",
        "304, 0, 0, 0",
        "303, -100, b'/', b'x' * 8, 0, 0",
        "317, 1, 0, b''",
        "444, 0, 0, 1",
    ],
    "copies": [
        "40, 1, 0, 0, 1",
        "275, 0, 0, 1, 0, 1, 0",
        "326, 0, 0, 1, 0, 1, 0",
        "278, 1, 0, 0, 0",
        "18, 0, b'x', 1, 0",
    ],
}

#: What is written in place of an answer: with `main` the module that asks, and `out` the answer's file.
FORGED = {
    "again_of_numbers": "{'values': [[np.zeros(()), np.zeros(())]], 'again': [1, 2]}",
    "half_a_letter": "{'values': [], 'error': {'type': '\\ud800', 'words': '', 'line': 1}}",
    "an_array_of_layers": "{'values': [], 'error': {'type': np.ones(3), 'words': '', 'line': 1}}",
    "a_score": "{'values': [], 'error': {'type': 'E', 'words': '', 'line': 1}, 'score': 100}",
    "an_endless_line": "{'values': [], 'error': {'type': 'E', 'words': 'x' * 10**6, 'line': 1}}",
    "no_values": "{'again': []}",
    "values_of_words": "{'values': ['a'], 'again': []}",
    "a_line_below_zero": "{'values': [], 'error': {'type': 'E', 'words': '', 'line': -5}}",
}


def _call(call: str) -> str:
    return (
        "import ctypes, os\nlibc = ctypes.CDLL(None, use_errno=True)\n"
        f"if libc.syscall({call}) != -1 or ctypes.get_errno() not in (1, 38):\n    raise RuntimeError('through')\n"
        + _STEP
    )


def _forged(answer: str) -> str:
    return (
        "import sys\nimport numpy as np\nmain = sys._getframe()\nwhile main and 'ask' not in main.f_globals:\n"
        "    main = main.f_back\n"
        f"main.f_globals['ask'] = lambda module, question: {answer}\n" + _STEP
    )


HOSTILE_CALLS = {
    f"{kind.replace(' ', '_')}_{i}": Hostile(
        _call(call).replace("{", "{{").replace("}", "}}").replace("{{outside}}", "{outside}"),
        "mistake",
        "nothing_moves",
    )
    for kind, calls in CALLS.items()
    for i, call in enumerate(calls)
}
HOSTILE_CALLS |= {
    f"forges_{name}": Hostile(
        _forged(answer).replace("{", "{{").replace("}", "}}"),
        # values that are missing are an error in its own process already
        *(("error", "raises_an_error") if name == "no_values" else ("crashed", "crashed")),
    )
    for name, answer in FORGED.items()
}
HOSTILE_CALLS |= {
    "ignores_its_time": Hostile(
        "import signal\nsignal.signal(signal.SIGXCPU, signal.SIG_IGN)\nwhile True:\n    pass\n",
        "timed out",
        "timed_out",
        Limits(seconds=1, wall_clock=3600.0),
    ),
    "sleeps_within_a_step": Hostile(
        "import time\ndef step(y, v, dt, spring):\n    time.sleep(1000)\n",
        "timed out",
        "timed_out",
        Limits(wall_clock=1.0),
    ),
    "many_threads": Hostile(
        "import threading, time\nfor i in range(10**6):\n    threading.Thread(target=time.sleep, args=(9,)).start()\n",
        "error",
        "raises_an_error",
    ),
    "says_that_it_is_ready": Hostile(
        "import os\nos.write(3, b'springlab: closed\\n' * 9)\nos._exit(0)\n", "crashed", "crashed"
    ),
    "strikes_itself": Hostile("import signal\nsignal.raise_signal(signal.SIGKILL)\n", "error", "reaches_out"),
    "answers_in_words": Hostile("def step(y, v, dt, spring):\n    return str(y), 'fast'\n", "error", "not_numbers"),
    "writes_over_its_answer": Hostile(
        "import os\nfor handle in range(3, 64):\n    try:\n        os.lseek(handle, 0, 0)\n"
        "        os.write(handle, b'springlab: closed\\n')\n    except OSError:\n        pass\nos._exit(0)\n",
        "crashed",
        "crashed",
    ),
    "ends_with_120": Hostile("import os\nos._exit(120)\n", "crashed", "crashed"),
    "aborts": Hostile("import os\nos.abort()\n", "crashed", "crashed"),
    "loads_more_code": Hostile("import sqlite3\n", "error", "missing_module"),
    "asks_for_a_folder": Hostile("import tempfile\ntempfile.mkdtemp()\n", "error", "reaches_out"),
    "asks_who_waits": Hostile("open('/proc/self/environ').read()\n", "error", "reaches_out"),
    "lists_the_machine": Hostile("import os\nos.listdir('/')\n", "error", "reaches_out"),
}
