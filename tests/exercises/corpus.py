"""Mistakes as students make them: a right solution in each of three styles, and what is written otherwise.

Nothing here knows of the checker's own knobs: each mistake is a change of the text of a program.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

STYLES = Path(__file__).parent / "styles"

#: A change of a text: what stands there, and what is written in its place.
Change = tuple[str, str]

_BODY = "    return total / s.masses[:, None]\n"
_LOOPS_END = "    return np.array(new_x), np.array(new_v)\n"

#: An own acceleration of one mass, in each style, for steps that write into the state they read.
_LOOPS_IN_PLACE = "    px, py, vx, vy = (list(map(float, column)) for column in (x[:, 0], x[:, 1], v[:, 0], v[:, 1]))\n"

LOOPS: Mapping[str, list[Change]] = {
    "spring_sign": [("k * (length - rest)", "k * (rest - length)")],
    "gravity_sign": [("fy += -string.masses[i]", "fy += string.masses[i]")],
    "gravity_missing": [("        fy += -string.masses[i] * string.gravity\n", "")],
    "weight_without_mass": [("fy += -string.masses[i] * string.gravity", "fy += -string.gravity")],
    "damping_sign": [("fx += -string.drag", "fx += string.drag"), ("fy += -string.drag", "fy += string.drag")],
    "damping_missing": [
        ("        fx += -string.drag * vx[i]\n", ""),
        ("        fy += -string.drag * vy[i]\n", ""),
    ],
    "rest_length_added": [("(length - rest)", "(length + rest)")],
    "rest_length_missing": [("(length - rest)", "length")],
    "not_normalised": [("force * dx / length", "force * dx"), ("force * dy / length", "force * dy")],
    "length_without_root": [("sqrt(dx * dx + dy * dy)", "dx * dx + dy * dy")],
    "x_and_y_swapped": [("fx += force * dx", "fx += force * DY"), ("fy += force * dy", "fy += force * dx"), ("DY", "dy")],
    "degrees": [
        ("force * dx / length", "force * cos(degrees(atan2(dy, dx)))"),
        ("force * dy / length", "force * sin(degrees(atan2(dy, dx)))"),
    ],
    "anchor_missing": [('    springs.append(("above"', '    if i > 0:\n        springs.append(("above"')],
    "anchor_at_origin": [("string.anchor[0], string.anchor[1]", "0.0, 0.0")],
    "anchor_off_by_one": [("if i == 0:", "if i <= 1:")],
    "last_link_wraps": [("    if i + 1 < n:\n        j = i + 1", "    if True:\n        j = (i + 1) % n")],
    "last_link_skipped": [("ay[i] = fy / string.masses[i]", "ay[i] = fy / string.masses[i]\n    ax[-1], ay[-1] = 0.0, 0.0")],
    "spring_above_only": [("if i + 1 < n:", "if False:")],
    "spring_below_only": [("    springs.append((\"above\"", "    if False:\n        springs.append((\"above\"")],
    "same_side": [("force = k * (length - rest)", "force = k * (length - rest) * (-1 if side == 'below' else 1)")],
    "neighbours_spring": [("string.stiffness[j], string.rest_lengths[j]", "string.stiffness[i], string.rest_lengths[i]")],
    "mass_forgotten": [("fx / string.masses[i]", "fx"), ("fy / string.masses[i]", "fy")],
    "mass_multiplied": [("fx / string", "fx * string"), ("fy / string", "fy * string")],
    "dt_twice": [("    n = len(px)\n    ax, ay = acc", "    n = len(px)\n    dt = dt * dt\n    ax, ay = acc")],
    "dt_missing": [("    n = len(px)\n    ax, ay = acc", "    n = len(px)\n    dt = 1\n    ax, ay = acc")],
    "half_missing": [("dt / 2 *", "dt *")],
    "half_of_one_slope": [
        ("dt / 2 * (vx[i] + hx[i])", "dt * (vx[i] + hx[i] / 2)"),
        ("dt / 2 * (vy[i] + hy[i])", "dt * (vy[i] + hy[i] / 2)"),
        ("dt / 2 * (ax[i] + bx[i])", "dt * (ax[i] + bx[i] / 2)"),
        ("dt / 2 * (ay[i] + by[i])", "dt * (ay[i] + by[i] / 2)"),
    ],
    "wrong_pair": [
        ("px[i] + dt * vx[i]", "px[i] + dt / 2 * vx[i]"),
        ("py[i] + dt * vy[i]", "py[i] + dt / 2 * vy[i]"),
        ("vx[i] + dt * ax[i]", "vx[i] + dt / 2 * ax[i]"),
        ("vy[i] + dt * ay[i]", "vy[i] + dt / 2 * ay[i]"),
    ],
    "second_slope_only": [
        ("dt / 2 * (vx[i] + hx[i])", "dt * hx[i]"),
        ("dt / 2 * (vy[i] + hy[i])", "dt * hy[i]"),
        ("dt / 2 * (ax[i] + bx[i])", "dt * bx[i]"),
        ("dt / 2 * (ay[i] + by[i])", "dt * by[i]"),
    ],
    "from_the_guess": [
        ("[[px[i] + dt / 2", "[[gx[i] + dt / 2"),
        (" py[i] + dt / 2", " gy[i] + dt / 2"),
        ("[[vx[i] + dt / 2", "[[hx[i] + dt / 2"),
        (" vy[i] + dt / 2", " hy[i] + dt / 2"),
    ],
    "positions_not_corrected": [("dt / 2 * (vx[i] + hx[i])", "dt * vx[i]"), ("dt / 2 * (vy[i] + hy[i])", "dt * vy[i]")],
    "velocities_not_corrected": [("dt / 2 * (ax[i] + bx[i])", "dt * ax[i]"), ("dt / 2 * (ay[i] + by[i])", "dt * ay[i]")],
    "guess_keeps_velocities": [("vx[i] + dt * ax[i]", "vx[i]"), ("vy[i] + dt * ay[i]", "vy[i]"),
                               ("(vx[i] + hx[i])", "(2 * vx[i])"), ("(vy[i] + hy[i])", "(2 * vy[i])")],
    "euler": [("dt / 2 * (vx[i] + hx[i])", "dt * vx[i]"), ("dt / 2 * (vy[i] + hy[i])", "dt * vy[i]"),
              ("dt / 2 * (ax[i] + bx[i])", "dt * ax[i]"), ("dt / 2 * (ay[i] + by[i])", "dt * ay[i]")],
    "kick_drift": [("dt / 2 * (vx[i] + hx[i])", "dt * hx[i]"), ("dt / 2 * (vy[i] + hy[i])", "dt * hy[i]"),
                   ("dt / 2 * (ax[i] + bx[i])", "dt * ax[i]"), ("dt / 2 * (ay[i] + by[i])", "dt * ay[i]")],
    "heun_link_by_link": [(_LOOPS_IN_PLACE, _LOOPS_IN_PLACE + """    for i in range(len(px)):
        x0, y0, u0, w0 = px[i], py[i], vx[i], vy[i]
        ax, ay = acceleration(px, py, vx, vy, string)
        px[i], py[i] = x0 + dt * u0, y0 + dt * w0
        vx[i], vy[i] = u0 + dt * ax[i], w0 + dt * ay[i]
        bx, by = acceleration(px, py, vx, vy, string)
        px[i], py[i] = x0 + dt * (u0 + vx[i]) / 2, y0 + dt * (w0 + vy[i]) / 2
        vx[i], vy[i] = u0 + dt * (ax[i] + bx[i]) / 2, w0 + dt * (ay[i] + by[i]) / 2
    return np.column_stack([px, py]), np.column_stack([vx, vy])
