// SPDX-License-Identifier: Apache-2.0
// The counters that benchmarks of markings report.
#pragma once

#include <benchmark/benchmark.h>

#include "shared/handles.hpp"

namespace bench {

// Reports the time of one run, divided by n.
inline void count_time_per(benchmark::State &state, const char *name, double n) {
  state.counters[name] =
      benchmark::Counter(n, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// Reports the counts of the last marking and the time per query.
inline void count_marking(benchmark::State &state, const riis_mark_stats &stats) {
  const auto n_queries = static_cast<double>(stats.n_queries);
  state.counters["nodes"] = static_cast<double>(stats.n_nodes);
  state.counters["marked"] = static_cast<double>(stats.n_marked);
  state.counters["queries"] = n_queries;
  state.counters["threads"] = stats.n_threads;
  count_time_per(state, "time/query", n_queries);
}

}  // namespace bench
