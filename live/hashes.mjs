// Takes the walk of live_hashes (standard input) in WebAssembly, compares the hash after each step and prints the median
// times of both.
//   live_hashes | node hashes.mjs DIRECTORY    with live.js and live.wasm
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { resolve } from "node:path";

const directory = resolve(process.argv[2]);
const createLive = createRequire(import.meta.url)(`${directory}/live.js`);
const live = await createLive({ wasmBinary: readFileSync(`${directory}/live.wasm`) });

function passed(numbers) {
  const pointer = live._live_scratch(8 * numbers.length);
  live.HEAPF64.set(numbers, pointer / 8);
  return pointer;
}

function timed(work) {
  const start = performance.now();
  const done = work();
  return [performance.now() - start, done];
}

const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1].toFixed(2);

function walk(steps) {
  if (steps.length < 100) throw new Error(`${steps.length} steps found, expected 100 at least`);
  const times = { step: [], flow: [] };
  steps.forEach(({ design, points, gradation, reynolds, hash }, step) => {
    const [milliseconds, done] = timed(() => step === 0
      ? live._live_generate(passed(design), design.length, points, gradation, reynolds)
      : live._live_update(passed(design), design.length));
    times.step.push(milliseconds);
    times.flow.push(timed(() => live._live_flow(2, 0))[0]);
    if (!done) throw new Error(`step ${step}: ${live.UTF8ToString(live._live_error())}`);
    const found = live.UTF8ToString(live._live_hash());
    if (found !== hash) throw new Error(`step ${step}: ${found} found, expected ${hash} as natively`);
    const broken = step % 100 === 0 ? live.UTF8ToString(live._live_check()) : "";
    if (broken !== "") throw new Error(`step ${step}: ${broken}`);
  });
  return times;
}

try {
  const steps = readFileSync(0, "utf8").trim().split("\n").map((line) => JSON.parse(line));
  const times = walk(steps);
  console.log(`${steps.length} meshes, the same bytes natively and in WebAssembly; median milliseconds, natively and there:`);
  for (const what of ["step", "flow"]) {
    console.log(`  ${what} ${median(steps.map((step) => step[`${what}_ms`]))}, ${median(times[what])}`);
  }
} catch (error) {
  console.error(`hashes.mjs: ${error.message}`);
  process.exitCode = 1;
}
