// SPDX-License-Identifier: Apache-2.0
// In: runs of the search benchmarks. Out: exhaustive against neighbour search, as the paper tabulates them, beside its ratios.
#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <ostream>
#include <string>

namespace bench {

class SearchTable {
 public:
  // args as "valve/thousands of nodes/threads". Of repeated runs the least comes last, and stays.
  void add(const std::string &name, const std::string &args, const benchmark::UserCounters &counters);

  // Nothing if no search ran.
  void print(std::ostream &out) const;

 private:
  const benchmark::UserCounters *find(const std::string &name, const std::string &args) const;

  std::map<std::string, benchmark::UserCounters> by_name_;  // "name/args"
};

}  // namespace bench
