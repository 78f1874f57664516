// SPDX-License-Identifier: Apache-2.0
#include "compare_adjacencies.hpp"

#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "shared/cylinder.hpp"

namespace bench {
namespace {

// The benchmark compares riis_adjacency_create_from_cells with this earlier version, which had no 32-bit counts yet.
struct PlainRows {
  std::vector<std::int64_t> offsets;
  std::vector<std::int32_t> columns;
};

struct Integers {
  const void *data;
  bool is_64_bits;
  std::int64_t operator[](std::int64_t i) const {
    return is_64_bits ? static_cast<const std::int64_t *>(data)[i] : static_cast<const std::int32_t *>(data)[i];
  }
};

struct Shape {
  int n_edges;
  std::array<std::array<std::uint8_t, 2>, 12> edges;
};
constexpr Shape tetrahedron{6, {{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}}};
constexpr Shape pyramid{8, {{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}}};
constexpr Shape prism{9, {{{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}}};
constexpr Shape hexahedron{
    12, {{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}}};

const Shape &shape_of(std::int64_t n_nodes) {
  switch (n_nodes) {
    case 4:
      return tetrahedron;
    case 5:
      return pyramid;
    case 6:
      return prism;
    default:
      return hexahedron;
  }
}

constexpr std::int64_t per_block = 4096;

// Calls body(begin, end) for blocks of n items, on several threads.
template <class Body>
void for_blocks(std::int64_t n, int n_threads, const Body &body) {
  const std::int64_t n_blocks = (n + per_block - 1) / per_block;
#pragma omp parallel for num_threads(n_threads) schedule(dynamic) if (n_threads > 1)
  for (std::int64_t block = 0; block < n_blocks; ++block) body(block * per_block, std::min(n, (block + 1) * per_block));
}

// Makes the rows of an adjacency from cells of 4, 5, 6 or 8 nodes, with ids of 32 or 64 bits. The cells must be valid, and the
// mesh must have fewer than 2^31 nodes.
PlainRows plain_adjacency(const riis_mesh_cells &cells, int n_threads) {
  const Integers nodes{cells.node_ids, cells.id_bits == 64}, offsets{cells.offsets, cells.id_bits == 64};
  const std::int64_t first = cells.offsets ? offsets[0] : 0, base = cells.index_base;
  const auto begin_of = [&](std::int64_t cell) {
    return cells.offsets ? offsets[cell] - first : cell * cells.nodes_per_cell;
  };
  const auto size_of = [&](std::int64_t cell) { return begin_of(cell + 1) - begin_of(cell); };
  const auto node_of = [&](std::int64_t cell, std::int64_t k) { return nodes[begin_of(cell) + k] - base; };
  for (std::int64_t cell = 0; cell < cells.n_cells; ++cell)
    for (std::int64_t k = 0; k < size_of(cell); ++k)
      if (node_of(cell, k) < 0 || node_of(cell, k) >= cells.n_nodes) {
        std::fprintf(stderr, "plain_adjacency: a cell names a node that does not exist\n");
        std::exit(1);
      }

  const auto n = static_cast<std::size_t>(cells.n_nodes);
  const auto next = std::make_unique<std::atomic<std::int64_t>[]>(n + 1);
  for (std::size_t i = 0; i <= n; ++i) next[i].store(0, std::memory_order_relaxed);
  for_blocks(cells.n_cells, n_threads, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t cell = begin; cell < end; ++cell)
      for (std::int64_t k = 0; k < size_of(cell); ++k)
        next.get()[node_of(cell, k)].fetch_add(1, std::memory_order_relaxed);
  });
  std::vector<std::int64_t> begins(n + 1), items;
  for (std::size_t i = 0; i < n; ++i) {
    begins[i + 1] = begins[i] + next[i].load(std::memory_order_relaxed);
    next[i].store(begins[i], std::memory_order_relaxed);
  }
  items.resize(static_cast<std::size_t>(begins[n]));
  for_blocks(cells.n_cells, n_threads, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t cell = begin; cell < end; ++cell)
      for (std::int64_t k = 0; k < size_of(cell); ++k) {
        const std::int64_t at = next.get()[node_of(cell, k)].fetch_add(1, std::memory_order_relaxed);
        items.data()[at] = cell;
      }
  });

  const auto neighbors_of = [&](std::int64_t i, std::vector<std::int64_t> &neighbors) {
    neighbors.clear();
    for (std::int64_t k = begins.data()[i]; k < begins.data()[i + 1]; ++k) {
      const std::int64_t cell = items.data()[k];
      const Shape &shape = shape_of(size_of(cell));
      for (int e = 0; e < shape.n_edges; ++e) {
        const auto &edge = shape.edges.data()[e];
        const std::int64_t a = node_of(cell, edge[0]), b = node_of(cell, edge[1]);
        if (a == i && b != i) neighbors.push_back(b);
        if (b == i && a != i) neighbors.push_back(a);
      }
    }
    std::sort(neighbors.begin(), neighbors.end());
    neighbors.erase(std::unique(neighbors.begin(), neighbors.end()), neighbors.end());
  };
  PlainRows made;
  made.offsets.resize(n + 1);
  for_blocks(cells.n_nodes, n_threads, [&](std::int64_t begin, std::int64_t end) {
    std::vector<std::int64_t> neighbors;
    for (std::int64_t i = begin; i < end; ++i) {
      neighbors_of(i, neighbors);
      made.offsets.data()[i + 1] = static_cast<std::int64_t>(neighbors.size());
    }
  });
  for (std::size_t i = 0; i < n; ++i) made.offsets[i + 1] += made.offsets[i];
  made.columns.resize(static_cast<std::size_t>(made.offsets.back()));
  for_blocks(cells.n_nodes, n_threads, [&](std::int64_t begin, std::int64_t end) {
    std::vector<std::int64_t> neighbors;
    for (std::int64_t i = begin; i < end; ++i) {
      neighbors_of(i, neighbors);
      std::int32_t *to = made.columns.data() + made.offsets.data()[i];
      for (const std::int64_t j : neighbors) *to++ = static_cast<std::int32_t>(j);
    }
  });
  return made;
}

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

// Returns the number of kilobytes in the given field of this process's status.
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

// Runs the work in a separate process. Returns by how many megabytes the peak memory rises.
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
