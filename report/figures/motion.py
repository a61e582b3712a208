"""Engines on a user's own scene over time: drawn as the string's divergence is."""

from report.figures.divergence import draw

__all__ = ["draw"]
