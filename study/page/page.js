// Tables and charts of the study, made of the JSON in the element "data". Text goes into the page as text nodes
// alone: names may be anything.
"use strict";

const study = JSON.parse(document.getElementById("data").textContent);
const PAPER = "the paper";
const I_COLORS = ["#440154", "#3b528b", "#21918c", "#5ec962", "#e0a80d", "#d55e00"];
const D_COLORS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#8c6d1f", "#56b4e9"];

// Heading, decimals and kind of difference of the paper's seven figures. A difference of `bound` has the palest colour,
// four times as much the strongest. Times are not coloured: they are of different machines.
const percent = (ours, papers) => 100 * (ours / papers - 1);
const points = (ours, papers) => ours - papers;
const FIGURES = [
  { title: "generation\ntriangles", decimals: 0, difference: percent, unit: " %", bound: 5, shared: true },
  { title: "generation\nms", decimals: 2, difference: percent, unit: " %", shared: true },
  { title: "remodelling\ntriangles", decimals: 0, difference: percent, unit: " %", bound: 5 },
  { title: "remodelling\nms", decimals: 3, difference: percent, unit: " %" },
  { title: "preservation %", decimals: 2, difference: points, unit: "", bound: 1 },
  { title: "surplus %", decimals: 2, difference: points, unit: "", bound: 5 },
  { title: "speed-up", decimals: 1, difference: percent, unit: " %", bound: 50 },
];
const [PRESERVATION, SURPLUS, SPEEDUP, LOST] = [4, 5, 6, 7];

// ---------------------------------------------------------------------------------------------- elements

function element(tag, attributes, ...children) {
  const result = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes || {})) {
    if (value !== undefined && value !== "") result.setAttribute(name, value);
  }
  result.append(...children);
  return result;
}

const section = (id) => document.getElementById(id);
const fixed = (value, decimals) => (value === null || value === undefined ? "–" : value.toFixed(decimals));
const signed = (value, decimals) => (value > 0 ? "+" : "") + fixed(value, decimals);
const unique = (values) => [...new Set(values)];
const titleOf = (name) => study.airfoils.find((airfoil) => airfoil.name === name)?.title ?? name;
const plural = (count, word) => `${count} ${word}${count === 1 ? "" : "s"}`;

const caseKey = (row) => JSON.stringify([row.airfoil, row.sigma, row.I, row.G, row.D]);
const papers = new Map(study.paper.map((row) => [caseKey(row), row]));
const strategies = unique(study.rows.map((row) => row.strategy));
const airfoils = unique(study.rows.map((row) => row.airfoil));

function heads(rows) {
  return element("thead", {}, ...rows.map((cells) =>
    element("tr", {}, ...cells.map(([text, attributes]) => element("th", attributes, text)))));
}

// ---------------------------------------------------------------------------------------------- summary

function showRun() {
  const list = element("dl");
  for (const [label, value] of study.summary) list.append(element("dt", {}, label), element("dd", {}, value));
  section("run").append(list);
  const state = section("state");
  state.textContent = study.verdict.sentence;
  if (!study.finished) {
    state.after(element("p", { class: "warning" },
      "The study is not finished: what is missing is listed below, and all figures are of what is there."));
  }
}

