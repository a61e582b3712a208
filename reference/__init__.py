"""The physics of a mesh of springs, by hand: systems, forces, schemes, exact solutions, identification.

This room imports none of the others: no engine, no plotting, no command line.
"""
