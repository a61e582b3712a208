"""What the numbers of a submission are called: the answers of the solution with mistakes, and the nearest of them."""
