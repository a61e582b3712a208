"""DART: joints that have springs, along a line."""
