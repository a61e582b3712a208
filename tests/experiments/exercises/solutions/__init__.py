"""Programs that students hand in, right and wrong."""
