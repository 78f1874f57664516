// SPDX-License-Identifier: Apache-2.0
// Triangles in space, in the form that all later stages use.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "base/recycled.hpp"
#include "common/array_view.hpp"
#include "geometry/quads.hpp"
#include "geometry/strided.hpp"
#include "valve/patches.hpp"

namespace riis {

// Groups of neighbouring triangles for searches. `order` has the triangles' positions in the set, group by group. `end` gives,
// for each group, the position after its last triangle.
struct Grouping {
  Vector<std::int32_t> order, end;
};

// The vertices of a patch of a valve. These vertices begin at `first` and end before the first vertex of the next patch.
struct VerticesOfPatch {
  std::int32_t patch_id, leaflet_id;
  std::int64_t first;
  AttachedSide attached;
  AxisLine axis;  // placed
};

// An edge of the attachment, for triangles from arrays. The vertices `from` and `to` follow each other in this order in the
// edge's triangle.
struct AttachedEdge {
  std::int64_t from, to;
  std::int32_t leaflet_id;
};

struct TriangleSet {
  std::vector<double> xyz;                // (3, n_vertices), placed
  std::vector<double> uv;                 // (2, n_vertices), empty for surfaces from arrays
  std::vector<double> velocity;           // (3, n_vertices), placed; empty if the triangles have no velocities
  std::vector<std::int64_t> vertex_id;    // (3, n_triangles)
  std::vector<std::int64_t> triangle_id;  // (n_triangles), ascending
  std::vector<std::int32_t> leaflet_id;   // (n_triangles)
  std::vector<std::int32_t> patch_id;     // (n_triangles)
  std::int64_t n_zero_area = 0;           // number of triangles that were left out
  double error_bound = 0;                 // bounds the distance to the smooth valve, placed; 0 for surfaces from arrays
  Vector<std::uint8_t> rim_sides;   // an entry for each patch_id, bits of PatchRim; empty for surfaces from arrays
  Vector<VerticesOfPatch> patches;  // ascending by first vertex; empty for surfaces from arrays
  std::uint64_t connectivity = 0;   // the number of the triangles' plan, or 0 (triangulate/triangulate_fixed.cpp)
  Grouping grouping;                // empty if the triangles were made without groups
  Vector<LevelledGrid> grids;       // the grids of the patches, with their lines; empty for surfaces from arrays
  std::int32_t skirt = -1;          // the leaflet_id of the skirt, or -1. The skirt of arrays has the last triangles
  Vector<AttachedEdge> attached;    // the attachment of arrays; empty for surfaces of valves
  AxisLine attached_axis{};         // the line from which a skirt of arrays leads away; its direction may be 0

  // Empties the set and keeps its memory for the next triangles.
  void clear() {
    for (auto *numbers : {&xyz, &uv, &velocity}) numbers->clear();
    for (auto *ids : {&vertex_id, &triangle_id}) ids->clear();
    for (auto *ids : {&leaflet_id, &patch_id}) ids->clear();
    for (auto *ids : {&grouping.order, &grouping.end}) ids->clear();
    rim_sides.clear();
    patches.clear();
    grids.clear();
    skirt = -1;
    attached.clear();
    n_zero_area = 0;
    error_bound = 0;
    connectivity = 0;
  }
  std::int64_t n_vertices() const { return view(xyz).size() / 3; }
  std::int64_t n_triangles() const { return view(triangle_id).size(); }
  Vec3 vertex(std::int64_t id) const {
    const double *v = xyz.data() + 3 * id;
    return {v[0], v[1], v[2]};
  }
  std::array<Vec3, 3> corners(std::int64_t triangle) const {
    const std::int64_t *id = vertex_id.data() + 3 * triangle;
    return {vertex(id[0]), vertex(id[1]), vertex(id[2])};
  }
  double area(std::int64_t triangle) const {
    const auto [a, b, c] = corners(triangle);
    return 0.5 * length(cross(b - a, c - a));
  }
  // Tells whether the triangles come from the patches of a valve. Otherwise they come from arrays.
  bool is_of_patches() const { return !uv.empty(); }
};

// Returns triangles from arrays without their skirt, for measures of the leaflets.
TriangleSet without_skirt(const TriangleSet &set);

// Finds the position of a triangle in the set from its id. A triangle's position equals its id if the set has left out none of
// the caller's triangles.
class TrianglePositions {
 public:
  explicit TrianglePositions(const TriangleSet &set)
      : ids_(view(set.triangle_id)), are_ids_(ids_[ids_.size() - 1] == ids_.size() - 1) {}

  // For an id that the set lacks, the result is any number of at least 0.
  std::int64_t of(std::int64_t id) const {
    return are_ids_ ? id : std::lower_bound(ids_.begin(), ids_.end(), id) - ids_.begin();
  }

 private:
  ArrayView<const std::int64_t> ids_;
  bool are_ids_;
};

// Groups the triangles from begin to end - 1 of a set by their place in space, and adds the groups to `grouping`.
void group_by_place(const TriangleSet &set, std::int32_t begin, std::int32_t end, Grouping &grouping);
// Groups all triangles of a set by their place in space. The groups replace the contents of `grouping`, whose memory is reused.
void group_all_by_place(const TriangleSet &set, Grouping &grouping);

// The library accepts at most this many triangles. Ids of four bytes could count more triangles, but each triangle takes a few
// hundred bytes of memory.
inline constexpr std::int64_t max_triangles = 16'777'216;

// Returns true if all edges are shorter than min_edge, or if the height over the longest edge is at most 1e-12 times the length
// of this edge.
inline bool has_zero_area(Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 ab = b - a, ac = c - a, bc = c - b;
  const double longest_sq = std::max({dot(ab, ab), dot(ac, ac), dot(bc, bc)});
  if (!(longest_sq >= min_edge * min_edge)) return true;
  // For edges from 1e-60 to 1e60, these products stay within the range of doubles.
  const Vec3 twice_area = cross(ab, ac);
  return !(dot(twice_area, twice_area) > 1e-24 * longest_sq * longest_sq);
}

}  // namespace riis
