// SPDX-License-Identifier: Apache-2.0
#include "seal/seal.hpp"

#include <algorithm>
#include <chrono>
#include <tuple>

#include "common/array_view.hpp"
#include "parallel/parallel_for.hpp"
#include "search/band_nodes.hpp"
#include "search/search.hpp"

namespace riis {
namespace {

struct Edge {
  std::int64_t a, b;  // a < b
  double length;

  bool operator<(const Edge &other) const { return std::tie(a, b) < std::tie(other.a, other.b); }
  bool operator==(const Edge &other) const { return a == other.a && b == other.b; }
};

// Returns a length up to which no edge can leak. If an edge of at most this length meets the surface in a point, one of its nodes
// is at most half the length away from this point. This node is thus within the half thickness, and therefore marked. With an
// offset, the length is smaller, because only nodes within a smaller distance are certainly in the band. The length includes
// margins of several times the rounding error, so it also holds for computed distances. Returns -1, so that no edge counts as
// short, in two cases: marks may be missing, or the distances were not measured to the triangles.
double length_that_cannot_leak(const Surface &surface, const Marks &marks) {
  if (surface.other_distance() || !marks.stats.complete) return -1;
  return 2 * surface.band().sure_distance() * (1 - 0x1p-40) - 4 * surface.scene().rounding();
}

// The search of one thread, with its memory.
template <class Edges>
struct alignas(64) Finder {
  const SearchRequest *request = nullptr;
  const Edges *edges = nullptr;
  const std::vector<std::int64_t> *marked = nullptr;
  const NodePlaces *places = nullptr;
  double too_short = 0;
  std::vector<std::int32_t> room;
  std::vector<Edge> found;

  bool is_open(std::int64_t node) const {
    return !request->is_masked_out(node) && !std::binary_search(marked->begin(), marked->end(), node);
  }

  bool crosses(Vec3 p, Vec3 q) {
    const TriangleScene &scene = request->surface.scene();
    const double *corners = scene.groups().corners.data();
    bool crosses = false;
    scene.for_each_along(p, q, room, [&](std::int32_t triangle) {
      const double *c = corners + 9 * static_cast<std::ptrdiff_t>(triangle);
      crosses = crosses || segment_meets_triangle(p, q, {{{c[0], c[1], c[2]}, {c[3], c[4], c[5]}, {c[6], c[7], c[8]}}});
    });
    return crosses;
  }

  // With an offset, an edge may cut across a sharp fold of the surface. Both ends of the edge are then outside the band, and on
  // the same side of the surface.
  bool only_cuts_off_fold(Vec3 p, Vec3 q) const {
    if (!request->surface.band().steps_aside()) return false;
    const NodePlace from = places->of(p), to = places->of(q);
    return !from.is_beyond_rim && !to.is_beyond_rim && from.side == to.side;
  }

  // Returns false only if no point of the surface is within the radius of p. One such query often makes the queries of many edges
  // unnecessary. The margin is several times the rounding error, including that of p, which lies near the surface.
  bool may_be_within(Vec3 p, double radius) const {
    const TriangleScene &scene = request->surface.scene();
    return scene.closest(p, radius * (1 + 1e-9) + 4 * scene.rounding(), request->instructions).triangle >= 0;
  }

  void search_block(const EdgeBlocks::Block &block, std::int64_t begin) {
    const Bounds &bounds = block.bounds;
    if (block.longest <= too_short || !overlap(bounds, request->surface.scene().bounds())) return;
    if (!may_be_within(bounds.middle(), length(bounds.half_extent()))) return;
    const std::int64_t end = std::min(begin + EdgeBlocks::rows_per_block, request->mesh.nodes().n);
    for (std::int64_t i = begin; i < end; ++i) search_row(i);
  }

  // Searches the edges that lead from the nodes of a box of the grid to nodes with higher numbers.
  void search_box(const Grid &grid, const GridBox &box) {
    constexpr std::int64_t few = 64;
    GridBox ends = box;
    for (int axis = 0; axis < 3; ++axis) ends.end[axis] = std::min(box.end[axis] + 1, grid.size(axis));
    const Bounds bounds{grid.at(box.begin), grid.at({ends.end[0] - 1, ends.end[1] - 1, ends.end[2] - 1})};
    if (grid.longest_edge(ends) <= too_short || !overlap(bounds, request->surface.scene().bounds())) return;
    if (!may_be_within(bounds.middle(), length(bounds.half_extent()))) return;
    const std::int64_t n = box.n_nodes();
    if (n <= few) {
      for (std::int64_t t = 0; t < n; ++t) search_row(grid.number(box[t]));
      return;
    }
    int axis = 0;
    for (int other = 1; other < 3; ++other)
      if (box.size(other) > box.size(axis)) axis = other;
    GridBox halves[2] = {box, box};
    halves[0].end[axis] = halves[1].begin[axis] = box.begin[axis] + box.size(axis) / 2;
    for (const GridBox &half : halves) search_box(grid, half);
  }

