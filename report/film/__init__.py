"""Pictures of systems: drawings, animations, films, contact sheets."""
