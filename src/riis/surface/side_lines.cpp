// SPDX-License-Identifier: Apache-2.0
#include "surface/side_lines.hpp"

#include <algorithm>
#include <utility>

#include "common/array_view.hpp"
#include "surface/rims.hpp"
#include "valve/skirt.hpp"

namespace riis {
namespace {

// Finds the vertices on a side of a patch, in order along the side. Two vertices of a subdivided quad may lie at the same place.
// Only the first of them is returned.
Vector<std::int64_t> vertices_on(const TriangleSet &set, std::int64_t begin, std::int64_t end, PatchRim side) {
  const std::int64_t of_along = side == rim_v0 || side == rim_v1 ? 0 : 1;
  const auto along = [&](std::int64_t id) { return view(set.uv)[2 * id + of_along]; };
  Vector<std::int64_t> found;
  for (std::int64_t id = begin; id < end; ++id)
    if (sides_of_place(&view(set.uv)[2 * id]) & side) found.push_back(id);
  std::sort(found.begin(), found.end(),
            [&](std::int64_t a, std::int64_t b) { return along(a) != along(b) ? along(a) < along(b) : a < b; });
  const auto is_same = [&](std::int64_t a, std::int64_t b) { return along(a) == along(b); };
  found.erase(std::unique(found.begin(), found.end(), is_same), found.end());
  return found;
}

// Returns one side of each patch: the side that choose(patch, rim) returns. `rim` holds the patch's bits of PatchRim. choose()
// returns 0 for a patch without such a side.
template <class Choose>
std::vector<SideLine> sides(const TriangleSet &set, const Choose &choose) {
  std::vector<SideLine> lines;
  const std::int64_t n = view(set.patches).size();
  for (std::int64_t i = 0; i < n; ++i) {
    const VerticesOfPatch &patch = view(set.patches)[i];
    const std::int64_t end = i + 1 < n ? view(set.patches)[i + 1].first : set.n_vertices();
    const int side = choose(patch, view(set.rim_sides)[patch.patch_id]);
    if (side == 0) continue;
    SideLine line{patch.leaflet_id, patch.patch_id, vertices_on(set, patch.first, end, static_cast<PatchRim>(side)),
                  patch.axis};
    if (length_of(set, line) > 0) lines.push_back(std::move(line));
  }
  std::sort(lines.begin(), lines.end(), [](const SideLine &a, const SideLine &b) { return a.patch_id < b.patch_id; });
  return lines;
}

}  // namespace

double length_of(const TriangleSet &set, const SideLine &side) {
  double length = 0;
  for (std::size_t i = 1; i < side.vertex_id.size(); ++i)
    length += distance(set.vertex(side.vertex_id[i - 1]), set.vertex(side.vertex_id[i]));
  return length;
}

std::vector<SideLine> free_edges(const TriangleSet &set) {
  return sides(set, [](const VerticesOfPatch &, int rim) { return rim & free_v1 ? rim_v1 : 0; });
}

std::vector<SideLine> attached_sides(const TriangleSet &set) {
  return sides(set, [](const VerticesOfPatch &patch, int rim) {
    if ((rim & held) == 0) return 0;
    return static_cast<int>(patch.attached == AttachedSide::v0 ? rim_v0 : rim_u1);
  });
}

Attachment attachment_of(const TriangleSet &set) {
  Attachment made;
  for (const SideLine &side : attached_sides(set))
    for (std::size_t k = 1; k < side.vertex_id.size(); ++k) {
      const std::int64_t from = side.vertex_id[k - 1], to = side.vertex_id[k];
      const Vec3 a = set.vertex(from), b = set.vertex(to);
      if (a == b) continue;
      for (const Vec3 end : {a, b}) {
        const bool is_aimed = !(side.axis.direction == Vec3{0, 0, 0});
        const Vec3 out = is_aimed ? outwards(side.axis, end) : Vec3{0, 0, 0};
        for (const double x : {end.x, end.y, end.z}) made.edges.push_back(x);
        for (const double x : {out.x, out.y, out.z}) made.outwards.push_back(x);
      }
      made.vertex_id.push_back(from);
      made.vertex_id.push_back(to);
      made.leaflet_id.push_back(side.leaflet_id);
      made.patch_id.push_back(side.patch_id);
    }
  return made;
}

}  // namespace riis
