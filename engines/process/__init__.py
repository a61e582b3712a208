"""A run's own process: the supervisor, its workers, environments of other versions."""
