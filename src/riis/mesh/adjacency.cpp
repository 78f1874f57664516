// SPDX-License-Identifier: Apache-2.0
#include "mesh/adjacency.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <vector>

#include "base/errors.hpp"
#include "base/recycled.hpp"
#include "common/array_view.hpp"
#include "mesh/cells.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

// Makes an adjacency from items, which are cells or faces. The code first lists the items of each node. The rows are sorted, have
// no repeats, and do not depend on the number of threads.

// Memory from malloc, which realloc can shrink in place. The content must be plain data.
class PlainMemory {
 public:
  // Keeps as much of the content as fits in the new size.
  void resize(std::int64_t n_bytes) {
    if (n_bytes == 0) return memory_.reset();
    void *const moved = std::realloc(memory_.get(), static_cast<std::size_t>(n_bytes));
    if (!moved) throw std::bad_alloc();
    static_cast<void>(memory_.release());
    memory_.reset(moved);
  }
  template <class T>
  T *as() const {
    return static_cast<T *>(memory_.get());
  }

 private:
  struct Free {
    void operator()(void *memory) const { std::free(memory); }
  };
  std::unique_ptr<void, Free> memory_;
};

// Makes the rows. An entry says that a node belongs to an item. The entries of a block of nodes are stored together, node by
// node. Later the block's rows overwrite these entries. Lists is a type with these members:
//   `n_nodes`, `n_items`: the numbers of nodes and items.
//   `most_neighbors`: the largest number of different nodes that one call of for_each_neighbor visits.
//   `for_each_entry(range, visit)`: calls visit(node, entry) for every node of every item in a range.
//   `for_each_neighbor(entry, node, visit)`: calls visit(other), in any order, for the neighbours that `node` has in the item.
//   `prefetch(entry)`: requests the memory that for_each_neighbor reads.
// The type Entry must be able to hold the number of all entries, and the type Column must be able to hold the number of nodes.
template <class Entry, class Column, class Lists>
class RowMaker {
 public:
  RowMaker(const Lists &lists, int n_threads)
      : lists_(lists),
        n_threads_(n_threads),
        n_parts_(std::min<std::int64_t>(n_threads, most_parts)),
        n_blocks_((lists.n_nodes + nodes_per_block - 1) / nodes_per_block) {}

  void make(UnfilledVector<std::int64_t> &offsets, UnfilledVector<Column> &columns) {
    count();
    fill();
    make_rows(offsets);
    next_ = UnfilledVector<Entry>();
    join(offsets, columns);
  }

 private:
  static constexpr std::int64_t nodes_per_block = 4096;
  // Each part of the items has a count for every node. More parts would save time, but would need too much memory.
  static constexpr std::int64_t most_parts = 8;
  static constexpr std::int64_t items_ahead = 16, entries_ahead = 24;  // how far ahead memory is requested
  static constexpr std::int64_t most_inserted =
      64;  // a longer row is sorted as a whole, because insertion would be too slow

  Range items_of(std::int64_t part) const {
    return {lists_.n_items / n_parts_ * part + std::min(lists_.n_items % n_parts_, part),
            lists_.n_items / n_parts_ * (part + 1) + std::min(lists_.n_items % n_parts_, part + 1)};
  }
  Entry *next_of(std::int64_t part) { return next_.data() + part * lists_.n_nodes; }
  Range nodes_of(std::int64_t block) const {
    return {block * nodes_per_block, std::min((block + 1) * nodes_per_block, lists_.n_nodes)};
  }

  // For each part of the items, counts the entries of each node. Then replaces each count by the position in the node's block at
  // which these entries begin.
  void count() {
    resize(next_, n_parts_ * lists_.n_nodes);
    parallel_for(n_parts_, n_threads_, [&](std::int64_t part, int) {
      Entry *const counts = next_of(part);
      std::fill(counts, counts + lists_.n_nodes, Entry{0});
      lists_.for_each_entry(items_of(part), [counts](std::int64_t node, std::int64_t) { ++counts[node]; });
    });
    resize(blocks_, n_blocks_);
    parallel_for(n_blocks_, n_threads_, [&](std::int64_t block, int) {
      Entry sum = 0;
      const Range nodes = nodes_of(block);
      for (std::int64_t node = nodes.begin; node < nodes.end; ++node)
        for (std::int64_t part = 0; part < n_parts_; ++part) {
          Entry &next = next_of(part)[node];
          const Entry n = next;
          next = sum;
          sum += n;
        }
      view(blocks_)[block].resize(static_cast<std::int64_t>(sum * sizeof(Entry)));
    });
  }

