// bench/pieces: the time of each piece by itself, by Google Benchmark. bench/compare measures the whole; this
// program tells which piece became slower. The options are those of Google Benchmark (--benchmark_filter and
// so on).
//
// The comment of each benchmark defines an iteration, to which Time and CPU refer, and an item, which
// items_per_second counts. Where an iteration needs preparations the clock is paused, which adds half a
// microsecond to it. No benchmark reads or writes a file, and the data are the same in every run.

#include <benchmark/benchmark.h>

BENCHMARK_MAIN();
