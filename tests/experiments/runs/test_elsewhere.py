"""What is called elsewhere is called in another process; and here, where no answer comes from there."""

from __future__ import annotations

import os

import pytest

from experiments.runs.elsewhere import elsewhere


def number_of_process(not_in: int = 0) -> int:
    """This process's number; none is returned in that other one."""
    if os.getpid() == not_in:
        raise RuntimeError("not here")
    return os.getpid()


def this_one_only(number: int) -> int:
    """What ends a process, unless it has that number."""
    if os.getpid() != number:
        os._exit(3)
    return number


def test_it_is_called_in_another_process() -> None:
    """Which has a number of its own."""
    assert elsewhere(number_of_process, os.getpid()) != os.getpid()


def test_it_is_called_here_where_no_answer_comes() -> None:
    """As from a process that ends; what is wrong is told as it is here."""
    assert elsewhere(this_one_only, os.getpid()) == os.getpid()
    with pytest.raises(ZeroDivisionError):
        elsewhere(divmod, 1, 0)
