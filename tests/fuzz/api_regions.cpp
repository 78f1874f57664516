// SPDX-License-Identifier: Apache-2.0
// Calls of riis_label_open_regions and riis_find_passage.
#include <algorithm>
#include <cmath>

#include "api_state.hpp"

namespace fuzz {
namespace {

constexpr std::int64_t untouched = 0x5a5a5a5a5a5a5a5a;

std::vector<std::uint8_t> marks_of(const riis_marks *result, std::int64_t n_nodes) {
  std::vector<std::uint8_t> marks(static_cast<std::size_t>(n_nodes));
  EXPECT_OK(dense_of(result, n_nodes, -1, marks.data(), nullptr, nullptr, nullptr));
  return marks;
}

// Checks that each label is the lowest node of its region, and that marked nodes have no label. test_open_regions.c compares
// labels with a flood fill.
void check_labels(const riis_marks *result, const std::vector<std::int64_t> &label, std::int64_t n_regions) {
  const std::vector<std::uint8_t> marks = marks_of(result, static_cast<std::int64_t>(label.size()));
  std::int64_t n_lowest = 0;
  for (std::size_t i = 0; i < label.size(); ++i) {
    EXPECT((label[i] == -1) == (marks[i] != 0), "label %lld of node %zu", static_cast<long long>(label[i]), i);
    if (label[i] < 0) continue;
    const auto lowest = static_cast<std::size_t>(label[i]);
    EXPECT(lowest <= i && label[lowest] == label[i], "label %zu of node %zu", lowest, i);
    n_lowest += lowest == i;
  }
  EXPECT(n_regions == n_lowest, "%lld regions", static_cast<long long>(n_regions));
}

}  // namespace

void label_regions(Input &in, State &state) {
  const ResultSlot &slot = state.results[in.slot()];
  const MeshSlot &mesh_slot = state.meshes[in.slot()];
  const Given<riis_mesh> mesh = given(in, state, State::mesh, mesh_slot.handle);
  const Given<riis_marks> result = given(in, state, State::result, slot.handle);
  riis_mark_options options = initialised(in, riis_mark_options_init);
  options.n_threads = in.n_threads();
  std::vector<std::int64_t> label(mesh_slot.handle ? static_cast<std::size_t>(mesh_slot.nodes->n) : 0, untouched);
  const std::int64_t n = in.mostly(static_cast<std::int64_t>(label.size()));
  std::int64_t n_regions = -9;
  const riis_status status = call(in, [&] {
    return riis_label_open_regions(mesh.handle, result.handle, in.one_in(2) ? &options : nullptr, n,
                                   mostly(in, label.data()), &n_regions);
  });
  if (!(mesh.is_right && result.is_right)) EXPECT(status == RIIS_INVALID_ARGUMENT, "%d", status);
  if (status != RIIS_OK) {
    EXPECT(std::count(label.begin(), label.end(), untouched) == static_cast<std::ptrdiff_t>(label.size()),
           "refused labels were written");
    return;
  }
  EXPECT(mesh_slot.adjacency, "labels without an adjacency");
  check_labels(slot.handle, label, n_regions);
}

void find_passage(Input &in, State &state) {
  riis_surface *surface_slot = state.surfaces[in.slot()];
  const MeshSlot &mesh_slot = state.meshes[in.slot()];
  const Given<riis_surface> surface = given(in, state, State::surface, surface_slot);
  const Given<riis_mesh> mesh = given(in, state, State::mesh, mesh_slot.handle);
  riis_mark_options options = initialised(in, riis_mark_options_init);
  options.n_threads = in.n_threads();
  const int n_nodes = mesh_slot.handle ? static_cast<int>(std::min<std::int64_t>(mesh_slot.nodes->n, 4096)) : 0;
  std::array<std::int64_t, 4> from{}, to{};
  for (std::int64_t &id : from) id = in.mostly<std::int64_t>(n_nodes > 0 ? in.below(n_nodes) : 0);
  for (std::int64_t &id : to) id = in.mostly<std::int64_t>(n_nodes > 0 ? in.below(n_nodes) : 0);
  const std::int64_t n_from = in.one_in(32) ? 0 : 1 + in.below(4), n_to = in.one_in(32) ? 0 : 1 + in.below(4);
  riis_passage passage;
  std::memset(static_cast<void *>(&passage), 0x5a, sizeof passage);
  const std::int64_t size = in.mostly<std::int64_t>(sizeof passage);
  const riis_status status = call(in, [&] {
    return find_passage_between(surface.handle, mesh.handle, in.one_in(2) ? &options : nullptr, n_from,
                                mostly(in, from.data()), n_to, mostly(in, to.data()), mostly(in, &passage), size);
  });
  if (!(surface.is_right && mesh.is_right)) EXPECT(status == RIIS_INVALID_ARGUMENT, "%d", status);
  if (status != RIIS_OK) {
    EXPECT(passage.node_id == untouched, "a refused passage was written");
    return;
  }
  EXPECT(mesh_slot.adjacency && n_from > 0 && n_to > 0, "a passage of nothing");
  EXPECT(passage.seconds >= 0 && (passage.state == RIIS_PASSAGE_NONE) == (passage.node_id == -1), "state %d",
         passage.state);
  if (passage.node_id < 0) return;
  riis_surface_info info;
  EXPECT_OK(riis_surface_get_info(surface.handle, &info, sizeof info));
  EXPECT((passage.distance > info.half_thickness) == (passage.state == RIIS_PASSAGE_OPEN), "state %d at %.17g",
         passage.state, passage.distance);
  const std::array<double, 3> p = (*mesh_slot.nodes)[passage.node_id];
  EXPECT(std::equal(p.begin(), p.end(), passage.point), "node %lld", static_cast<long long>(passage.node_id));
}

}  // namespace fuzz
