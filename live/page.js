// The page of `remodel live`. The mesh lives in a worker; the page holds what is wished for (`wish`), asks the
// worker for it, and shows what comes back (`shown`). At most one picture is asked for at a time: whatever is wished
// meanwhile is asked for next, all at once.
"use strict";

const $ = (id) => document.getElementById(id);
const DEGREE = 5; // of airfoils that are fitted
const STRIP_LENGTH = 100; // designs in the strip chart
const SEARCH_BUDGET = 12; // milliseconds of search per picture
const SLOW_FLOW = 30; // milliseconds: a flow that takes longer waits until the shape rests
const REST = 150; // milliseconds without a change
const SEARCH_SIGMA = 0.02;
const LONGEST_HISTORY = 500; // designs that can be undone
const COLOURS = ["fate", "quality", "size", "age", "pressure"];

const FIRST = { design: null, points: 200, gradation: 4, alpha: 2, colour: "fate", flow: true, regenerate: false, fresh: false };

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
  $("status").textContent = sentence;
  $("status").classList.toggle("trouble", trouble);
}

const sayTrouble = (error) => say(sentenceOf(error.message ?? String(error)), true);
// Names of files keep their first letter.
const sentenceOf = (text) => (/^\S*[.:]/.test(text) ? text[0] : text[0].toUpperCase()) + text.slice(1) + (/[.!?]$/.test(text) ? "" : ".");
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
  for (const name of ["ground", "ink", "quiet", "rule", "body", "line", "kept", "moved", "new", "step", "flow", "low", "middle", "high"]) {
    theme[name] = style.getPropertyValue(`--${name}`).trim();
  }
}

function measureStage() {
  Object.assign(stage, { width: Math.max(1, $("stage").clientWidth), height: Math.max(1, $("stage").clientHeight) });
}

// ---------------------------------------------------------------------------------------------- airfoils by CST

// y = sqrt(x) (1 - x) sum of coefficient_i Bernstein_i(x) + x te. A design holds the upper side's coefficients, the
// lower side's, and the two ends of the trailing edge.
const surfaceLength = (design) => design.length / 2 - 1;

function basisRow(x, degree) {
  const row = [];
  let binomial = Math.sqrt(x) * (1 - x);
  for (let i = 0; i <= degree; ++i) {
    row.push(binomial * x ** i * (1 - x) ** (degree - i));
    binomial *= (degree - i) / (i + 1);
  }
  return row;
}

function heightAt(design, upper, x) {
  const length = surfaceLength(design);
  const row = basisRow(x, length - 1);
  const first = upper ? 0 : length;
  const edge = design[design.length - (upper ? 2 : 1)];
  return row.reduce((sum, value, i) => sum + value * design[first + i], x * edge);
}

// The design nearest to the given one, by the sum of squares of its coefficients' changes, whose surface has the
// height y at x: the change is a multiple of the basis row.
function withHeight(design, upper, x, y) {
  const length = surfaceLength(design);
  const row = basisRow(x, length - 1);
  const squares = row.reduce((sum, value) => sum + value * value, 0);
  const factor = (y - heightAt(design, upper, x)) / squares;
  const first = upper ? 0 : length;
  return design.map((value, i) => (i >= first && i < first + length ? value + factor * row[i - first] : value));
}

function outline(design, samples = 160) {
  const points = [];
  for (let i = 0; i <= samples; ++i) {
    const x = (1 + Math.cos((2 * Math.PI * i) / samples)) / 2;
    points.push([x, heightAt(design, 2 * i < samples, x)]);
  }
  return points;
}

// ---------------------------------------------------------------------------------------------- the worker

const replies = new Map();
let worker = null;
let calls = 0;

function call(method, argument, transfer = []) {
  const id = ++calls;
  return new Promise((resolve, reject) => {
    replies.set(id, { resolve, reject });
    worker.postMessage(method === "start" ? { id, wasm: argument } : { id, method, argument }, transfer);
  });
}

function takeReply({ data: { id, result, error } }) {
  const { resolve, reject } = replies.get(id);
  replies.delete(id);
  if (error === undefined) resolve(result);
  else reject(new Error(error));
}

