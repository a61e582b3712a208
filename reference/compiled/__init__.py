"""Machinery, apart from what is to be read: schemes traced into loops, compiled, run on one system or on many."""
