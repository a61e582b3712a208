"""What times are measured with."""
