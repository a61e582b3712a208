"""The package index, where it can be reached."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from engines.process.environments import environment
from reference.errors import InputError


def environment_or_skip(package: str, version: str) -> Path:
    """The Python of an environment; the test is skipped where there is none, but never in continuous integration."""
    try:
        return environment(package, version)
    except InputError as error:
        if os.environ.get("CI"):
            raise
        pytest.skip(str(error))
