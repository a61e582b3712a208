"""The lab's runs lose nothing, whoever is killed whenever. `make soak` runs these in full."""
