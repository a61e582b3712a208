"""The pages that are made of the project: what each has of it."""

from __future__ import annotations

import inspect

import springlab as lab

from reference.schemes.catalogue import find
from report.site import generated
from report.site.generated import PAGES, api_page, commands_page


def test_the_api_has_each_public_function_and_class_once() -> None:
    """Each under its heading, classes with what they have; nothing else, as a constant or the version."""
    functions, classes = api_page().split("## Answers")
    public = {name: getattr(lab, name) for name in lab.__all__}
    for name, thing in public.items():
        assert functions.count(f".. autofunction:: {name}\n") == inspect.isfunction(thing)
        assert classes.count(f".. autoclass:: {name}\n   :members:\n") == inspect.isclass(thing)
    assert sum(page.count(".. auto") for page in (functions, classes)) == 1 + sum(
        inspect.isfunction(thing) or inspect.isclass(thing) for thing in public.values()
    )


def test_a_scheme_is_told_with_what_is_known_of_it() -> None:
    """Its order, whether equations are solved, what it needs, and its other names; its function is folded below."""
    drift, solved = (generated._section(find(name)) for name in ("semi_implicit_euler", "backward_euler"))
    assert "### kick_drift\n" in drift
    assert "*order 1; explicit; needs " in drift
    assert "also called `semi_implicit_euler`" in drift
    assert "def kick_drift(" in drift.partition("<details><summary>Its function</summary>")[2]
    assert "*order 1; implicit; needs " in solved
    assert "also called" not in generated._section(find("rk4"))
    in_place = generated._section(find("euler_in_place"))
    assert "<math" not in in_place
    assert "<details>" not in in_place


def test_commands_are_those_of_the_program() -> None:
    """By the module that has them."""
    assert ".. click:: report.commands.main:springlab\n" in commands_page()
    assert [*PAGES] == ["schemes", "engines", "api", "commands"]
