"""Exudyn: mass points and spring-dampers."""
