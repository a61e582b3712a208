"""The lecture's own algorithms, executed, and its barrier as it is printed."""
