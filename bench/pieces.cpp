// bench/pieces: how long each piece takes by itself, by Google Benchmark. compare says how fast the whole is;
// this says which piece made it slower. The options are the library's (--benchmark_filter and so on).
//
// Every benchmark says in its comment what one iteration is, which Time and CPU are of, and what an item is,
// which items_per_second counts. Pausing the clock, where an iteration needs something made ready, costs it
// half a microsecond. Nothing here reads or writes a file, and the data are the same in every run.

#include <benchmark/benchmark.h>

BENCHMARK_MAIN();
