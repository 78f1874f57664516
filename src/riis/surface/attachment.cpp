// SPDX-License-Identifier: Apache-2.0
#include "surface/attachment.hpp"

#include <algorithm>

#include "common/array_view.hpp"
#include "surface/rims.hpp"

namespace riis {
namespace {

std::uint8_t attached_side(const VerticesOfPatch &patch) {
  if (patch.attached == AttachedSide::none) return 0;
  return patch.attached == AttachedSide::v0 ? rim_v0 : rim_u1;
}

// Finds the vertices of the attached side of a patch, ascending along it. Vertices of subdivided quads repeat places of others.
void find_side(const TriangleSet &set, const VerticesOfPatch &patch, std::int64_t end, Vector<std::int64_t> &side) {
  side.clear();
  const std::int64_t of_along = attached_side(patch) == rim_v0 ? 0 : 1;
  const auto along = [&](std::int64_t id) { return view(set.uv)[2 * id + of_along]; };
  for (std::int64_t id = patch.first; id < end; ++id)
    if (sides_of_place(&view(set.uv)[2 * id]) & attached_side(patch)) side.push_back(id);
  std::sort(side.begin(), side.end(),
            [&](std::int64_t a, std::int64_t b) { return along(a) != along(b) ? along(a) < along(b) : a < b; });
  side.erase(
      std::unique(side.begin(), side.end(), [&](std::int64_t a, std::int64_t b) { return along(a) == along(b); }),
      side.end());
}

void add_edge(const TriangleSet &set, const VerticesOfPatch &patch, std::int64_t from, std::int64_t to,
              Attachment &made) {
  const Vec3 a = set.vertex(from), b = set.vertex(to);
  if (a == b) return;
  for (const double x : {a.x, a.y, a.z, b.x, b.y, b.z}) made.edges.push_back(x);
  made.vertex_id.push_back(from);
  made.vertex_id.push_back(to);
  made.leaflet_id.push_back(patch.leaflet_id);
  made.patch_id.push_back(patch.patch_id);
}

}  // namespace

Attachment attachment_of(const TriangleSet &set) {
  const std::int64_t n = view(set.patches).size();
  Vector<std::int64_t> by_id;
  for (std::int64_t i = 0; i < n; ++i)
    if (view(set.rim_sides)[view(set.patches)[i].patch_id] & attached_side(view(set.patches)[i])) by_id.push_back(i);
  std::sort(by_id.begin(), by_id.end(), [&](std::int64_t a, std::int64_t b) {
    return view(set.patches)[a].patch_id < view(set.patches)[b].patch_id;
  });
  Attachment made;
  Vector<std::int64_t> side;
  for (const std::int64_t i : by_id) {
    const VerticesOfPatch &patch = view(set.patches)[i];
    find_side(set, patch, i + 1 < n ? view(set.patches)[i + 1].first : set.n_vertices(), side);
    for (std::size_t k = 1; k < side.size(); ++k) add_edge(set, patch, side[k - 1], side[k], made);
  }
  return made;
}

}  // namespace riis
