"""What experiments know of stability limits."""
