"""Steppers of users' own: Python files, C files, functions of a notebook. Each is an engine to the lab, as any other.

- `forms`: the forms that people write a step in, told by the names of its parameters
- `system`: what a step is given of the system
- `stepping`: a step of any form, on a system, with what it returns looked at
- `recorded`: a step of any form, on answers that are independent of one another
- `python_file`: a Python file, read in the process it runs in
- `c_file`, `springlab.h`: a C file, compiled by the system's compiler
- `stepper`: the stepper of a file or a function; what it does that it should not
"""
