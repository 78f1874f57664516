// SPDX-License-Identifier: Apache-2.0
#include "search_table.hpp"

#include <cstdio>

namespace bench {
namespace {

// The paper's tables "Scaling of mesh traversal functions", for meshes of 108,233 to 109,464, 504,683 to 504,929, and 985,877 to
// 1,006,781 nodes: seconds of its exhaustive and of its neighbour search.
struct PaperRow {
  const char *args;
  double exhaustive, neighbor;
};
constexpr PaperRow rows[] = {{"0/100/1", 33.420, 1.655}, {"0/100/2", 16.461, 0.896},    {"0/500/1", 152.917, 6.464},
                             {"0/500/2", 74.513, 3.288}, {"0/1000/1", 307.133, 11.950}, {"0/1000/2", 149.403, 6.103},
                             {"1/100/1", 42.718, 2.359}, {"1/100/2", 21.306, 1.193},    {"1/500/1", 198.841, 8.393},
                             {"1/500/2", 99.259, 4.278}, {"1/1000/1", 391.664, 15.246}, {"1/1000/2", 194.165, 7.557}};

std::string formatted(const char *format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string grouped(double value) {
  std::string digits = formatted("%.0f", value);
  for (std::size_t i = digits.size(); i > 3;) digits.insert(i -= 3, ",");
  return digits;
}

double counter(const benchmark::UserCounters &counters, const char *name) {
  const auto found = counters.find(name);
  return found == counters.end() ? 0 : found->second.value;
}

double shortest(const benchmark::UserCounters &counters) { return counter(counters, "least_ms"); }

}  // namespace

void SearchTable::add(const std::string &name, const std::string &args, const benchmark::UserCounters &counters) {
  by_name_[name + "/" + args] = counters;
}

const benchmark::UserCounters *SearchTable::find(const std::string &name, const std::string &args) const {
  const auto found = by_name_.find(name + "/" + args);
  return found == by_name_.end() ? nullptr : &found->second;
}

void SearchTable::print(std::ostream &out) const {
  bool has_begun = false;
  for (const PaperRow &row : rows) {
    const benchmark::UserCounters *every = find("search_all_distances", row.args),
                                  *exhaustive = find("search_exhaustive", row.args),
                                  *cold = find("search_neighbor_cold", row.args),
                                  *warm = find("search_neighbor_warm", row.args),
                                  *clusters = find("search_clusters", row.args),
                                  *paper = find("search_paper", row.args),
                                  *loop = find("search_every_triangle", row.args);
    if (!every || !exhaustive || !clusters || !cold || !warm || !paper) continue;
    if (!has_begun) {
      out << "\nMilliseconds a marking, the shortest of many. The paper's ratio is that of its exhaustive "
             "search, which computes every "
             "distance, to "
             "its neighbour search.\n\n"
             "| valve | nodes | marked | threads | every triangle | every distance | clusters | exhaustive | "
             "neighbour, cold | "
             "warm "
             "| the paper's rule | every distance / cold | exhaustive / warm | exhaustive / clusters | paper's ratio "
             "|\n"
             "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
      has_begun = true;
    }
    const double n_nodes = counter(*exhaustive, "nodes");
    out << "| " << (row.args[0] == '0' ? "aortic" : "mitral") << " | " << grouped(n_nodes) << " | "
        << formatted("%.1f %%", 100 * counter(*exhaustive, "marked") / n_nodes) << " | "
        << formatted("%.0f", counter(*warm, "threads")) << " | "
        << (loop ? grouped(1e3 * counter(*loop, "all_nodes_s")) : "") << " | " << formatted("%.0f", shortest(*every))
        << " | " << formatted("%.2f", shortest(*clusters)) << " | " << formatted("%.2f", shortest(*exhaustive)) << " | "
        << formatted("%.2f", shortest(*cold)) << " | " << formatted("%.2f", shortest(*warm)) << " | "
        << formatted("%.2f", shortest(*paper)) << " | " << formatted("%.1f", shortest(*every) / shortest(*cold))
        << " | " << formatted("%.2f", shortest(*exhaustive) / shortest(*warm)) << " | "
        << formatted("%.1f", shortest(*exhaustive) / shortest(*clusters)) << " | "
        << formatted("%.1f", row.exhaustive / row.neighbor) << " |\n";
  }
}

}  // namespace bench