  // Writes the entries. This moves each position in next_ to the end of the entries that began there.
  void fill() {
    parallel_for(n_parts_, n_threads_, [&](std::int64_t part, int) {
      Entry *const next = next_of(part);
      const PlainMemory *const blocks = blocks_.data();
      const auto place_of = [&](std::int64_t node) {
        return blocks[node / nodes_per_block].template as<Entry>() + next[node];
      };
      const Range items = items_of(part);
      for (std::int64_t begin = items.begin; begin < items.end; begin += items_ahead) {
        const Range few{begin, std::min(begin + items_ahead, items.end)};
        lists_.for_each_entry(few, [&](std::int64_t node, std::int64_t) { __builtin_prefetch(place_of(node), 1); });
        lists_.for_each_entry(few, [&](std::int64_t node, std::int64_t entry) {
          *place_of(node) = static_cast<Entry>(entry);
          ++next[node];
        });
      }
    });
  }

  // The memory of one thread while it makes rows.
  struct Scratch {
    std::vector<std::uint8_t> is_seen;  // for each node, whether the row already has this node
    UnfilledVector<Column> columns;     // columns of one block
  };

  // Makes the rows of each block, in the memory that holds the block's entries. Writes the lengths of the rows into `offsets`.
  void make_rows(UnfilledVector<std::int64_t> &offsets) {
    resize(offsets, lists_.n_nodes + 1);
    view(offsets)[0] = 0;
    std::vector<Scratch> by_thread;
    resize(by_thread, n_threads_);
    parallel_for(n_blocks_, n_threads_, [&](std::int64_t number, int thread) {
      PlainMemory &block = view(blocks_)[number];
      Scratch &scratch = view(by_thread)[thread];
      resize(scratch.is_seen, lists_.n_nodes);
      const Range nodes = nodes_of(number);
      const Entry *const ends = next_of(n_parts_ - 1);
      const ArrayView<const Entry> entries(block.as<Entry>(), static_cast<std::int64_t>(ends[nodes.end - 1]));
      const Lists lists = lists_;  // a copy, so that the compiler knows that stores to is_seen do not change it
      std::int64_t begin = 0, n_columns = 0;
      for (std::int64_t node = nodes.begin; node < nodes.end; ++node) {
        const auto end = static_cast<std::int64_t>(ends[node]);
        const std::int64_t room = n_columns + std::min((end - begin) * Lists::most_neighbors, lists_.n_nodes);
        if (view(scratch.columns).size() < room)
          resize(scratch.columns, std::max(room, 2 * view(scratch.columns).size()));
        const std::int64_t n =
            make_row(lists, node, entries, {begin, end}, scratch.is_seen.data(), scratch.columns.data() + n_columns);
        view(offsets)[node + 1] = n;
        n_columns += n;
        begin = end;
      }
      const auto n_bytes = static_cast<std::int64_t>(sizeof(Column)) * n_columns;
      block.resize(n_bytes);
      if (n_bytes > 0) std::memcpy(block.as<Column>(), scratch.columns.data(), static_cast<std::size_t>(n_bytes));
    });
  }

