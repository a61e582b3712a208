"""Runs every candidate beside every file, and takes the nearest."""

import csv
import json
from pathlib import Path

import numpy as np

EXERCISE = 8
SEED = "example"
HERE = Path(__file__).parent
S = json.loads((HERE / "string.json").read_text())
H = S["dt"]
MASSES, STIFFNESS, RESTS = (np.array(S[key]) for key in ("masses", "stiffness", "rest_lengths"))


def slope(z):
    x, v = z
    gap = np.diff(np.vstack([S["anchor"], x]), axis=0)
    length = np.linalg.norm(gap, axis=1)
    pull = (STIFFNESS * (length - RESTS) / length)[:, None] * gap
    force = -pull - S["drag"] * v
    force[:-1] += pull[1:]
    a = force / MASSES[:, None]
    a[:, 1] -= S["gravity"]
    return np.array([v, a])


def euler(z, h=H):
    return z + h * slope(z)


def heun(z):
    return z + H / 2 * (slope(z) + slope(euler(z)))


def midpoint(z):
    return z + H * slope(euler(z, H / 2))


def rk4(z):
    k1 = slope(z)
    k2 = slope(z + H / 2 * k1)
    k3 = slope(z + H / 2 * k2)
    k4 = slope(z + H * k3)
    return z + H / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def kick_drift(z):
    v = z[1] + H * slope(z)[1]
    return np.array([z[0] + H * v, v])


def drift_kick(z):
    x = z[0] + H * z[1]
    return np.array([x, z[1] + H * slope((x, z[1]))[1]])


def velocity_verlet(z):
    x, v = z
    a = slope(z)[1]
    y = x + H * v + H**2 / 2 * a
    # the drag after: with the velocity of the step before E fits none; with Euler's guess it does
    return np.array([y, v + H / 2 * (a + slope((y, v + H * a))[1])])


def heun_link_by_link(z):
    z = z.copy()
    for i in range(len(z[0])):
        first = slope(z)[:, i]
        guess = z.copy()
        guess[:, i] += H * first
        z[:, i] += H / 2 * (first + slope(guess)[:, i])
    return z


def distance(step, rows):
    z = np.array([S["x"], S["v"]])
    worst = 0.0
    for row in rows:
        z = step(z)
        worst = max(worst, abs(z[0].ravel() - row).max())
    return worst


def names():
    steps = (euler, heun, kick_drift, drift_kick, velocity_verlet, midpoint, rk4, heun_link_by_link)
    result = []
    for letter in "ABCDE":
        lines = list(csv.reader((HERE / f"{letter}.csv").open()))[2:42]
        rows = np.array(lines, dtype=float)[:, 1:]
        result.append(min(steps, key=lambda step: distance(step, rows)).__name__)
    return result