function showVerdict() {
  const target = section("verdict");
  if (study.verdict.lines.length === 0) {
    target.append(element("p", {}, study.verdict.sentence));
    return;
  }
  target.append(element("p", { class: "note" },
    "Ours by chain, the paper's method, less the paper's: from the least to the largest difference of a table's rows. " +
    "Speed-ups are ratios; absolute times are of different machines, and only reported."));
  const range = (values, decimals) => `${signed(values[0], decimals)} to ${signed(values[1], decimals)}`;
  const body = element("tbody");
  for (const line of study.verdict.lines) {
    const all = line.inside === line.judged;
    body.append(element("tr", {},
      element("td", { class: "words" }, line.table), element("td", { class: "words" }, line.title),
      element("td", {}, String(line.sigma)), element("td", {}, String(line.rows)),
      element("td", {}, range(line.generation, 1)), element("td", {}, range(line.remodelling, 1)),
      element("td", {}, range(line.preservation, 2)), element("td", {}, range(line.surplus, 1)),
      element("td", {}, `${fixed(line.speedup[0], 2)} to ${fixed(line.speedup[1], 2)}`),
      element("td", { style: all ? "" : "background: rgba(var(--high), 0.25)" }, `${line.inside} of ${line.judged}`)));
  }
  target.append(element("table", { id: "verdict-lines" },
    heads([["table", "airfoil", "σ", "rows", "generation %", "remodelling %", "preservation, points", "surplus, points",
            "speed-up, ratio", "inside, I ≥ 200"].map((text, i) => [text, { class: i < 2 ? "words" : "" }])]), body));
  showOutside(target);
}

function showOutside(target) {
  const rows = study.verdict.outside;
  if (rows.length === 0) return;
  const body = element("tbody");
  for (const row of rows) {
    body.append(element("tr", {},
      element("td", { class: "words" }, row.table), element("td", {}, String(row.I)), element("td", {}, String(row.D)),
      element("td", {}, String(row.scenarios)), element("td", {}, signed(row.generation, 1)),
      element("td", {}, signed(row.preservation, 2)), element("td", {}, fixed(row.error, 2)),
      element("td", {}, signed(row.surplus, 1)), element("td", { class: "words" }, row.remark)));
  }
  target.append(element("details", {},
    element("summary", {}, "Rows outside", element("small", {}, plural(rows.length, "row"))),
    element("table", { id: "verdict-outside" },
      heads([["table", "I", "D", "scenarios", "generation %", "preservation, points", "its standard error",
              "surplus, points", "outside by"].map((text, i) => [text, { class: i === 0 || i === 8 ? "words" : "" }])]),
      body)));
}

// ---------------------------------------------------------------------------------------------- tables

function shade(figure, difference) {
  if (!figure.bound || !Number.isFinite(difference)) return "";
  const strength = Math.min(Math.abs(difference) / (4 * figure.bound), 1);
  return `background: rgba(var(--${difference < 0 ? "low" : "high"}), ${(0.6 * strength).toFixed(2)})`;
}

function oursCell(row, paper, k, begins) {
  const figure = FIGURES[k];
  if (!row || row.means[k] === null) return element("td", { class: begins }, "–");
  const value = row.means[k];
  const lines = [`${row.strategy}: ${fixed(value, figure.decimals + 1)}`];
  if (row.deviations[k] !== null) lines.push(`standard deviation of the scenarios ${fixed(row.deviations[k], figure.decimals + 1)}`);
  let difference = null;
  if (paper) {
    difference = figure.difference(value, paper.means[k]);
    lines.push(`the paper: ${paper.means[k]}, difference ${signed(difference, 2)}${figure.unit || " points"}`);
  }
  return element("td", { class: begins, style: shade(figure, difference ?? NaN), title: lines.join("\n") },
    element("span", { class: "value" }, fixed(value, figure.decimals)),
    element("span", { class: "difference" }, difference === null ? fixed(value, figure.decimals) : signed(difference, figure.unit ? 1 : 2) + figure.unit));
}

function tableHead(hasPaper) {
  const first = ["I", "G", "D"].map((text) => [text, { rowspan: 2 }]);
  const second = [];
  for (const figure of FIGURES) {
    const columns = [...(hasPaper ? ["paper"] : []), ...(figure.shared ? ["ours"] : strategies)];
    first.push([figure.title, { colspan: columns.length, class: "begin" }]);
    columns.forEach((column, i) => second.push([column, { class: i === 0 ? "begin" : "" }]));
  }
  return heads([first, second]);
}

