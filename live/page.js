// The page of `remodel live`. The mesh lives in a worker; the page holds what is wished for (`wish`), asks the
// worker for it, and shows what comes back (`shown`). At most one picture is asked for at a time: whatever is wished
// meanwhile is asked for next, all at once. One script with picture.js, charts.js and files.js, which come before it.

const $ = (id) => document.getElementById(id);
const DEGREE = 5; // of airfoils that are fitted
const STRIP_LENGTH = 100; // designs in the strip chart
const SEARCH_BUDGET = 12; // milliseconds of search per picture
const SLOW_FLOW = 30; // milliseconds: a flow that takes longer waits until the shape rests
const REST = 150; // milliseconds without a change
const SEARCH_SIGMA = 0.02;
const LEAST_SCALE = 120; // pixels per chord below which handles would cover each other
const LONGEST_HISTORY = 500; // designs that can be undone
const COLOURS = ["fate", "quality", "size", "age", "pressure", "mach"];
const MODELS = ["potential", "euler", "laminar"];
const LONG_STEP = 8; // milliseconds: while a handle is held no step that takes longer is tried ahead

const FIRST = {
  design: null, points: 200, gradation: 4, alpha: 2, mach: 0, reynolds: 5000, model: "potential", colour: "fate",
  flow: true, layers: false, regenerate: false, fresh: false,
};

const wish = { ...FIRST };
let shown = null; // the last frame of the worker
let view = null; // centre x, y in chords, and pixels (of the style sheet) per chord

// ---------------------------------------------------------------------------------------------- elements

function element(tag, attributes, ...children) {
  const result = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) result.setAttribute(name, value);
  result.append(...children);
  return result;
}

function say(sentence, trouble = false) {
  if (pictureLost && !trouble) return say(PICTURE_LOST, true); // what keeps it away is not to be talked over
  $("status").textContent = sentence;
  $("status").classList.toggle("trouble", trouble);
}

const sayTrouble = (error) => say(sentenceOf(error.message ?? String(error)), true);
// Names of files keep their first letter.
function sentenceOf(text) {
  const first = /^\S*[.:]/.test(text) ? text[0] : text[0].toUpperCase();
  return first + text.slice(1) + (/[.!?]$/.test(text) ? "" : ".");
}

const signed = (value, decimals) => value.toFixed(decimals).replace("-", "−");
const percent = (share) => `${(100 * share).toFixed(1)} %`;
const nextFrame = () => new Promise((resolve) => requestAnimationFrame(resolve));

function median(values) {
  if (values.length === 0) return NaN;
  const sorted = [...values].sort((a, b) => a - b);
  const middle = sorted.length >> 1;
  return sorted.length % 2 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}

// The style sheet's colours and the size of the stage, looked up once and not in every picture.
const theme = {};
const stage = { width: 1, height: 1 };

function readTheme() {
  const style = getComputedStyle(document.documentElement);
  const names = "quiet rule body line kept moved new going step flow low middle high";
  for (const name of names.split(" ")) theme[name] = style.getPropertyValue(`--${name}`).trim();
}

function measureStage() {
  Object.assign(stage, { width: Math.max(1, $("stage").clientWidth), height: Math.max(1, $("stage").clientHeight) });
}

// ---------------------------------------------------------------------------------------------- the worker

let mesher = null; // the worker that owns the mesh

const call = (method, argument, transfer) => mesher.call(method, argument, transfer);

