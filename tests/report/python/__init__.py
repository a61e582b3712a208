"""The public module `springlab`."""
