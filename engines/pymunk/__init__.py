"""Pymunk: damped springs in the plane."""
