"""Exercises for students, and their checker."""
