// The worker of the page: it owns the living mesh, which is compiled to WebAssembly, and answers one call at a
// time. The emscripten glue, which defines createLive, stands before this text in the same script.

let core = null; // the module once it runs
let have = null; // design, points and gradation of the present mesh
let isFirst = true; // whether there was no mesh before the present one, of which anything could have been kept

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
  have = { design: wish.design, points: wish.points, gradation: wish.gradation };
  isFirst = !hadMesh;
  return true;
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
    return { at: (triangle) => (isFirst ? 1 : 2 * fates[triangle] + 1) / 6, range: [0, 2] };
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
  return { vertices, range, figures: values };
}

function flow({ alpha, mach }) {
  expectDone(core._live_flow(alpha, mach));
  return {
    sonic: core._live_sonic_cp(),
    wall: doubles(core._live_wall_cp(), 2 * core._live_wall_cp_count()),
    lift: core._live_lift(),
  };
}

// What the page shows of the present mesh. A flow that fails takes nothing but itself away.
function frame(wish, stepped, stepMilliseconds) {
  const result = { stepped, isFirst, step: stepMilliseconds, flow: 0, pressure: null, design: have.design, notice: "" };
  let colour = wish.colour;
  if (wish.flow || colour === "pressure") {
    try {
      result.flow = timed(() => { result.pressure = flow(wish); });
    } catch (error) {
      result.notice = error.message;
      if (colour === "pressure") colour = "fate";
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
    have = { ...have, design };
    const objective = core._live_search_objective();
    core._live_search_tell(objective);
    ++search.evaluations;
    if (objective < search.objective) Object.assign(search, { objective, best: design });
    return true;
  }
  throw new Error(`${REFUSALS_IN_A_ROW} designs in a row could not be meshed, so the search has stopped.`);
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
      have = { ...have, design: search.best };
    }
    return { ...frame(wish, steps > 0, each), search: { ...search, best: null, running } };
  },
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
  const arrays = [result?.vertices, result?.points, result?.triangles, result?.pressure?.wall];
  return arrays.filter(Boolean).map((array) => array.buffer);
}

function answer({ id, method, argument }) {
  try {
    const result = METHODS[method](argument);
    self.postMessage({ id, result }, buffersOf(result));
  } catch (error) {
    self.postMessage({ id, error: error.message || String(error) });
  }
}

self.onmessage = async ({ data }) => {
  if (!data.wasm) return answer(data);
  try {
    core = await createLive({ wasmBinary: data.wasm });
    self.postMessage({ id: data.id, result: null });
  } catch (error) {
    self.postMessage({ id: data.id, error: `The mesher did not start: ${error.message || error}` });
  }
};
