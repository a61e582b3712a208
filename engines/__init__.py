"""Physics engines as steppers: one file per engine, each run in a process of its own."""
