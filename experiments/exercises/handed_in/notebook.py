"""The program in a Jupyter notebook: its code cells, one after another (nbformat 4)."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any

#: What only a notebook takes: IPython's magics, shell lines, and requests for help.
NOT_PYTHON = re.compile(r"^\s*([%!?]|.*\?\s*$)")


def program_in(notebook: str) -> str:
    r"""The text of all code cells, empty lines between them; lines that are not Python become comments.

    Cells that Otter and nbgrader put in to test (`is_of_a_grader`) are left out: they need these packages.

    Raises:
        ValueError: where it is not a notebook.

    >>> cell = {"cell_type": "code", "source": ["EXERCISE = 1\n", "%matplotlib inline"]}
    >>> print(program_in(json.dumps({"nbformat": 4, "cells": [cell, {"cell_type": "markdown", "source": "Hello"}]})))
    EXERCISE = 1
    # %matplotlib inline
    <BLANKLINE>
    """
    try:
        cells = json.loads(notebook)["cells"]
        sources = [cell["source"] for cell in cells if cell["cell_type"] == "code" and not is_of_a_grader(cell)]
        texts = ["".join(source) if isinstance(source, list) else str(source) for source in sources]
    except (KeyError, TypeError, AttributeError, RecursionError) as error:
        raise ValueError(f"not a notebook: {error}") from None
    return "\n\n".join("\n".join(map(_python, text.splitlines())) for text in texts if text.strip()) + "\n"


def is_of_a_grader(cell: Mapping[str, Any]) -> bool:
    """Whether a cell is nbgrader's that tests and gives points, or Otter's that students can neither change nor delete.

    >>> is_of_a_grader({"metadata": {"nbgrader": {"grade": True, "solution": False}}})
    True
    >>> is_of_a_grader({"metadata": {"deletable": False, "editable": False}}), is_of_a_grader({"metadata": {}})
    (True, False)
    """
    metadata = cell.get("metadata", {})
    if "nbgrader" in metadata:
        return bool(metadata["nbgrader"].get("grade")) and not metadata["nbgrader"].get("solution")
    return metadata.get("deletable") is False and metadata.get("editable") is False


def _python(line: str) -> str:
    return f"# {line}" if NOT_PYTHON.match(line) and not line.lstrip().startswith("#") else line
