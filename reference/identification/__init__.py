"""Identification: a stepper in, out comes the catalogued scheme that reproduces its trajectory to rounding.

A stepper and a scheme that do the same arithmetic in another order differ by rounding only, about 1e-15 of the system's
size over some hundred steps; two different schemes differ by many orders of magnitude more. So the ranking of the
catalogue by largest deviation has a cliff in it, and a name is given only to what stands on the far side.

    scale           how large a run's numbers are, and how they round
    result          what was found: the ranking, the tolerance, the name, what ties with it
    ranking         how far known trajectories are from a run's
    search          which of the catalogue's trajectories a run is compared with
    pushes          a motion in which schemes differ, where a system's own has none
    amplification   where the motion multiplies rounding: how much more may be rounding
    single_steps    steps one by one, where trajectories part by rounding
    bits            trajectories of single precision, equal to the last bit
    naming          all of it together
"""

from reference.identification.amplification import AMPLIFIED, PERTURBATION, amplified
from reference.identification.naming import (
    Identified,
    identify,
    identify_all,
    identify_by_rounding,
    scheme_of,
)
from reference.identification.ranking import NOISE, STRETCH, TOLERANCE, identify_beginning, identify_run
from reference.identification.result import Identification, Match
from reference.identification.scale import scale
from reference.identification.search import LARGE, Candidates, candidates, candidates_for

__all__ = [
    "AMPLIFIED",
    "LARGE",
    "NOISE",
    "PERTURBATION",
    "STRETCH",
    "TOLERANCE",
    "Candidates",
    "Identification",
    "Identified",
    "Match",
    "amplified",
    "candidates",
    "candidates_for",
    "identify",
    "identify_all",
    "identify_beginning",
    "identify_by_rounding",
    "identify_run",
    "scale",
    "scheme_of",
]
