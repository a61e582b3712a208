"""The forces of springs, each law in a file of its own. Needs NumPy only.

linear_law      a spring with stiffness and damping, one spring at a time: what is traced, compiled and drawn
kinds           what springs may have besides: ropes, struts, springs that harden, yield or break
nonlinear_law   the law of those, for all springs of a system at once
breaking        which springs break, and when
"""
