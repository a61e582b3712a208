"""The forces of springs, each law in a file of its own. Needs NumPy only.

linear_law      a spring with stiffness and damping, one spring at a time: what is traced, compiled and drawn
kinds           what springs may have besides: ropes, struts, springs that harden, yield or break
nonlinear_law   the law of those, for all springs of a system at once
breaking        which springs break, and when
angles          the angle at a mass between two others
angular         springs that resist bending at a mass: what a system says of them
bending         a system with such springs wherever two springs meet
angular_law     the law of those
"""
