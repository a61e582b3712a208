"""The one way to register: names taken once, in the order of files, found with a suggestion, entered on trial."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import pytest

from reference.errors import InputError
from reference.registry import Registry, imported, origin, summary_of


@pytest.fixture
def files() -> Iterator[list[str]]:
    """Two modules that can be imported."""
    names = ["reference_registry_first", "reference_registry_second"]
    sys.modules.update({name: ModuleType(name) for name in names})
    yield names
    for name in names:
        del sys.modules[name]


def entered(files: list[str], lazily: bool = False) -> Registry[int]:
    """A registry in which the second file was first; and something of neither came before both."""
    found = Registry[int]("colour", (lambda: files) if lazily else files)
    found.enter("grey", 0, "elsewhere")
    for name, value, module in (
        ("green", 3, files[1]),
        ("red", 1, files[0]),
        ("blue", 4, files[1]),
        ("pink", 2, files[0]),
    ):
        found.enter(name, value, module)
    return found


@pytest.mark.parametrize("lazily", [False, True])
def test_things_are_in_the_order_of_their_files(files: list[str], lazily: bool) -> None:
    """Within a file in its own, whichever was imported first; what stands elsewhere comes last."""
    found = entered(files, lazily)
    assert list(found.all().items()) == [("red", 1), ("pink", 2), ("green", 3), ("blue", 4), ("grey", 0)]
    assert found.find("blue") == 4


def test_a_name_is_taken_once(files: list[str]) -> None:
    """By whom is said; only a notebook's cell may be run again."""
    found = entered(files)
    with pytest.raises(InputError, match=r"^colour 'red' is taken by reference_registry_first: expected another name$"):
        found.enter("red", 9, "__main__")
    found.enter("cell", 5, "__main__")
    found.enter("cell", 6, "__main__")
    assert found.find("cell") == 6
    with pytest.raises(InputError, match="taken by __main__"):
        found.enter("cell", 7, files[0])
    assert found.find("red") == 1


def test_an_unknown_name_is_refused_with_a_suggestion(files: list[str]) -> None:
    """One letter off."""
    with pytest.raises(InputError, match=r"^unknown colour 'gren': did you mean 'green'\?$"):
        entered(files).find("gren")


def test_what_is_entered_on_trial_is_gone_afterwards(files: list[str]) -> None:
    """Also after an error; and what there was is there still."""
    found = entered(files)
    before = dict(found.all())

    def try_out() -> None:
        with found.as_it_is():
            found.enter("black", 8, files[0])
            assert found.find("black") == 8
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        try_out()
    assert dict(found.all()) == before
    with pytest.raises(TypeError):
        found.all()["white"] = 9  # type: ignore[index]


@pytest.mark.parametrize(
    ("module", "whose"),
    [
        ("reference.scenes.strings", ""),
        ("engines.bullet", ""),
        ("experiments.runs", ""),
        ("my_package.reference", "my_package"),
        ("other", "other"),
    ],
)
def test_what_is_the_labs_own_has_no_other_origin(module: str, whose: str) -> None:
    """The first name of a module says whose it is."""
    assert origin(module) == whose


def test_of_the_labs_own_modules_an_error_is_an_error_and_of_others_it_is_told(tmp_path: Path) -> None:
    """By the first name: a plug-in may have a module that is called as one of the lab's."""
    (tmp_path / "some_plug_in").mkdir()
    (tmp_path / "some_plug_in" / "reference.py").write_text("1 / 0\n")
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(tmp_path))
        with pytest.raises(InputError, match=r"^plug-in some_plug_in.reference: it cannot be imported: ZeroDivisionE"):
            imported("some_plug_in.reference")
    sys.modules.pop("some_plug_in", None)
    with pytest.raises(ModuleNotFoundError):
        imported("reference.that_is_not_there")


@pytest.mark.parametrize(
    ("docstring", "summary"),
    [
        ("Falls.", "Falls."),
        ("Falls.\n\n    Then it stops.\n    ", "Falls."),
        ("\n    Falls.\n\n    Then it stops.\n    ", "Falls."),
        ("", ""),
        (None, ""),
    ],
)
def test_what_is_listed_of_a_function_is_its_first_line(docstring: str | None, summary: str) -> None:
    """Also where a plug-in's begins on the next line, or is not there."""

    def function() -> None:
        pass

    function.__doc__ = docstring
    assert summary_of(function) == summary