  // Writes the row of a node and returns the row's length. All entries of `is_seen` are 0 before and after the call.
  static std::int64_t make_row(const Lists &lists, std::int64_t node, const ArrayView<const Entry> &entries,
                               const Range &of_node, std::uint8_t *is_seen, Column *row) {
    const bool inserts = of_node.end - of_node.begin <= most_inserted;
    std::int64_t n = 0;
    is_seen[node] = 1;  // a node that is listed twice in an item is no neighbour of itself
    for (std::int64_t k = of_node.begin; k < of_node.end; ++k) {
      lists.prefetch(static_cast<std::int64_t>(entries[std::min(k + entries_ahead, entries.size() - 1)]));
      lists.for_each_neighbor(static_cast<std::int64_t>(entries[k]), node, [&](std::int64_t other) {
        if (is_seen[other]) return;
        is_seen[other] = 1;
        const auto column = static_cast<Column>(other);
        std::int64_t at = n++;
        if (inserts)
          for (; at > 0 && row[at - 1] > column; --at) row[at] = row[at - 1];
        row[at] = column;
      });
    }
    is_seen[node] = 0;
    for (std::int64_t k = 0; k < n; ++k) is_seen[row[k]] = 0;
    if (!inserts) std::sort(row, row + n);
    return n;
  }

  // Turns lengths into offsets, and copies the rows of one block after another.
  void join(UnfilledVector<std::int64_t> &offsets, UnfilledVector<Column> &columns) {
    for (std::int64_t node = 0; node < lists_.n_nodes; ++node) view(offsets)[node + 1] += view(offsets)[node];
    resize(columns, view(offsets)[lists_.n_nodes]);
    parallel_for(n_blocks_, n_threads_, [&](std::int64_t number, int) {
      const Range nodes = nodes_of(number);
      const std::int64_t begin = view(offsets)[nodes.begin], n = view(offsets)[nodes.end] - begin;
      std::copy_n(view(blocks_)[number].template as<Column>(), n, columns.data() + begin);
      view(blocks_)[number].resize(0);
    });
  }

  const Lists &lists_;
  int n_threads_;
  std::int64_t n_parts_, n_blocks_;
  UnfilledVector<Entry> next_;       // (n_nodes, n_parts)
  std::vector<PlainMemory> blocks_;  // the blocks hold entries first, and columns later
};

// Makes the adjacency of lists that are within NarrowLimits.
template <class Lists>
OwnAdjacency narrow_adjacency_of_lists(const Lists &lists, int n_threads) {
  OwnAdjacency made;
  RowMaker<std::uint32_t, std::int32_t, Lists>(lists, n_threads).make(made.offsets, made.columns_32);
  return made;
}

// Makes the adjacency of the lists, which must have at most n_entries entries.
template <class Lists>
OwnAdjacency adjacency_of_lists(const Lists &lists, std::int64_t n_entries, int n_threads, const NarrowLimits &limits) {
  OwnAdjacency made;
  if (lists.n_nodes > limits.n_nodes)
    RowMaker<std::uint64_t, std::int64_t, Lists>(lists, n_threads).make(made.offsets, made.columns_64);
  else if (n_entries > limits.n_entries)
    RowMaker<std::uint64_t, std::int32_t, Lists>(lists, n_threads).make(made.offsets, made.columns_32);
  else
    made = narrow_adjacency_of_lists(lists, n_threads);
  return made;
}

constexpr std::int64_t max_count = std::numeric_limits<std::int64_t>::max() / 64;

void check_count(const char *field, std::int64_t n, std::int64_t least) {
  if (n < least || n > max_count)
    fail(n < least ? RIIS_INVALID_ARGUMENT : RIIS_LIMIT_EXCEEDED, field, " is ", n, "; it must be from ", least, " to ",
         max_count);
}

// The type Lists from which the neighbours of cells are made. Cells take the place of nodes, and an entry is a face between two
// cells.
struct InnerFaces {
  static constexpr std::int64_t most_neighbors = 1;

  IntegerArray owner, neighbor;
  std::int64_t stride, base;
  std::int64_t n_nodes, n_items;

  template <class Visit>
  void for_each_entry(const Range &range, const Visit &visit) const {
    for (std::int64_t face = range.begin; face < range.end; ++face) {
      const std::int64_t other = neighbor[face * stride] - base;
      if (other < 0) continue;
      visit(owner[face * stride] - base, face);
      visit(other, face);
    }
  }
  template <class Visit>
  void for_each_neighbor(std::int64_t face, std::int64_t node, const Visit &visit) const {
    const std::int64_t a = owner[face * stride] - base, b = neighbor[face * stride] - base;
    visit(a == node ? b : a);
  }
  void prefetch(std::int64_t) const {}
};

