"""MuJoCo: tendons, flexes, the composite cable and ropes."""