""")],
    "euler_in_place": [(_LOOPS_IN_PLACE, _LOOPS_IN_PLACE + """    for i in range(len(px)):
        ax, ay = acceleration(px, py, vx, vy, string)
        px[i] += dt * vx[i]
        py[i] += dt * vy[i]
        vx[i] += dt * ax[i]
        vy[i] += dt * ay[i]
    return np.column_stack([px, py]), np.column_stack([vx, vy])
""")],
    "heun_aliased": [(_LOOPS_IN_PLACE, _LOOPS_IN_PLACE + """    begin = list(zip(px, py, vx, vy))
    slopes = []
    for i in range(len(px)):
        ax, ay = acceleration(px, py, vx, vy, string)
        slopes.append((vx[i], vy[i], ax[i], ay[i]))
        px[i], py[i], vx[i], vy[i] = (b + dt * s for b, s in zip(begin[i], slopes[i]))
    for i in range(len(px)):
        ax, ay = acceleration(px, py, vx, vy, string)
        here = (vx[i], vy[i], ax[i], ay[i])
        px[i], py[i], vx[i], vy[i] = (b + dt / 2 * (s + t) for b, s, t in zip(begin[i], slopes[i], here))
    return np.column_stack([px, py]), np.column_stack([vx, vy])
""")],
    "modifies_its_input": [(_LOOPS_END, "    x[:], v[:] = new_x, new_v\n    return x, v\n")],
    "whole_numbers": [(_LOOPS_END, "    return np.array(new_x, dtype=int), np.array(new_v, dtype=int)\n")],
    "transposed": [(_LOOPS_END, "    return np.array(new_x).T, np.array(new_v).T\n")],
    "wrong_shape": [(_LOOPS_END, "    return np.array(new_x).ravel(), np.array(new_v).ravel()\n")],
    "returns_nothing": [(_LOOPS_END, "    print(new_x, new_v)\n")],
    "not_a_number": [("sqrt(dx * dx + dy * dy)", "float(np.sqrt(-dx * dx - dy * dy))")],
    "random_or_time": [("fx += -string.drag", "fx += 1e-3 * np.random.rand() - string.drag")],
    "remembers_earlier_calls": [
        ("EXERCISE = 4\n", "EXERCISE = 4\ncalls = [0]\n"),
        ("    n = len(px)\n    ax, ay = acc", "    n = len(px)\n    calls[0] += 1\n    dt = dt + 1e-4 * calls[0]\n    ax, ay = acc"),
    ],
}  # fmt: skip

ARRAYS: Mapping[str, list[Change]] = {
    "spring_sign": [("(length - s.rest", "-(length - s.rest")],
    "gravity_sign": [("total[:, 1] - s.masses", "total[:, 1] + s.masses")],
    "gravity_missing": [("    total[:, 1] = total[:, 1] - s.masses * s.gravity\n", "")],
    "weight_without_mass": [("- s.masses * s.gravity", "- s.gravity")],
    "damping_sign": [("total - s.drag", "total + s.drag")],
    "damping_missing": [("    total = total - s.drag * v\n", "")],
    "rest_length_added": [("length - s.rest", "length + s.rest")],
    "rest_length_missing": [("(length - s.rest_lengths[:, None])", "length")],
    "not_normalised": [("* unit", "* gap")],
    "length_without_root": [("np.sqrt(np.sum(gap**2, axis=1, keepdims=True))", "np.sum(gap**2, axis=1, keepdims=True)")],
    "x_and_y_swapped": [("unit = gap / length", "unit = gap[:, ::-1] / length")],
    "degrees": [(
        "unit = gap / length",
        "angle = np.rad2deg(np.arctan2(gap[:, 1], gap[:, 0]))\n    unit = np.column_stack([np.cos(angle), np.sin(angle)])",
    )],
    "anchor_missing": [("    total = pull.copy()\n", "    pull[0] = 0\n    total = pull.copy()\n")],
    "anchor_at_origin": [("s.anchor[None, :]", "np.zeros((1, 2))")],
    "anchor_off_by_one": [
        ("np.concatenate([s.anchor[None, :], x[:-1]])", "np.concatenate([s.anchor[None, :], s.anchor[None, :], x[1:-1]])"),
    ],
    "last_link_wraps": [("total[:-1] = total[:-1] - pull[1:]", "total = total - np.roll(pull, -1, axis=0)")],
    "last_link_skipped": [("    total = total - s.drag * v\n", "    total = total - s.drag * v\n    total[-1] = 0\n")],
    "spring_above_only": [("    total[:-1] = total[:-1] - pull[1:]\n", "")],
    "spring_below_only": [("total = pull.copy()", "total = np.zeros_like(pull)")],
    "same_side": [("total[:-1] - pull[1:]", "total[:-1] + pull[1:]")],
    "neighbours_spring": [(
        "total[:-1] - pull[1:]",
        "total[:-1] - (s.stiffness[:-1, None] * (length[1:] - s.rest_lengths[:-1, None]) * unit[1:])",
    )],
    "mass_forgotten": [(_BODY, "    return total\n")],
    "mass_multiplied": [(_BODY, "    return total * s.masses[:, None]\n")],
    "dt_twice": [("    a = acc", "    dt *= dt\n    a = acc")],
    "dt_missing": [("dt * (v + v1)", "(v + v1)"), ("dt * (a + b)", "(a + b)"), ("dt * v,", "v,"), ("dt * a\n", "a\n")],
    "half_missing": [(") / 2", ")")],
    "half_of_one_slope": [("(v + v1) / 2", "(v + v1 / 2)"), ("(a + b) / 2", "(a + b / 2)")],
    "wrong_pair": [("x + dt * v, v + dt * a", "x + dt / 2 * v, v + dt / 2 * a")],
    "corrected_velocity_averaged": [
        ("    new_x = x + dt * (v + v1) / 2\n", ""),
        ("(a + b) / 2\n", "(a + b) / 2\n    new_x = x + dt * (v + new_v) / 2\n"),
    ],
    "second_slope_only": [("(v + v1) / 2", "v1"), ("(a + b) / 2", "b")],
    "from_the_guess": [("new_x = x +", "new_x = x1 +"), ("new_v = v +", "new_v = v1 +")],
    "positions_not_corrected": [("new_x = x + dt * (v + v1) / 2", "new_x = x1")],
    "velocities_not_corrected": [("new_v = v + dt * (a + b) / 2", "new_v = v1")],
    "position_with_new_velocity": [
        ("    new_x = x + dt * (v + v1) / 2\n", ""),
        ("(a + b) / 2\n", "(a + b) / 2\n    new_x = x + dt * new_v\n"),
    ],
    "guess_keeps_velocities": [("v + dt * a\n", "v\n")],
    "guess_keeps_positions": [("x1, v1 = x + dt * v", "x1, v1 = x")],
    "euler": [("(v + v1) / 2", "v"), ("(a + b) / 2", "a")],
    "kick_drift": [("(v + v1) / 2", "v1"), ("(a + b) / 2", "a")],
    "velocity_verlet": [("new_x = x + dt * (v + v1) / 2", "new_x = x + dt * v + dt**2 / 2 * a"),
                        ("accelerations(x1, v1", "accelerations(x + dt * v + dt**2 / 2 * a, v1")],
    "heun_link_by_link": [("    a = accelerations(x, v, string)\n", """    x, v = x.copy(), v.copy()
    for i in range(len(x)):
        x0, v0 = x[i].copy(), v[i].copy()
        a = accelerations(x, v, string)[i]
        x[i], v[i] = x0 + dt * v0, v0 + dt * a
        b = accelerations(x, v, string)[i]
        x[i], v[i] = x0 + dt * (v0 + v[i]) / 2, v0 + dt * (a + b) / 2
    return x, v