// The type Lists for a grid, in which each node has one entry.
struct GridNodes {
  static constexpr std::int64_t most_neighbors = 6;

  std::int64_t ni, nj, nk;
  std::int64_t n_nodes = ni * nj * nk, n_items = n_nodes;

  template <class Visit>
  void for_each_entry(const Range &range, const Visit &visit) const {
    for (std::int64_t node = range.begin; node < range.end; ++node) visit(node, node);
  }
  template <class Visit>
  void for_each_neighbor(std::int64_t node, std::int64_t, const Visit &visit) const {
    const std::int64_t i = node % ni, j = node / ni % nj, k = node / (ni * nj);
    if (k > 0) visit(node - ni * nj);
    if (j > 0) visit(node - ni);
    if (i > 0) visit(node - 1);
    if (i + 1 < ni) visit(node + 1);
    if (j + 1 < nj) visit(node + ni);
    if (k + 1 < nk) visit(node + ni * nj);
  }
  void prefetch(std::int64_t) const {}
};

template <class Id>
OwnAdjacency adjacency_from_cells_with(const riis_mesh_cells &given, int n_threads, const NarrowLimits &limits) {
  const Cells<Id> cells(given, n_threads);
  // Code for cells of one shape takes three quarters of the time of the general code. This code is compiled only for meshes
  // within NarrowLimits, because hardly any mesh is larger.
  if (given.offsets || cells.n_nodes() > limits.n_nodes || cells.n_listed() > limits.n_entries)
    return adjacency_of_lists(CellsOfAnyShape<Id>(cells), cells.n_listed(), n_threads, limits);
  const auto made_of = [&](const auto &lists) { return narrow_adjacency_of_lists(lists, n_threads); };
  switch (given.nodes_per_cell) {
    case tetrahedron.n_nodes:
      return made_of(CellsOfOneShape<Id, tetrahedron>(cells));
    case pyramid.n_nodes:
      return made_of(CellsOfOneShape<Id, pyramid>(cells));
    case prism.n_nodes:
      return made_of(CellsOfOneShape<Id, prism>(cells));
    default:
      return made_of(CellsOfOneShape<Id, hexahedron>(cells));
  }
}

}  // namespace

Adjacency checked_adjacency(const riis_csr &csr, std::int64_t n_nodes) {
  if (csr.n_rows != n_nodes)
    fail(RIIS_INVALID_ARGUMENT, "csr.n_rows is ", csr.n_rows, "; the mesh has ", n_nodes, " nodes");
  const std::int64_t n_all = csr.n_all == 0 ? csr.n_rows : csr.n_all;
  if (n_all < csr.n_rows || n_all > max_count)
    fail(RIIS_INVALID_ARGUMENT, "csr.n_all is ", csr.n_all, "; it must be at least n_rows, which is ", csr.n_rows,
         ", and at most ", max_count);
  check_bits("csr.offset_bits", csr.offset_bits);
  check_bits("csr.column_bits", csr.column_bits);
  check_base("csr.index_base", csr.index_base);
  check_reserved("csr.reserved", csr.reserved);
  if (csr.n_rows > 0) require(csr.offsets, "csr.offsets");
  const Adjacency made{
      csr.n_rows, {csr.offsets, csr.offset_bits == 64}, {csr.columns, csr.column_bits == 64}, csr.index_base};
  if (csr.offsets && made.offsets[0] != made.base)
    fail(RIIS_INVALID_MESH, "csr.offsets begins with ", made.offsets[0], "; it must begin with ", made.base);
  for (std::int64_t i = 0; i < csr.n_rows; ++i) {
    const std::int64_t begin = made.offsets[i], end = made.offsets[i + 1];
    if (end < begin)
      fail(RIIS_INVALID_MESH, "row ", i, " of the adjacency ends at ", end, ", before it begins, at ", begin);
  }
  // The offsets ascend, so no row ends after the last offset, which is the number of columns.
  for (std::int64_t i = 0; i < csr.n_rows; ++i) {
    const std::int64_t begin = made.offsets[i], end = made.offsets[i + 1];
    if (end > begin) require(csr.columns, "csr.columns");
    for (std::int64_t k = begin - made.base; k < end - made.base; ++k) {
      const std::int64_t given = made.columns[k];
      if (given < made.base || given >= n_all + made.base)
        fail(RIIS_INVALID_MESH, "row ", i, " of the adjacency has the column ", given, "; there are nodes ", made.base,
             " to ", n_all - 1 + made.base);
    }
  }
  return made;
}

