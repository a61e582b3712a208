"""Masses that collide with one another.

round_masses  which masses collide, how large they are, and how much they bounce: what a system says of it
impacts       how pairs that overlap at the end of a step are moved apart, and bounce
"""
