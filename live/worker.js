// The worker of the page: it owns the living mesh, which is compiled to WebAssembly, and answers one call at a
// time. Another one, with a core of its own, looks for Euler's flow, which takes longer. The emscripten glue, which
// defines createLive, stands before this text in the same script.

let core = null; // the module once it runs
let have = null; // design, points and gradation of the present mesh; before: the design before the last step
let isFirst = true; // whether there was no mesh before the present one, of which anything could have been kept
let state = 0; // of the mesh: a number for each

const REFUSALS_IN_A_ROW = 100; // after so many refused designs a search gives up

// ---------------------------------------------------------------------------------------------- flat arrays

// The heaps are looked up at every use, because memory may have grown.
const doubles = (pointer, count) => core.HEAPF64.slice(pointer / 8, pointer / 8 + count);
const integers = (pointer, count) => core.HEAPU32.slice(pointer / 4, pointer / 4 + count);

function fail() {
  throw new Error(core.UTF8ToString(core._live_error()));
}

function expectDone(done) {
  if (!done) fail();
  return done;
}

// The pointers are good until the next call of this function.
function placeDoubles(...arrays) {
  const total = arrays.reduce((sum, array) => sum + array.length, 0);
  const start = core._live_scratch(8 * total);
  const pointers = [];
  let at = start / 8;
  for (const array of arrays) {
    core.HEAPF64.set(array, at);
    pointers.push(8 * at);
    at += array.length;
  }
  return pointers;
}

function placeStrings(...strings) {
  const bytes = strings.map((text) => new TextEncoder().encode(text));
  let at = core._live_scratch(bytes.reduce((sum, text) => sum + text.length + 1, 0));
  return bytes.map((text) => {
    const pointer = at;
    core.HEAPU8.set(text, pointer);
    core.HEAPU8[pointer + text.length] = 0;
    at += text.length + 1;
    return pointer;
  });
}

const designOf = (count) => doubles(core._live_design(), expectDone(count));
const figures = () => doubles(core._live_figures(), 14);
const sameDesign = (a, b) => a.length === b.length && a.every((value, i) => value === b[i]);

// ---------------------------------------------------------------------------------------------- steps

// These return 0 where the design is refused; the mesh is as it was then.
function generate(wish, design) {
  const [pointer] = placeDoubles(design);
  return core._live_generate(pointer, design.length, wish.points, wish.gradation);
}

function remeshed(wish, design) {
  if (wish.regenerate) return generate(wish, design);
  const [pointer] = placeDoubles(design);
  return core._live_update(pointer, design.length);
}

// Brings the mesh to the wish; true where that took a step.
function bring(wish) {
  const hadMesh = have !== null;
  const sameMesh = hadMesh && have.points === wish.points && have.gradation === wish.gradation;
  const moved = !hadMesh || !sameDesign(have.design, wish.design);
  if (sameMesh && !moved && !wish.remesh) return false;
  if (!sameMesh || wish.remesh) expectDone(generate(wish, wish.design));
  else expectDone(remeshed(wish, wish.design));
  const wasStep = sameMesh && !wish.remesh && !wish.regenerate;
  take({ design: wish.design, points: wish.points, gradation: wish.gradation }, wasStep);
  isFirst = !hadMesh;
  return true;
}

function take(mesh, wasStep) {
  have = { ...mesh, before: wasStep ? have.design : null };
  ++state;
}

// Milliseconds that the work took.
function timed(work) {
  const start = performance.now();
  work();
  return performance.now() - start;
}

// ---------------------------------------------------------------------------------------------- pictures

const clamp = (value) => Math.min(1, Math.max(0, value));