// A worker with a core of its own; onStep is told the steps of a search for a flow.
async function openWorker(onStep = () => {}) {
  const worker = new Worker(URL.createObjectURL(new Blob([$("worker").textContent], { type: "text/javascript" })));
  const replies = new Map();
  let calls = 0;
  let isClosed = false;
  const post = (message, transfer = []) => new Promise((resolve, reject) => {
    const id = ++calls;
    replies.set(id, { resolve, reject });
    worker.postMessage({ id, ...message }, transfer);
  });
  worker.onmessage = ({ data: { id, flowStep, result, error, isBroken } }) => {
    if (flowStep !== undefined) return onStep(flowStep);
    const { resolve, reject } = replies.get(id);
    replies.delete(id);
    if (error === undefined) resolve(result);
    else reject(Object.assign(new Error(error), { isBroken }));
  };
  worker.onerror = (event) => sayTrouble(new Error(`The worker has failed: ${event.message}. Open the page again.`));
  const core = await unpackedCore();
  await post({ wasm: core }, [core]);
  return {
    call: (method, argument, transfer) =>
      (isClosed ? Promise.reject(takenBack()) : post({ method, argument }, transfer)),
    close() {
      isClosed = true;
      worker.terminate();
      for (const { reject } of replies.values()) reject(takenBack());
    },
  };
}

