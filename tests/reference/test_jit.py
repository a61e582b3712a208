"""Compiled texts: each kept under the digest of all it was made from, and made anew where anything of it is another."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from reference.jit import HEADER, INNER, array, compiled, module, text_of
from reference.state import Array


@pytest.fixture
def kernels(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty cache of compiled modules."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    return tmp_path / "springlab" / "kernels"


def ratio(a: float, b: float) -> float:
    """A part of something."""
    return a / b


def squared_ratio(a: float, b: float) -> float:
    """Another function's work, squared."""
    return ratio(a, b) ** 2


def test_what_is_compiled_is_the_text_without_its_types_and_docstring() -> None:
    """So that a comment or a type that is another compiles nothing anew."""
    assert text_of(ratio).endswith("\ndef ratio(a, b):\n    return a / b")
    assert text_of(squared_ratio).endswith("\ndef squared_ratio(a, b):\n    return ratio(a, b) ** 2")
    assert text_of(ratio).startswith("@njit(")
    assert text_of(ratio, inner=True) == text_of(ratio).replace("'numpy')", f"'numpy', {INNER})")


def test_functions_call_those_before_them_and_divide_as_numpy_does(kernels: Path) -> None:
    """x/0 is infinite, and 0/0 is not a number: no exception."""
    one, two = compiled(ratio, squared_ratio)
    assert one(3.0, 2.0) == 1.5
    assert two(3.0, 2.0) == 2.25
    assert two(-1.0, 0.0) == np.inf
    assert np.isnan(one(0.0, 0.0))


def doubled(a: Array, out: Array) -> None:
    """Write twice the numbers."""
    for i in range(len(a)):
        out[i] = 2 * a[i]


def test_with_kinds_a_function_is_compiled_once_whoever_may_write_what_it_is_given(kernels: Path) -> None:
    """And for nothing else: another kind of array is refused. Without kinds each of them is compiled anew."""
    sealed = np.array([1.0, 2.0])
    sealed.flags.writeable = False
    (once,) = compiled(doubled, kinds={"a": array(1), "out": array(1, written=True), "unused": "int64"})
    (anew,) = compiled(doubled)
    for function, many in ((once, 1), (anew, 2)):
        for a in (sealed, sealed.copy()):
            out = np.zeros(2)
            function(a, out)
            assert out.tolist() == [2.0, 4.0]
        assert len(function.signatures) == many
    with pytest.raises(TypeError, match="No matching definition"):
        once(np.array([1, 2]), np.zeros(2))
    assert text_of(doubled, {"a": "float64"}) == text_of(doubled)


def test_every_text_is_a_module_of_its_own(kernels: Path) -> None:
    """And the same text the same one; nothing half-written is left."""
    first, again, other = (module(f"{HEADER}\nvalue = {value}\n") for value in (1.5, 1.5, 2.5))
    assert first is again
    assert (first.value, other.value) == (1.5, 2.5)
    assert {file.suffix for file in kernels.iterdir() if file.is_file()} == {".py"}
    assert len(list(kernels.glob("*.py"))) == 2


def test_a_file_that_was_spoilt_is_written_again(kernels: Path) -> None:
    """As after a disk that was full: its name says what should be in it."""
    text = f"{HEADER}\nvalue = 4.5\n"
    assert module(text).value == 4.5
    (file,) = kernels.glob("*.py")
    file.write_text(text[:-2], encoding="utf-8")
    module.cache_clear()
    assert module(text).value == 4.5
    assert file.read_text(encoding="utf-8") == text