async function unpackedCore() {
  const text = atob($("wasm").textContent.trim());
  const packed = Uint8Array.from(text, (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

async function startWorker() {
  worker = new Worker(URL.createObjectURL(new Blob([$("worker").textContent], { type: "text/javascript" })));
  worker.onmessage = takeReply;
  worker.onerror = (event) => sayTrouble(new Error(`The worker has failed: ${event.message}. Open the page again.`));
  const core = await unpackedCore();
  await call("start", core, [core]);
}

// ---------------------------------------------------------------------------------------------- the picture

const gl = $("mesh").getContext("webgl2", { antialias: false, alpha: false, powerPreference: "high-performance" });
let painter = null; // program, buffer, palette and their places
let wantsPicture = false;

const VERTEX_SHADER = `#version 300 es
layout(location = 0) in vec3 corner;
layout(location = 1) in vec3 barycentric;
uniform vec2 centre, scale;
uniform sampler2D palette;
out vec3 weights;
out vec3 shade;
void main() {
  weights = barycentric;
  shade = texture(palette, vec2(corner.z, 0.5)).rgb;
  gl_Position = vec4((corner.xy - centre) * scale, 0.0, 1.0);
}`;

// Lines are a pixel wide; where triangles are of the size of pixels they fade, so that their colour is seen.
const FRAGMENT_SHADER = `#version 300 es
precision mediump float;
in highp vec3 weights;
in vec3 shade;
uniform vec3 line;
uniform float width;
out vec4 colour;
void main() {
  highp vec3 slope = fwidth(weights);
  highp vec3 distance = weights / slope;
  float nearest = min(distance.x, min(distance.y, distance.z));
  float steepest = max(slope.x, max(slope.y, slope.z));
  float share = clamp(width - nearest, 0.0, 1.0) * clamp(0.9 - 2.5 * steepest, 0.1, 0.65);
  colour = vec4(mix(shade, line, share), 1.0);
}`;

function compiled(kind, source) {
  const shader = gl.createShader(kind);
  gl.shaderSource(shader, source);
  gl.compileShader(shader);
  if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
  return shader;
}

function linkedProgram() {
  const program = gl.createProgram();
  gl.attachShader(program, compiled(gl.VERTEX_SHADER, VERTEX_SHADER));
  gl.attachShader(program, compiled(gl.FRAGMENT_SHADER, FRAGMENT_SHADER));
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  return program;
}

function makePainter() {
  const program = linkedProgram();
  gl.useProgram(program);
  const place = (name) => gl.getUniformLocation(program, name);
  painter = {
    corners: gl.createBuffer(),
    weights: gl.createBuffer(),
    weightsFor: 0, // triangles that the buffer of weights serves
    count: 0,
    ...Object.fromEntries(["centre", "scale", "line", "width"].map((name) => [name, place(name)])),
  };
  gl.enableVertexAttribArray(0);
  gl.enableVertexAttribArray(1);
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
}

// The barycentric coordinates of corners are the same for every mesh: their buffer only grows.
function growWeights(triangles) {
  if (triangles <= painter.weightsFor) return;
  painter.weightsFor = Math.ceil(1.5 * triangles);
  const weights = new Uint8Array(9 * painter.weightsFor);
  for (let i = 0; i < weights.length; i += 9) weights[i] = weights[i + 4] = weights[i + 8] = 1;
  gl.bindBuffer(gl.ARRAY_BUFFER, painter.weights);
  gl.bufferData(gl.ARRAY_BUFFER, weights, gl.STATIC_DRAW);
  gl.vertexAttribPointer(1, 3, gl.UNSIGNED_BYTE, false, 0, 0);
}

function uploadMesh(vertices) {
  painter.count = vertices.length / 3;
  growWeights(vertices.length / 9);
  gl.bindBuffer(gl.ARRAY_BUFFER, painter.corners);
  gl.bufferData(gl.ARRAY_BUFFER, vertices, gl.DYNAMIC_DRAW);
  gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
}

function fitCanvas(canvas, { width, height }) {
  const ratio = Math.min(2, devicePixelRatio || 1);
  const pixels = { width: Math.max(1, Math.round(width * ratio)), height: Math.max(1, Math.round(height * ratio)) };
  if (canvas.width !== pixels.width || canvas.height !== pixels.height) Object.assign(canvas, pixels);
  return ratio;
}

function paint() {
  wantsPicture = false;
  if (!shown || gl.isContextLost()) return;
  const canvas = $("mesh");
  const ratio = fitCanvas(canvas, stage);
  gl.viewport(0, 0, canvas.width, canvas.height);
  gl.clearColor(...rgb(theme.body), 1);
  gl.clear(gl.COLOR_BUFFER_BIT);
  gl.uniform2f(painter.centre, view.x, view.y);
  gl.uniform2f(painter.scale, (2 * view.scale) / stage.width, (2 * view.scale) / stage.height);
  gl.uniform1f(painter.width, 0.5 * ratio + 0.5);
  gl.uniform3f(painter.line, ...rgb(theme.line));
  gl.drawArrays(gl.TRIANGLES, 0, painter.count);
  placeHandles();
  placeTarget();
}

function paintSoon() {
  if (!wantsPicture) requestAnimationFrame(() => wantsPicture && paint());
  wantsPicture = true;
}

// ---------------------------------------------------------------------------------------------- colours

const rgb = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255);

// Viridis for what has a low and a high end, blue to red for what has a middle.
const VIRIDIS = ["#440154", "#472d7b", "#3b528b", "#2c728e", "#21918c", "#28ae80", "#5ec962", "#addc30", "#fde725"];
const STOPS = {
  fate: () => [theme.kept, theme.moved, theme.new],
  quality: () => VIRIDIS,
  size: () => VIRIDIS,
  age: () => [...VIRIDIS].reverse(),
  pressure: () => [theme.low, theme.middle, theme.high],
};

function paletteOf(colour) {
  const stops = STOPS[colour]().map(rgb);
  const pixels = new Uint8Array(4 * 256);
  for (let i = 0; i < 256; ++i) {
    const at = colour === "fate" ? Math.floor((i / 256) * 3) : (i / 255) * (stops.length - 1);
    const low = stops[Math.floor(at)];
    const high = stops[Math.min(stops.length - 1, Math.floor(at) + 1)];
    for (let k = 0; k < 3; ++k) pixels[4 * i + k] = 255 * (low[k] + (at % 1) * (high[k] - low[k]));
    pixels[4 * i + 3] = 255;
  }
  return pixels;
}

function uploadPalette(pixels) {
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
}

function bar(pixels) {
  const canvas = element("canvas", { width: 256, height: 1 });
  canvas.getContext("2d").putImageData(new ImageData(new Uint8ClampedArray(pixels), 256, 1), 0, 0);
  return canvas;
}

const swatch = (variable) => element("i", { style: `background: var(${variable})` });
const short = (value) => Number(value.toPrecision(2)).toString();
const LEGENDS = {
  fate: () => [swatch("--kept"), "kept", swatch("--moved"), "moved", swatch("--new"), "new"],
  quality: (pixels, [low, high]) => ["smallest angle ", `${low}°`, bar(pixels), `${high}°`],
  size: (pixels, [low, high]) => ["size ", short(low), bar(pixels), `${short(high)} chords`],
  age: (pixels, [low, high]) => ["age ", `${low}`, bar(pixels), `${high} steps`],
  pressure: (pixels, [low, high]) => ["pressure coefficient ", signed(low, 1), bar(pixels), signed(high, 1)],
};
let legendShown = "";

function showLegend(force = false) {
  const key = JSON.stringify([shown.colour, shown.range]);
  if (key === legendShown && !force) return;
  legendShown = key;
  const pixels = paletteOf(shown.colour);
  uploadPalette(pixels);
  $("legend").replaceChildren(...LEGENDS[shown.colour](pixels, shown.range));
}

// ---------------------------------------------------------------------------------------------- the view

const toScreen = (x, y) => [stage.width / 2 + (x - view.x) * view.scale, stage.height / 2 - (y - view.y) * view.scale];
const toChords = (px, py) => [view.x + (px - stage.width / 2) / view.scale, view.y - (py - stage.height / 2) / view.scale];

// A view that was fitted to the stage is fitted again when the stage changes.
function showAirfoil() {
  view = { x: 0.5, y: 0, scale: Math.min(0.82 * stage.width, 1.9 * stage.height), fit: showAirfoil };
  viewChanged();
}

function showField() {
  view = { x: 0.5, y: 0, scale: Math.min(stage.width, stage.height) / 52, fit: showField };
  viewChanged();
}

function viewChanged() {
  paintSoon();
  if (shown) writeLink();
}

// Scales about a point of the stage, which stays where it is.
function zoom(factor, px = stage.width / 2, py = stage.height / 2) {
  const [x, y] = toChords(px, py);
  view.scale = Math.min(5e5, Math.max(5, view.scale * factor));
  const [nowX, nowY] = toChords(px, py);
  pan(x - nowX, y - nowY);
}

function pan(dx, dy) {
  const within = (value) => Math.min(30, Math.max(-30, value));
  view = { x: within(view.x + dx), y: within(view.y + dy), scale: view.scale };
  viewChanged();
}

const panPixels = (dx, dy) => pan(-dx / view.scale, dy / view.scale);

const VIEW_KEYS = {
  ArrowLeft: () => panPixels(60, 0), ArrowRight: () => panPixels(-60, 0),
  ArrowUp: () => panPixels(0, 60), ArrowDown: () => panPixels(0, -60),
  "+": () => zoom(1.25), "=": () => zoom(1.25), "-": () => zoom(0.8), "0": showAirfoil, "9": showField,
};
const VIEW_BUTTONS = { in: () => zoom(1.5), out: () => zoom(1 / 1.5), airfoil: showAirfoil, field: showField };

function takeKeyOfView(event) {
  const act = VIEW_KEYS[event.key];
  if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
  event.preventDefault();
  act();
}

// One pointer pans, two pinch.
const fingers = new Map();

function movePinch(before, after) {
  const others = [...fingers.values()].filter((finger) => finger !== before);
  if (others.length === 0) return panPixels(after[0] - before[0], after[1] - before[1]);
  const [other] = others;
  const gap = (a, b) => Math.max(10, Math.hypot(a[0] - b[0], a[1] - b[1]));
  panPixels((after[0] - before[0]) / 2, (after[1] - before[1]) / 2);
  zoom(gap(after, other) / gap(before, other), (after[0] + other[0]) / 2, (after[1] + other[1]) / 2);
}

function listenToView() {
  const canvas = $("mesh");
  canvas.addEventListener("pointerdown", (event) => {
    capture(canvas, event);
    fingers.set(event.pointerId, [event.offsetX, event.offsetY]);
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = fingers.get(event.pointerId);
    if (!before) return;
    const after = [event.offsetX, event.offsetY];
    movePinch(before, after);
    fingers.set(event.pointerId, after);
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (event) => fingers.delete(event.pointerId));
  canvas.addEventListener("keydown", takeKeyOfView);
  $("stage").addEventListener("wheel", (event) => {
    event.preventDefault();
    const box = canvas.getBoundingClientRect();
    zoom(Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.05 : 0.0015)), event.clientX - box.left, event.clientY - box.top);
  }, { passive: false });
  for (const button of document.querySelectorAll("#view button")) {
    button.addEventListener("click", () => VIEW_BUTTONS[button.dataset.view]());
  }
}

// Events that a script makes have no pointer that could be captured.
function capture(target, event) {
  if (event.isTrusted) target.setPointerCapture(event.pointerId);
}

// ---------------------------------------------------------------------------------------------- handles

let handles = []; // element, upper, x
let gesture = null; // what a held handle began with

// As many handles on a side as it has coefficients, closer at the edges, and none
// where the two sides nearly meet.
function makeHandles() {
  const length = surfaceLength(shown.design);
  if (handles.length === 2 * length) return;
  handles = [];
  for (const upper of [true, false]) {
    for (let i = 1; i <= length; ++i) {
      const x = (1 - Math.cos((Math.PI * i) / (length + 1.5))) / 2;
      const name = `${upper ? "Upper" : "Lower"} side at ${Math.round(100 * x)} % of the chord`;
      const knob = element("div", { class: "handle", role: "slider", tabindex: 0, title: name, "aria-label": name,
                                    "aria-orientation": "vertical", "aria-valuemin": -0.5, "aria-valuemax": 0.5 });
      const handle = { knob, upper, x };
      knob.addEventListener("pointerdown", (event) => takeHandle(handle, event));
      knob.addEventListener("pointermove", moveHandle);
      for (const end of ["pointerup", "pointercancel"]) knob.addEventListener(end, dropHandle);
      knob.addEventListener("keydown", (event) => nudgeHandle(handle, event));
      handles.push(handle);
    }
  }
  $("handles").replaceChildren(...handles.map((handle) => handle.knob));
}

function placeHandles() {
  for (const { knob, upper, x } of handles) {
    const y = heightAt(shown.design, upper, x);
    const [px, py] = toScreen(x, y);
    knob.style.transform = `translate(${px.toFixed(1)}px, ${py.toFixed(1)}px)`;
    knob.setAttribute("aria-valuenow", y.toFixed(4));
  }
}

function takeHandle(handle, event) {
  if (event.button !== 0 || gesture) return;
  event.preventDefault();
  handle.knob.focus({ preventScroll: true });
  capture(handle.knob, event);
  stopSearch();
  const y = heightAt(wish.design, handle.upper, handle.x);
  const offset = toScreen(handle.x, y)[1] - event.clientY; // the pointer may have met the handle beside its middle
  gesture = { ...handle, design: wish.design, pointer: event.pointerId, offset };
  handle.knob.classList.add("held");
}

function moveHandle(event) {
  if (!gesture || event.pointerId !== gesture.pointer) return;
  const [, y] = toChords(0, event.clientY + gesture.offset);
  change({ design: withHeight(gesture.design, gesture.upper, gesture.x, y) }, event.timeStamp);
}

function dropHandle(event) {
  if (!gesture || event.pointerId !== gesture.pointer) return;
  gesture.knob.classList.remove("held");
  gesture = null;
  settle();
}

const NUDGES = { ArrowUp: 0.001, ArrowDown: -0.001, PageUp: 0.01, PageDown: -0.01 };

function nudgeHandle({ upper, x }, event) {
  const step = NUDGES[event.key];
  if (!step || event.ctrlKey || event.metaKey || event.altKey) return;
  event.preventDefault();
  stopSearch();
  const y = heightAt(wish.design, upper, x) + step * (event.shiftKey ? 5 : 1);
  change({ design: withHeight(wish.design, upper, x, y) }, event.timeStamp);
}

// ---------------------------------------------------------------------------------------------- coefficients

function makeSliders() {
  const length = surfaceLength(shown.design);
  const box = $("coefficients");
  if (box.childElementCount === 2 * length) return;
  box.replaceChildren();
  for (let row = 0; row < 2 * length; ++row) {
    const index = (row >> 1) + (row % 2) * length; // upper and lower by turns: two columns
    const name = `${row % 2 ? "lower" : "upper"} ${(row >> 1) + 1}`;
    const slider = element("input", { type: "range", min: -0.6, max: 0.6, step: "any", "data-index": index });
    slider.addEventListener("input", (event) => {
      stopSearch();
      change({ design: wish.design.map((value, i) => (i === index ? slider.valueAsNumber : value)) }, event.timeStamp);
    });
    box.append(element("label", { class: "slider" }, name, slider, element("output", {})));
  }
}

function showSliders() {
  if (!$("coefficients-part").open) return;
  for (const slider of $("coefficients").querySelectorAll("input")) {
    const value = shown.design[slider.dataset.index];
    if (document.activeElement !== slider || !wishPending()) slider.value = value;
    slider.setAttribute("aria-valuetext", value.toFixed(3));
    slider.nextElementSibling.textContent = signed(value, 3);
  }
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
  if (wish.flow && !shown.pressure && !shown.notice) restTimer = setTimeout(refresh, REST);
}

// Asks for pictures until the last one shows what is wished. A design that is refused gives way to the one shown.
async function refresh() {
  again = true;
  if (busy) return;
  busy = true;
  while (again && !searching) {
    again = false;
    await showWish();
  }
  busy = false;
  settle();
}

async function showWish() {
  const rests = performance.now() - lastChange > REST || (shown && wish.design === shown.design);
  const asked = { ...wish, flow: wish.flow && (rests || flowTime < SLOW_FLOW), since: stamp };
  stamp = 0;
  wish.remesh = false;
  try {
    showFrame(await call("show", asked), asked);
  } catch (error) {
    if (shown && wish.design === asked.design) wish.design = shown.design;
    if (shown) Object.assign(wish, { points: shown.points, gradation: shown.gradation });
    sayTrouble(error);
    showControls();
  }
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

function showFrame(frame, { points, gradation, since = 0 }) {
  shown = { ...frame, points, gradation };
  makeHandles();
  makeSliders();
  uploadMesh(frame.vertices);
  showLegend();
  paint();
  if (exact) gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); // waits for the picture
  const latency = since ? performance.now() - since : NaN;
  if (frame.pressure || !wish.flow) pressure = frame.pressure;
  if (frame.flow) flowTime = frame.flow;
  if (frame.stepped) addToStrip(frame, latency);
  else if (frame.flow && strip.length && !strip.at(-1).flow) strip.at(-1).flow = frame.flow;
  showSliders();
  drawCharts();
  if (frame.notice) sayTrouble(new Error(frame.notice));
  else if (frame.stepped && !searching) say(sentenceOfStep(frame));
}

let exact = false; // whether measurements include the time until the picture is there

function sentenceOfStep({ figures, isFirst }) {
  if (isFirst) return "The mesh is there: drag a handle, or move one with the arrow keys.";
  if (figures[8]) return "Every triangle is new: this mesh was generated.";
  const changed = `${figures[10]} vertices moved, ${figures[11]} inserted, ${figures[12]} removed`;
  return `One step: ${changed}${figures[7] ? "; the far field was adjusted too" : ""}.`;
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

// ---------------------------------------------------------------------------------------------- charts

let strip = []; // step, flow, latency in milliseconds; kept and surplus as shares
let textsWaiting = false;

function addToStrip(frame, latency) {
  const [triangles, , kept, , , , fresh] = frame.figures;
  const entry = { step: frame.step, flow: frame.flow || NaN, latency, kept: kept / triangles, surplus: fresh ? triangles / fresh - 1 : NaN };
  strip = [...strip.slice(1 - STRIP_LENGTH), entry];
}

const column = (name) => strip.map((entry) => entry[name]).filter(Number.isFinite);

// Medians of the strip chart's columns.
function medians() {
  return Object.fromEntries(["step", "flow", "latency", "kept", "surplus"].map((name) => [name, median(column(name))]));
}

function chart(canvas, draw) {
  const size = { width: canvas.clientWidth, height: canvas.clientHeight };
  const ratio = fitCanvas(canvas, size);
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, size.width, size.height);
  context.font = '11px system-ui, "DejaVu Sans", sans-serif';
  context.lineWidth = 1;
  draw(context, size.width, size.height);
}

// The next of 1, 2, 5 times a power of ten that is not below the value.
function roundUp(value) {
  const power = 10 ** Math.floor(Math.log10(Math.max(value, 1e-3)));
  return power * [1, 2, 5, 10].find((factor) => factor * power >= value * 0.999999);
}

// A row of the strip chart: one bar for each design, whose parts stand on each other.
function drawStrip(parts, top, high) {
  return (context, width, height) => {
    const box = { x: 46, y: 2, width: width - 48, height: height - 4 };
    const step = box.width / STRIP_LENGTH;
    const first = STRIP_LENGTH - strip.length;
    strip.forEach((entry, i) => drawBar(context, box, box.x + (first + i) * step, Math.max(1, step - 1), entry, parts, top));
    drawFrame(context, box, [high, "0"]);
  };
}

function drawBar(context, box, x, width, entry, parts, top) {
  let base = 0;
  for (const name of parts) {
    if (!Number.isFinite(entry[name])) continue;
    const end = Math.min(top, Math.max(0, base + entry[name]));
    const [low, high] = [base, end].map((value) => (value / top) * box.height);
    context.fillStyle = name === "flow" ? theme.flow : theme.step;
    context.fillRect(x, box.y + box.height - high, width, Math.max(1, high - low));
    base = end;
  }
}

function drawFrame(context, box, [high, low]) {
  context.strokeStyle = theme.rule;
  context.strokeRect(box.x - 0.5, box.y - 0.5, box.width + 1, box.height + 1);
  context.fillStyle = theme.quiet;
  context.textAlign = "right";
  context.textBaseline = "top";
  context.fillText(high, box.x - 5, box.y - 2);
  context.textBaseline = "bottom";
  context.fillText(low, box.x - 5, box.y + box.height + 2);
}

function drawStrips() {
  const slowest = roundUp(Math.max(1, ...strip.map((entry) => entry.step + (entry.flow || 0))));
  chart($("strip-time"), drawStrip(["step", "flow"], slowest, `${slowest} ms`));
  chart($("strip-kept"), drawStrip(["kept"], 1, "100 %"));
  const surplus = roundUp(Math.max(0.05, ...column("surplus")));
  chart($("strip-surplus"), drawStrip(["surplus"], surplus, `${Math.round(100 * surplus)} %`));
}

function drawCp(context, width, height) {
  if (!pressure) return drawNote(context, width, height, "The pressure is not asked for.");
  const wall = pressure.wall;
  let low = -1;
  for (let i = 1; i < wall.length; i += 2) low = Math.min(low, wall[i]);
  low = -roundUp(-low);
  const box = { x: 46, y: 6, width: width - 58, height: height - 24 };
  const at = (x, cp) => [box.x + x * box.width, box.y + ((cp - low) / (1 - low)) * box.height];
  drawFrame(context, box, [`cp ${signed(low, 0 + (low % 1 !== 0))}`, "1"]);
  drawChordAxis(context, box, at);
  context.strokeStyle = shown.pressure ? theme.step : theme.flow; // pale where it is of an earlier design
  context.lineWidth = 1.6;
  context.beginPath();
  for (let i = 0; i < wall.length; i += 2) context.lineTo(...at(wall[i], wall[i + 1]));
  context.closePath();
  context.stroke();
}

function drawChordAxis(context, box, at) {
  context.textBaseline = "top";
  context.textAlign = "center";
  for (const x of [0, 0.25, 0.5, 0.75, 1]) context.fillText(String(x), at(x, 1)[0], box.y + box.height + 4);
  context.beginPath();
  context.moveTo(...at(0, 0));
  context.lineTo(...at(1, 0));
  context.stroke();
  context.textAlign = "right";
  context.textBaseline = "middle";
  context.fillText("0", box.x - 5, at(0, 0)[1]);
}

function drawNote(context, width, height, text) {
  context.fillStyle = theme.quiet;
  context.textAlign = "center";
  context.fillText(text, width / 2, height / 2);
}

function drawCharts() {
  chart($("cp"), drawCp);
  drawStrips();
  if (textsWaiting) return;
  textsWaiting = true;
  setTimeout(() => { textsWaiting = false; showTexts(); }, 200);
}

const milliseconds = (value) => (Number.isFinite(value) ? `${value.toFixed(1)} ms` : "–");

function showTexts() {
  const { step, flow, latency, kept, surplus } = medians();
  $("median-step").textContent = milliseconds(step);
  $("median-flow").textContent = milliseconds(flow);
  $("median-latency").textContent = milliseconds(latency);
  $("median-kept").textContent = strip.length ? percent(kept) : "–";
  $("median-surplus").textContent = Number.isFinite(surplus) ? percent(surplus) : "not counted";
  $("lift").textContent = pressure ? `lift coefficient ${signed(pressure.lift, 3)}` : "";
  showFigures(shown);
}

function showFigures({ figures: [triangles, , kept, moved, made, angle], isFirst }) {
  const bold = (text) => element("b", {}, text);
  const fates = [bold(percent(kept / triangles)), " kept, ", bold(percent(moved / triangles)), " moved, ", bold(percent(made / triangles)), " new"];
  $("figures").replaceChildren(bold(triangles.toLocaleString("en")), " triangles", ...(isFirst ? [] : [": ", ...fates]),
    " · smallest angle ", bold(`${angle.toFixed(1)}°`));
}

// For those who cannot see the charts.
function describeCharts() {
  const { step, kept } = medians();
  $("strips").setAttribute("aria-label", strip.length === 0 ? "No design yet" :
    `The last ${strip.length} designs: median ${milliseconds(step)} a step, ${percent(kept)} of the triangles kept`);
  if (!pressure) return $("cp").setAttribute("aria-label", "The pressure is not asked for");
  const values = pressure.wall.filter((_, i) => i % 2);
  const range = `${values.reduce((a, b) => Math.min(a, b)).toFixed(2)} to ${values.reduce((a, b) => Math.max(a, b)).toFixed(2)}`;
  $("cp").setAttribute("aria-label", `Pressure coefficient along the chord: ${range}, lift coefficient ${signed(pressure.lift, 3)}`);
}

// ---------------------------------------------------------------------------------------------- the search

let searching = false;
let target = null; // the design that the search looks for

async function startSearch() {
  $("search").disabled = true;
  try {
    await settled();
    clearTimeout(restTimer);
    target = await designLike(wish.design, await call("named", { name: $("goal").value, degree: surfaceLength(wish.design) - 1 }));
    await call("searchStart", { target, sigma: SEARCH_SIGMA, seed: 1 });
    searching = true;
    $("search").textContent = "Stop";
    $("search").disabled = false;
    $("undo").disabled = false;
    say("The search is running.");
    while (searching) await searchOnce();
  } catch (error) {
    sayTrouble(error);
  }
  endSearch();
}

async function searchOnce() {
  const frame = await call("searchNext", { wish: { ...wish, flow: wish.flow && flowTime < SLOW_FLOW }, budget: SEARCH_BUDGET });
  if (searching) wish.design = frame.design;
  showFrame(frame, shown);
  const { evaluations, objective, refused, running } = frame.search;
  $("search-state").textContent = `${evaluations} designs, best distance ${objective.toExponential(1)}${refused ? `, ${refused} refused` : ""}`;
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
  paintSoon();
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

// ---------------------------------------------------------------------------------------------- shapes and files

const SU2_MARKERS = ["airfoil", "wall", "body"]; // names of the airfoil's marker, the likeliest first
const LARGEST_FILE = 64 * 1024 * 1024;

// True where the design is shown then.
async function takeDesign(method, argument) {
  stopSearch();
  try {
    const design = await call(method, { degree: DEGREE, ...argument });
    change({ design });
    await settled();
    return same(shown.design, design);
  } catch (error) {
    sayTrouble(error);
    return false;
  }
}

// Coordinates in Selig's order of the airfoil's marker in a mesh of SU2.
function coordinatesOfSu2(text, file) {
  const lines = text.split(/\r?\n/).map((line) => line.replace(/%.*/, "").trim()).filter(Boolean);
  const numbersAfter = (at, count) => lines.slice(at + 1, at + 1 + count).map((line) => line.split(/\s+/).map(Number));
  const countAt = (at) => Number(lines[at].split("=")[1].trim().split(/\s+/)[0]);
  const start = lines.findIndex((line) => /^NPOIN\s*=/i.test(line));
  if (start < 0) throw new Error(`${file}: no NPOIN= found, expected a mesh of SU2`);
  const points = numbersAfter(start, countAt(start));
  const tags = lines.flatMap((line, at) => (/^MARKER_TAG\s*=/i.test(line) ? [[line.split("=")[1].trim().toLowerCase(), at]] : []));
  const tag = SU2_MARKERS.map((name) => tags.find(([found]) => found === name)).find(Boolean);
  if (!tag) throw new Error(`${file}: found no marker named ${SU2_MARKERS.join(", ")}, expected the airfoil's`);
  const loop = chained(numbersAfter(tag[1] + 1, countAt(tag[1] + 1)).map(([, a, b]) => [a, b]), file);
  if (loop.some((index) => !points[index])) throw new Error(`${file}: the marker names points that are not there`);
  return selig(loop.map((index) => points[index].slice(0, 2)));
}

function chained(edges, file) {
  const after = new Map(edges);
  const loop = [];
  for (let at = edges[0]?.[0]; loop.length < edges.length; at = after.get(at)) loop.push(at);
  if (loop.length < 6 || new Set(loop).size !== loop.length) throw new Error(`${file}: the airfoil's marker is no closed loop`);
  return loop;
}

// From the trailing edge over the upper side and back, closed.
function selig(loop) {
  const area = loop.reduce((sum, [x, y], i) => sum + x * loop[(i + 1) % loop.length][1] - y * loop[(i + 1) % loop.length][0], 0);
  const points = area < 0 ? [...loop].reverse() : loop;
  const edge = points.reduce((best, [x], i) => (x > points[best][0] ? i : best), 0);
  const turned = [...points.slice(edge), ...points.slice(0, edge + 1)];
  return `mesh\n${turned.map(([x, y]) => `${x} ${y}`).join("\n")}\n`;
}

async function takeFile(file) {
  try {
    if (file.size > LARGEST_FILE) throw new Error(`${file.name}: the file is larger than 64 MiB`);
    const text = await file.text();
    const isMesh = file.name.toLowerCase().endsWith(".su2");
    const content = isMesh ? coordinatesOfSu2(text, file.name) : text;
    if (await takeDesign("read", { text: content, file: file.name })) say(`${file.name} is shown.`);
  } catch (error) {
    sayTrouble(error);
  }
}

function listenToFiles() {
  $("open").addEventListener("click", () => $("file").click());
  $("file").addEventListener("change", () => {
    if ($("file").files[0]) takeFile($("file").files[0]);
    $("file").value = "";
  });
  addEventListener("dragover", (event) => { event.preventDefault(); document.body.classList.add("dropping"); });
  addEventListener("dragleave", (event) => event.relatedTarget || document.body.classList.remove("dropping"));
  addEventListener("drop", (event) => {
    event.preventDefault();
    document.body.classList.remove("dropping");
    if (event.dataTransfer.files[0]) takeFile(event.dataTransfer.files[0]);
  });
}

// ---------------------------------------------------------------------------------------------- downloads

function save(name, blob) {
  const link = element("a", { download: name, href: URL.createObjectURL(blob) });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

// The edges that have a triangle on one side only, as the triangles turn: those far away are the far field's.
function boundaryEdges({ points, triangles }) {
  const open = new Map();
  for (let i = 0; i < triangles.length; ++i) {
    const [a, b] = [triangles[i], triangles[i % 3 === 2 ? i - 2 : i + 1]];
    if (!open.delete(`${b} ${a}`)) open.set(`${a} ${b}`, [a, b]);
  }
  const edges = { airfoil: [], farfield: [] };
  for (const [a, b] of open.values()) edges[Math.hypot(points[2 * a], points[2 * a + 1]) > 5 ? "farfield" : "airfoil"].push(`3 ${a} ${b}`);
  return edges;
}

function su2Text(mesh) {
  const { points, triangles } = mesh;
  const lines = ["NDIME= 2", `NELEM= ${triangles.length / 3}`];
  for (let i = 0; i < triangles.length; i += 3) lines.push(`5 ${triangles[i]} ${triangles[i + 1]} ${triangles[i + 2]} ${i / 3}`);
  lines.push(`NPOIN= ${points.length / 2}`);
  for (let i = 0; i < points.length; i += 2) lines.push(`${points[i]} ${points[i + 1]} ${i / 2}`);
  const edges = boundaryEdges(mesh);
  lines.push("NMARK= 2");
  for (const [name, list] of Object.entries(edges)) lines.push(`MARKER_TAG= ${name}`, `MARKER_ELEMS= ${list.length}`, ...list);
  return lines.join("\n") + "\n";
}

const meshText = async () => su2Text(await call("mesh"));

// The .json that `remodel mesh` takes as a shape.
function designText(design) {
  const length = surfaceLength(design);
  const [te_upper, te_lower] = design.slice(-2);
  return JSON.stringify({ degree: length - 1, upper: [...design.slice(0, length)], lower: [...design.slice(length, -2)], te_upper, te_lower }, null, 2) + "\n";
}

function savePicture() {
  paint(); // what is drawn is there until the browser has shown it
  $("mesh").toBlob((blob) => save("remodel.png", blob));
}

async function copyLink() {
  writeLink();
  try {
    await navigator.clipboard.writeText(location.href);
    say("The link is copied.");
  } catch {
    say("The browser does not let the page copy; the link is in the address bar.");
  }
}

async function checkMesh() {
  await settled();
  const broken = await call("check");
  if (broken) sayTrouble(new Error(`The mesh is not valid: ${broken}`));
  else say(`The mesh is valid: Delaunay, graded, and every angle is at least ${shown.figures[5].toFixed(1)}°.`);
  return broken;
}

// ---------------------------------------------------------------------------------------------- the link

const LINK_NUMBERS = { points: [20, 1000], gradation: [1, 20], alpha: [-10, 15] };
const LINK_SWITCHES = ["flow", "regenerate", "fresh"];
let linkTimer = 0;

function linkText() {
  const parts = Object.keys(LINK_NUMBERS).map((name) => `${name}=${wish[name]}`);
  parts.push(`colour=${wish.colour}`, ...LINK_SWITCHES.map((name) => `${name}=${Number(wish[name])}`));
  parts.push(`view=${[view.x, view.y, view.scale].map((value) => Number(value.toPrecision(6))).join(",")}`);
  parts.push(`design=${shown.design.join(",")}`);
  return `#${parts.join("&")}`;
}

// Browsers refuse to change the address too often.
function writeLink() {
  clearTimeout(linkTimer);
  linkTimer = setTimeout(() => {
    if (shown && location.hash !== linkText()) history.replaceState(null, "", linkText());
  }, 400);
}

function numbersOf(text) {
  const numbers = (text ?? "").split(",").map(Number);
  return text && numbers.every(Number.isFinite) ? numbers : [];
}

// Takes what is sound in the link; the design, or null.
function readLink() {
  const link = new URLSearchParams(location.hash.slice(1));
  for (const [name, [low, high]] of Object.entries(LINK_NUMBERS)) {
    const [value] = numbersOf(link.get(name));
    if (value >= low && value <= high) wish[name] = value;
  }
  if (COLOURS.includes(link.get("colour"))) wish.colour = link.get("colour");
  for (const name of LINK_SWITCHES) if (link.has(name)) wish[name] = link.get(name) === "1";
  const [x, y, scale] = numbersOf(link.get("view"));
  if (scale > 0) view = { x, y, scale };
  const design = numbersOf(link.get("design"));
  if (link.has("design") && (design.length < 6 || design.length % 2)) throw new Error("The link holds no design that can be read.");
  return design.length ? Float64Array.from(design) : null;
}

// ---------------------------------------------------------------------------------------------- controls

// The program's default, within the slider's range.
const usualGradation = (points) => Math.min(20, Math.max(1, points / 50));
const RANGES = { points: String, gradation: (value) => value.toFixed(1), alpha: (value) => `${signed(value, 1)}°` };

function showControls() {
  for (const [name, text] of Object.entries(RANGES)) {
    $(name).value = wish[name];
    $(name).nextElementSibling.textContent = text(wish[name]);
  }
  for (const name of LINK_SWITCHES) $(name).checked = wish[name];
  $("colour").value = wish.colour;
}

function listenToControls() {
  for (const name of Object.keys(RANGES)) {
    $(name).addEventListener("input", () => {
      if (name !== "alpha") stopSearch();
      change({ [name]: $(name).valueAsNumber, ...(name === "points" ? { gradation: usualGradation($(name).valueAsNumber) } : {}) });
      showControls();
    });
  }
  for (const name of LINK_SWITCHES) $(name).addEventListener("change", () => change({ [name]: $(name).checked }));
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
  $("mesh").addEventListener("webglcontextlost", () => sayTrouble(new Error("The browser has taken the picture away. Open the page again.")));
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
  if (!gl) throw new Error("This browser has no WebGL 2, which the picture needs.");
  readTheme();
  measureStage();
  showAirfoil();
  makePainter();
  await startWorker();
  await fillCatalogue();
  await showFirst();
  showControls();
  listenToView();
  listenToFiles();
  listenToControls();
  listenToWindow();
  document.documentElement.dataset.ready = "true";
}

// For tests and the console. A picture counts as there when it is drawn; with `exact`, when its pixels can be read,
// which holds up the page.
globalThis.live = {
  wish, stage, call, change, settled, medians, meshText,
  get shown() { return shown; },
  get view() { return view; },
  measure(isExact) {
    exact = isExact;
    strip = [];
  },
};

start().catch(sayTrouble);
