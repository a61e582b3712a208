"""What times are measured with: clocks, meshes, and tuned C to compare with."""
