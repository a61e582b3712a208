"""The smallest changes of a submission's own text that make it right."""