async function unpackedCore() {
  const text = atob($("wasm").textContent.trim());
  const packed = Uint8Array.from(text, (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

// ---------------------------------------------------------------------------------------------- wishes and frames

let busy = false;
let again = false;
let lastChange = -Infinity; // when something was wished
let flowTime = 0; // milliseconds of the last flow
let pressure = null; // of the last flow, which may be of an earlier design
let restTimer = 0;
let stamp = 0; // of the input that the next picture answers
const idle = []; // those who wait until nothing is under way

const wishPending = () => busy && again;

function change(changes, timeStamp = 0) {
  Object.assign(wish, changes);
  stamp = timeStamp;
  lastChange = performance.now();
  refresh();
}

// A flow that was left out for its slowness is made up for once the shape rests.
function makeUpFlow() {
  clearTimeout(restTimer);
  if (wish.flow && !shown.pressure && !shown.notice && !solvedFlow()) restTimer = setTimeout(refresh, REST);
}

// Asks for pictures until the last one shows what is wished. A design that is refused gives way to the one shown.
async function refresh() {
  again = true;
  if (busy) return;
  busy = true;
  while (again && !searching) {
    again = false;
    await showWish();
    if (!again && !searching) await lookAhead();
  }
  busy = false;
  settle();
}

// What the mesh is made by, beside its design.
const settingsOf = ({ points, gradation, layers, reynolds }) => ({ points, gradation, layers, reynolds });

async function showWish() {
  const rests = performance.now() - lastChange > REST || (shown && wish.design === shown.design);
  const asked = { ...wish, flow: wish.flow && (rests || flowTime < SLOW_FLOW), since: stamp, heard: lastChange };
  stamp = 0;
  wish.remesh = false;
  try {
    showFrame(await call("show", asked), asked);
  } catch (error) {
    if (shown && wish.design === asked.design) wish.design = shown.design;
    if (shown) Object.assign(wish, settingsOf(shown));
    if (!wish.layers && wish.model === "laminar") wish.model = "potential";
    sayTrouble(error);
    showControls();
  }
}

// Which triangles would go if the last change were made once more, as the worker finds by trying. It takes a step's time,
// so that it waits where there is none.
async function lookAhead() {
  const wasStep = shown && !shown.isFirst && !shown.figures[8];
  if (!wasStep || shown.colour !== "fate" || (gesture && shown.step > LONG_STEP)) return;
  const outlook = await call("outlook");
  if (!outlook.going || outlook.state !== shown.state || shown.colour !== "fate") return;
  const { vertices, triangles, going } = { ...shown, ...outlook };
  shown.going = 0;
  going.forEach((isGoing, cell) => {
    if (!isGoing) return;
    ++shown.going;
    const [first, end] = cell < triangles ? [cell, cell + 1] : [2 * cell - triangles, 2 * cell - triangles + 2];
    for (let at = 9 * first + 2; at < 9 * end; at += 3) vertices[at] = 7 / 8; // the last of four colours
  });
  uploadMesh(shown);
  if (isPainting) paint();
  showFigures(shown);
}

function settled() {
  return busy || gesture ? new Promise((resolve) => idle.push(resolve)) : Promise.resolve();
}

// Once nothing is under way: what is shown becomes a place to which one can go back.
function settle() {
  if (busy || gesture || searching || !shown) return;
  remember(shown.design);
  describeCharts();
  showTexts();
  writeLink();
  makeUpFlow();
  while (idle.length) idle.pop()();
}

function showFrame(frame, { since = 0, heard = 0, ...settings }) {
  shown = { ...frame, ...settingsOf(settings) };
  makeHandles();
  makeSliders();
  uploadMesh(frame);
  colourByFlow();
  showLegend();
  if (isPainting) paint();
  if (exact) gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); // waits for the picture
  const now = performance.now();
  const times = since ? { latency: now - since, answer: now - heard } : { latency: NaN, answer: NaN };
  const potential = frame.pressure ?? (wish.flow ? pressure : null);
  pressure = solvedFlow() ?? (isSolved(potential) ? null : potential);
  showLift(); // at once: that of another flow or shape must not stay as if it were this one's
  if (frame.flow && !frame.isFirst) flowTime = frame.flow; // the first one waits for the code to be compiled
  if (frame.stepped && !frame.isFirst) addToStrip(frame, times);
  else if (frame.flow && strip.length && !strip.at(-1).flow) strip.at(-1).flow = frame.flow;
  showSliders();
  if (isPainting) drawCharts();
  if (frame.notice) sayTrouble(new Error(frame.notice));
  else if (frame.stepped && !searching) say(sentenceOfStep(frame));
  showFlowState();
  searchFlow();
}

let exact = false; // whether measurements include the time until the picture is there
let isPainting = true; // false where they leave painting out

function sentenceOfStep({ figures, isFirst }) {
  if (isFirst) return "The mesh is there: drag a handle, or move one with the arrow keys.";
  if (figures[8]) return "Every cell is new: this mesh was generated.";
  if (figures[7]) return `A full adjustment: ${figures[10]} vertices moved, and nothing else changed.`;
  return `One step: ${figures[10]} vertices moved, ${figures[11]} inserted, ${figures[12]} removed.`;
}

// ---------------------------------------------------------------------------------------------- undo

let past = [];
let place = -1;

const same = (a, b) => a.length === b.length && a.every((value, i) => value === b[i]);

function remember(design) {
  if (place < 0 || !same(past[place], design)) {
    past = [...past.slice(0, place + 1), design].slice(-LONGEST_HISTORY);
    place = past.length - 1;
  }
  $("undo").disabled = place <= 0;
  $("redo").disabled = place >= past.length - 1;
}

// From a search one goes back to where it began.
function travel(step) {
  const to = searching ? place : place + step;
  stopSearch();
  if (to < 0 || to >= past.length || gesture) return;
  place = to;
  change({ design: past[to] });
}

function takeKeyOfPage(event) {
  if (!(event.ctrlKey || event.metaKey) || event.target.matches("#naca")) return;
  const key = event.key.toLowerCase();
  if (key !== "z" && key !== "y") return;
  event.preventDefault();
  travel(key === "y" || event.shiftKey ? 1 : -1);
}

// ---------------------------------------------------------------------------------------------- the search

let searching = false;
let target = null; // the design that the search looks for
let goal = ""; // its name: what the page shows as the goal while the search runs

async function startSearch() {
  $("search").disabled = true;
  try {
    await taking.catch(() => {}); // a shape that was chosen is the one to begin with
    await settled();
    clearTimeout(restTimer);
    await aim();
    searching = true;
    $("search").textContent = "Stop";
    $("search").disabled = false;
    $("undo").disabled = false;
    say("The search is running.");
    while (searching) {
      if ($("goal").value === goal) await searchOnce();
      else await aim();
    }
  } catch (error) {
    sayTrouble(error);
  }
  endSearch();
}

// Begins a search from the design that is shown towards the goal that is shown, whatever is chosen meanwhile.
async function aim() {
  let design = null;
  do {
    if (!searching) await settled();
    goal = $("goal").value;
    design = wish.design;
    const other = await call("named", { name: goal, degree: surfaceLength(design) - 1 });
    target = await designLike(design, other);
    placeTarget();
    await call("searchStart", { target, sigma: SEARCH_SIGMA, seed: 1 });
  } while (goal !== $("goal").value || (!searching && (gesture || wish.design !== design)));
}

async function searchOnce() {
  const asked = { ...wish, flow: wish.flow && flowTime < SLOW_FLOW };
  const frame = await call("searchNext", { wish: asked, budget: SEARCH_BUDGET });
  if (searching) wish.design = frame.design;
  showFrame(frame, shown);
  const { evaluations, objective, refused, running } = frame.search;
  const others = refused ? `, ${refused} refused` : "";
  $("search-state").textContent = `${evaluations} designs, best distance ${objective.toPrecision(2)} chords${others}`;
  if (!running) {
    searching = false;
    say(`The search has converged after ${evaluations} designs.`);
  }
  await nextFrame();
}

// Whoever changes the shape takes it from the search.
function stopSearch() {
  if (searching) say("The search has stopped.");
  searching = false;
}

function endSearch() {
  searching = false;
  target = null;
  $("search").textContent = "Optimise";
  $("search").disabled = false;
  placeTarget();
  if (again || !same(wish.design, shown.design)) refresh();
  else settle();
}

// A search needs designs of one degree: the other shape is fitted anew where its degree differs.
async function designLike(design, other) {
  if (design.length === other.length) return other;
  const text = outline(other, 200).map(([x, y]) => `${x} ${y}`).join("\n");
  return call("read", { text: `outline\n${text}`, file: "outline.dat", degree: surfaceLength(design) - 1 });
}

function placeTarget() {
  const points = target ? outline(target).map(([x, y]) => toScreen(x, y).map((p) => p.toFixed(1)).join(",")) : [];
  if (target || $("target").getAttribute("points")) $("target").setAttribute("points", points.join(" "));
}

// ---------------------------------------------------------------------------------------------- controls

// The program's default, within the slider's range.
const usualGradation = (points) => Math.min(20, Math.max(1, points / 50));
const RANGES = {
  points: String,
  gradation: (value) => value.toFixed(1),
  alpha: (value) => `${signed(value, 2)}°`,
  mach: (value) => value.toFixed(2),
};

function showControls() {
  for (const [name, text] of Object.entries(RANGES)) {
    $(name).value = wish[name];
    $(name).nextElementSibling.textContent = text(wish[name]);
  }
  for (const name of LINK_SWITCHES) $(name).checked = wish[name];
  $("colour").value = wish.colour;
  $("reynolds").value = wish.reynolds;
  $("layers").disabled = wish.model === "laminar"; // which needs them
  for (const model of MODELS) $(`model-${model}`).checked = wish.model === model;
}

// A number that is refused gives way to the one before.
function takeReynolds(text) {
  const value = text.trim() === "" ? NaN : Number(text);
  const [least, most] = REYNOLDS;
  if (value >= least && value <= most) {
    if (wish.layers) stopSearch();
    change({ reynolds: value });
  } else {
    sayTrouble(new Error(`The Reynolds number is a number from ${least} to ${most.toLocaleString("en")}; found “${text}”.`));
  }
  showControls();
}

function listenToControls() {
  for (const name of Object.keys(RANGES)) {
    $(name).addEventListener("input", () => {
      if (name === "points" || name === "gradation") stopSearch();
      const value = $(name).valueAsNumber;
      change({ [name]: value, ...(name === "points" ? { gradation: usualGradation(value) } : {}) });
      showControls();
    });
  }
  $("reynolds").addEventListener("change", () => takeReynolds($("reynolds").value));
  for (const name of LINK_SWITCHES) {
    $(name).addEventListener("change", () => {
      if (name === "layers") stopSearch();
      change({ [name]: $(name).checked });
    });
  }
  for (const model of MODELS) $(`model-${model}`).addEventListener("change", () => chooseModel(model));
  $("colour").addEventListener("change", () => change({ colour: $("colour").value }));
  $("airfoil").addEventListener("change", () => $("airfoil").value && takeDesign("named", { name: $("airfoil").value }));
  $("naca-form").addEventListener("submit", (event) => {
    event.preventDefault();
    takeDesign("named", { name: `naca:${$("naca").value.trim().replace(/^naca[\s:]*/i, "")}` });
  });
  const clicks = {
    undo: () => travel(-1), redo: () => travel(1), remesh: () => { stopSearch(); change({ remesh: true }); },
    check: () => checkMesh().catch(sayTrouble), search: () => (searching ? stopSearch() : startSearch()), link: copyLink,
    "save-mesh": async () => save("remodel.su2", new Blob([await meshText()])), "save-picture": savePicture,
    "save-design": () => save("remodel.json", new Blob([designText(shown.design)])),
  };
  for (const [id, act] of Object.entries(clicks)) $(id).addEventListener("click", act);
  $("coefficients-part").addEventListener("toggle", () => shown && showSliders());
}

function listenToWindow() {
  addEventListener("keydown", takeKeyOfPage);
  addEventListener("hashchange", () => location.reload()); // another link was put into the address bar
  new ResizeObserver(() => {
    measureStage();
    view.fit?.();
    if (!shown) return;
    paint(); // at once: a canvas whose size has changed is empty
    drawCharts();
  }).observe($("stage"));
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    readTheme();
    if (!shown) return;
    showLegend(true);
    paintSoon();
    drawCharts();
  });
}

