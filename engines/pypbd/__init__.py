"""PositionBasedDynamics, by its Python module pyPBD: particles joined by XPBD distance constraints."""
