"""Submissions in C: compiled and called; their header."""
