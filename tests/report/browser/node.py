"""The page's physics, run by Node: runs and limits asked for as JSON, answered as JSON with doubles as their bits."""

from __future__ import annotations

import base64
import json
import os
import shutil
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from report.browser.lab_page import physics

#: Doubles travel as their bits: JSON has neither NaN nor infinity, and some writers lose the sign of zero.
DRIVER = """
const bits = array => Buffer.from(array.buffer, array.byteOffset, array.byteLength).toString("base64");
const answers = JSON.parse(require("fs").readFileSync(0, "utf8")).map(asked => {
  if (asked.ask === "run") {
    const world = startWorld(asked.system, asked.scheme, asked.dt, asked.changes || [], asked.drives || []);
    const {F, at} = world.memory, size = at.n * at.d, rows = [];
    for (let k = 0; k < asked.steps; k++) {
      world.blownUp = null;
      advance(world, 1);
      rows.push(...F.slice(at.x, at.x + 2 * size));
    }
    return bits(Float64Array.from(rows));
  }
  if (asked.ask === "blown") {
    const world = startWorld(asked.system, asked.scheme, asked.dt);
    const left = () => world.blownUp ? 0 : asked.steps - world.steps;
    while (left()) advance(world, Math.min(asked.at_once, left()));
    return {steps: world.steps, ...world.blownUp};
  }
  const memory = memoryOf(asked.system);
  for (const [name, value] of Object.entries(asked.set || {})) setParameter(memory, name, value);
  if (asked.ask === "corner") return linearise(memory, asked.rest).corner !== undefined;
  const rest = equilibrium(memory, asked.rest, asked.contacts), linear = linearise(memory, rest.x, asked.contacts);
  const known = {};
  if (asked.ask === "limits") {
    const without = restWithout(memory, asked.alone), {system} = asked;
    const found = name => limitBesideObstacles(name, linear, without, known, system);
    const limits = Object.fromEntries(asked.schemes.map(name => [name, found(name)]));
    return {off: rest.off, limits, rest: Array.from(rest.x)};
  }
  if (asked.ask === "at") return asked.schemes.map(name =>
    grown(asked.system, memory, rest.x, name, asked.dt, asked.steps, asked.size));
  if (asked.ask === "grown") return asked.schemes.flatMap(name => {
    const {limit} = limitOf(name, linear, known, asked.system);
    const run = (dt, steps) => grown(asked.system, memory, rest.x, name, dt, steps, asked.size);
    const explicit = limitOf("kick_drift", linear, known, asked.system).limit;
    if (limit === Infinity) return [[name, run(20 * explicit, asked.long), null]];
    const steps = limit > 0 ? stepsToSee(linear, name, limit) : 0;
    return steps > 0 && steps < asked.most ? [[name, run(0.98 * limit, steps), run(1.02 * limit, 3 * steps)]] : [];
  });
  throw Error(asked.ask);
});
// How many steps of 1.02 times the limit make the worst perturbation a hundred thousand times as large.
function stepsToSee(linear, name, limit) {
  const scheme = schemes[name], h = 1.02 * limit;
  const apply = scheme.linear ? stepLinear : scheme.kind === "in_place" ? stepInPlace : stepWholeLinear;
  const top = largestEigenpair(scaled(linear, "stiffness"), linear.size, alongStart(linear));
  const g = dot(top.vector, scaled(linear, "damping")(top.vector, new Float64Array(linear.size)));
  const small = 2 * linear.free.length * linear.memory.at.d <= STEP_UP_TO;
  const whole = small && !scheme.memory;
  const growth = whole ? growthOfStep(linear, h, apply(scheme, linear, h)) : growthOfMode(scheme, top.value, g)(h);
  return Math.ceil(Math.log(1e5) / Math.log(growth));
}
function grown(system, memory, rest, scheme, dt, steps, size) {
  const {at, I} = memory, noise = pseudoRandom(at.n * at.d, 7);
  const positions = rest.map((x, e) => I[at.fixed + Math.floor(e / at.d)] ? x : x + size * noise[e]);
  const world = startWorld({...system, positions: Array.from(positions), velocities: 0, obstacles: []}, scheme, dt);
  const away = () => {
    let most = 0;
    rest.forEach((x, e) => { most = Math.max(most, Math.abs(world.memory.F[at.x + e] - x)); });
    return most / size;
  };
  let most = 0;
  for (let k = 0; k < steps && !world.blownUp && most < 1e4; k += 20) {
    advance(world, 20);
    most = Math.max(most, away());
  }
  return world.blownUp ? 1e300 : most;
}
process.stdout.write(JSON.stringify(answers));
"""


def ask(questions: Sequence[Mapping[str, Any]], text: str = "") -> list[Any]:
    """Node's answers, by the page's physics or another text; without Node the test is skipped, but never in CI."""
    node = shutil.which("node")
    if node is None:
        if os.environ.get("CI"):
            pytest.fail("node is not installed, and in CI it must be: see .ci/run")
        pytest.skip("node is not installed")
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder) / "physics.cjs"
        program.write_text((text or physics()) + DRIVER, encoding="utf-8")
        done = subprocess.run(
            [node, str(program)], input=json.dumps(questions), capture_output=True, text=True, timeout=600
        )
    assert done.returncode == 0, done.stderr[-3000:]
    answers: list[Any] = json.loads(done.stdout)
    return answers


def doubles(answer: str) -> np.ndarray[Any, np.dtype[np.float64]]:
    """Bits as an array."""
    return np.frombuffer(base64.b64decode(answer), dtype=np.float64)
