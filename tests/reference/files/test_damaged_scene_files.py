"""Scene files that nobody meant: pieces cut out and others put in make a setup, or one line."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from reference.errors import InputError
from reference.files.scene_file import load
from tests.reference.files.test_scene_file import NAMED, WRITTEN_OUT
from tests.reference.systems import property_test

PIECES = [
    "nan",
    "inf",
    "-1",
    "1e308",
    "[",
    "]",
    "[[",
    '"',
    "'",
    "=",
    "\n",
    "\n[",
    ",",
    "true",
    "{}",
    "1979-05-27",
    "99999999999999999999999",
    "é",
    "#",
    ".",
]


def mutated(text: str, edits: list[tuple[int, int, str]]) -> str:
    """The text with pieces cut out and others put in their place."""
    for place, length, piece in edits:
        at = place % (len(text) + 1)
        text = text[:at] + piece + text[at + length :]
    return text


@settings(property_test, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    text=st.sampled_from([NAMED, WRITTEN_OUT]),
    edits=st.lists(
        st.tuples(st.integers(0, 2000), st.integers(0, 12), st.sampled_from(PIECES) | st.text(max_size=3)),
        min_size=1,
        max_size=3,
    ),
)
@example(text=WRITTEN_OUT, edits=[(WRITTEN_OUT.index("[1, 2]"), 6, "[1]")])
@example(text=WRITTEN_OUT, edits=[(WRITTEN_OUT.index("3.0, 4.0"), 8, "1e200, 0")])
@example(text=NAMED, edits=[(NAMED.index("20"), 2, "9" * 30)])
@example(text="a = " + 5000 * "[", edits=[(0, 0, "")])
def test_a_mutated_file_makes_a_setup_or_one_line(tmp_path: Path, text: str, edits: list[tuple[int, int, str]]) -> None:
    """Nothing but an InputError, naming the file; and what is taken is a system of finite numbers."""
    file = tmp_path / "mutant.toml"
    file.write_bytes(mutated(text, edits).encode("utf-8", errors="surrogatepass"))
    message = None
    try:
        setup = load(file, {})
    except InputError as error:
        message = str(error)
    if message is None:
        assert np.isfinite(setup.system.positions).all()
    else:
        assert message.startswith(f"scene file {file}")
        assert "\n" not in message
