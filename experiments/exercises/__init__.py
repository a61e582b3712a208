"""Exercises for students, and a checker that names the mistake: data plus small functions, a folder for each."""