function tableRow(rows, hasPaper, newGroup) {
  const { I, G, D } = rows[0];
  const paper = papers.get(caseKey(rows[0]));
  const line = element("tr", { class: newGroup ? "group" : "" }, ...[I, G, D].map((value) => element("td", {}, String(value))));
  FIGURES.forEach((figure, k) => {
    if (hasPaper) {
      line.append(element("td", { class: "paper begin" }, paper ? fixed(paper.means[k], Math.min(figure.decimals, 2)) : "–"));
    }
    const ours = figure.shared ? [rows[0]] : strategies.map((strategy) => rows.find((row) => row.strategy === strategy));
    ours.forEach((row, i) => line.append(oursCell(row, paper, k, !hasPaper && i === 0 ? "begin" : "")));
  });
  return line;
}

function showTable(target, airfoil, sigma, open) {
  const rows = study.rows.filter((row) => row.airfoil === airfoil && row.sigma === sigma);
  const cases = new Map();
  for (const row of rows) cases.set(caseKey(row), [...(cases.get(caseKey(row)) ?? []), row]);
  const paper = rows.map((row) => papers.get(caseKey(row))).find((row) => row);
  const body = element("tbody");
  let before = null;
  for (const group of cases.values()) {
    body.append(tableRow(group, Boolean(paper), before !== null && before !== group[0].I));
    before = group[0].I;
  }
  const scenarios = unique(rows.map((row) => row.scenarios)).sort((a, b) => a - b);
  const name = `${paper ? `Table ${paper.table}: ` : ""}${titleOf(airfoil)}, σ = ${sigma}`;
  target.append(element("details", open ? { open: "open" } : {},
    element("summary", {}, name, element("small", {},
      `mean of ${scenarios.join(" to ")} ${scenarios.at(-1) === 1 ? "scenario" : "scenarios"}`)),
    element("table", { class: "study", "data-rows": cases.size }, tableHead(Boolean(paper)), body)));
}

function showTables() {
  const target = section("tables");
  const swatch = (color) => element("span", { class: "swatch", style: `background: rgba(var(--${color}), 0.6)` });
  const toggle = element("input", { type: "checkbox", id: "differences" });
  toggle.addEventListener("change", () => target.classList.toggle("differences", toggle.checked));
  target.append(
    element("p", {}, "Rows and columns as in the paper's tables. Colours say how far we are from the paper; the strongest " +
      "stands for 20 % of triangles, 4 points of preservation, 20 points of surplus, and a speed-up three times the " +
      "paper's. Hold the pointer over a cell for the difference and the deviation of the scenarios."),
    element("div", { class: "controls" },
      element("span", {}, swatch("low"), "less than the paper's"), element("span", {}, swatch("high"), "more than the paper's"),
      element("label", {}, toggle, " show differences instead of values")));
  airfoils.forEach((airfoil, i) => {
    target.append(element("h3", { id: `tables-${i}` }, titleOf(airfoil)));
    const sigmas = unique(study.rows.filter((row) => row.airfoil === airfoil).map((row) => row.sigma));
    for (const sigma of sigmas) showTable(target, airfoil, sigma, i === 0);
  });
}

// ---------------------------------------------------------------------------------------------- charts

const INK = "currentColor";
const CONFIG = {
  background: null,
  font: "system-ui, sans-serif",
  view: { stroke: null },
  axis: { labelColor: INK, titleColor: INK, domainColor: INK, tickColor: INK, gridColor: INK, gridOpacity: 0.12,
          domainOpacity: 0.5, tickOpacity: 0.5, labelFontSize: 11, titleFontSize: 12, titleFontWeight: 500 },
  legend: { labelColor: INK, titleColor: INK, labelFontSize: 11.5, titleFontSize: 12, symbolStrokeWidth: 2 },
  header: { labelColor: INK, titleColor: INK, labelFontSize: 12.5, labelFontWeight: 600 },
  line: { strokeWidth: 1.7 },
};
const views = [];
const queue = [];  // charts are drawn one after the other, so that the page can be read in the meantime

