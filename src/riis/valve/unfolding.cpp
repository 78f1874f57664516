// SPDX-License-Identifier: Apache-2.0
#include "valve/unfolding.hpp"

#include <algorithm>
#include <utility>

#include "common/array_view.hpp"

namespace riis {
namespace {

bool is_in_place(const PatchImage &image) {
  return image.mirror == Mirror::none && image.rotation.row_x == no_rotation.row_x &&
         image.rotation.row_y == no_rotation.row_y && image.rotation.row_z == no_rotation.row_z &&
         image.translation == Vec3{0, 0, 0};
}

template <class Move>
Bezier moved_by(const Bezier &span, const Move &move) {
  Bezier made = span;
  for (int i = 0; i <= span.degree; ++i) view(made.control)[i] = move(view(span.control)[i]);
  return made;
}

}  // namespace

Unfolding::Unfolding(const PatchSet &set) : set_(set), first_(set.curves.size(), no_copy) {
  keeps_numbers_ = std::all_of(set.patches.begin(), set.patches.end(), [](const Patch &patch) {
    return patch.images.size() == 1 && is_in_place(patch.images.front());
  });
  if (keeps_numbers_)
    for (std::size_t i = 0; i < set.curves.size(); ++i) first_[i] = add(i, nullptr);
  Vector<std::size_t> first_image;
  for (std::size_t i = 0; i < set.patches.size(); ++i) {
    first_image.push_back(patches_.size());
    for (std::size_t k = 0; k < set.patches[i].images.size(); ++k) patches_.push_back(unfolded(i, k));
  }
  for (const Seam &seam : set.seams)
    sew(patches_[first_image[seam.patch] + seam.image], patches_[first_image[seam.patch] + seam.twin], seam.place);
}

std::size_t Unfolding::add(std::size_t curve, const PatchImage *image) {
  CurveCopy copy{curve, image, first_[curve], {}, {}};
  for (const Bezier &span : set_.curves[curve].spans())
    copy.spans.push_back(image ? moved_by(span, [&](Vec3 p) { return place(*image, p); }) : span);
  if (curve < set_.rates.size()) {  // a skirt's curves have no rates
    copy.rates = set_.rates[curve];
    if (image) {
      const PatchImage turn = turn_of(*image);
      for (Bezier &rate : copy.rates) rate = moved_by(rate, [&](Vec3 p) { return place(turn, p); });
    }
  }
  copies_.push_back(std::move(copy));
  return first_[curve] = copies_.size() - 1;
}

bool Unfolding::has_copy_at(const CurveCopy &copy, const PatchImage &image) const {
  std::size_t k = 0;
  for (const Bezier &span : set_.curves[copy.curve].spans()) {
    for (int i = 0; i <= span.degree; ++i)
      if (!(place(image, view(span.control)[i]) == view(copy.spans[k].control)[i])) return false;
    ++k;
  }
  return true;
}

std::size_t Unfolding::copy_of(std::size_t curve, const PatchImage &image) {
  if (keeps_numbers_) return first_[curve];
  for (std::size_t i = first_[curve]; i != no_copy; i = copies_[i].next)
    if (copies_[i].image == &image || has_copy_at(copies_[i], image)) return i;
  return add(curve, &image);
}

Vec3 &Unfolding::end_of(const Side &side, bool last) {
  Vector<Bezier> &spans = copies_[side.curve].spans;
  if (last == side.reversed) return spans.front().control[0];
  Bezier &span = spans.back();
  return view(span.control)[span.degree];
}

Patch Unfolding::unfolded(std::size_t number, std::size_t which) {
  const Patch &patch = set_.patches[number];
  const PatchImage &image = patch.images[which];
  const auto side = [&](const Side &given) { return Side{copy_of(given.curve, image), given.reversed}; };
  // Along a seam, the curve is the twin's curve.
  const PatchImage *of_v1 = &image;
  for (const Seam &seam : set_.seams)
    if (seam.patch == number && seam.image == which && seam.place == SeamPlace::side_v1)
      of_v1 = &patch.images[seam.twin];
  const bool is_mirrored = image.mirror != Mirror::none;
  Patch made{side(patch.v0),
             {copy_of(patch.v1.curve, *of_v1), patch.v1.reversed},
             side(patch.u0),
             side(patch.u1),
             {},
             is_mirrored ? -patch.bulge : patch.bulge,
             patch.attached};
  made.images.push_back(
      {Mirror::none, no_rotation, {0, 0, 0}, image.leaflet_id, image.patch_id, is_mirrored != image.is_turned_over});
  return made;
}

// Gives a patch the points of its twin at the seam. The patch's own points differ from the twin's points only by rounding.
void Unfolding::sew(const Patch &patch, const Patch &twin, SeamPlace place) {
  const Vec3 corner = end_of(twin.v1, true);
  end_of(patch.v1, true) = corner;
  end_of(patch.u1, true) = corner;
  if (place != SeamPlace::side_u1) return;
  end_of(patch.v0, true) = corner;
  for (Bezier &span : copies_[patch.u1.curve].spans) span.control.fill(corner);
}

}  // namespace riis