// Each colouring gives what lies at a triangle's corner in [0,1], and the ends of its scale.
const COLOURINGS = {
  fate(count) {
    const fates = core.HEAPU8.subarray(core._live_fates(), core._live_fates() + count);
    return { at: (triangle) => (isFirst ? 1 : 2 * fates[triangle] + 1) / 8, range: [0, 3] };
  },
  quality(count) {
    const angles = doubles(core._live_angles(), count);
    return { at: (triangle) => clamp((angles[triangle] - 30) / 30), range: [30, 60] };
  },
  size(count) {
    const sizes = doubles(core._live_sizes(), count);
    const low = sizes.reduce((a, b) => Math.min(a, b));
    const high = sizes.reduce((a, b) => Math.max(a, b));
    const span = Math.log(high / low) || 1;
    return { at: (triangle) => Math.log(sizes[triangle] / low) / span, range: [low, high] };
  },
  age(count, values) {
    const births = integers(core._live_births(), count);
    const step = values[9];
    const oldest = Math.max(15, step);
    return { at: (triangle) => Math.log1p(step - births[triangle]) / Math.log1p(oldest), range: [0, oldest] };
  },
  pressure(count, values) {
    const cp = doubles(core._live_cp(), values[1]);
    return { at: (triangle, vertex) => clamp(0.5 + cp[vertex] / 3), range: [-1.5, 1.5] };
  },
  mach(count, values) {
    const mach = doubles(core._live_mach(), values[1]);
    return { at: (triangle, vertex) => clamp(mach[vertex] / 2), range: [0, 2] };
  },
};

// Three corners of each triangle, each x, y and its place in the colour scale.
function picture(colour) {
  const values = figures();
  const count = values[0];
  const points = doubles(core._live_points(), 2 * values[1]);
  const corners = integers(core._live_triangles(), 3 * count);
  const { at, range } = COLOURINGS[colour](count, values);
  const vertices = new Float32Array(9 * count);
  for (let corner = 0, out = 0; corner < corners.length; ++corner) {
    const vertex = corners[corner];
    vertices[out++] = points[2 * vertex];
    vertices[out++] = points[2 * vertex + 1];
    vertices[out++] = at((corner / 3) | 0, vertex);
  }
  return { vertices, corners, range, figures: values };
}

function flow({ alpha, mach }) {
  expectDone(core._live_flow(alpha, mach));
  return {
    model: "potential",
    sonic: core._live_sonic_cp(),
    wall: doubles(core._live_wall_cp(), 2 * core._live_wall_cp_count()),
    lift: core._live_lift(),
  };
}

// What the page shows of the present mesh. A flow that fails takes nothing but itself away.
function frame(wish, stepped, stepMilliseconds) {
  const result = {
    state, stepped, isFirst, step: stepMilliseconds, flow: 0, pressure: null, design: have.design, notice: "",
  };
  let colour = wish.colour;
  const isOfFlow = colour === "pressure" || colour === "mach";
  if (wish.flow || isOfFlow) {
    try {
      result.flow = timed(() => { result.pressure = flow(wish); });
    } catch (error) {
      result.notice = error.message;
      if (isOfFlow) colour = "fate";
    }
  }
  if (stepped && wish.fresh) expectDone(core._live_fresh());
  result.pack = timed(() => Object.assign(result, picture(colour), { colour }));
  return result;
}

// ---------------------------------------------------------------------------------------------- the search

const search = { evaluations: 0, refused: 0, objective: Infinity, best: null };

// One design that the mesh takes: asked for, meshed, told. False where the search has converged.
function evaluate(wish) {
  for (let tries = 0; tries < REFUSALS_IN_A_ROW; ++tries) {
    const count = core._live_search_next();
    if (count === 0) return false;
    const design = doubles(core._live_design(), count);
    if (!remeshed(wish, design)) {
      ++search.refused;
      continue;
    }
    take({ ...have, design }, true);
    const objective = core._live_search_objective();
    core._live_search_tell(objective);
    ++search.evaluations;
    if (objective < search.objective) Object.assign(search, { objective, best: design });
    return true;
  }
  throw new Error(`${REFUSALS_IN_A_ROW} designs in a row could not be meshed, so the search has stopped.`);
}

