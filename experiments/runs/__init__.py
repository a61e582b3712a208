"""Runs that lose nothing: tasks, the runner, the store, sweeps, and steppers side by side."""
