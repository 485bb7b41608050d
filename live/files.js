// What goes into the page of `remodel live` and comes out of it: files of airfoils and meshes, pictures, the link. One
// script with page.js.

// ---------------------------------------------------------------------------------------------- shapes and files

const SU2_MARKERS = ["airfoil", "wall", "body"]; // names of the airfoil's marker, the likeliest first
const LARGEST_FILE = 64 * 1024 * 1024;

// True where the design is shown then.
let taking = Promise.resolve(); // the last design that was asked for

async function takeDesign(method, argument) {
  stopSearch();
  try {
    taking = call(method, { degree: DEGREE, ...argument });
    const design = await taking;
    stopSearch();
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
  const isTag = (line) => /^MARKER_TAG\s*=/i.test(line);
  const tags = lines.flatMap((line, at) => (isTag(line) ? [[line.split("=")[1].trim().toLowerCase(), at]] : []));
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
  const closed = new Set(loop).size === loop.length && after.get(loop.at(-1)) === loop[0];
  if (loop.length < 6 || !closed) throw new Error(`${file}: the airfoil's marker is no closed loop of six edges or more`);
  return loop;
}

// From the trailing edge over the upper side and back, closed.
function selig(loop) {
  const next = (i) => loop[(i + 1) % loop.length];
  const area = loop.reduce((sum, [x, y], i) => sum + x * next(i)[1] - y * next(i)[0], 0);
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

// The corners of each cell, triangles first.
function cellsOfMesh({ triangles, quads }) {
  const cells = [];
  for (let i = 0; i < triangles.length; i += 3) cells.push(triangles.subarray(i, i + 3));
  for (let i = 0; i < quads.length; i += 4) cells.push(quads.subarray(i, i + 4));
  return cells;
}

// The edges that have a cell on one side only, as the cells turn: those far away are the far field's.
function boundaryEdges(cells, points) {
  const open = new Map();
  for (const cell of cells) {
    cell.forEach((a, i) => {
      const b = cell[(i + 1) % cell.length];
      if (!open.delete(`${b} ${a}`)) open.set(`${a} ${b}`, [a, b]);
    });
  }
  const edges = { airfoil: [], farfield: [] };
  for (const [a, b] of open.values()) {
    const isFar = Math.hypot(points[2 * a], points[2 * a + 1]) > 5;
    edges[isFar ? "farfield" : "airfoil"].push(`3 ${a} ${b}`);
  }
  return edges;
}

const SU2_TYPES = { 3: 5, 4: 9 }; // of cells, by their corners

function su2Text(mesh) {
  const { points } = mesh;
  const cells = cellsOfMesh(mesh);
  const lines = ["NDIME= 2", `NELEM= ${cells.length}`];
  cells.forEach((cell, i) => lines.push(`${SU2_TYPES[cell.length]} ${cell.join(" ")} ${i}`));
  lines.push(`NPOIN= ${points.length / 2}`);
  for (let i = 0; i < points.length; i += 2) lines.push(`${points[i]} ${points[i + 1]} ${i / 2}`);
  const edges = boundaryEdges(cells, points);
  lines.push("NMARK= 2");
  for (const [name, list] of Object.entries(edges)) {
    lines.push(`MARKER_TAG= ${name}`, `MARKER_ELEMS= ${list.length}`, ...list);
  }
  return lines.join("\n") + "\n";
}

const meshText = async () => su2Text(await call("mesh"));

// The .json that `remodel mesh` takes as a shape.
function designText(design) {
  const length = surfaceLength(design);
  const [te_upper, te_lower] = design.slice(-2);
  const [upper, lower] = [[...design.slice(0, length)], [...design.slice(length, -2)]];
  return JSON.stringify({ degree: length - 1, upper, lower, te_upper, te_lower }, null, 2) + "\n";
}

function savePicture() {
  if (pictureLost) return say(PICTURE_LOST);
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

function sentenceOfSoundness({ figures, layers }) {
  const angle = figures[5].toFixed(1);
  return layers ? `The mesh is valid: the layers’ cells are convex, the triangles beyond are Delaunay, from ${angle}° and graded.`
                : `The mesh is valid: Delaunay, graded, and every angle is at least ${angle}°.`;
}

async function checkMesh() {
  await settled();
  const broken = await call("check");
  if (broken) sayTrouble(new Error(`The mesh is not valid: ${broken}`));
  else say(sentenceOfSoundness(shown));
  return broken;
}

// ---------------------------------------------------------------------------------------------- the link

const LINK_NUMBERS = {
  points: [20, 1000], gradation: [1, 20], alpha: [-10, 15], mach: [0, 0.85], reynolds: REYNOLDS,
};
const LINK_SWITCHES = ["flow", "layers", "regenerate", "fresh"];
let linkTimer = 0;

function linkText() {
  const parts = Object.keys(LINK_NUMBERS).map((name) => `${name}=${wish[name]}`);
  parts.push(`model=${wish.model}`, `colour=${wish.colour}`);
  parts.push(...LINK_SWITCHES.map((name) => `${name}=${Number(wish[name])}`));
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
  if (MODELS.includes(link.get("model"))) wish.model = link.get("model");
  for (const name of LINK_SWITCHES) if (link.has(name)) wish[name] = link.get(name) === "1";
  if (wish.model === "laminar") wish.layers = true;
  const [x, y, scale] = numbersOf(link.get("view"));
  if (scale > 0) view = { x, y, scale };
  const design = numbersOf(link.get("design"));
  if (link.has("design") && (design.length < 6 || design.length % 2)) {
    throw new Error("The link holds no design that can be read.");
  }
  return design.length ? Float64Array.from(design) : null;
}
