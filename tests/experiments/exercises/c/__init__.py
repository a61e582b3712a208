"""Tests of submissions in C."""
