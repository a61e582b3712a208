"""What theory says of systems and schemes: exact motions, equilibria, modes, step maps, stability limits."""
