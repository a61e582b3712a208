"""The lecture's own algorithms, executed, and its obstacle as it is printed."""
