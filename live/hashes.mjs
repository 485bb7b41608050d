// Takes the walk of live_hashes (standard input) in WebAssembly and compares the hash after each step.
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

function walk(lines) {
  if (lines.length < 500) throw new Error(`${lines.length} steps found, expected 500 at least`);
  lines.map((line) => JSON.parse(line)).forEach(({ design, points, gradation, hash }, step) => {
    const done = step === 0
      ? live._live_generate(passed(design), design.length, points, gradation)
      : live._live_update(passed(design), design.length);
    if (!done) throw new Error(`step ${step}: ${live.UTF8ToString(live._live_error())}`);
    const found = live.UTF8ToString(live._live_hash());
    if (found !== hash) throw new Error(`step ${step}: ${found} found, expected ${hash} as natively`);
    const broken = step % 100 === 0 ? live.UTF8ToString(live._live_check()) : "";
    if (broken !== "") throw new Error(`step ${step}: ${broken}`);
  });
}

const lines = readFileSync(0, "utf8").trim().split("\n");
try {
  walk(lines);
  console.log(`${lines.length} meshes, the same bytes natively and in WebAssembly`);
} catch (error) {
  console.error(`hashes.mjs: ${error.message}`);
  process.exitCode = 1;
}