  void search_row(std::int64_t i) {
    const MeshNodes &nodes = request->mesh.nodes();
    const Vec3 p = checked_node(nodes, i);
    double longest = 0;
    edges->for_each_neighbor(i, [&](std::int64_t j) { longest = std::max(longest, distance(p, nodes[j])); });
    if (longest <= too_short || !is_open(i) || !may_be_within(p, longest)) return;
    edges->for_each_neighbor(i, [&](std::int64_t j) {
      if (j < i && edges->has_neighbor(j, i)) return;  // the edge was found in row j
      const Vec3 q = checked_node(nodes, j);
      const double length = distance(p, q);
      if (length <= too_short || !is_open(j)) return;
      // Each edge is examined from its lower node to its higher node, even if it was found in the row of the higher node.
      if (crosses(i < j ? p : q, i < j ? q : p) && !only_cuts_off_fold(p, q))
        found.push_back({std::min(i, j), std::max(i, j), length});
    });
  }
};

// Searches the edges of points, block by block.
void search_edges(const SearchRequest &request, double too_short, std::vector<Finder<Adjacency>> &finders) {
  constexpr std::int64_t blocks_per_task = 16;
  const EdgeBlocks &edges = request.mesh.edges(request.n_threads);
  if (edges.longest <= too_short) return;
  const auto search = [&](const Range &range, int thread) {
    for (std::int64_t k = range.begin; k < range.end; ++k)
      view(finders)[thread].search_block(view(edges.blocks)[k], k * EdgeBlocks::rows_per_block);
  };
  parallel_for_ranges(view(edges.blocks).size(), blocks_per_task, request.n_threads, search);
}

// Searches the edges of a grid in cubes of nodes.
void search_edges(const SearchRequest &request, double, std::vector<Finder<GridEdges>> &finders) {
  constexpr std::int64_t side = 16;
  const Grid &grid = *request.mesh.nodes().grid;
  GridBox box = grid.within(request.surface.scene().bounds());
  GridBox cubes{{0, 0, 0}, {0, 0, 0}};
  for (int axis = 0; axis < 3; ++axis) {
    box.begin[axis] = std::max<std::int64_t>(box.begin[axis] - 1, 0);  // an edge from this node leads into the box
    cubes.end[axis] = (box.size(axis) + side - 1) / side;
  }
  parallel_for(cubes.n_nodes(), request.n_threads, [&](std::int64_t i, int thread) {
    const GridIndex cube = cubes[i];
    GridBox nodes = box;
    for (int axis = 0; axis < 3; ++axis) {
      nodes.begin[axis] = box.begin[axis] + side * cube[axis];
      nodes.end[axis] = std::min(nodes.begin[axis] + side, box.end[axis]);
    }
    view(finders)[thread].search_box(grid, nodes);
  });
}

template <class Edges>
std::vector<Edge> leaking_edges(const SearchRequest &request, const Edges &edges, const Marks &marks) {
  std::vector<Edge> found;
  const double too_short = length_that_cannot_leak(request.surface, marks);
  std::vector<Finder<Edges>> finders;
  resize(finders, request.n_threads);
  const NodePlaces places(request);
  for (Finder<Edges> &finder : finders) {
    finder.request = &request;
    finder.edges = &edges;
    finder.marked = &marks.marked_nodes().node_id;
    finder.places = &places;
    finder.too_short = too_short;
  }
  search_edges(request, too_short, finders);
  for (const Finder<Edges> &finder : finders) found.insert(found.end(), finder.found.begin(), finder.found.end());
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());  // the caller's rows may repeat columns
  return found;
}

Leaks listed(const SearchRequest &request, const std::vector<Edge> &edges) {
  constexpr std::int64_t edges_per_task = 64, few = 512;
  const int n_threads = request.n_threads.for_part(view(edges).size(), few);
  const MeshNodes &nodes = request.mesh.nodes();
  const NodePlaces places(request);
  Leaks list;
  list.node_id.resize(2 * edges.size());
  list.length.resize(edges.size());
  list.distance.resize(edges.size());
  parallel_for_ranges(view(edges).size(), edges_per_task, n_threads, [&](const Range &range, int) {
    for (std::int64_t i = range.begin; i < range.end; ++i) {
      const Edge &edge = view(edges)[i];
      view(list.node_id)[2 * i] = edge.a;
      view(list.node_id)[2 * i + 1] = edge.b;
      view(list.length)[i] = edge.length;
      // The least half thickness at which at least one end of the edge is marked. The computed number has the same bits as in a
      // marking.
      view(list.distance)[i] =
          std::min(places.of(nodes[edge.a]).half_thickness, places.of(nodes[edge.b]).half_thickness);
    }
  });
  return list;
}

void find_longest(const MeshNodes &nodes, Leaks &leaks) {
  if (leaks.length.empty()) return;
  const std::int64_t longest = std::max_element(leaks.length.begin(), leaks.length.end()) - leaks.length.begin();
  for (int end = 0; end < 2; ++end) leaks.longest_node_id[end] = view(leaks.node_id)[2 * longest + end];
  leaks.longest_length = view(leaks.length)[longest];
  leaks.longest_middle = mix(nodes[leaks.longest_node_id[0]], nodes[leaks.longest_node_id[1]], 0.5);
  leaks.half_thickness = *std::max_element(leaks.distance.begin(), leaks.distance.end());
}

}  // namespace

Leaks find_leaks(const SearchRequest &request, const Marks &marks) {
  const auto start = std::chrono::steady_clock::now();
  if (request.mesh.nodes().n == 0) return {};
  Leaks leaks = listed(
      request, with_edges(request.mesh, [&](const auto &edges) { return leaking_edges(request, edges, marks); }));
  find_longest(request.mesh.nodes(), leaks);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  leaks.seconds = elapsed.count();
  return leaks;
}

}  // namespace riis