// The strategy that the page's choice shows, beside the paper.
const strategyFilter = { filter: `datum.source === ${JSON.stringify(PAPER)} || datum.source === strategy` };
const strategyParameter = { name: "strategy", value: strategies[0] };

function addChart(target, name, spec) {
  const place = element("div", { class: "chart", "data-chart": name });
  target.append(place);
  queue.push(async () => {
    const { view } = await vegaEmbed(place, { $schema: "https://vega.github.io/schema/vega-lite/v6.json", config: CONFIG, ...spec },
      { renderer: "svg", actions: { export: true, source: false, compiled: false, editor: false }, downloadFileName: name });
    if (spec.params?.includes(strategyParameter)) views.push(view);
  });
}

const numbered = (values) => unique(values).sort((a, b) => a - b);
const distanceScale = (rows) => {
  const domain = numbered(rows.map((row) => row.D));
  return { domain, range: domain.map((_, i) => D_COLORS[i % D_COLORS.length]) };
};

// Values of one figure, ours and the paper's, as chart rows.
function chartValues(rows, k) {
  const values = [];
  const add = (row, source, value) => {
    if (value !== null && value !== undefined) values.push({ panel: `σ = ${row.sigma}`, I: row.I, D: row.D, source, by: source === PAPER ? PAPER : "ours", value });
  };
  for (const row of rows) {
    add(row, row.strategy, row.means[k]);
    const paper = papers.get(caseKey(row));
    if (paper && row.strategy === strategies[0]) add(row, PAPER, paper.means[k]);
  }
  return values;
}

function overPoints(rows, k, title) {
  const ticks = numbered(rows.map((row) => row.I));
  return {
    data: { values: chartValues(rows, k) },
    params: [strategyParameter],
    transform: [strategyFilter],
    facet: { column: { field: "panel", title: null, sort: null } },
    spec: {
      width: 262, height: 200,
      params: [{ name: "picked", select: { type: "point", fields: ["D"] }, bind: "legend" }],
      mark: { type: "line", point: { size: 26 }, tooltip: true },
      encoding: {
        x: { field: "I", type: "quantitative", title: "I", scale: { type: "log", nice: false, domain: [ticks[0] * 0.9, ticks.at(-1) * 1.1] },
             axis: { values: ticks, grid: false, labelOverlap: false } },
        y: { field: "value", type: "quantitative", title, scale: { zero: false } },
        color: { field: "D", type: "ordinal", title: "D", scale: distanceScale(rows) },
        strokeDash: { field: "by", type: "nominal", title: null, scale: { domain: ["ours", PAPER], range: [[1, 0], [5, 4]] } },
        opacity: { condition: { param: "picked", value: 1 }, value: 0.08 },
        tooltip: ["source", "I", "D", { field: "value", title, format: ".2f" }].map((field) => (typeof field === "string" ? { field } : field)),
      },
    },
  };
}

function lossValues(rows) {
  const values = [];
  const add = (row, source, lost, surplus) => {
    if (lost > 0 && surplus !== null) values.push({ panel: `σ = ${row.sigma}`, I: row.I, D: row.D, source, lost, surplus });
  };
  for (const row of rows) {
    add(row, row.strategy, row.means[LOST], row.means[SURPLUS]);
    const paper = papers.get(caseKey(row));
    if (paper && row.strategy === strategies[0]) add(row, PAPER, paper.lost, paper.means[SURPLUS]);
  }
  return values;
}

