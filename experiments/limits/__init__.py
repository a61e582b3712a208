"""Stability limits of steppers: predicted and measured on one system, and growth over planes of parameters."""