async function fillCatalogue() {
  const list = await call("catalogue");
  const options = () => list.map(({ name, description }) => element("option", { value: name }, description));
  $("airfoil").append(element("option", { value: "" }, "choose one of the catalogue"), ...options());
  $("goal").append(...options());
}

// The design of the link, or the first one where there is none that can be meshed: the status says so then.
async function showFirst() {
  let trouble = null;
  try {
    wish.design = readLink();
    if (wish.design) await refresh();
  } catch (error) {
    trouble = error;
  }
  if (shown) return;
  if (wish.design) trouble = new Error($("status").textContent);
  Object.assign(wish, FIRST, { design: await call("named", { name: "naca:0012", degree: DEGREE }) });
  await refresh();
  if (trouble) sayTrouble(trouble);
}

async function start() {
  gl = $("mesh").getContext("webgl2", { antialias: false, alpha: false, powerPreference: "high-performance" });
  if (!gl) throw new Error("This browser has no WebGL 2, which the picture needs.");
  listenToContext();
  readTheme();
  measureStage();
  showAirfoil();
  makePainter();
  mesher = await openWorker();
  await fillCatalogue();
  await showFirst();
  showControls();
  listenToView();
  listenToFiles();
  listenToControls();
  listenToWindow();
  document.documentElement.dataset.ready = "true";
}

// For tests and the console. A picture counts as there when it is drawn; measured to its "pixels", when these can be read,
// which holds up the page; with "nothing", when it could be drawn, and neither mesh nor charts are.
globalThis.live = {
  wish, stage, call, change, settled, solved, medians, meshText,
  get shown() { return shown; },
  get view() { return view; },
  get busy() { return busy; },
  get flow() { return solvedFlow(); },
  get flowSearch() { return flowSearch; },
  get times() { return strip; },
  measure(upTo) {
    exact = upTo === "pixels";
    isPainting = upTo !== "nothing";
    strip = [];
  },
};

start().catch(sayTrouble);
