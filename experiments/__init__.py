"""Questions put to schemes and engines: one file per question, and the command line."""
