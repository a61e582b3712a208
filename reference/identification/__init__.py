"""Identification: a stepper in, out comes the catalogued scheme that reproduces its trajectory to rounding.

A stepper and a scheme that do the same arithmetic in another order differ by rounding only, about 1e-15 of the system's
size over some hundred steps; two different schemes differ by many orders of magnitude more. So the ranking of the
catalogue by largest deviation has a cliff in it, and a name is given only to what stands on the far side.

    result         what was found: the ranking, the tolerance, the name
    ranking        how far known trajectories are from a run's
    search         which of the catalogue's trajectories a run is compared with
    amplification  where the motion multiplies rounding: how much more may be rounding
    naming         all of it together
"""

from reference.identification.amplification import AMPLIFIED, PERTURBATION, amplified
from reference.identification.naming import identify, identify_by_rounding, scheme_of
from reference.identification.ranking import NOISE, STRETCH, TOLERANCE, identify_beginning, identify_run
from reference.identification.result import Identification, Match
from reference.identification.search import LARGE, candidates, candidates_for

__all__ = [
    "AMPLIFIED",
    "LARGE",
    "NOISE",
    "PERTURBATION",
    "STRETCH",
    "TOLERANCE",
    "Identification",
    "Match",
    "amplified",
    "candidates",
    "candidates_for",
    "identify",
    "identify_beginning",
    "identify_by_rounding",
    "identify_run",
    "scheme_of",
]
