"""What went wrong where the submission is not to blame."""

from __future__ import annotations


class NotGradedError(Exception):
    """A submission was not graded, and it is not its fault: the machine's, or the checker's. It can be tried again."""
