// SPDX-License-Identifier: Apache-2.0
#include "valve/patch_arrays.hpp"

#include <utility>

#include "common/array_view.hpp"
#include "valve/warped_patches.hpp"

namespace riis {

PatchArrays arrays_of(const PatchSet &set) {
  const PatchSet whole = without_images(set);
  PatchArrays made;
  made.first_span.push_back(0);
  for (const Curve &curve : whole.curves) {
    for (const Bezier &span : curve.spans()) {
      made.degree.push_back(span.degree);
      for (int i = 0; i <= span.degree; ++i) {
        const Vec3 q = view(span.control)[i];
        made.control.insert(made.control.end(), {q.x, q.y, q.z});
      }
    }
    made.first_span.push_back(view(made.degree).size());
  }
  for (const Patch &patch : whole.patches) {
    const PatchImage &image = patch.images.front();
    const bool is_exchanged = points_upstream(image);
    Side sides[4] = {patch.v0, patch.v1, patch.u0, patch.u1};
    std::int32_t attached = patch.attached == AttachedSide::v0 ? 0 : patch.attached == AttachedSide::u1 ? 3 : -1;
    if (is_exchanged) {
      std::swap(sides[2], sides[3]);
      sides[0].reversed = !sides[0].reversed;
      sides[1].reversed = !sides[1].reversed;
      if (attached == 3) attached = 2;
    }
    for (const Side &side : sides) {
      made.curve_id.push_back(static_cast<std::int32_t>(side.curve));
      made.reversed.push_back(side.reversed ? 1 : 0);
    }
    made.leaflet_id.push_back(image.leaflet_id);
    made.patch_id.push_back(image.patch_id);
    made.attached.push_back(attached);
    made.bulge.push_back(is_exchanged ? -patch.bulge : patch.bulge);
  }
  return made;
}

riis_valve_patches view_of(const PatchArrays &arrays) {
  const auto n_patches = view(arrays.leaflet_id).size();
  return {view(arrays.first_span).size() - 1,
          view(arrays.degree).size(),
          arrays.first_span.data(),
          arrays.degree.data(),
          arrays.control.data(),
          n_patches,
          arrays.curve_id.data(),
          arrays.reversed.data(),
          arrays.leaflet_id.data(),
          arrays.patch_id.data(),
          arrays.attached.data(),
          arrays.bulge.data()};
}

}  // namespace riis
