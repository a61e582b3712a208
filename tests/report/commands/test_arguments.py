"""What the words of options mean, and which of them may be given several times."""

from __future__ import annotations

import pytest

from reference.changes import Change
from reference.drives import Ramp, Sine
from reference.errors import InputError
from report.commands.arguments import parse_changes, parse_ramps, parse_ranges, parse_settings, parse_sines
from report.commands.main import COMMANDS
from tests.report.commands.test_units import command, options

#: Options of which every one says one thing of many: parameters, changes, steppers.
SEVERAL = {"--set", "--change", "--ramp", "--sine", "--stepper", "--range", "--over", "--engine", "--only", "--record"}


def test_each_word_is_one_of_its_option() -> None:
    """In their order; of one key the last counts, and what follows its first = is its value."""
    assert parse_settings(["masses=3", "name=a=b", "masses=4"]) == {"masses": "4", "name": "a=b"}
    assert parse_changes(["0.5:drag=2", "1:gravity=1,-9.5"]) == (
        Change(0.5, "drag", 2.0),
        Change(1.0, "gravity", [1.0, -9.5]),
    )
    assert parse_ramps(["0.5:2:drag=3"]) == (Ramp("drag", 0.5, 2.0, 3.0),)
    assert parse_sines(["0.5:drag=2@3"]) == (Sine("drag", 0.5, 2.0, 3.0),)
    assert parse_ranges(["dt=1e-3:2e-3", "drag=0:1"]) == {"dt": (1e-3, 2e-3), "drag": (0.0, 1.0)}


@pytest.mark.parametrize("word", ["", "=", "masses", "masses=", "=3"])
def test_a_setting_has_a_key_and_a_value(word: str) -> None:
    """Both; it is named as it was written."""
    with pytest.raises(InputError, match=f"^--set '{word}': expected KEY=VALUE$"):
        parse_settings([word])


@pytest.mark.parametrize("key", ["dt", "duration"])
def test_what_has_an_option_of_its_own_is_no_parameter(key: str) -> None:
    """That option is told."""
    with pytest.raises(InputError, match=f"{key} is no parameter of a scene: expected --{key} 0.5$"):
        parse_settings([f"{key}=0.5"])


@pytest.mark.parametrize(
    ("parse", "word"),
    [
        *((parse_changes, word) for word in ("drag=1", "a:drag=1", "1:drag=b", "1:drag=1,b", "1:drag")),
        *((parse_ramps, word) for word in ("0:drag=1", "0:1:2:drag=1", "a:1:drag=1", "0:b:drag=1", "0:1:drag=c")),
        *((parse_sines, word) for word in ("drag=1@2", "0:drag=1", "a:drag=1@2", "0:drag=b@2", "0:drag=1@c")),
        *((parse_ranges, word) for word in ("dt=1", "dt", "dt=a:1", "dt=1:b")),
    ],
)
def test_a_word_of_another_form_is_refused_as_it_was_written(parse: object, word: str) -> None:
    """With the form that is expected."""
    assert callable(parse)
    with pytest.raises(InputError, match=f"'{word}': expected "):
        parse([word])


@pytest.mark.parametrize("name", COMMANDS)
def test_what_says_one_thing_of_many_may_be_given_several_times(name: str) -> None:
    """And a time, a step, a folder once."""
    found = {option.opts[0]: option.multiple for option in options(command(name))}
    assert {word for word in found.keys() & SEVERAL if not found[word]} == set()
    assert {
        word for word in found.keys() & {"--dt", "--duration", "--out", "--time-limit", "--key"} if found[word]
    } == set()
