"""What masses may not enter: circle, sphere, cylinder, plane, box, as on slides 16-17. Needs NumPy only.

obstacle  the rule that all kinds have in common, and its place at the end of every step
kinds     each kind: its numbers, its signed distance
    validation  the obstacles of a system, from scene files or as they are
"""

from reference.obstacles.kinds import KINDS, Box, Circle, Cylinder, Plane, Sphere, obstacle_of
from reference.obstacles.obstacle import Obstacle, project_out
from reference.obstacles.validation import ROUNDING, checked_obstacles

__all__ = [
    "KINDS",
    "ROUNDING",
    "Box",
    "Circle",
    "Cylinder",
    "Obstacle",
    "Plane",
    "Sphere",
    "checked_obstacles",
    "obstacle_of",
    "project_out",
]
