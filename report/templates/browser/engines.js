// Engines that the page carries, each a WebAssembly program: loaded once, and stepped as a lane. What tells it what to do
// is the lab's own script of it, `softBody`.

const engineNamed = name => lab.scene && lab.scene.engines && lab.scene.engines[name] === "" ? DATA.carried.engines.find(one => one.name === name) : undefined;

// The program, unpacked and begun; and one body for each lane, as each holds memory for good.
let carriedProgram = null;
const bodies = [];
async function loadEngines() {
  const bytes = Uint8Array.from(atob(DATA.carried.program), c => c.charCodeAt(0));
  const text = await new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).text();
  const program = await import(URL.createObjectURL(new Blob([text], {type: "text/javascript"})));
  carriedProgram = await program.default();
}

// A vector in space: a line goes up and down in it, as engines have it.
const inSpace = (values, d) => d === 1 ? [0, values[0], 0] : d === 2 ? [values[0], values[1], 0] : [...values];
const vectorAt = ({F, at}, begin, i) => inSpace(F.subarray(begin + at.d * i, begin + at.d * (i + 1)), at.d);

// A world whose steps an engine takes.
function carry(engine, world, k) {
  const {memory} = world, {F, I, at} = memory, {n, s, d} = at, ends = j => [I[at.springs + 2 * j], I[at.springs + 2 * j + 1]];
  const body = bodies[k] = bodies[k] || softBody(carriedProgram), moved = Array.from({length: s}, (_, j) => j).filter(j => !ends(j).every(i => I[at.fixed + i]));
  const single = Math.fround, numbers = () => ({
    inverse: Array.from({length: n}, (_, i) => I[at.fixed + i] ? 0 : single(1 / single(F[at.masses + i]))),
    compliance: moved.map(j => single(1 / single(F[at.stiffness + j]))), rest: moved.map(j => F[at.rest_lengths + j]),
    gravity: vectorAt(memory, at.gravity, 0),
  });
  const all = begin => Array.from({length: n}, (_, i) => vectorAt(memory, begin, i));
  body.make({substeps: engine.substeps, positions: all(at.x), velocities: all(at.v), springs: moved.map(ends), ...numbers()});
  let done = world.done;
  world.put = i => body.put(i, vectorAt(memory, at.x, i), vectorAt(memory, at.v, i));
  world.step = () => {
    if (world.done !== done || world.drives.length) body.write(numbers());
    done = world.done;
    const cannot = F[at.drag] > 0 || F.subarray(at.damping, at.damping + s).some(c => c > 0) || moved.some(j => !(F[at.stiffness + j] > 0));
    if (cannot) return false;
    body.step(world.dt);
    body.state().forEach((vectors, q) => {
      const begin = q ? at.v : at.x;
      for (let i = 0; i < n; i++) for (let axis = 0; axis < d; axis++) F[begin + d * i + axis] = vectors[3 * i + (d === 1 ? 1 : axis)];
    });
    return true;
  };
}