// ---------------------------------------------------------------------------------------------- what will go

let ahead = null; // the last answer, which holds as long as the mesh is what it was

// A byte for each triangle: 1 where the last change, made once more, would replace it. Null where no step came before,
// or none can follow.
function going() {
  const { design, before } = have;
  if (!before || before.length !== design.length) return null;
  const [pointer] = placeDoubles(design.map((value, i) => 2 * value - before[i]));
  if (!core._live_outlook(pointer, design.length)) return null;
  return core.HEAPU8.slice(core._live_going(), core._live_going() + figures()[0]);
}

function outlook() {
  if (ahead?.state !== state) ahead = { state, going: going() };
  return { state, going: ahead.going?.slice() ?? null };
}

// ---------------------------------------------------------------------------------------------- Euler's flow

const FINE = 600; // vertices from which on a first flow begins with that of a coarser mesh
const COARSENING = 2; // of I and G
const FEWEST_POINTS = 40; // on an airfoil of a coarser mesh
const COARSE_KEYS = 0x80000000; // sets names of vertices of coarser meshes apart from the others
const STARTS = ["cold", "carried", "refactored"];
let hasFlow = false;

// The present mesh in the words of _live_euler_mesh(): `numbers` has triangles, keys and edges.
function meshForFlow() {
  const [triangles, vertices] = figures();
  const edges = core._live_edges();
  const counts = { vertices, triangles, airfoil: core._live_airfoil_edges(), farfield: core._live_farfield_edges() };
  const parts = [
    integers(core._live_triangles(), 3 * triangles), integers(core._live_keys(), 2 * vertices),
    integers(edges, 2 * (counts.airfoil + counts.farfield)),
  ];
  const numbers = new Uint32Array(parts.reduce((sum, part) => sum + part.length, 0));
  parts.reduce((at, part) => (numbers.set(part, at), at + part.length), 0);
  return { state, ...counts, points: doubles(core._live_points(), 2 * vertices), numbers, wish: { ...have } };
}

// One flow; throws where it is not found.
function solveOn({ points, numbers, vertices, triangles, airfoil, farfield }, { alpha, mach }) {
  const start = core._live_scratch(points.byteLength + numbers.byteLength);
  core.HEAPF64.set(points, start / 8);
  core.HEAPU32.set(numbers, (start + points.byteLength) / 4);
  const reason = () => core.UTF8ToString(core._live_euler_reason());
  const isTaken = core._live_euler_mesh(start, start + points.byteLength, vertices, triangles, airfoil, farfield);
  if (!isTaken || !core._live_euler(alpha, mach)) throw new Error(reason());
  const values = doubles(core._live_euler_figures(), 13);
  if (!values[0]) throw new Error(reason());
  hasFlow = true;
  return values;
}

// Leaves a flow on a coarser mesh of the same design, for the fine one to begin with; where there is none, the fine one
// begins without. Newton steps on all of them.
function solveCoarser({ vertices, wish }, conditions) {
  const [points, gradation] = [Math.round(wish.points / COARSENING), wish.gradation / COARSENING];
  if (vertices < FINE || points < FEWEST_POINTS || !generate({ points, gradation }, wish.design)) return 0;
  const mesh = meshForFlow();
  for (let i = 0; i < mesh.vertices; ++i) mesh.numbers[3 * mesh.triangles + 2 * i + 1] ^= COARSE_KEYS;
  try {
    return solveCoarser({ vertices: mesh.vertices, wish: { ...wish, points, gradation } }, conditions) +
           solveOn(mesh, conditions)[7];
  } catch {
    return 0;
  }
}

