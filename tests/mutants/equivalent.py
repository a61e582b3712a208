"""Mutants that are no mistakes: what they change nobody can notice. Each with its reason, in `equivalent.toml`.

An entry has a `file` and a `reason`, and of these as many as tell what is meant from other mutants of the file: the
`kind` of mistake, the lines `before` and what becomes of them, `after`. Lines above it may come and go.
"""

from __future__ import annotations

import json
import tomllib
from collections.abc import Mapping
from pathlib import Path

from tests.mutants.mutations import Mutant

#: Where they are kept, in a project.
KEPT = Path("tests", "mutants", "equivalent.toml")

#: What tells a mutant.
FIELDS = ("file", "kind", "before", "after")


def equivalents(root: Path) -> list[Mapping[str, str]]:
    """The entries there are."""
    file = root / KEPT
    return tomllib.loads(file.read_text(encoding="utf-8"))["equivalent"] if file.exists() else []


def is_meant(entry: Mapping[str, str], mutant: Mutant) -> bool:
    """Whether an entry is about a mutant."""
    return all(entry[name] == getattr(mutant, name) for name in FIELDS if name in entry)


def entry_of(mutant: Mutant) -> str:
    """The entry of one mutant, but for its reason."""
    # a text of JSON is one of TOML
    lines = [
        f"{name} = {json.dumps(getattr(mutant, name), ensure_ascii=False)}" for name in ("file", "before", "after")
    ]
    return "\n".join(["[[equivalent]]", *lines])