function losses(rows) {
  return {
    data: { values: lossValues(rows) },
    facet: { column: { field: "panel", title: null, sort: null } },
    spec: {
      width: 262, height: 230,
      params: [{ name: "picked", select: { type: "point", fields: ["source"] }, bind: "legend" }],
      mark: { type: "point", size: 44, strokeWidth: 1.6 },
      encoding: {
        x: { field: "lost", type: "quantitative", title: "triangles lost per step", scale: { type: "log", nice: false, padding: 12 },
             axis: { grid: false, values: [50, 100, 200, 500, 1000, 2000, 5000] } },
        y: { field: "surplus", type: "quantitative", title: "surplus, %" },
        color: { field: "source", type: "nominal", title: null,
                 scale: { domain: [PAPER, ...strategies], range: ["#8a8f94", ...D_COLORS] } },
        shape: { field: "D", type: "nominal", sort: null, title: "D" },
        opacity: { condition: { param: "picked", value: 1 }, value: 0.08 },
        tooltip: [{ field: "source" }, { field: "I" }, { field: "D" }, { field: "lost", format: ".0f" }, { field: "surplus", format: ".2f" }],
      },
    },
  };
}

function blockValues(airfoil) {
  return study.blocks.filter((block) => study.rows[block[0]].airfoil === airfoil).map(([index, first, last, triangles, preservation, surplus]) => {
    const row = study.rows[index];
    return { panel: `σ = ${row.sigma}`, I: row.I, D: row.D, source: row.strategy, evaluation: (first + last) / 2, triangles, preservation, surplus };
  });
}

function overRun(values) {
  const ticks = numbered(values.map((value) => value.I));
  const panel = (field, title, scale, axis) => ({
    transform: [{ filter: `isValid(datum.${field})` }],
    facet: { column: { field: "panel", title: null, sort: null } },
    spec: {
      width: 262, height: 160,
      mark: { type: "line", strokeWidth: 1.4, tooltip: true },
      encoding: {
        x: { field: "evaluation", type: "quantitative", title: "evaluation", axis: { grid: false, tickCount: 5 } },
        y: { field, type: "quantitative", title, scale, axis },
        color: { field: "I", type: "ordinal", scale: { domain: ticks, range: ticks.map((_, i) => I_COLORS[Math.round((i * (I_COLORS.length - 1)) / Math.max(1, ticks.length - 1)) % I_COLORS.length]) } },
      },
    },
  });
  return {
    data: { values },
    params: [strategyParameter],
    transform: [strategyFilter],
    vconcat: [panel("triangles", "triangles", { type: "log", nice: false }, { values: [1000, 2000, 5000, 10000, 20000, 50000, 100000] }),
              panel("preservation", "preservation, %", { zero: false }),
              panel("surplus", "surplus, %", { zero: false })],
  };
}

function strategyChoice() {
  const name = `strategy-${document.querySelectorAll(".choice").length}`;
  const controls = element("div", { class: "controls choice" }, "Ours by");
  for (const strategy of strategies) {
    const input = element("input", { type: "radio", name, value: strategy });
    input.checked = strategy === strategyParameter.value;
    input.addEventListener("change", () => chooseStrategy(strategy));
    controls.append(element("label", {}, input, ` ${strategy}`));
  }
  return controls;
}

function chooseStrategy(strategy) {
  strategyParameter.value = strategy;
  for (const input of document.querySelectorAll(".choice input")) input.checked = input.value === strategy;
  for (const view of views) view.signal("strategy", strategy).runAsync();
}

// The numbers of the paper's figures of an airfoil: 2 to 4 and A23 to A25 for RAE 2822, A11 onwards by table.
function figureNumbers(rows) {
  const paper = rows.map((row) => papers.get(caseKey(row))).find((row) => row);
  if (!paper) return ["", "", ""];
  const airfoil = Math.floor((Number(paper.table.slice(1)) - 1) / 3);
  return [0, 1, 2].map((k) => (airfoil === 4 ? `figures ${k + 2} and A${11 + 3 * airfoil + k}` : `figure A${11 + 3 * airfoil + k}`));
}

