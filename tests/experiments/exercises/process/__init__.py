"""Tests of the process of a submission."""
