// SPDX-License-Identifier: Apache-2.0
// Disjoint sets of nodes that several threads unite at the same time without locks. An array holds each node's parent, which is
// a lower node. So the root of a set is its lowest node, in any order of the unions.
#pragma once

#include <cstdint>

#include "common/array_view.hpp"

namespace riis {

class OpenSets {
 public:
  static constexpr std::int64_t closed = -1;  // the parent of a node that is in no set

  // Borrows the array of parents. Each entry must be `closed`, the node itself, or a lower node of the same set.
  explicit OpenSets(ArrayView<std::int64_t> parent) : parent_(parent) {}

  bool is_open(std::int64_t node) const { return load(node) != closed; }
  // Puts the node into a new set of its own.
  void open(std::int64_t node) { parent_[node] = node; }

  // Returns the lowest node of the set. Also halves the path to it, which makes later calls faster.
  std::int64_t root(std::int64_t node) {
    for (;;) {
      std::int64_t parent = load(node);
      const std::int64_t above = load(parent);
      if (above == parent) return parent;
      replace(node, parent, above);  // may fail: another thread may have found a still lower parent
      node = above;
    }
  }

  // Makes the lowest node of the set the node's parent, and returns it. Must not run while other threads unite sets.
  std::int64_t flatten(std::int64_t node) {
    const std::int64_t lowest = root(node);
    __atomic_store_n(&parent_[node], lowest, __ATOMIC_RELAXED);
    return lowest;
  }

  void unite(std::int64_t a, std::int64_t b) {
    for (;;) {
      a = root(a);
      b = root(b);
      if (a == b) return;
      if (replace(a < b ? b : a, a < b ? b : a, a < b ? a : b)) return;
      // Another thread has given the higher root a parent, so the loop tries again.
    }
  }

 private:
  // Relaxed atomic operations are enough here. No other data depends on the parents, and the end of the parallel loop orders
  // everything else.
  std::int64_t load(std::int64_t node) const { return __atomic_load_n(&parent_[node], __ATOMIC_RELAXED); }
  bool replace(std::int64_t node, std::int64_t before, std::int64_t parent) {
    return __atomic_compare_exchange_n(&parent_[node], &before, parent, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED);
  }

  ArrayView<std::int64_t> parent_;
};

}  // namespace riis
