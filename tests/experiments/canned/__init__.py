"""Results made by hand, of numbers that can be looked up: nothing is run for them."""
