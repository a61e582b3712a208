"""Some of the results made by hand: those that pages are made of in tests."""

from __future__ import annotations

from tests.experiments.canned import results
from tests.experiments.canned.divergence import SETUP
from tests.experiments.canned.divergence import not_installed as no_engine_installed
from tests.experiments.canned.divergence import usual as engines_that_run
from tests.experiments.canned.errata import usual as errata

__all__ = ["RESULTS", "SETUP", "engines_that_run", "errata", "no_engine_installed"]

#: By experiment, results to show: as usual, and with what is missing.
RESULTS = {name: results.RESULTS[name] for name in ("divergence", "stiff_limit", "errata", "scenes", "drape")}
