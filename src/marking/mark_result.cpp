// SPDX-License-Identifier: Apache-2.0
#include "marking/mark_result.hpp"

#include <algorithm>

namespace riis {

// By half more than needed, so that a valve that moves does not want more memory with every new largest number.
void NodeList::reserve(std::size_t n) {
  if (n <= node_id.capacity() && n <= leaflet_id.capacity()) return;
  n += n / 2;
  node_id.reserve(n);
  distance.reserve(n);
  triangle_id.reserve(n);
  leaflet_id.reserve(n);
}

void NodeList::resize(std::size_t n) {
  node_id.resize(n);
  distance.resize(n);
  triangle_id.resize(n);
  leaflet_id.resize(n);
}

void NodeList::set(std::size_t i, std::int64_t node, double node_distance, std::int64_t triangle,
                   std::int32_t leaflet) {
  node_id[i] = node;
  distance[i] = node_distance;
  triangle_id[i] = triangle;
  leaflet_id[i] = leaflet;
}

void Collection::prepare(int n_threads) {
  if (by_thread.size() < static_cast<std::size_t>(n_threads)) by_thread.resize(static_cast<std::size_t>(n_threads));
  // Which thread finds how much differs from step to step: each gets room for what any had.
  std::size_t largest = 0;
  for (const auto &found : by_thread) largest = std::max(largest, found.capacity());
  for (auto &found : by_thread) {
    found.clear();
    found.reserve(largest);
  }
}

void Collection::sort(std::int64_t n_nodes) {
  // By counting how many fall into each stretch of nodes, then within the stretches.
  constexpr std::int64_t nodes_per_block = 1024;
  const auto block_of = [](const FoundNode &found) { return static_cast<std::size_t>(found.node / nodes_per_block); };
  blocks.assign(static_cast<std::size_t>((n_nodes + nodes_per_block - 1) / nodes_per_block), {0, 0, 0});
  std::size_t n = 0;
  for (const auto &found : by_thread)
    for (const FoundNode &node : found) ++blocks[block_of(node)].end, ++n;
  sorted_.resize(n);
  std::size_t begin = 0;
  for (Block &block : blocks) {
    const std::size_t size = block.end;
    block = {0, begin, begin};
    begin += size;
  }
  for (const auto &found : by_thread)
    for (const FoundNode &node : found) sorted_[blocks[block_of(node)].end++] = node;
  for (const Block &block : blocks)
    std::sort(sorted_.begin() + static_cast<std::ptrdiff_t>(block.begin),
              sorted_.begin() + static_cast<std::ptrdiff_t>(block.end),
              [](const FoundNode &a, const FoundNode &b) { return a.node < b.node; });
  std::swap(sorted_, by_thread[0]);
}

void Collection::Walked::prepare(std::int64_t n_nodes, int n_threads) {
  const auto n = static_cast<std::size_t>(n_nodes), n_slots = static_cast<std::size_t>(n_threads);
  if (n_nodes != n_marks_ || walk_ == 255) {
    if (n_nodes != n_marks_) marks_ = std::make_unique<std::atomic<std::uint8_t>[]>(n);
    n_marks_ = n_nodes;
    for (std::size_t i = 0; i < n; ++i) marks_[i].store(0, std::memory_order_relaxed);
    walk_ = 0;
  }
  ++walk_;
  queue.resize(n);
  if (threads.size() < n_slots) threads.resize(n_slots);
  std::size_t largest = 0;
  for (const Thread &thread : threads) largest = std::max(largest, thread.near_groups.capacity());
  for (Thread &thread : threads) {
    thread.clear();
    thread.next.reserve(static_cast<std::size_t>(nodes_per_range));
    thread.near_groups.reserve(largest);
  }
}

}  // namespace riis
