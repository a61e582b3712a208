"""The lab's own modules have plain names; a file of that name beside a script is imported in their place."""

from __future__ import annotations

import importlib.util
from pathlib import Path

#: They stand beside this module where it is installed, and two folders up in a checkout.
ROOMS = ("reference", "engines", "experiments", "report")
HOMES = (Path(__file__).parents[1], Path(__file__).parents[3])


def check_rooms() -> None:
    """Raises ImportError, in a line, where a file or folder of somebody else's hides one of the lab's own."""
    for room in ROOMS:
        found = importlib.util.find_spec(room)
        places = [] if found is None else [*(found.submodule_search_locations or []), *filter(None, [found.origin])]
        if not any(Path(place).resolve().is_relative_to(home) for place in places for home in HOMES):
            what = places[0] if places else "nothing"
            raise ImportError(
                f"springlab needs its own module {room!r}, and {what} is found in its place: rename that, or run "
                "`python -P`, which does not look beside the script"
            )
