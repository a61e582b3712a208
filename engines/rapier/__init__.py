"""Rapier: spring joints between bodies that cannot turn."""
