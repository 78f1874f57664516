// SPDX-License-Identifier: Apache-2.0
#include "seal/seal.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

#include "base/errors.hpp"
#include "base/recycled.hpp"
#include "parallel/parallel_for.hpp"
#include "pipeline/mark_nodes.hpp"
#include "search/band_nodes.hpp"
#include "search/search.hpp"

namespace riis {
namespace {

// For each node there is a least half thickness that marks it, and the nodes are ordered by this number. Without an offset, the
// number is the node's distance.

// Returns the least half thickness that marks all of these nodes. Refuses nodes in the band.
double largest_thickness(const SearchRequest &request, const char *name, ArrayView<const std::int64_t> ids) {
  constexpr std::int64_t nodes_per_task = 256, few = 2048;
  const int n_threads = request.n_threads.for_part(ids.size(), few);
  const double half_thickness = request.surface.half_thickness();
  const NodePlaces places(request);
  std::vector<double> marking;
  resize(marking, ids.size());
  parallel_for_ranges(ids.size(), nodes_per_task, n_threads, [&](const Range &range, int) {
    for (std::int64_t i = range.begin; i < range.end; ++i) {
      const Vec3 p = checked_node(request.mesh.nodes(), ids[i]);
      const double d = view(marking)[i] = places.of(p).half_thickness;
      if (!(d > half_thickness))
        fail(RIIS_INVALID_ARGUMENT, "ends.", name, "[", i, "] is node ", ids[i], ", in the band: ",
             request.surface.band().steps_aside() ? "the half thickness that marks it, "
                                                  : "its distance to the surface, ",
             d, ", is at most the half thickness, ", half_thickness);
    }
  });
  return *std::max_element(marking.begin(), marking.end());
}

// A node that has not been opened yet.
struct Candidate {
  double distance;  // the half thickness that marks it
  std::int64_t node;

  // Puts the farthest node first. If distances are equal, the node with the lowest id comes first.
  bool operator<(const Candidate &other) const {
    return distance != other.distance ? distance > other.distance : node < other.node;
  }
};

// An edge between `node` and `other` that is listed only in the row of `other`.
struct OneWayEdge {
  std::int64_t node, other;

  bool operator<(const OneWayEdge &edge) const { return node != edge.node ? node < edge.node : other < edge.other; }
};

// Opens nodes, the farthest first, until open nodes connect the ends of the passage.
template <class Edges>
class Opening {
 public:
  Opening(const SearchRequest &request, const Edges &edges, const PassageEnds &ends)
      : request_(request),
        edges_(edges),
        from_(request.mesh.nodes().n),
        to_(from_ + 1),
        from_ids_(ends.from.begin(), ends.from.end()),
        to_ids_(ends.to.begin(), ends.to.end()) {
    resize(parent_, from_ + 2);
    std::sort(from_ids_.begin(), from_ids_.end());
    std::sort(to_ids_.begin(), to_ids_.end());
  }

  // Opens the nodes that the half thickness `limit` leaves unmarked. Returns whether the open nodes join the ends.
  bool joins_beyond(double limit) {
    const Band band = request_.surface.band().with(limit);
    SearchRequest within = request_;
    within.distance_limit = band.reach();
    mark_nodes(within, {RIIS_SEARCH_AUTO, 0, nullptr, band.steps_aside() ? &band : nullptr}, near_);
    label_open_regions(edges_, {request_.mesh.nodes(), request_.node_mask, near_.within.nodes.node_id},
                       request_.n_threads, view(parent_));
    OpenSets sets = this->sets();
    sets.open(from_);
    sets.open(to_);
    for (const std::int64_t node : from_ids_)
      if (sets.is_open(node)) sets.unite(node, from_);
    for (const std::int64_t node : to_ids_)
      if (sets.is_open(node)) sets.unite(node, to_);
    return is_joined();
  }

  // Opens those closed nodes that are farther than `nearest`, one by one, until a node joins the two ends. Returns this node. If
  // no node joins the ends, returns a candidate with the id -1.
  Candidate open_until_joined(double nearest) {
    const std::vector<OneWayEdge> one_way = one_way_edges();
    OpenSets sets = this->sets();
    for (const Candidate &next : candidates(nearest)) {
      const std::int64_t node = next.node;
      sets.open(node);
      edges_.for_each_neighbor(node, [&](std::int64_t other) {
        if (sets.is_open(other)) sets.unite(node, other);
      });
      for (auto edge = std::lower_bound(one_way.begin(), one_way.end(), OneWayEdge{node, 0});
           edge != one_way.end() && edge->node == node; ++edge)
        if (sets.is_open(edge->other)) sets.unite(node, edge->other);
      if (std::binary_search(from_ids_.begin(), from_ids_.end(), node)) sets.unite(node, from_);
      if (std::binary_search(to_ids_.begin(), to_ids_.end(), node)) sets.unite(node, to_);
      if (is_joined()) return next;
    }
    return {0, -1};
  }

 private:
  OpenSets sets() { return OpenSets(view(parent_)); }
  bool is_joined() { return sets().root(from_) == sets().root(to_); }

