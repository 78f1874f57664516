// SPDX-License-Identifier: Apache-2.0
#include "compare_adjacencies.hpp"

#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "plain_adjacency.hpp"
#include "shared/cylinder.hpp"

namespace bench {
namespace {

constexpr int n_turns = 10, n_plain_turns = 5;

const RatioBar ratio_bars[] = {
    {"adjacency in lines: plain loop / library, 1 thread", "plain adjacency in lines, 1 thread",
     "adjacency in lines, 1 thread", Wanted::at_least, 8},
    {"adjacency at random: plain loop / library, 1 thread", "plain adjacency at random, 1 thread",
     "adjacency at random, 1 thread", Wanted::at_least, 5},
    {"adjacency in lines: 1 thread / 2 threads", "adjacency in lines, 1 thread", "adjacency in lines, 2 threads",
     Wanted::at_least, 1.6},
    {"adjacency at random: 1 thread / 2 threads", "adjacency at random, 1 thread", "adjacency at random, 2 threads",
     Wanted::at_least, 1.6},
};

// Returns a number of kilobytes from this process's status.
double status_kb(const char *field) {
  std::FILE *file = std::fopen("/proc/self/status", "r");
  char line[256];
  double kb = -1;
  while (file && kb < 0 && std::fgets(line, sizeof line, file))
    if (std::strncmp(line, field, std::strlen(field)) == 0) kb = std::strtod(line + std::strlen(field) + 1, nullptr);
  if (file) std::fclose(file);
  if (kb < 0) {
    std::fprintf(stderr, "/proc/self/status does not give %s\n", field);
    std::_Exit(1);
  }
  return kb;
}

// Runs the work in a process of its own, and returns by how many megabytes the peak memory rises.
double peak_megabytes(const std::function<void()> &work) {
  int ends[2];
  if (pipe(ends) != 0) {
    std::perror("pipe");
    std::exit(1);
  }
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    malloc_trim(0);
    const double before = status_kb("VmRSS");
    work();
    const double added = (status_kb("VmHWM") - before) / 1024;
    std::_Exit(write(ends[1], &added, sizeof added) == sizeof added ? 0 : 1);
  }
  close(ends[1]);
  double added = 0;
  int status = 0;
  if (child < 0 || read(ends[0], &added, sizeof added) != sizeof added || waitpid(child, &status, 0) != child ||
      status) {
    std::fprintf(stderr, "the process whose memory is measured failed\n");
    std::exit(1);
  }
  close(ends[0]);
  return added;
}

bool is_same(const PlainRows &plain, const riis_adjacency *adjacency) {
  riis_csr rows;
  check(riis_adjacency_get_csr(adjacency, &rows, sizeof rows));
  const auto n = static_cast<std::size_t>(rows.n_rows);
  const auto *offsets = static_cast<const std::int64_t *>(rows.offsets);
  return rows.column_bits == 32 && plain.offsets.size() == n + 1 &&
         std::memcmp(plain.offsets.data(), offsets, (n + 1) * sizeof *offsets) == 0 &&
         std::memcmp(plain.columns.data(), rows.columns, plain.columns.size() * sizeof plain.columns[0]) == 0;
}

riis_mesh_cells cells_of(std::int64_t n_nodes, const std::vector<std::int32_t> &tetrahedra) {
  riis_mesh_cells cells;
  check(riis_mesh_cells_init(&cells, sizeof cells));
  cells.n_nodes = n_nodes;
  cells.n_cells = static_cast<std::int64_t>(tetrahedra.size() / 4);
  cells.node_ids = tetrahedra.data();
  return cells;
}

}  // namespace

bool compare_adjacencies(Contest &contest, Bars &bars, std::int64_t about_n_nodes, nlohmann::json &counts) {
  const CylinderNodes nodes(wide_cylinder, about_n_nodes);
  const std::int64_t n = nodes.n_nodes();
  std::vector<std::int32_t> numbers(static_cast<std::size_t>(n));
  std::iota(numbers.begin(), numbers.end(), 0);
  std::shuffle(numbers.begin(), numbers.end(), std::mt19937_64(1));
  std::vector<std::int32_t> in_lines = nodes.tetrahedra(), at_random = in_lines;
  for (std::int32_t &node : at_random) node = numbers[static_cast<std::size_t>(node)];

  const double plain_peak = peak_megabytes([&] { plain_adjacency(cells_of(n, in_lines), 1); });
  const double peak = peak_megabytes([&] { adjacency_of(n, in_lines, 1); });
  bars.add("adjacency: peak memory / the plain loop's", peak / plain_peak, Wanted::at_most, 0.5);

  bool is_right = true;
  for (const std::vector<std::int32_t> *tetrahedra : {&in_lines, &at_random}) {
    const std::string name = tetrahedra == &in_lines ? "adjacency in lines" : "adjacency at random";
    const riis_mesh_cells cells = cells_of(n, *tetrahedra);
    const PlainRows plain = plain_adjacency(cells, 2);
    for (const int n_threads : {1, 2}) {
      const std::string of_threads = n_threads == 1 ? ", 1 thread" : ", 2 threads";
      is_right = is_right && is_same(plain, adjacency_of(n, *tetrahedra, n_threads).get());
      contest.add(name + of_threads, n_turns, [n, tetrahedra, n_threads] { adjacency_of(n, *tetrahedra, n_threads); });
    }
    contest.add("plain " + name + ", 1 thread", n_plain_turns, [cells] { plain_adjacency(cells, 1); });
  }
  std::printf(
      "Adjacency of %lld nodes in %zu tetrahedra: at most %.0f MB more in memory; the plain loop %.0f MB.%s\n\n",
      static_cast<long long>(n), in_lines.size() / 4, peak, plain_peak, is_right ? "" : " ROWS DIFFER.");
  std::fflush(stdout);
  contest.run();
  for (const RatioBar &ratio : ratio_bars) bars.add(contest, ratio);
  counts["adjacency"] = {
      {"nodes", n}, {"tetrahedra", in_lines.size() / 4}, {"peak_mb", peak}, {"plain_peak_mb", plain_peak}};
  return is_right;
}

}  // namespace bench