""")],
    "euler_in_place": [("    a = accelerations(x, v, string)\n", """    x, v = x.copy(), v.copy()
    for i in range(len(x)):
        a = accelerations(x, v, string)[i]
        x[i] += dt * v[i]
        v[i] += dt * a
    return x, v
""")],
    "heun_aliased": [("    a = accelerations(x, v, string)\n", """    x0, v0, x, v = x, v, x.copy(), v.copy()
    first = []
    for i in range(len(x)):
        first.append((v[i].copy(), accelerations(x, v, string)[i]))
        x[i], v[i] = x0[i] + dt * first[i][0], v0[i] + dt * first[i][1]
    for i in range(len(x)):
        u, b = v[i].copy(), accelerations(x, v, string)[i]
        x[i] = x0[i] + dt * (first[i][0] + u) / 2
        v[i] = v0[i] + dt * (first[i][1] + b) / 2
    return x, v
""")],
    "modifies_its_input": [("    new_x = x + dt * (v + v1) / 2\n", "    x += dt * (v + v1) / 2\n"), ("return new_x", "return x")],
    "overwrites_its_results": [
        ("EXERCISE = 4\n", "EXERCISE = 4\nkept = {}\n"),
        ("    return new_x, new_v", "    out = kept.setdefault(len(x), np.zeros((2, len(x), 2)))\n"
                                   "    out[:] = new_x, new_v\n    return out[0], out[1]"),
    ],
    "whole_numbers": [("    return new_x, new_v", "    out = np.zeros((2, len(x), 2), int)\n    out[:] = new_x, new_v\n"
                                                  "    return tuple(out)")],
    "transposed": [("return new_x, new_v", "return new_x.T, new_v.T")],
    "wrong_shape": [("return new_x, new_v", "return new_x[:-1], new_v[:-1]")],
    "returns_nothing": [("    return new_x, new_v", "    x = new_x")],
    "not_a_number": [("unit = gap / length", "unit = gap / (length - length)")],
    "random_or_time": [("import numpy as np\n", "import time\n\nimport numpy as np\n"),
                       ("    a = acc", "    dt += time.perf_counter() % 1e-3\n    a = acc")],
    "remembers_earlier_calls": [
        ("EXERCISE = 4\n", "EXERCISE = 4\nbefore = []\n"),
        ("    a = accelerations(x, v, string)\n", "    a = before.pop() if before else accelerations(x, v, string)\n"
         "    a = a if a.shape == x.shape else accelerations(x, v, string)\n"),
        ("    new_x =", "    before.append(b)\n    new_x ="),
    ],
}  # fmt: skip

_HEUN_OF_CLASS = "        k1 = self.rate(y)\n"
CLASSES: Mapping[str, list[Change]] = {
    "spring_sign": [("T = k *", "T = -k *")],
    "gravity_sign": [("F[:, 1] -=", "F[:, 1] +=")],
    "gravity_missing": [("        F[:, 1] -= self.s.masses * self.s.gravity\n", "")],
    "weight_without_mass": [("self.s.masses * self.s.gravity", "self.s.gravity")],
    "damping_sign": [("F -= self.s.drag", "F += self.s.drag")],
    "damping_missing": [("        F -= self.s.drag * u\n", "")],
    "rest_length_added": [("(norm - l0)", "(l0 + norm)")],
    "rest_length_missing": [("(norm - l0)", "norm")],
    "not_normalised": [("e = d / norm", "e = d")],
    "length_without_root": [("np.hypot(d[0], d[1])", "d @ d")],
    "x_and_y_swapped": [("e = d / norm", "e = np.array([d[1], d[0]]) / norm")],
    "degrees": [(
        "e = d / norm",
        "theta = 180 / np.pi * np.arctan2(d[1], d[0])\n            e = np.array([np.cos(theta), np.sin(theta)])",
    )],
    "anchor_missing": [("for i in range(self.n)]", "for i in range(1, self.n)]")],
    "anchor_at_origin": [("np.array(self.s.anchor)", "np.zeros(2)")],
    "anchor_off_by_one": [("d = self.place(r, upper)", "d = self.place(r, upper if lower > 1 else -1)")],
    "last_link_wraps": [(
        "        F[:, 1] -= ",
        "        if self.n > 1:\n            d = r[0] - r[-1]\n"
        "            F[-1] += self.s.stiffness[0] * (1 - self.s.rest_lengths[0] / np.sqrt(d @ d)) * d\n        F[:, 1] -= ",
    )],
    "last_link_skipped": [("        F -= self.s.drag * u\n", "        F -= self.s.drag * u\n        F[self.n - 1] = 0\n")],
    "spring_above_only": [("if upper >= 0:", "if upper > self.n:")],
    "spring_below_only": [("            F[lower] += T * e\n", "")],
    "same_side": [("F[upper] -=", "F[upper] +=")],
    "neighbours_spring": [("F[upper] -= T * e", "F[upper] -= self.springs[upper][2] * (norm - self.springs[upper][3]) * e")],
    "mass_forgotten": [("(F / self.s.masses.reshape(-1, 1))", "F")],
    "mass_multiplied": [("(F / self", "(F * self")],
    "dt_twice": [("x.ravel()]), dt)", "x.ravel()]), dt**2)")],
    "dt_missing": [("h * k1", "k1"), ("h * 0.5 *", "0.5 *")],
    "half_missing": [("h * 0.5 *", "h *")],
    "half_of_one_slope": [("h * 0.5 * (k1 + k2)", "h * (k1 + 0.5 * k2)")],
    "wrong_pair": [("y + h * k1", "y + 0.5 * h * k1")],
    "second_slope_only": [("0.5 * (k1 + k2)", "k2")],
    "from_the_guess": [("return y +", "return guess +")],
    "positions_not_corrected": [("        return y + h * 0.5 * (k1 + k2)", "        k2[2 * self.n :] = k1[2 * self.n :]\n"
                                "        return y + h * 0.5 * (k1 + k2)")],
    "velocities_not_corrected": [("        return y + h * 0.5 * (k1 + k2)", "        k2[: 2 * self.n] = k1[: 2 * self.n]\n"
                                 "        return y + h * 0.5 * (k1 + k2)")],
    "guess_keeps_velocities": [("        k2 = ", "        guess[: 2 * self.n] = y[: 2 * self.n]\n        k2 = ")],
    "guess_keeps_positions": [("        k2 = ", "        guess[2 * self.n :] = y[2 * self.n :]\n        k2 = ")],
    "euler": [("return y + h * 0.5 * (k1 + k2)", "return guess")],
    "kick_drift": [("return y + h * 0.5 * (k1 + k2)", "guess[2 * self.n :] = y[2 * self.n :] + h * guess[: 2 * self.n]\n"
                    "        return guess")],
    "midpoint": [("y + h * k1", "y + h / 2 * k1"), ("0.5 * (k1 + k2)", "k2")],
    "rk4": [("return y + h * 0.5 * (k1 + k2)", "k2 = self.rate(y + h / 2 * k1)\n        k3 = self.rate(y + h / 2 * k2)\n"
             "        k4 = self.rate(y + h * k3)\n        return y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)")],
    "heun_link_by_link": [(_HEUN_OF_CLASS, """        y = y.copy()
        for i in range(self.n):
            mine = [2 * i, 2 * i + 1, 2 * self.n + 2 * i, 2 * self.n + 2 * i + 1]
            old = y[mine]
            k1 = self.rate(y)[mine]
            y[mine] = old + h * k1
            y[mine] = old + h / 2 * (k1 + self.rate(y)[mine])
        return y
