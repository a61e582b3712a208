"""Newton: particles joined by springs, under its solvers of particles."""
