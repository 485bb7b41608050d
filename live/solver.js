// Compressible flow on the page of `remodel live`, by Euler's equations or laminar: a worker of its own looks for it while
// the mesh goes on living. It is asked for the mesh that is shown whenever it has nothing to do, and what it finds is
// shown if that mesh and the conditions are still the ones on the page; until then potential flow is. One script with
// page.js.

// ---------------------------------------------------------------------------------------------- the search for flows

const FLOW_COLOURS = ["pressure", "mach"];
const LEAST_MACH = 0.1; // below it the equations are stiff
const MOST_VERTICES = 12000; // about I = 450: factors of more take many seconds and gigabytes
const REYNOLDS = [100, 1e6]; // numbers from and to
const USUAL_MACH = 0.5; // for those who choose these models at a lower one
const SOLVED_MODELS = { euler: "Euler’s flow", laminar: "Laminar flow" };

let solver = null; // the worker, once it was asked for
let flowSearch = null; // what is under way: state, conditions, steps
let lastAnswer = null; // the last answer: a flow, or why there is none, with its state and conditions
const awaiting = []; // those who wait until the flow that is shown is of the model, or there is none

const wantsFlow = () => wish.flow || FLOW_COLOURS.includes(wish.colour);
const isSolved = (flow) => flow != null && flow.model in SOLVED_MODELS;
const conditionsOf = ({ model, alpha, mach, reynolds }) =>
  ({ model, alpha, mach, reynolds: model === "laminar" ? reynolds : 0 });
const isOfPage = (flow) => flow !== null && shown !== null && flow.state === shown.state &&
  Object.entries(conditionsOf(wish)).every(([name, value]) => flow[name] === value);
const hasMeshFor = (model) => shown !== null && (model !== "laminar" || shown.layers);
const wantsSolver = () =>
  wish.model in SOLVED_MODELS && wantsFlow() && hasMeshFor(wish.model) && !isOfPage(lastAnswer);
const solvedFlow = () => (isOfPage(lastAnswer) && !lastAnswer.reason ? lastAnswer : null);

const takenBack = () => Object.assign(new Error("it was stopped"), { isTakenBack: true });

async function searchFlow() {
  if (flowSearch || !wantsSolver()) return giveWay();
  flowSearch = { state: shown.state, ...conditionsOf(wish), steps: 0 };
  showFlowState();
  try {
    lastAnswer = { ...(await askForFlow(flowSearch)), reason: "" };
  } catch (error) {
    lastAnswer = error.isTakenBack ? null : { ...flowSearch, reason: error.message };
    if (error.isBroken) stopSolver();
  }
  flowSearch = null;
  if (isOfPage(lastAnswer)) showFlow();
  showFlowState();
  searchFlow();
}

async function askForFlow({ model, alpha, mach, reynolds }) {
  solver ??= await openWorker((step) => {
    if (!flowSearch) return;
    flowSearch.steps = step;
    showFlowState();
  });
  const asked = solver;
  const mesh = await call("meshForFlow");
  flowSearch.state = mesh.state;
  if (mesh.vertices > MOST_VERTICES) {
    const [most, have] = [MOST_VERTICES, mesh.vertices].map((count) => count.toLocaleString("en"));
    throw new Error(`the mesh has ${have} vertices, and more than ${most} take too long here; ` +
                    "`remodel flow` has no such limit");
  }
  if (wish.model !== model) throw takenBack();
  if (model === "laminar" && !mesh.have.reynolds) throw takenBack(); // the layers are not there yet
  return asked.call("solve", { mesh, model, alpha, mach, reynolds }, [mesh.points.buffer, mesh.numbers.buffer]);
}

function giveWay() {
  if (flowSearch || wantsSolver()) return;
  while (awaiting.length) awaiting.pop()();
}

// Waits until the flow of what is shown was looked for.
async function solved() {
  await settled();
  if (flowSearch || wantsSolver()) await new Promise((resolve) => awaiting.push(resolve));
}

// A search that nobody waits for any more ends with its worker, whose factors are of no use then.
function stopSolver() {
  solver?.close();
  solver = null;
}

function chooseModel(model) {
  const isSlow = model in SOLVED_MODELS && wish.mach < LEAST_MACH;
  const getsLayers = model === "laminar" && !wish.layers;
  if (flowSearch && flowSearch.model !== model) stopSolver();
  if (getsLayers) stopSearch();
  change({ model, ...(isSlow ? { mach: USUAL_MACH } : {}), ...(getsLayers ? { layers: true } : {}) });
  showControls();
  if (isSlow) say(`${SOLVED_MODELS[model]} is that of a gas in motion: the Mach number is ${USUAL_MACH.toFixed(2)} now.`);
}

// ---------------------------------------------------------------------------------------------- what is shown of it

// The answer is of the mesh and the conditions on the page.
function showFlow() {
  if (lastAnswer.reason) {
    sayTrouble(new Error(`${SOLVED_MODELS[wish.model]} was not found, potential flow is shown: ${lastAnswer.reason}`));
  } else {
    colourByFlow();
    pressure = lastAnswer;
    paintSoon();
  }
  drawCharts();
  describeCharts();
  showTexts();
}

// Puts the flow's values in the place of those of potential flow.
function colourByFlow() {
  const flow = solvedFlow();
  if (!flow || !FLOW_COLOURS.includes(shown.colour)) return;
  const values = flow.values[shown.colour];
  shown.corners.forEach((vertex, corner) => { shown.vertices[3 * corner + 2] = values[vertex]; });
  uploadMesh(shown);
}

const HOW_FOUND = {
  cold: ({ coarse }) => (coarse ? "cold, coarser meshes first" : "cold"),
  carried: ({ corrected }) =>
    (corrected ? `carried, older factors corrected at ${corrected} vertices` : "carried, older factors"),
  refactored: () => "refactored",
};

function sentenceOfFlow(flow) {
  const steps = [[flow.newton + flow.coarse, "Newton steps"], [flow.krylov, "others"]]
    .filter(([count]) => count).map(([count, name]) => `${count} ${name}`).join(", ");
  const time = Math.round(flow.milliseconds).toLocaleString("en");
  return `Found in ${time} ms: ${HOW_FOUND[flow.start](flow)}, ${steps || "no step"}.`;
}

function showFlowState() {
  const flow = solvedFlow();
  const isMissing = isOfPage(lastAnswer) && lastAnswer.reason !== "";
  $("flow-steps").textContent =
    flowSearch ? `${SOLVED_MODELS[flowSearch.model]} is looked for, step ${flowSearch.steps}; potential flow until then.` : "";
  const sentence = flow ? sentenceOfFlow(flow) : isMissing ? `${SOLVED_MODELS[wish.model]} was not found.` : "";
  if ($("flow-cost").textContent !== sentence) $("flow-cost").textContent = sentence;
}

const counts = (drag) => (1e4 * drag).toFixed(1).replace("-", "−");
const sentenceOfForces = ({ model, lift, drag, dragOfPressure, dragOfFriction, highestMach }) =>
  (model === "euler"
    ? `Euler: CL ${signed(lift, 4)}, CD ${counts(drag)} counts, up to Mach ${highestMach.toFixed(2)}`
    : `Laminar: CL ${signed(lift, 4)}, CD ${counts(drag)} counts (pressure ${counts(dragOfPressure)}, ` +
      `friction ${counts(dragOfFriction)}), up to Mach ${highestMach.toFixed(2)}`);
