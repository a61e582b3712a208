"""What each version of an engine does, what changed, and the baseline of the versions we keep."""
