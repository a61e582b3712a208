"""The command line: its entry point, one file for each command, and what they share."""
