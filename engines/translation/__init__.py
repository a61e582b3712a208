"""What to type into an engine so that its springs are of k [N/m] and c [N s/m], and what its own numbers mean."""
