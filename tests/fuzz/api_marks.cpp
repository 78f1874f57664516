// SPDX-License-Identifier: Apache-2.0
// Calls of riis_mark_*.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "api_state.hpp"

namespace fuzz {
namespace {

ResultSlot &slot_of(Input &in, State &state) { return state.results[in.slot()]; }

struct Found {
  std::int64_t node, triangle_id;
  double distance;
  std::int32_t leaflet_id;
  bool operator==(const Found &o) const {
    return node == o.node && triangle_id == o.triangle_id && distance == o.distance && leaflet_id == o.leaflet_id;
  }
};

std::vector<Found> copy_of(const riis_mark_list &list) {
  EXPECT((list.n_nodes == 0) == (list.node_id == nullptr), "%lld nodes", static_cast<long long>(list.n_nodes));
  std::vector<Found> found;
  for (std::int64_t i = 0; i < list.n_nodes; ++i)
    found.push_back({list.node_id[i], list.triangle_id[i], list.distance[i], list.leaflet_id[i]});
  for (std::size_t i = 1; i < found.size(); ++i) EXPECT(found[i].node > found[i - 1].node, "not ascending at %zu", i);
  return found;
}

void expect_same(const std::vector<Found> &found, const std::vector<Found> &expected, const char *what) {
  for (std::size_t i = 0; i < std::min(found.size(), expected.size()); ++i)
    EXPECT(found[i] == expected[i],
           "%s %zu: node %lld at %.17g of triangle %lld, expected node %lld at %.17g of triangle %lld", what, i,
           static_cast<long long>(found[i].node), found[i].distance, static_cast<long long>(found[i].triangle_id),
           static_cast<long long>(expected[i].node), expected[i].distance,
           static_cast<long long>(expected[i].triangle_id));
  EXPECT(found.size() == expected.size(), "%s: %zu nodes, expected %zu", what, found.size(), expected.size());
}

void expect_part(const std::vector<Found> &found, const std::vector<Found> &whole, const char *what) {
  for (const Found &one : found)
    EXPECT(std::find(whole.begin(), whole.end(), one) != whole.end(), "%s: node %lld at %.17g", what,
           static_cast<long long>(one.node), one.distance);
}

// Returns every node within the limit. A query finds each node's closest point.
std::vector<Found> expected_of(const riis_surface *surface, const Nodes &nodes, double limit,
                               const std::uint8_t *mask) {
  const riis_triangles t = triangles_of(surface);
  const bool by_loop = is_small(t, nodes.n) && is_by_triangles(surface);
  std::vector<Found> found;
  for (std::int64_t i = 0; i < nodes.n; ++i) {
    if (mask && !mask[i]) continue;
    if (by_loop) {
      const Closest closest = closest_by_loop(t, nodes[i]);
      if (closest.distance <= limit)
        found.push_back({i, t.triangle_id[closest.triangle], closest.distance, t.leaflet_id[closest.triangle]});
    } else {
      const std::array<double, 3> p = nodes[i];
      riis_closest closest;
      EXPECT_OK(riis_closest_point(surface, p.data(), &closest, sizeof closest));
      if (closest.distance <= limit) found.push_back({i, closest.triangle_id, closest.distance, closest.leaflet_id});
    }
  }
  return found;
}

void check_dense(const riis_marks *result, std::int64_t n_nodes, const std::vector<Found> &marked,
                 const std::vector<Found> &within) {
  const auto n = static_cast<std::size_t>(n_nodes);
  std::vector<std::uint8_t> mark(n, 7), expected_mark(n, 0);
  std::vector<double> distance(n, -77.5), expected_distance(n, RIIS_FAR_DISTANCE);
  std::vector<std::int64_t> triangle(n, -77), expected_triangle(n, -1);
  for (const Found &one : marked) expected_mark[static_cast<std::size_t>(one.node)] = 1;
  for (const Found &one : within) {
    expected_distance[static_cast<std::size_t>(one.node)] = one.distance;
    expected_triangle[static_cast<std::size_t>(one.node)] = one.triangle_id;
  }
  // The far distance is -1. A positive far distance within the limit would be refused, and limits go up to 1e60.
  if (dense_of(result, n_nodes, -1, mark.data(), distance.data(), triangle.data(), nullptr) != RIIS_OK)
    EXPECT(false, "%s", riis_last_error());
  std::replace(expected_distance.begin(), expected_distance.end(), RIIS_FAR_DISTANCE, -1.0);
  EXPECT(mark == expected_mark && distance == expected_distance && triangle == expected_triangle,
         "dense arrays differ");
}

// Checks that the requested fields equal those of riis_closest_point, and that all other fields are missing.
void check_fields(const riis_surface *surface, const Nodes &nodes, std::int32_t fields, const riis_marks *result) {
  riis_mark_list made;
  EXPECT_OK(riis_marks_get_list(result, RIIS_LIST_WITHIN_LIMIT, &made, sizeof made));
  const auto is_as_asked = [&](const void *array, std::int32_t field) {
    return (array != nullptr) == ((fields & field) != 0 && made.n_nodes > 0);
  };
  EXPECT(is_as_asked(made.point, RIIS_FIELD_POINT) && is_as_asked(made.normal, RIIS_FIELD_NORMAL) &&
             is_as_asked(made.barycentric, RIIS_FIELD_BARYCENTRIC) && is_as_asked(made.side, RIIS_FIELD_SIDE) &&
             is_as_asked(made.rim, RIIS_FIELD_RIM) && is_as_asked(made.uv, RIIS_FIELD_UV) &&
             is_as_asked(made.velocity, RIIS_FIELD_VELOCITY) && is_as_asked(made.patch_id, RIIS_FIELD_PATCH),
         "fields %d", fields);
  for (std::int64_t i = 0; i < made.n_nodes && i < 64; ++i) {
    const std::array<double, 3> p = nodes[made.node_id[i]];
    riis_closest closest;
    EXPECT_OK(riis_closest_point(surface, p.data(), &closest, sizeof closest));
    for (int k = 0; k < 3; ++k)
      EXPECT((!made.point || made.point[3 * i + k] == closest.point[k]) &&
                 (!made.normal || made.normal[3 * i + k] == closest.normal[k]) &&
                 (!made.barycentric || made.barycentric[3 * i + k] == closest.barycentric[k]),
             "node %lld", static_cast<long long>(made.node_id[i]));
    EXPECT(!made.side || made.side[i] == closest.side, "node %lld", static_cast<long long>(made.node_id[i]));
    EXPECT(!made.rim || made.rim[i] == 0 || made.rim[i] == 1, "rim %d", made.rim[i]);
  }
}

void check_marking(Input &in, const riis_surface *surface, const MeshSlot &mesh, const riis_mark_options &options,
                   const ResultSlot &slot) {
  riis_surface_info info;
  EXPECT_OK(riis_surface_get_info(surface, &info, sizeof info));
  riis_mark_stats stats;
  EXPECT_OK(riis_marks_get_stats(slot.handle, &stats, sizeof stats));
  const std::vector<Found> marked = copy_of(marked_list(slot.handle)), within = copy_of(within_list(slot.handle));
  EXPECT(stats.n_nodes == mesh.nodes->n && stats.n_marked == static_cast<std::int64_t>(marked.size()) &&
             stats.n_within_limit == static_cast<std::int64_t>(within.size()) && stats.n_queries >= 0 &&
             stats.seconds >= 0 && stats.n_threads >= 1 && stats.n_unreached >= 0 &&
             stats.n_unreached <= stats.n_within_limit && stats.instructions >= RIIS_INSTRUCTIONS_BASELINE &&
             stats.instructions <= RIIS_INSTRUCTIONS_AVX512 &&
             (options.instructions == RIIS_INSTRUCTIONS_AUTO || options.instructions == stats.instructions ||
              !is_by_triangles(surface)),
         "%lld marked", static_cast<long long>(stats.n_marked));
  EXPECT(options.n_threads == 0 || stats.n_threads <= options.n_threads, "%d threads of %d", stats.n_threads,
         options.n_threads);
  const bool is_of_paper = options.search == RIIS_SEARCH_PAPER;
  // If clusters cannot be used, the exhaustive search runs.
  const bool may_be_clusters = options.search == RIIS_SEARCH_AUTO || options.search == RIIS_SEARCH_CLUSTERS;
  EXPECT(may_be_clusters ? stats.search == RIIS_SEARCH_EXHAUSTIVE || stats.search == RIIS_SEARCH_CLUSTERS
                         : stats.search == options.search,
         "%d", stats.search);
  EXPECT(stats.complete == (is_of_paper ? 0 : 1), "search %d, complete %d", options.search, stats.complete);
  for (std::size_t i = 0; i < marked.size(); ++i) EXPECT(marked[i].distance <= info.half_thickness, "%zu", i);
  if (mesh.was_told) check_fields(surface, *mesh.nodes, options.fields, slot.handle);

  // If a node moved to an invalid place without an update, the results cannot be compared.
  for (std::int64_t i = 0; i < mesh.nodes->n; ++i)
    for (const double x : (*mesh.nodes)[i])
      if (!(std::abs(x) <= 1e60)) return;
  const std::vector<Found> expected = expected_of(surface, *mesh.nodes, slot.distance_limit, options.node_mask);
  std::vector<Found> expected_marked;
  for (const Found &one : expected)
    if (one.distance <= info.half_thickness) expected_marked.push_back(one);
  // Clusters use copies of the coordinates, which may be out of date, so the results may differ.
  if (!mesh.was_told && stats.search == RIIS_SEARCH_CLUSTERS) return;
  if (is_of_paper || !mesh.was_told) {
    expect_part(within, expected, "within the limit");
    expect_part(marked, expected_marked, "marked");
  } else {
    expect_same(within, expected, "within the limit");
    expect_same(marked, expected_marked, "marked");
  }
  if (in.one_in(4)) check_dense(slot.handle, mesh.nodes->n, marked, within);
}

}  // namespace

void mark(Input &in, State &state) {
  ResultSlot &slot = slot_of(in, state);
  if (!slot.handle) {
    slot.handle = made_by<riis_marks>(in, [](riis_marks **made) { return riis_marks_create(made); });
    if (!slot.handle) return;
  }
  riis_surface *surface_slot = state.surfaces[in.slot()];
  const MeshSlot &mesh_slot = state.meshes[in.slot()];
  const Given<riis_surface> surface = given(in, state, State::surface, surface_slot);
  const Given<riis_mesh> mesh = given(in, state, State::mesh, mesh_slot.handle);
  const Given<riis_marks> result = given(in, state, State::result, slot.handle);
  riis_mark_options options = initialised(in, riis_mark_options_init);
  static const std::int32_t searches[] = {2, 1, 4, 0, 3, 4, 1, 2, 4, 0, 4, 5, -1};
  options.search = in.one_of(searches);
  static const std::int32_t instructions[] = {0, 0, 0, 0, 1, 1, 2, 3, 4, -1};
  options.instructions = in.one_of(instructions);
  options.n_threads = in.n_threads();
  riis_surface_info info{};
  if (surface.is_right) EXPECT_OK(riis_surface_get_info(surface.handle, &info, sizeof info));
  if (in.one_in(2)) options.distance_limit = in.one_in(4) ? in.number() : info.half_thickness * (1 + in.below(8));
  std::vector<std::uint8_t> mask(mesh_slot.handle ? static_cast<std::size_t>(mesh_slot.nodes->n) : 0);
  if (in.one_in(4)) {
    std::uint32_t bits = in.raw<std::uint16_t>();
    for (std::uint8_t &m : mask)
      m = (bits = bits * 1664525u + 1013904223u) >> 28 > 5 ? static_cast<std::uint8_t>(1 + (bits >> 30)) : 0;
    options.node_mask = mask.data();
  }
  riis_resistance resistance = initialised(in, riis_resistance_init);
  resistance.R = in.number();
  if (in.one_in(4)) options.resistance = &resistance;
  if (in.one_in(4)) options.fields = in.one_in(16) ? in.raw<std::int32_t>() : in.below(256);
  const bool by_default = in.one_in(16);
  const std::vector<Found> before = copy_of(within_list(slot.handle));
  const riis_status status = call(
      in, [&] { return riis_mark_nodes(surface.handle, mesh.handle, by_default ? nullptr : &options, result.handle); });
  const bool are_right = surface.is_right && mesh.is_right && result.is_right;
  if (!are_right) EXPECT(status == RIIS_INVALID_ARGUMENT, "%d", status);
  if (status != RIIS_OK) {
    EXPECT(status != RIIS_INVALID_MESH || !mesh_slot.was_told, "a mesh that was accepted is refused: %s",
           riis_last_error());
    expect_same(copy_of(within_list(slot.handle)), before, "after a refusal");
    return;
  }
  if (by_default) EXPECT_OK(riis_mark_options_init(&options, sizeof options));
  const bool walks = options.search == RIIS_SEARCH_NEIGHBOR || options.search == RIIS_SEARCH_PAPER;
  EXPECT(!walks || mesh_slot.adjacency, "search %d without an adjacency", options.search);
  slot.distance_limit = options.distance_limit == RIIS_AUTO ? info.half_thickness : options.distance_limit;
  check_marking(in, surface.handle, mesh_slot, options, slot);
}

void read_marks(Input &in, State &state) {
  ResultSlot &slot = slot_of(in, state);
  const Given<riis_marks> result = given(in, state, State::result, slot.handle);
  const auto stats = std::make_unique<riis_mark_stats>();
  std::memset(static_cast<void *>(stats.get()), 0x5a, sizeof *stats);
  const std::int64_t size = in.mostly<std::int64_t>(sizeof *stats);
  riis_status status = call(in, [&] { return riis_marks_get_stats(result.handle, mostly(in, stats.get()), size); });
  if (!result.is_right) EXPECT(status == RIIS_INVALID_ARGUMENT, "%d", status);
  if (status != RIIS_OK) EXPECT(stats->n_nodes == 0x5a5a5a5a5a5a5a5a, "refused counts were written");

  const auto list = std::make_unique<riis_mark_list>();
  std::memset(static_cast<void *>(list.get()), 0x5a, sizeof *list);
  const std::int64_t room = in.mostly<std::int64_t>(sizeof *list);
  const std::int32_t which = in.mostly(in.below(2));
  status = call(in, [&] { return riis_marks_get_list(result.handle, which, mostly(in, list.get()), room); });
  if (!result.is_right) EXPECT(status == RIIS_INVALID_ARGUMENT, "%d", status);
  if (status != RIIS_OK) EXPECT(list->n_nodes == 0x5a5a5a5a5a5a5a5a, "a refused list was written");

  std::int64_t n_nodes = 0;
  if (slot.handle) {
    riis_mark_stats of_slot;
    EXPECT_OK(riis_marks_get_stats(slot.handle, &of_slot, sizeof of_slot));
    n_nodes = of_slot.n_nodes;
  }
  const auto n = static_cast<std::size_t>(n_nodes);
  std::vector<std::uint8_t> marks(n, 7);
  std::vector<double> distance(n, -77.5);
  std::vector<std::int64_t> triangle(n, -77);
  std::vector<std::int32_t> leaflet(n, -77);
  const double far_distance = in.number();
  const std::int64_t n_asked = in.mostly(n_nodes);
  status = call(in, [&] {
    return dense_of(result.handle, n_asked, far_distance, mostly(in, marks.data()), mostly(in, distance.data()),
                    mostly(in, triangle.data()), mostly(in, leaflet.data()));
  });
  if (status != RIIS_OK) {
    for (std::size_t i = 0; i < n; ++i) EXPECT(marks[i] == 7 && triangle[i] == -77, "refused, but written");
    return;
  }
  EXPECT(result.is_right && n_asked == n_nodes, "%lld of %lld nodes", static_cast<long long>(n_asked),
         static_cast<long long>(n_nodes));
  EXPECT(!(far_distance >= 0 && far_distance <= slot.distance_limit), "far distance %g, limit %g", far_distance,
         slot.distance_limit);
}

namespace {

riis_leak_list list_of(const riis_leaks *leaks) {
  riis_leak_list list;
  EXPECT_OK(riis_leaks_get_list(leaks, &list, sizeof list));
  EXPECT((list.n_edges == 0) == (list.node_id == nullptr) && list.n_edges >= 0, "%lld edges",
         static_cast<long long>(list.n_edges));
  return list;
}

// Checks that the edges are in ascending order, join unmarked nodes and agree with the summary. test_leaks.c checks that all
// leaking edges are listed.
void check_leaks(const riis_marks *result, std::int64_t n_nodes, const riis_leak_list &list) {
  const std::vector<Found> marked = copy_of(marked_list(result));
  const auto is_marked = [&](std::int64_t node) {
    return std::any_of(marked.begin(), marked.end(), [&](const Found &one) { return one.node == node; });
  };
  double longest = 0, farthest = 0;
  for (std::int64_t i = 0; i < list.n_edges; ++i) {
    const std::int64_t *edge = list.node_id + 2 * i, a = edge[0], b = edge[1];
    EXPECT(a >= 0 && a < b && b < n_nodes, "edge %lld %lld", static_cast<long long>(a), static_cast<long long>(b));
    EXPECT(i == 0 || edge[-2] < a || (edge[-2] == a && edge[-1] < b), "not ascending at %lld",
           static_cast<long long>(i));
    EXPECT(!is_marked(a) && !is_marked(b), "a marked node of edge %lld %lld", static_cast<long long>(a),
           static_cast<long long>(b));
    longest = std::max(longest, list.length[i]);
    farthest = std::max(farthest, list.distance[i]);
  }
  EXPECT(list.longest_length == longest && list.half_thickness == farthest && list.seconds >= 0 &&
             (list.n_edges > 0 || list.longest_node_id[0] == -1),
         "%lld edges", static_cast<long long>(list.n_edges));
}

}  // namespace

void find_leaks(Input &in, State &state) {
  ResultSlot &slot = slot_of(in, state);
  riis_surface *surface_slot = state.surfaces[in.slot()];
  const MeshSlot &mesh_slot = state.meshes[in.slot()];
  const Given<riis_surface> surface = given(in, state, State::surface, surface_slot);
  const Given<riis_mesh> mesh = given(in, state, State::mesh, mesh_slot.handle);
  const Given<riis_marks> result = given(in, state, State::result, slot.handle);
  riis_mark_options options = initialised(in, riis_mark_options_init);
  options.n_threads = in.n_threads();
  riis_leaks *&leaks_slot = state.leaks[in.slot()];
  if (!leaks_slot) leaks_slot = made_by<riis_leaks>(in, [](riis_leaks **made) { return riis_leaks_create(made); });
  if (!leaks_slot) return;
  const Given<riis_leaks> leaks = given(in, state, State::leak, leaks_slot);
  const std::int64_t n_before = list_of(leaks_slot).n_edges;
  const riis_status status = call(in, [&] {
    return riis_find_leaks(surface.handle, mesh.handle, result.handle, in.one_in(2) ? &options : nullptr, leaks.handle);
  });
  if (!(surface.is_right && mesh.is_right && result.is_right && leaks.is_right))
    EXPECT(status == RIIS_INVALID_ARGUMENT, "%d", status);
  if (status != RIIS_OK) {
    EXPECT(list_of(leaks_slot).n_edges == n_before, "a refused call changed the edges");
    return;
  }
  EXPECT(mesh_slot.adjacency, "leaks without an adjacency");
  check_leaks(slot.handle, mesh_slot.nodes->n, list_of(leaks_slot));
}

}  // namespace fuzz
