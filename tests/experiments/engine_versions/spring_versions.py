"""A package with three versions, made up."""

from __future__ import annotations

import copy

from experiments.engine_versions.versions import Rows, Subject, VersionMeasurements
from tests.conformance import doctored
from tests.conformance.doctored import Doctored

#: A measure that is a number.
LIMIT = "largest stable dt [s], undamped"


def made_up() -> dict[str, Rows]:
    """Three versions: the second changes a number and a word, the third takes the engine away."""
    first: Rows = {"springs": {"runs": "yes", "can: mesh": "kept", LIMIT: 0.01}, "spring": {"crash list: a": "SIGABRT"}}
    second = copy.deepcopy(first)
    second["springs"][LIMIT] = 0.011
    second["spring"]["crash list: a"] = "fine"
    third = copy.deepcopy(second)
    third["springs"] = {"runs": "unsupported: it is gone"}
    return {"1.9.0": first, "1.10.0": second, "2.0.0": third}


MEASURED = VersionMeasurements("spring", made_up())


def subject() -> Subject:
    """Of the engine made up."""

    class Springs(doctored.KickDrift):
        """Only its name is used."""

    Springs.__name__ = "springs"
    return Subject("spring", [Doctored(Springs, package="spring")], whole=True)
