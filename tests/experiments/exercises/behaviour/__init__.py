"""Tests of what behaviour tells."""