function perAirfoil(target, open, fill) {
  airfoils.forEach((airfoil, i) => {
    const place = element("details", open || i === 0 ? { open: "open" } : {}, element("summary", {}, titleOf(airfoil)));
    target.append(place);
    fill(place, airfoil, study.rows.filter((row) => row.airfoil === airfoil), i);
  });
}

function showCharts() {
  const target = section("charts");
  target.append(element("p", {}, "The paper's figures 2 to 4 and A11 to A37: means of the scenarios over I, the paper's dashed. " +
    "Click on a D in the legend to see it alone, hold the pointer over a point for its numbers."), strategyChoice());
  perAirfoil(target, true, (place, airfoil, rows, i) => {
    const numbers = figureNumbers(rows);
    [["Element preservation", "preservation, %", PRESERVATION], ["Element surplus", "surplus, %", SURPLUS],
     ["Speed-up", "speed-up", SPEEDUP]].forEach(([title, axis, k], n) => {
      place.append(element("p", { class: "note" }, `${title}, ${titleOf(airfoil)}${numbers[n] ? ` (the paper's ${numbers[n]})` : ""}`));
      addChart(place, `chart-${i}-${n}`, overPoints(rows, k, axis));
    });
  });
}

function showLosses() {
  const target = section("losses");
  target.append(element("p", {}, "Down and to the left is better: triangles that a fresh mesh would not have, against triangles whose " +
    "solution is lost at each step. Each point is one I and D; the paper's losses are its remodelling triangles times one less its preservation."));
  perAirfoil(target, false, (place, airfoil, rows, i) => addChart(place, `losses-${i}`, losses(rows)));
}

function showBlocks() {
  const target = section("blocks");
  target.append(element("p", {}, "Means over stretches of the run, for the D nearest to 1. Surplus is against fresh meshes of the compared " +
    "evaluations."), strategyChoice());
  perAirfoil(target, false, (place, airfoil, rows, i) => {
    const values = blockValues(airfoil);
    if (values.length > 0) addChart(place, `blocks-${i}`, overRun(values));
  });
}

// ---------------------------------------------------------------------------------------------- pictures

function picture(figure) {
  const svg = new DOMParser().parseFromString(figure.svg, "image/svg+xml").documentElement;
  const result = element("figure", {}, document.importNode(svg, true), element("figcaption", {}, figure.title));
  return result;
}

function showPictures() {
  const meshes = section("meshes");
  meshes.append(element("p", {}, "Made for this page from the designs of one scenario's search. Above: what is removed around each pair of " +
    "vertices before new ones are inserted (the paper's figure 1). Below: meshes coloured by gradation, remodelled ones beside a " +
    "fresh one (the paper's figure 5): blue triangles are finer than the design asks for."));
  study.meshes.forEach((figure) => meshes.append(picture(figure)));
  const outlines = element("div", { class: "outlines" });
  study.outlines.forEach((figure) => outlines.append(picture(figure)));
  section("airfoils").append(element("p", {}, "The paper's figures A1 to A10: outlines, camber lines dashed."), outlines);
}

function showContents() {
  for (const part of document.querySelectorAll("main > section")) {
    const entry = element("li", {}, element("a", { href: `#${part.id}` }, part.querySelector("h2").textContent));
    if (part.id === "tables") {
      entry.append(element("ul", {}, ...airfoils.map((airfoil, i) =>
        element("li", {}, element("a", { href: `#tables-${i}` }, titleOf(airfoil))))));
    }
    section("contents").append(entry);
  }
}

async function drawQueue() {
  let failed = 0;
  for (const draw of queue) {
    try {
      await draw();
    } catch (error) {
      failed += 1;
      console.error(`chart: ${error}`);
    }
    await new Promise((resolve) => setTimeout(resolve));
  }
  document.documentElement.dataset.charts = `${queue.length - failed} of ${queue.length}`;
}

for (const show of [showRun, showVerdict, showTables, showCharts, showLosses, showBlocks, showPictures, showContents]) show();
drawQueue();
