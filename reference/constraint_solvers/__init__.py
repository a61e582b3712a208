"""What solvers of constraints share (`schemes.position_based`, `schemes.soft_constraints`).

- `solver_numbers`: what they read of a system, in double or in true single precision
- `spring_order`: in which order they go through its springs
"""
