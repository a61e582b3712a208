"""The pages that are written from the project itself: every scheme's equations, engines, the commands, the API."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from textwrap import dedent

from reference.schemes.catalogue import Scheme, schemes
from report.commands import main
from report.site.engines_page import engines_page
from report.site.linear_form import NotLinear
from report.site.mathml import of_equations
from report.site.solved_form import equations_of

#: What each kind of scheme is called on the page.
KINDS = {
    "scheme": "Textbook schemes",
    "engine_scheme": "Schemes that engines use",
    "in_place": "Deliberately wrong: in place",
}

SCHEMES_PAGE = """\
# The schemes, with their equations

Positions are x, velocities v, the step is h, and a(x, v) are the accelerations: the forces of springs, dampers, drag
and gravity on each mass, over its mass. A prime marks the new state. The equations are not typed: each scheme's own
function is run on symbols, and what it computes is multiplied out. Of one that solves equations or looks back, they are
the sums that its steps keep to: an acceleration that stands in its own place is what it solves for, and indices of -1,
and m, are what it remembers of the step before. Where a scheme is no such sum, or goes from mass to mass, its function
stands here as it is.

A scheme's order is what theory predicts; the tests measure it.
"""

API_PAGE = """\
# springlab in Python

```{eval-rst}
.. automodule:: springlab
   :no-members:
```

## Functions

```{eval-rst}
.. currentmodule:: springlab

{functions}
```

## Answers

```{eval-rst}
.. currentmodule:: springlab

{classes}
```
"""

COMMANDS_PAGE = """\
# Commands

Bad input is one line that names what was wrong and what was expected, and exit code 2. Programs ask for `--json`.

```{eval-rst}
.. click:: {main}:springlab
   :prog: springlab
   :nested: full
```
"""


def schemes_page() -> str:
    """A section for every scheme: what it is, its equations, its function."""
    parts = [SCHEMES_PAGE]
    for kind, heading in KINDS.items():
        parts.append(f"## {heading}\n")
        parts += [_section(scheme) for scheme in schemes().values() if scheme.kind == kind]
    return "\n".join(parts)


def _section(scheme: Scheme) -> str:
    words = [f"### {scheme.name}\n", f"{scheme.summary}\n"]
    facts = [f"order {scheme.order}", "implicit" if scheme.implicit else "explicit", f"needs {scheme.needs}"]
    if scheme.aliases:
        facts.append(f"also called {', '.join(f'`{alias}`' for alias in scheme.aliases)}")
    words.append(f"*{'; '.join(facts)}*\n")
    try:
        words.append(f"{of_equations(equations_of(scheme))}\n")
        shown = "dropdown"
    except NotLinear:
        shown = "open"
    source = dedent(inspect.getsource(scheme.step)).rstrip()
    if shown == "dropdown":
        words.append(f"<details><summary>Its function</summary>\n\n```python\n{source}\n```\n\n</details>\n")
    else:
        words.append(f"```python\n{source}\n```\n")
    return "\n".join(words)


def commands_page() -> str:
    """All commands with their options, from click."""
    return COMMANDS_PAGE.replace("{main}", main.__name__)


def api_page() -> str:
    """The public module, from its docstrings."""
    import springlab

    public = {name: getattr(springlab, name) for name in springlab.__all__ if not name.startswith("_")}
    functions = [f".. autofunction:: {name}" for name, thing in public.items() if inspect.isfunction(thing)]
    classes = [
        f".. autoclass:: {name}\n   :members:\n   :inherited-members: ValueError, ArithmeticError"
        for name, thing in public.items()
        if inspect.isclass(thing)
    ]
    return API_PAGE.replace("{functions}", "\n\n".join(functions)).replace("{classes}", "\n\n".join(classes))


#: What these pages are called.
PAGES: dict[str, Callable[[], str]] = {
    "schemes": schemes_page,
    "engines": engines_page,
    "api": api_page,
    "commands": commands_page,
}
