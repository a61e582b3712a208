// node host.mjs FILE_OF_JOLT: a soft body of Jolt, told what to do line by line of JSON on the standard input, and answering each line with one.
//
//   {"make": {...}}    the system and dt, see `make` of soft_body.mjs; answers true
//   {"write": {...}}   numbers of masses and edges that change; answers true
//   {"steps": n}       answers true
//   {"state": true}    answers [[x, y, z, ...], [vx, vy, vz, ...]] of all masses
import { createInterface } from 'node:readline';
import { softBody } from './soft_body.mjs';

const body = softBody(await (await import(process.argv[2])).default());
let dt;

// JSON has no infinity and no NaN
const plain = (_, value) => (typeof value === 'number' && !Number.isFinite(value) ? String(value) : value);

for await (const line of createInterface({ input: process.stdin })) {
  const told = JSON.parse(line);
  let answer = true;
  if (told.make) {
    dt = told.make.dt;
    body.make(told.make);
  } else if (told.write) body.write(told.write);
  else if (told.steps) for (let i = 0; i < told.steps; i++) body.step(dt);
  else answer = body.state();
  process.stdout.write(JSON.stringify(answer, plain) + '\n');
}