""")],
    "euler_in_place": [(_HEUN_OF_CLASS, """        y = y.copy()
        for i in range(self.n):
            mine = [2 * i, 2 * i + 1, 2 * self.n + 2 * i, 2 * self.n + 2 * i + 1]
            y[mine] += h * self.rate(y)[mine]
        return y
""")],
    "heun_aliased": [(_HEUN_OF_CLASS, """        start, y, k1 = y, y.copy(), np.zeros_like(y)
        for i in range(self.n):
            mine = [2 * i, 2 * i + 1, 2 * self.n + 2 * i, 2 * self.n + 2 * i + 1]
            k1[mine] = self.rate(y)[mine]
            y[mine] = start[mine] + h * k1[mine]
        for i in range(self.n):
            mine = [2 * i, 2 * i + 1, 2 * self.n + 2 * i, 2 * self.n + 2 * i + 1]
            y[mine] = start[mine] + h / 2 * (k1[mine] + self.rate(y)[mine])
        return y
""")],
    "modifies_its_input": [("    return r, u", "    np.copyto(v, u)\n    return r, v")],
    "overwrites_its_results": [
        ("EXERCISE = 4\n", "EXERCISE = 4\nBUFFERS = {}\n"),
        ("    return r, u", "    b = BUFFERS.setdefault(rope.n, [np.empty((rope.n, 2)), np.empty((rope.n, 2))])\n"
                            "    b[0][...], b[1][...] = r, u\n    return b[0], b[1]"),
    ],
    "whole_numbers": [("    return r, u", "    return np.rint(r), np.rint(u)")],
    "transposed": [("return r, u", "return np.transpose(r), np.transpose(u)")],
    "wrong_shape": [("return r, u", "return y[2 * rope.n :], y[: 2 * rope.n]")],
    "returns_nothing": [("    return r, u", "    rope.result = r, u")],
    "not_a_number": [("e = d / norm", "e = d / norm * np.arccos(1 + norm) / np.arccos(1 + norm)")],
    "random_or_time": [("T = k * (norm - l0)", "T = k * (norm - l0) * np.random.default_rng().uniform(0.99, 1.01)")],
    "remembers_earlier_calls": [
        ("EXERCISE = 4\n", "EXERCISE = 4\nropes = []\n"),
        ("    rope = Rope(string)\n", "    ropes.append(Rope(string))\n    rope = ropes[-1]\n"
                                    "    dt = dt * (1 + 1e-3 * len(ropes))\n"),
    ],
}  # fmt: skip

MISTAKES = {"loops": LOOPS, "arrays": ARRAYS, "classes": CLASSES}


def solution(style: str) -> str:
    """A right solution."""
    return (STYLES / f"{style}.py").read_text(encoding="utf-8")


def wrong(style: str, mistake: str) -> str:
    """The same with a mistake."""
    text = solution(style)
    for old, new in MISTAKES[style][mistake]:
        assert old in text, f"{style}, {mistake}: {old!r} is not there"
        text = text.replace(old, new)
    return text
