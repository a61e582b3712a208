"""Which dt to use for a scene, in each engine."""
