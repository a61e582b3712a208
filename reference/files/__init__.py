"""Files that describe what moves: scenes in TOML, meshes, accelerograms."""
