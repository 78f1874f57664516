// SPDX-License-Identifier: Apache-2.0
// Fuzzes meshes that are given by the axes of a grid. A grid is made, or refused with a reason. A mesh from the grid and a mesh
// from the grid's points give the same marks, leaks and open regions. Some numbers of a grid belong to no node, and no result
// contains them.
#include <riis/riis.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "input.hpp"

namespace {

using fuzz::Input;

constexpr std::int64_t most_numbers = 4096;  // larger arrays would only waste time

struct Surface {
  riis_surface *handle = nullptr;
  explicit Surface(double opening) {
    riis_valve *valve = nullptr;
    EXPECT(riis_valve_create("aortic", &valve) == RIIS_OK, "%s", riis_last_error());
    EXPECT(riis_valve_set_scalar(valve, "opening", opening) == RIIS_OK, "%s", riis_last_error());
    riis_surface_options options;
    EXPECT(riis_surface_options_init(&options, sizeof options) == RIIS_OK, "%s", riis_last_error());
    options.half_thickness = 0.25;
    options.tolerance = 1;
    EXPECT(riis_surface_create(valve, &options, &handle) == RIIS_OK, "%s", riis_last_error());
    riis_valve_destroy(&valve);
  }
};

// A grid with its axes. The numbers of the nodes are in ascending order.
struct Case {
  riis_grid grid;
  std::array<std::vector<double>, 3> axes;
  bool is_spoilt = false;
};

std::vector<double> axis_of(Input &in) {
  std::vector<double> axis;
  const int n = 1 + in.below(10);
  double x = in.sound_place();
  for (int i = 0; i < n; ++i) {
    axis.push_back(x);
    x += (1 + in.below(16)) / 16.0;
  }
  return axis;
}

Case case_of(Input &in) {
  Case made;
  EXPECT(riis_grid_init(&made.grid, sizeof made.grid) == RIIS_OK, "%s", riis_last_error());
  for (std::vector<double> &axis : made.axes) axis = axis_of(in);
  riis_grid &grid = made.grid;
  grid.ni = static_cast<std::int64_t>(made.axes[0].size());
  grid.nj = static_cast<std::int64_t>(made.axes[1].size());
  grid.nk = static_cast<std::int64_t>(made.axes[2].size());
  if (in.below(2) == 1) {
    static const std::array<std::array<int, 3>, 6> orders = {
        {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
    const std::int64_t n[3] = {grid.ni, grid.nj, grid.nk};
    std::int64_t way = 0;
    for (const int axis : orders[static_cast<std::size_t>(in.below(6))]) {
      grid.stride[axis] = way + 1 + in.below(3);
      way += (n[axis] - 1) * grid.stride[axis];
    }
    grid.first = in.below(20);
    grid.n_nodes = grid.first + way + 1 + in.below(9);
  }
  grid.x = made.axes[0].data(), grid.y = made.axes[1].data(), grid.z = made.axes[2].data();
  made.is_spoilt = in.one_in(4);
  if (!made.is_spoilt) return made;
  static const std::int64_t wrong[] = {0,         -1,        1,         7,        INT64_MIN, INT64_MAX, INT64_MAX / 3,
                                       1LL << 20, 1LL << 39, 1LL << 40, 1LL << 41};
  std::int64_t *const numbers[] = {&grid.first, &grid.stride[0], &grid.stride[1], &grid.stride[2], &grid.n_nodes};
  if (in.one_in(3)) {
    std::vector<double> &axis = made.axes[static_cast<std::size_t>(in.below(3))];
    axis[static_cast<std::size_t>(in.below(static_cast<int>(axis.size())))] = in.number();
  } else {
    *in.one_of(numbers) = in.one_of(wrong);
  }
  return made;
}

// Fails if a refusal does not name the grid.
bool is_made(riis_status status) {
  if (status == RIIS_OK) return true;
  const char *const text = riis_last_error();
  EXPECT(status == RIIS_INVALID_MESH || status == RIIS_INVALID_ARGUMENT || status == RIIS_LIMIT_EXCEEDED, "%d: %s",
         status, text);
  EXPECT(std::strncmp(text, "grid.", 5) == 0, "the text '%s'", text);
  return false;
}

// The nodes of the grid as points. Each point has the number of its node.
struct Points {
  std::vector<double> xyz;
  std::vector<std::int64_t> number;
  riis_mesh *mesh = nullptr;
  riis_adjacency *edges = nullptr;
};

// Computes the number of each node from the grid's fields, and sorts the nodes by these numbers.
Points points_of(const Case &of, std::int64_t n_numbers) {
  const riis_grid &grid = of.grid;
  const std::int64_t n[3] = {grid.ni, grid.nj, grid.nk};
  const bool is_default = grid.stride[0] == 0 && grid.stride[1] == 0 && grid.stride[2] == 0;
  const std::int64_t stride[3] = {is_default ? 1 : grid.stride[0], is_default ? n[0] : grid.stride[1],
                                  is_default ? n[0] * n[1] : grid.stride[2]};
  std::vector<std::int64_t> node_of(static_cast<std::size_t>(n_numbers), -1);
  for (std::int64_t t = 0; t < n[0] * n[1] * n[2]; ++t) {
    const std::int64_t at[3] = {t % n[0], t / n[0] % n[1], t / n[0] / n[1]};
    std::int64_t number = grid.first;
    for (int c = 0; c < 3; ++c) number += n[c] > 1 ? at[c] * stride[c] : 0;
    EXPECT(number >= 0 && number < n_numbers, "number %lld", static_cast<long long>(number));
    EXPECT(node_of[static_cast<std::size_t>(number)] < 0, "two nodes have one number");
    node_of[static_cast<std::size_t>(number)] = t;
  }
  Points made;
  std::vector<std::int64_t> order(static_cast<std::size_t>(n[0] * n[1] * n[2])), owner, neighbor;
  for (std::int64_t number = 0; number < n_numbers; ++number) {
    const std::int64_t t = node_of[static_cast<std::size_t>(number)];
    if (t < 0) continue;
    order[static_cast<std::size_t>(t)] = static_cast<std::int64_t>(made.number.size());
    made.number.push_back(number);
    const std::int64_t at[3] = {t % n[0], t / n[0] % n[1], t / n[0] / n[1]};
    for (std::size_t c = 0; c < 3; ++c) made.xyz.push_back(of.axes[c][static_cast<std::size_t>(at[c])]);
  }
  const std::int64_t step[3] = {1, n[0], n[0] * n[1]};
  for (std::int64_t t = 0; t < n[0] * n[1] * n[2]; ++t) {
    const std::int64_t at[3] = {t % n[0], t / n[0] % n[1], t / n[0] / n[1]};
    for (int c = 0; c < 3; ++c) {
      if (at[c] + 1 == n[c]) continue;
      owner.push_back(order[static_cast<std::size_t>(t)]);
      neighbor.push_back(order[static_cast<std::size_t>(t + step[c])]);
    }
  }
  const auto n_nodes = static_cast<std::int64_t>(made.number.size());
  const double *const x = made.xyz.data();
  EXPECT(riis_mesh_create(n_nodes, x, x + 1, x + 2, 3, &made.mesh) == RIIS_OK, "%s", riis_last_error());
  riis_mesh_faces faces;
  EXPECT(riis_mesh_faces_init(&faces, sizeof faces) == RIIS_OK, "%s", riis_last_error());
  faces.n_cells = n_nodes;
  faces.n_faces = static_cast<std::int64_t>(owner.size());
  faces.owner = owner.data(), faces.neighbor = neighbor.data();
  faces.id_bits = 64;
  EXPECT(riis_adjacency_create_from_faces(&faces, &made.edges) == RIIS_OK, "%s", riis_last_error());
  riis_csr rows;
  EXPECT(riis_adjacency_get_csr(made.edges, &rows, sizeof rows) == RIIS_OK, "%s", riis_last_error());
  EXPECT(riis_mesh_set_adjacency(made.mesh, &rows) == RIIS_OK, "%s", riis_last_error());
  return made;
}

// The results of riis for a mesh.
struct Found {
  riis_marks *marks = nullptr;
  riis_leaks *leaks = nullptr;
  riis_mark_list list;
  riis_leak_list edges;
  std::vector<std::int64_t> label;
  std::int64_t n_regions = 0;
};

void find(const riis_surface *surface, const riis_mesh *mesh, const riis_mark_options &options, std::int64_t n,
          Found &to) {
  EXPECT(riis_marks_create(&to.marks) == RIIS_OK && riis_leaks_create(&to.leaks) == RIIS_OK, "%s", riis_last_error());
  EXPECT(riis_mark_nodes(surface, mesh, &options, to.marks) == RIIS_OK, "%s", riis_last_error());
  EXPECT(riis_marks_get_list(to.marks, RIIS_LIST_WITHIN_LIMIT, &to.list, sizeof to.list) == RIIS_OK, "%s",
         riis_last_error());
  EXPECT(riis_find_leaks(surface, mesh, to.marks, &options, to.leaks) == RIIS_OK, "%s", riis_last_error());
  EXPECT(riis_leaks_get_list(to.leaks, &to.edges, sizeof to.edges) == RIIS_OK, "%s", riis_last_error());
  to.label.resize(static_cast<std::size_t>(n));
  EXPECT(riis_label_open_regions(mesh, to.marks, &options, n, to.label.data(), &to.n_regions) == RIIS_OK, "%s",
         riis_last_error());
}

void compare(const riis_surface *surface, Input &in, const Case &of, const riis_mesh *mesh, std::int64_t n_numbers) {
  Points points = points_of(of, n_numbers);
  const auto n = static_cast<std::int64_t>(points.number.size());
  riis_mark_options options;
  EXPECT(riis_mark_options_init(&options, sizeof options) == RIIS_OK, "%s", riis_last_error());
  static const double limits[] = {RIIS_AUTO, 0.5, 2, 1e60};
  options.distance_limit = in.one_of(limits);
  options.n_threads = 1 + in.below(2);
  Found got, expected;
  find(surface, mesh, options, n_numbers, got);
  find(surface, points.mesh, options, n, expected);
  EXPECT(got.list.n_nodes == expected.list.n_nodes, "%lld and %lld nodes", static_cast<long long>(got.list.n_nodes),
         static_cast<long long>(expected.list.n_nodes));
  const auto number = [&](std::int64_t node) { return node < 0 ? -1 : points.number[static_cast<std::size_t>(node)]; };
  for (std::int64_t i = 0; i < got.list.n_nodes; ++i) {
    EXPECT(got.list.node_id[i] == number(expected.list.node_id[i]), "node %lld", static_cast<long long>(i));
    EXPECT(std::memcmp(got.list.distance + i, expected.list.distance + i, sizeof(double)) == 0, "distance %lld",
           static_cast<long long>(i));
  }
  EXPECT(got.edges.n_edges == expected.edges.n_edges, "%lld leaks", static_cast<long long>(got.edges.n_edges));
  for (std::int64_t i = 0; i < 2 * got.edges.n_edges; ++i)
    EXPECT(got.edges.node_id[i] == number(expected.edges.node_id[i]), "leak %lld", static_cast<long long>(i / 2));
  EXPECT(got.n_regions == expected.n_regions, "%lld regions", static_cast<long long>(got.n_regions));
  std::vector<std::int64_t> labels(static_cast<std::size_t>(n_numbers), -1);
  for (std::size_t i = 0; i < points.number.size(); ++i)
    labels[static_cast<std::size_t>(points.number[i])] = number(expected.label[i]);
  EXPECT(labels == got.label, "the labels of open regions differ");
  for (Found *found : {&got, &expected}) {
    riis_marks_destroy(&found->marks);
    riis_leaks_destroy(&found->leaks);
  }
  riis_mesh_destroy(&points.mesh);
  riis_adjacency_destroy(&points.edges);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *bytes, std::size_t size) {
  static const Surface surfaces[] = {Surface(0), Surface(0.6)};
  Input in(bytes, size);
  const Surface &surface = surfaces[in.below(2)];
  riis_mesh *mesh = nullptr;
  // If two grids are valid, the second grid replaces the first. A refused grid changes nothing.
  Case last;
  for (int turn = 0; turn < 2; ++turn) {
    Case of = case_of(in);
    const riis_status status = mesh ? riis_mesh_update_grid(mesh, &of.grid) : riis_mesh_create_grid(&of.grid, &mesh);
    if (!is_made(status)) continue;
    last = std::move(of);
  }
  if (!mesh) return 0;
  riis_marks *marks = nullptr;
  EXPECT(riis_marks_create(&marks) == RIIS_OK, "%s", riis_last_error());
  riis_mark_stats stats{};
  EXPECT(riis_mark_nodes(surface.handle, mesh, nullptr, marks) == RIIS_OK, "%s", riis_last_error());
  EXPECT(riis_marks_get_stats(marks, &stats, sizeof stats) == RIIS_OK, "%s", riis_last_error());
  if (stats.n_nodes <= most_numbers) compare(surface.handle, in, last, mesh, stats.n_nodes);
  riis_marks_destroy(&marks);
  riis_mesh_destroy(&mesh);
  return 0;
}
