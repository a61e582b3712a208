"""The program in a Jupyter notebook: its code cells, one after another (nbformat 4)."""

from __future__ import annotations

import json
import re

#: What only a notebook takes: IPython's magics, shell lines, and requests for help.
NOT_PYTHON = re.compile(r"^\s*([%!?]|.*\?\s*$)")


def program_in(notebook: str) -> str:
    r"""The text of all code cells, empty lines between them; lines that are not Python become comments.

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
        sources = [cell["source"] for cell in cells if cell["cell_type"] == "code"]
        texts = ["".join(source) if isinstance(source, list) else str(source) for source in sources]
    except (KeyError, TypeError, RecursionError) as error:
        raise ValueError(f"not a notebook: {error}") from None
    return "\n\n".join("\n".join(map(_python, text.splitlines())) for text in texts if text.strip()) + "\n"


def _python(line: str) -> str:
    return f"# {line}" if NOT_PYTHON.match(line) and not line.lstrip().startswith("#") else line
