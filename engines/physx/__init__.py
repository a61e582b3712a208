"""PhysX 5, by SAPIEN: distance joints that are springs."""
