// Euler's flow on the page of `remodel live`: a worker of its own looks for it while the mesh goes on living. It is
// asked for the mesh that is shown whenever it has nothing to do, and what it finds is shown if that mesh, angle and
// Mach number are still the ones on the page; until then potential flow is. One script with page.js.

// ---------------------------------------------------------------------------------------------- the search for flows

const FLOW_COLOURS = ["pressure", "mach"];
const LEAST_MACH = 0.1; // below it the equations are stiff
const MOST_VERTICES = 12000; // about I = 450: factors of more take many seconds and gigabytes
const USUAL_MACH = 0.5; // for those who choose Euler's equations at a lower one

let solver = null; // the worker, once it was asked for
let flowSearch = null; // what is under way: state, alpha, mach, steps
let lastAnswer = null; // the last answer: a flow, or why there is none, with its state, alpha and mach
const awaiting = []; // those who wait until the flow that is shown is Euler's, or there is none

const wantsFlow = () => wish.flow || FLOW_COLOURS.includes(wish.colour);
const isOfPage = (flow) =>
  flow !== null && shown !== null && flow.state === shown.state && flow.alpha === wish.alpha && flow.mach === wish.mach;
const wantsEuler = () => wish.model === "euler" && wantsFlow() && shown !== null && !isOfPage(lastAnswer);
const eulerShown = () => (wish.model === "euler" && isOfPage(lastAnswer) && !lastAnswer.reason ? lastAnswer : null);

const takenBack = () => Object.assign(new Error("it was stopped"), { isTakenBack: true });

async function searchFlow() {
  if (flowSearch || !wantsEuler()) return giveWay();
  flowSearch = { state: shown.state, alpha: wish.alpha, mach: wish.mach, steps: 0 };
  showFlowState();
  try {
    lastAnswer = { ...(await askForFlow(flowSearch)), reason: "" };
  } catch (error) {
    lastAnswer = error.isTakenBack ? null : { ...flowSearch, reason: error.message };
    if (error.isBroken) stopSolver();
  }
  flowSearch = null;
  if (isOfPage(lastAnswer) && wish.model === "euler") showFlow();
  showFlowState();
  searchFlow();
}

async function askForFlow({ alpha, mach }) {
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
  if (wish.model !== "euler") throw takenBack();
  return asked.call("euler", { mesh, alpha, mach }, [mesh.points.buffer, mesh.numbers.buffer]);
}

function giveWay() {
  if (flowSearch || wantsEuler()) return;
  while (awaiting.length) awaiting.pop()();
}

// Waits until the flow of what is shown was looked for.
async function solved() {
  await settled();
  if (flowSearch || wantsEuler()) await new Promise((resolve) => awaiting.push(resolve));
}

// A search that nobody waits for any more ends with its worker, whose factors are of no use then.
function stopSolver() {
  solver?.close();
  solver = null;
}

function chooseModel(model) {
  const isSlow = model === "euler" && wish.mach < LEAST_MACH;
  if (model !== "euler" && flowSearch) stopSolver();
  change({ model, ...(isSlow ? { mach: USUAL_MACH } : {}) });
  showControls();
  if (isSlow) say(`Euler’s equations are those of a gas in motion: the Mach number is ${USUAL_MACH.toFixed(2)} now.`);
}

// ---------------------------------------------------------------------------------------------- what is shown of it

// The answer is of the mesh, the angle and the Mach number on the page.
function showFlow() {
  if (lastAnswer.reason) {
    sayTrouble(new Error(`Euler’s flow was not found, potential flow is shown: ${lastAnswer.reason}`));
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
  const flow = eulerShown();
  if (!flow || !FLOW_COLOURS.includes(shown.colour)) return;
  const values = flow.values[shown.colour];
  shown.corners.forEach((vertex, corner) => { shown.vertices[3 * corner + 2] = values[vertex]; });
  uploadMesh(shown.vertices);
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
  const flow = eulerShown();
  const isMissing = wish.model === "euler" && isOfPage(lastAnswer) && lastAnswer.reason !== "";
  $("flow-steps").textContent =
    flowSearch ? `Euler’s flow is looked for, step ${flowSearch.steps}; potential flow until then.` : "";
  const sentence = flow ? sentenceOfFlow(flow) : isMissing ? "Euler’s flow was not found." : "";
  if ($("flow-cost").textContent !== sentence) $("flow-cost").textContent = sentence;
}

const counts = (drag) => (1e4 * drag).toFixed(1).replace("-", "−");
const sentenceOfForces = ({ lift, drag, highestMach }) =>
  `Euler: CL ${signed(lift, 4)}, CD ${counts(drag)} counts, up to Mach ${highestMach.toFixed(2)}`;
