"""Bullet: deformable mass-spring bodies."""