riis_csr OwnAdjacency::csr() const {
  const auto n = view(offsets).size() - 1;
  const bool small = columns_64.empty();
  return {sizeof(riis_csr),
          n,
          n,
          offsets.data(),
          small ? static_cast<const void *>(columns_32.data()) : static_cast<const void *>(columns_64.data()),
          64,
          small ? 32 : 64,
          0,
          0};
}

OwnAdjacency adjacency_from_cells(const riis_mesh_cells &cells, int n_threads, const NarrowLimits &limits) {
  check_count("cells.n_nodes", cells.n_nodes, 0);
  check_count("cells.n_cells", cells.n_cells, 0);
  check_bits("cells.id_bits", cells.id_bits);
  check_base("cells.index_base", cells.index_base);
  if (cells.n_cells > 0) require(cells.node_ids, "cells.node_ids");
  return cells.id_bits == 64 ? adjacency_from_cells_with<std::int64_t>(cells, n_threads, limits)
                             : adjacency_from_cells_with<std::int32_t>(cells, n_threads, limits);
}

OwnAdjacency adjacency_from_faces(const riis_mesh_faces &faces, int n_threads) {
  check_count("faces.n_cells", faces.n_cells, 0);
  check_count("faces.n_faces", faces.n_faces, 0);
  check_bits("faces.id_bits", faces.id_bits);
  check_base("faces.index_base", faces.index_base);
  if (faces.stride < 1 || faces.stride > 1024)
    fail(RIIS_INVALID_ARGUMENT, "faces.stride is ", faces.stride, "; it must be from 1 to 1024");
  check_reserved("faces.reserved", faces.reserved);
  if (faces.n_faces > 0) {
    require(faces.owner, "faces.owner");
    require(faces.neighbor, "faces.neighbor");
  }
  const IntegerArray owner{faces.owner, faces.id_bits == 64}, neighbor{faces.neighbor, faces.id_bits == 64};
  const std::int64_t base = faces.index_base;
  // Compares the numbers before the base is subtracted, because the difference of unchecked numbers may overflow.
  const auto check = [&](const char *which, std::int64_t face, const IntegerArray &ends, std::int64_t least) {
    const std::int64_t given = ends[face * faces.stride];
    if (given < least || given >= faces.n_cells + base)
      fail(RIIS_INVALID_MESH, which, " of face ", face, " is ", given, "; there are cells ", base, " to ",
           faces.n_cells - 1 + base,
           least == base ? ""
           : base == 1   ? ", and 0 for the boundary"
                         : ", and -1 for the boundary");
  };
  for (std::int64_t face = 0; face < faces.n_faces; ++face) {
    check("owner", face, owner, base);
    check("neighbor", face, neighbor, base - 1);
  }
  return adjacency_of_lists(InnerFaces{owner, neighbor, faces.stride, base, faces.n_cells, faces.n_faces},
                            2 * faces.n_faces, n_threads, {});
}

std::int64_t nodes_of_grid(std::int64_t ni, std::int64_t nj, std::int64_t nk) {
  check_count("ni", ni, 1);
  check_count("nj", nj, 1);
  check_count("nk", nk, 1);
  if (nj > max_count / ni || nk > max_count / (ni * nj))
    fail(RIIS_LIMIT_EXCEEDED, "a grid of ", ni, " * ", nj, " * ", nk, " nodes is more than memory can hold");
  return ni * nj * nk;
}

OwnAdjacency adjacency_from_grid(std::int64_t ni, std::int64_t nj, std::int64_t nk, int n_threads) {
  return adjacency_of_lists(GridNodes{ni, nj, nk}, nodes_of_grid(ni, nj, nk), n_threads, {});
}

}  // namespace riis
