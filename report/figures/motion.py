"""Engines on somebody's scene over time: drawn as the string's divergence is."""

from report.figures.divergence import draw

__all__ = ["draw"]
