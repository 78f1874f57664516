// SPDX-License-Identifier: Apache-2.0
#include "valve/rims.hpp"

#include <algorithm>
#include <tuple>

#include "common/array_view.hpp"

namespace riis {
namespace {

// A side of an image of a patch.
struct Use {
  std::size_t curve;
  const PatchImage *image;
  PatchRim side;
  bool is_skirt, is_attached;
};

// Returns the bit of the side at which a patch is attached, or 0.
int attached_side(const Patch &patch) {
  if (patch.attached == AttachedSide::none) return 0;
  return patch.attached == AttachedSide::v0 ? rim_v0 : rim_u1;
}

// Returns whether both images put the curve at the same place. The positions are the same if the placed control points are equal
// to the last bit.
bool coincide(const Curve &curve, const PatchImage &a, const PatchImage &b) {
  for (const Bezier &span : curve.spans())
    for (int i = 0; i <= span.degree; ++i) {
      const Vec3 q = view(span.control)[i];
      if (!(place(a, q) == place(b, q))) return false;
    }
  return true;
}

}  // namespace

Vector<std::uint8_t> rim_sides(const PatchSet &set) {
  Vector<Use> uses;
  std::int64_t n_ids = 0;
  for (const Patch &patch : set.patches)
    for (const PatchImage &image : patch.images) {
      n_ids = std::max(n_ids, std::int64_t{image.patch_id} + 1);
      const auto add = [&](const Side &side, PatchRim bit) {
        uses.push_back({side.curve, &image, bit, patch.is_skirt, attached_side(patch) == bit});
      };
      add(patch.v0, rim_v0);
      add(patch.v1, rim_v1);
      add(patch.u0, rim_u0);
      add(patch.u1, rim_u1);
    }
  std::sort(uses.begin(), uses.end(), [](const Use &a, const Use &b) {
    return std::tie(a.curve, a.image->patch_id, a.side) < std::tie(b.curve, b.image->patch_id, b.side);
  });
  Vector<std::uint8_t> sides;
  resize(sides, n_ids);
  for (auto first = uses.begin(); first != uses.end();) {
    const auto last = std::find_if(first, uses.end(), [&](const Use &use) { return use.curve != first->curve; });
    for (auto use = first; use != last; ++use) {
      bool is_shared = false, is_shared_by_leaflets = false, is_shared_in_leaflet = false;
      for (auto other = first; other != last && !is_shared_in_leaflet; ++other) {
        if (other == use || !coincide(set.curves[use->curve], *use->image, *other->image)) continue;
        is_shared = true;
        is_shared_by_leaflets = is_shared_by_leaflets || !other->is_skirt;
        is_shared_in_leaflet = other->image->leaflet_id == use->image->leaflet_id;
      }
      std::uint8_t &of_patch = view(sides)[use->image->patch_id];
      if (!is_shared) of_patch = static_cast<std::uint8_t>(of_patch | use->side);
      if (!is_shared_in_leaflet && use->side == rim_v1 && !use->is_skirt)
        of_patch = static_cast<std::uint8_t>(of_patch | free_v1);
      if (!is_shared_by_leaflets && use->is_attached) of_patch = static_cast<std::uint8_t>(of_patch | held);
    }
    first = last;
  }
  for (const Seam &seam : set.seams) {
    if (seam.place == SeamPlace::corner) continue;
    const PatchRim side = seam.place == SeamPlace::side_v1 ? rim_v1 : rim_u1;
    for (const PatchImage *image :
         {&set.patches[seam.patch].images[seam.image], &set.patches[seam.patch_of_twin()].images[seam.twin]}) {
      std::uint8_t &of_patch = view(sides)[image->patch_id];
      of_patch = static_cast<std::uint8_t>(of_patch & ~side);
    }
  }
  return sides;
}

}  // namespace riis
