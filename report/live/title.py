"""The title of the live page's tab: viser's page has its own in the file that it serves, and no option for another."""

from __future__ import annotations

import gzip
from typing import Any

TITLE = "springlab live"

_THEIRS, _OURS = b"<title>Viser</title>", f"<title>{TITLE}</title>".encode()


def titled(response: Any) -> Any:
    """A response of viser's as it is, but the page with our title."""
    if response is None or not str(response.headers.get("Content-Type", "")).startswith("text/html"):
        return response
    zipped = response.headers.get("Content-Encoding") == "gzip"
    text = gzip.decompress(response.body) if zipped else response.body
    text = text.replace(_THEIRS, _OURS)
    response.body = gzip.compress(text) if zipped else text
    del response.headers["Content-Length"]
    response.headers["Content-Length"] = str(len(response.body))
    return response
