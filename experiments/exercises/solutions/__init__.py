"""What several exercises share: right and wrong forces and steps, and the questions on them."""
