"""What is typed into engines for a spring, what it then really does, and what engines' own numbers mean."""