function euler({ mesh, alpha, mach }) {
  const conditions = { alpha, mach };
  let values = null;
  let coarse = 0;
  const milliseconds = timed(() => {
    if (!hasFlow) coarse = solveCoarser(mesh, conditions);
    values = solveOn(mesh, conditions);
  });
  const [, start, lift, drag, moment, sonic, highestMach, newton, factorisations, krylov, corrected, , memory] = values;
  return {
    model: "euler", state: mesh.state, alpha, mach, milliseconds, coarse,
    start: coarse > 0 ? "cold" : STARTS[start], lift, drag, moment, sonic, highestMach, newton, factorisations, krylov,
    corrected, memory,
    wall: doubles(core._live_euler_wall_cp(), 2 * core._live_euler_wall_cp_count()),
    values: {
      pressure: doubles(core._live_euler_cp(), mesh.vertices).map((cp) => clamp(0.5 + cp / 3)),
      mach: doubles(core._live_euler_mach(), mesh.vertices).map((value) => clamp(value / 2)),
    },
  };
}

// ---------------------------------------------------------------------------------------------- calls

const METHODS = {
  catalogue: () => JSON.parse(core.UTF8ToString(core._live_catalogue())),
  named({ name, degree }) {
    const [text] = placeStrings(name);
    return designOf(core._live_named(text, degree));
  },
  read({ text, file, degree }) {
    const [content, name] = placeStrings(text, file);
    return designOf(core._live_read(content, name, degree));
  },
  show(wish) {
    let stepped = false;
    const step = timed(() => { stepped = bring(wish); });
    return frame(wish, stepped, stepped ? step : 0);
  },
  searchStart({ target, sigma, seed }) {
    const [from, to] = placeDoubles(have.design, target);
    expectDone(core._live_search_start(from, have.design.length, to, target.length, sigma, seed));
    Object.assign(search, { evaluations: 0, refused: 0, objective: Infinity, best: null });
  },
  // Evaluates for about as many milliseconds as the budget has, at least once; the picture is of the last one.
  searchNext({ wish, budget }) {
    const start = performance.now();
    const before = search.evaluations;
    isFirst = false;
    let running = true;
    do running = evaluate(wish);
    while (running && performance.now() - start < budget);
    const steps = search.evaluations - before;
    const each = (performance.now() - start) / Math.max(1, steps);
    if (!running && search.best) {
      expectDone(remeshed(wish, search.best));
      take({ ...have, design: search.best }, true);
    }
    return { ...frame(wish, steps > 0, each), search: { ...search, best: null, running } };
  },
  outlook, meshForFlow, euler,
  check: () => core.UTF8ToString(core._live_check()),
  hash: () => core.UTF8ToString(core._live_hash()),
  mesh() {
    const values = figures();
    return {
      points: doubles(core._live_points(), 2 * values[1]),
      triangles: integers(core._live_triangles(), 3 * values[0]),
    };
  },
  memory: () => core.HEAPU8.length,
};

function buffersOf(result) {
  const { vertices, corners, points, triangles, numbers, going, wall, pressure, values } = result ?? {};
  const arrays = [
    vertices, corners, points, triangles, numbers, going, wall, pressure?.wall, values?.pressure, values?.mach,
  ];
  return arrays.filter((array) => array?.buffer).map((array) => array.buffer);
}

function answer({ id, method, argument }) {
  try {
    const result = METHODS[method](argument);
    self.postMessage({ id, result }, buffersOf(result));
  } catch (error) {
    const isBroken = error instanceof WebAssembly.RuntimeError; // the core cannot go on
    self.postMessage({ id, error: error.message || String(error), isBroken });
  }
}

self.onmessage = async ({ data }) => {
  if (!data.wasm) return answer(data);
  try {
    core = await createLive({ wasmBinary: data.wasm, onFlowStep: (step) => self.postMessage({ flowStep: step }) });
    self.postMessage({ id: data.id, result: null });
  } catch (error) {
    self.postMessage({ id: data.id, error: `The mesher did not start: ${error.message || error}` });
  }
};
