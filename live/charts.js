// The charts of the page of `remodel live`. One script with page.js.

// ---------------------------------------------------------------------------------------------- charts

// Of each design: step, flow, latency (since the pointer moved) and answer (since the page heard of it) in milliseconds,
// kept and surplus as shares.
let strip = [];
let textsWaiting = false;

const cellsOf = ({ figures }) => figures[0] + figures[14]; // triangles and quadrilaterals
const nameOfCells = () => (shown.layers ? "cells" : "triangles");

function addToStrip(frame, times) {
  const [, , kept, , , , fresh] = frame.figures;
  const cells = cellsOf(frame);
  const surplus = fresh ? cells / fresh - 1 : NaN;
  const { step, flow, design } = frame;
  const entry = { step, flow: flow || NaN, ...times, kept: kept / cells, surplus, design };
  strip = [...strip.slice(1 - STRIP_LENGTH), entry];
}

const column = (name) => strip.map((entry) => entry[name]).filter(Number.isFinite);

// Medians of the strip chart's columns.
function medians() {
  const names = ["step", "flow", "latency", "answer", "kept", "surplus"];
  return Object.fromEntries(names.map((name) => [name, median(column(name))]));
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
    const wide = Math.max(1, step - 1);
    strip.forEach((entry, i) => drawBar(context, box, box.x + (first + i) * step, wide, entry, parts, top));
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

const sentenceOfNoPressure = () =>
  (wish.flow ? "The pressure follows when the shape rests." : "The pressure is not asked for.");

// Of the design that is shown, not of an earlier one.
const pressureIsCurrent = () => Boolean(shown.pressure) || isSolved(pressure);

function drawCp(context, width, height) {
  if (!pressure) return drawNote(context, width, height, sentenceOfNoPressure());
  const wall = pressure.wall;
  let low = -1;
  for (let i = 1; i < wall.length; i += 2) low = Math.min(low, wall[i]);
  low = -roundUp(-low);
  const high = pressure.wall.some((value, i) => i % 2 && value > 1) ? 1.2 : 1; // gas at rest is above 1
  const box = { x: 46, y: 6, width: width - 58, height: height - 24 };
  const at = (x, cp) => [box.x + x * box.width, box.y + ((cp - low) / (high - low)) * box.height];
  drawFrame(context, box, [`cp ${signed(low, 0 + (low % 1 !== 0))}`, String(high)]);
  drawChordAxis(context, box, at, high);
  if (pressure.sonic > low) drawSonicLine(context, at, pressure.sonic);
  context.strokeStyle = pressureIsCurrent() ? theme.step : theme.flow; // pale where it is of an earlier design
  context.lineWidth = 1.6;
  context.beginPath();
  for (let i = 0; i < wall.length; i += 2) context.lineTo(...at(wall[i], wall[i + 1]));
  context.closePath();
  context.stroke();
}

function drawChordAxis(context, box, at, high) {
  context.textBaseline = "top";
  context.textAlign = "center";
  for (const x of [0, 0.25, 0.5, 0.75, 1]) context.fillText(String(x), at(x, high)[0], box.y + box.height + 4);
  context.beginPath();
  context.moveTo(...at(0, 0));
  context.lineTo(...at(1, 0));
  context.stroke();
  context.textAlign = "right";
  context.textBaseline = "middle";
  context.fillText("0", box.x - 5, at(0, 0)[1]);
}

// Above this line the flow is faster than sound.
function drawSonicLine(context, at, cp) {
  context.setLineDash([4, 3]);
  context.beginPath();
  context.moveTo(...at(0, cp));
  context.lineTo(...at(1, cp));
  context.stroke();
  context.setLineDash([]);
  context.textAlign = "right";
  context.textBaseline = "bottom";
  context.fillText("sonic", at(1, cp)[0] - 3, at(1, cp)[1] - 1);
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

function sentenceOfLift() {
  if (isSolved(pressure)) return sentenceOfForces(pressure);
  const isSupersonic = pressure.wall.some((value, i) => i % 2 && value < pressure.sonic);
  const lift = `lift coefficient ${signed(pressure.lift, 3)}${pressureIsCurrent() ? "" : ", of an earlier shape"}`;
  return isSupersonic ? `${lift}; faster than sound: beyond this model` : lift;
}

const milliseconds = (value) => (Number.isFinite(value) ? `${value.toFixed(1)} ms` : "–");

function showTexts() {
  const { step, flow, latency, kept, surplus } = medians();
  $("median-step").textContent = milliseconds(step);
  $("median-flow").textContent = milliseconds(flow);
  $("median-latency").textContent = milliseconds(latency);
  $("name-kept").textContent = nameOfCells();
  $("median-kept").textContent = strip.length ? percent(kept) : "–";
  $("median-surplus").textContent = Number.isFinite(surplus) ? percent(surplus) : "not counted";
  showLift();
  showFigures(shown);
}

function showLift() {
  $("lift").textContent = pressure ? sentenceOfLift() : "";
  $("lift").classList.toggle("stale", pressure !== null && !pressureIsCurrent());
}

function showFigures({ figures, isFirst, going, layers }) {
  const [, , kept, moved, made, angle] = figures;
  const cells = cellsOf({ figures });
  const bold = (text) => element("b", {}, text);
  const share = (count) => bold(percent(count / cells));
  const fates = [": ", share(kept), " kept, ", share(moved), " moved, ", share(made), " new",
    ...(going === undefined ? [] : [", ", share(going), " about to go"])];
  const ofLayers = layers ? [` (${figures[15].toLocaleString("en")} in layers)`] : [];
  $("figures").replaceChildren(bold(cells.toLocaleString("en")), ` ${nameOfCells()}`, ...ofLayers, ...(isFirst ? [] : fates),
    ` · smallest angle ${layers ? "outside the layers " : ""}`, bold(`${angle.toFixed(1)}°`));
}

// For those who cannot see the charts.
function describeCharts() {
  const { step, kept } = medians();
  $("strips").setAttribute("aria-label", strip.length === 0 ? "No design yet" :
    `The last ${strip.length} designs: median ${milliseconds(step)} a step, ${percent(kept)} of the ${nameOfCells()} kept`);
  if (!pressure) return $("cp").setAttribute("aria-label", sentenceOfNoPressure());
  const values = pressure.wall.filter((_, i) => i % 2);
  const range = `${signed(Math.min(...values), 2)} to ${signed(Math.max(...values), 2)}`;
  $("cp").setAttribute("aria-label",
    `Pressure coefficient along the chord: ${range}. ${sentenceOfLift()}`);
}