  std::vector<Candidate> candidates(double nearest) const {
    const NodeList &within = near_.within.nodes;
    const Band &band = near_.band;
    std::vector<Candidate> made;
    for (std::int64_t i = 0; i < within.size(); ++i) {
      const double distance = view(within.distance)[i];
      const double marking =
          band.steps_aside() ? band.marking_thickness(distance, view(near_.within.fields.height)[i]) : distance;
      if (marking > nearest) made.push_back({marking, view(within.node_id)[i]});
    }
    std::sort(made.begin(), made.end());
    return made;
  }

  // Returns the edges that lead to a closed node but are not listed in the row of this node. Most adjacencies are symmetric and
  // have no such edges.
  std::vector<OneWayEdge> one_way_edges() {
    constexpr std::int64_t rows_per_task = 4096;
    if (Edges::is_symmetric) return {};
    std::vector<std::vector<OneWayEdge>> by_thread;
    resize(by_thread, request_.n_threads);
    const OpenSets sets = this->sets();
    parallel_for_ranges(edges_.n_rows, rows_per_task, request_.n_threads, [&](const Range &range, int thread) {
      for (std::int64_t i = range.begin; i < range.end; ++i)
        edges_.for_each_neighbor(i, [&](std::int64_t j) {
          if (!sets.is_open(j) && !edges_.has_neighbor(j, i)) view(by_thread)[thread].push_back({j, i});
        });
    });
    std::vector<OneWayEdge> all;
    for (const auto &edges : by_thread) all.insert(all.end(), edges.begin(), edges.end());
    std::sort(all.begin(), all.end());
    return all;
  }

  const SearchRequest &request_;
  const Edges &edges_;
  std::int64_t from_, to_;  // two extra nodes; each is joined to all nodes of one end
  std::vector<std::int64_t> from_ids_, to_ids_;
  Marks near_;
  UnfilledVector<std::int64_t> parent_;
};

// Returns a half thickness that marks every node.
double thickest(const Band &band) { return 10 * max_coordinate / (1 - std::abs(band.offset)); }

template <class Edges>
riis_passage find_passage_along(const SearchRequest &request, const Edges &edges, const PassageEnds &ends) {
  const auto start = std::chrono::steady_clock::now();
  const double half_thickness = request.surface.half_thickness(), beyond_all = thickest(request.surface.band());
  // A path includes its two ends. As the half thickness grows, some node of the path is therefore marked no later than either
  // end.
  const double widest =
      std::min(largest_thickness(request, "from", ends.from), largest_thickness(request, "to", ends.to));
  Opening<Edges> opening(request, edges, ends);
  double limit = half_thickness, beyond = -1, growth = 2;
  for (int step = 0; opening.joins_beyond(limit); ++step) {
    beyond = limit;
    if (step >= 4) growth *= growth;  // the radius must grow faster for a surface that is tiny compared with the mesh
    limit = std::min(growth * limit, limit < widest ? widest : beyond_all);
  }
  const Candidate nearest = opening.open_until_joined(beyond);
  riis_passage passage{-1, 0, {0, 0, 0}, 0, RIIS_PASSAGE_NONE, 0};
  if (nearest.node >= 0) {
    const Vec3 p = request.mesh.nodes()[nearest.node];
    passage = {nearest.node,
               nearest.distance,
               {p.x, p.y, p.z},
               0,
               nearest.distance > half_thickness ? RIIS_PASSAGE_OPEN : RIIS_PASSAGE_CLOSED,
               0};
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  passage.seconds = elapsed.count();
  return passage;
}

}  // namespace

riis_passage find_passage(const SearchRequest &request, const PassageEnds &ends) {
  return with_edges(request.mesh, [&](const auto &edges) { return find_passage_along(request, edges, ends); });
}

template <class Edges>
std::int64_t label_open_regions(const Edges &edges, const OpenNodes &open, int n_threads,
                                ArrayView<std::int64_t> label) {
  constexpr std::int64_t rows_per_task = 4096;
  const std::int64_t n = edges.n_rows;
  OpenSets sets(label);
  parallel_for_ranges(n, rows_per_task, n_threads, [&](const Range &range, int) {
    for (std::int64_t i = range.begin; i < range.end; ++i)
      label[i] = !open.nodes.has_node(i) || (open.node_mask && !open.node_mask[i]) ? OpenSets::closed : i;
  });
  for (const std::int64_t i : open.closed_id) label[i] = OpenSets::closed;
  parallel_for_ranges(n, rows_per_task, n_threads, [&](const Range &range, int) {
    for (std::int64_t i = range.begin; i < range.end; ++i) {
      if (!sets.is_open(i)) continue;
      edges.for_each_neighbor(i, [&](std::int64_t j) {
        if (sets.is_open(j)) sets.unite(i, j);
      });
    }
  });
  std::atomic<std::int64_t> n_regions{0};
  parallel_for_ranges(n, rows_per_task, n_threads, [&](const Range &range, int) {
    std::int64_t n_roots = 0;
    for (std::int64_t i = range.begin; i < range.end; ++i) n_roots += sets.is_open(i) && sets.flatten(i) == i;
    n_regions.fetch_add(n_roots, std::memory_order_relaxed);
  });
  return n_regions;
}

template std::int64_t label_open_regions(const Adjacency &, const OpenNodes &, int, ArrayView<std::int64_t>);
template std::int64_t label_open_regions(const GridEdges &, const OpenNodes &, int, ArrayView<std::int64_t>);

}  // namespace riis
