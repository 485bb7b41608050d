// The picture of the page of `remodel live`: the mesh by WebGL 2, the view, and the handles on the
// airfoil. One script with page.js.
"use strict";

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

// ---------------------------------------------------------------------------------------------- the picture

let gl = null; // the context of WebGL 2
let painter = null; // program, buffer, palette and their places
let wantsPicture = false;
let pictureLost = false; // the browser has taken the context, and all that was on it

const PICTURE_LOST = "The browser has taken the picture away. If it does not give it back, open the page again.";

// From the first moment on: a browser may take the context while the mesher starts.
function listenToContext() {
  $("mesh").addEventListener("webglcontextlost", (event) => {
    event.preventDefault(); // says that it may be given back
    pictureLost = true;
    say(PICTURE_LOST);
  });
  $("mesh").addEventListener("webglcontextrestored", () => {
    pictureLost = false;
    makePainter();
    say("The picture is back.");
    if (!shown) return;
    uploadMesh(shown);
    showLegend(true);
    paint();
  });
}

const VERTEX_SHADER = `#version 300 es
layout(location = 0) in vec3 corner;
uniform vec2 centre, scale;
uniform int halves;
uniform sampler2D palette;
out vec3 weights;
out vec3 shade;
void main() {
  int place = gl_VertexID % 3;
  weights = vec3(place == 0, place == 1, place == 2);
  // Halves of quadrilaterals, a b c and a c d, have no line on the diagonal a c: it is too far from b and from d.
  if (gl_VertexID >= halves) weights[1 + (gl_VertexID / 3 - halves / 3) % 2] = 1.0;
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
  highp vec3 distance = weights / max(slope, 1e-9);
  float nearest = min(distance.x, min(distance.y, distance.z));
  float steepest = max(slope.x, max(slope.y, slope.z));
  float share = clamp(width - nearest, 0.0, 1.0) * clamp(0.9 - 2.5 * steepest, 0.1, 0.65);
  colour = vec4(mix(shade, line, share), 1.0);
}`;

function compiled(kind, source) {
  const shader = gl.createShader(kind);
  gl.shaderSource(shader, source);
  gl.compileShader(shader);
  if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) throw new Error(gl.getShaderInfoLog(shader));
  return shader;
}

function linkedProgram() {
  const program = gl.createProgram();
  gl.attachShader(program, compiled(gl.VERTEX_SHADER, VERTEX_SHADER));
  gl.attachShader(program, compiled(gl.FRAGMENT_SHADER, FRAGMENT_SHADER));
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) throw new Error(gl.getProgramInfoLog(program));
  return program;
}

function makePainter() {
  const program = linkedProgram();
  gl.useProgram(program);
  const place = (name) => gl.getUniformLocation(program, name);
  painter = {
    corners: gl.createBuffer(),
    count: 0,
    ...Object.fromEntries(["centre", "scale", "halves", "line", "width"].map((name) => [name, place(name)])),
  };
  gl.enableVertexAttribArray(0);
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
}

// Three corners of each triangle, then those of halves of quadrilaterals.
function uploadMesh({ vertices, triangles }) {
  painter.count = vertices.length / 3;
  gl.bindBuffer(gl.ARRAY_BUFFER, painter.corners);
  gl.bufferData(gl.ARRAY_BUFFER, vertices, gl.DYNAMIC_DRAW);
  gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
  gl.uniform1i(painter.halves, 3 * triangles);
}

function fitCanvas(canvas, { width, height }) {
  const ratio = Math.min(2, devicePixelRatio || 1);
  const pixels = { width: Math.max(1, Math.round(width * ratio)), height: Math.max(1, Math.round(height * ratio)) };
  if (canvas.width !== pixels.width || canvas.height !== pixels.height) Object.assign(canvas, pixels);
  return ratio;
}

function paint() {
  wantsPicture = false;
  if (!shown) return;
  placeHandles();
  placeTarget();
  if (gl.isContextLost()) return;
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
  fate: () => [theme.kept, theme.moved, theme.new, theme.going],
  quality: () => VIRIDIS,
  size: () => VIRIDIS,
  age: () => [...VIRIDIS].reverse(),
  pressure: () => [theme.low, theme.middle, theme.high],
  mach: () => [theme.low, theme.middle, theme.high],
};

function paletteOf(colour) {
  const stops = STOPS[colour]().map(rgb);
  const pixels = new Uint8Array(4 * 256);
  for (let i = 0; i < 256; ++i) {
    const at = colour === "fate" ? Math.floor((i / 256) * stops.length) : (i / 255) * (stops.length - 1);
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
  fate: () => [swatch("--kept"), "kept", swatch("--moved"), "moved", swatch("--new"), "new",
    swatch("--going"), "about to go"],
  quality: (pixels, [low, high]) => ["smallest angle ", `${low}°`, bar(pixels), `${high}°`],
  size: (pixels, [low, high]) => ["size ", short(low), bar(pixels), `${short(high)} chords`],
  age: (pixels, [low, high]) => ["age ", `${low}`, bar(pixels), `${high} steps`],
  pressure: (pixels, [low, high]) => ["pressure coefficient ", signed(low, 1), bar(pixels), signed(high, 1)],
  mach: (pixels, [low, high]) => ["Mach number ", short(low), bar(pixels), `${short(high)}, sonic midway`],
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
  for (const end of ["pointerup", "pointercancel"]) {
    canvas.addEventListener(end, (event) => fingers.delete(event.pointerId));
  }
  canvas.addEventListener("keydown", takeKeyOfView);
  $("stage").addEventListener("wheel", (event) => {
    event.preventDefault();
    const box = canvas.getBoundingClientRect();
    const rate = event.deltaMode === 1 ? 0.05 : 0.0015; // of lines, of pixels
    zoom(Math.exp(-event.deltaY * rate), event.clientX - box.left, event.clientY - box.top);
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
  $("handles").hidden = view.scale < LEAST_SCALE;
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
