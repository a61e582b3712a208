"""Tests of what a run did, and of natural modes."""
