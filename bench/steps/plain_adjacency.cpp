// SPDX-License-Identifier: Apache-2.0
#include "plain_adjacency.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <memory>

namespace bench {
namespace {

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

}  // namespace

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

}  // namespace bench
