"""The page of engines: what each setting is identified as, what its numbers mean, and what it refuses."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from engines.engine import CAPABILITIES, Engine, precision, registry

PAGE = """\
# The engines, and what each refuses

Written from the adapters. What an engine is said to be identified as is what its runs are held against:
`pytest tests/conformance --engine NAME` runs it on strings, random strings, meshes, and damping. Where a package is not
installed with the lab, `springlab versions PACKAGE --install` makes it an environment of its own.

## What each is identified as

{identified}

## What their numbers mean

{meanings}

## What each refuses

A system that asks for one of these is refused in a line, before anything runs. Some engines refuse more, for reasons of
their own, such as springs that are too short: those are on record in `tests/conformance/refusals.toml`.

{refused}
"""


def engines_page() -> str:
    """Three tables, from the registry."""
    known = registry()
    return PAGE.format(
        identified=_table(("engine", "package", "numbers", "identified as"), [_identified(e) for e in known.values()]),
        meanings=_table(("engine", "in SI units"), [(f"`{e.name}`", e.semantics) for e in known.values()]),
        refused=_table(("engines", "refuse"), refusals(known)),
    )


def refusals(engines: Mapping[str, Engine]) -> list[tuple[str, str]]:
    """Engines of the same capabilities together, in their order, with all that they lack."""
    together: dict[frozenset[str], list[str]] = {}
    for name, engine in engines.items():
        together.setdefault(engine.capabilities, []).append(f"`{name}`")
    return [
        (", ".join(names), "; ".join(words for key, words in CAPABILITIES.items() if key not in able) or "nothing")
        for able, names in together.items()
    ]


def _identified(engine: Engine) -> tuple[str, str, str, str]:
    """Each scheme once, with what it is claimed for where there are several."""
    claims = engine.identified_as
    schemes = {scheme: [what for what in claims if claims[what] == scheme] for scheme in claims.values()}
    words = [f"`{s}`" + (f" ({', '.join(of)})" if len(schemes) > 1 else "") for s, of in schemes.items()]
    return f"`{engine.name}`", engine.package, precision(engine), ", ".join(words)


def _table(columns: tuple[str, ...], rows: Sequence[tuple[str, ...]]) -> str:
    """A table of Markdown."""
    lines = [columns, ("---",) * len(columns), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)
