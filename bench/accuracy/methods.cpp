// SPDX-License-Identifier: Apache-2.0
#include "accuracy/methods.hpp"

#include <algorithm>
#include <stdexcept>

#include "api/handles.hpp"
#include "paper_distances/patch_distance.hpp"

namespace riis::accuracy {
namespace {

void check(riis_status status) {
  if (status != RIIS_OK) throw std::runtime_error(std::string(riis_status_name(status)) + ": " + riis_last_error());
}

// Returns the kind of a valve that is made from ready patches. These may be patches of arcs, which riis_valve_create_from_patches
// does not accept.
const ValveKind &fixed_patches_kind() {
  static const ValveKind &kind =
      *new ValveKind{"fixed patches",
                     {opening_spec("not used: the patches stay as they are", 0)},
                     0,
                     false,
                     nullptr,
                     [](const ValveState &closed, const ValveState &, double) { return closed.patches; },
                     nullptr};
  return kind;
}

}  // namespace

PatchSet patches_of(const Leaflet &leaflet) {
  PatchSet set = Valve(find_valve_kind(leaflet.valve)).make_patches();
  for (Patch &patch : set.patches)
    patch.images.erase(std::remove_if(patch.images.begin(), patch.images.end(),
                                      [&](const PatchImage &image) { return image.leaflet_id != leaflet.leaflet_id; }),
                       patch.images.end());
  // The curves of removed patches may remain, because nothing uses these curves.
  set.patches.erase(
      std::remove_if(set.patches.begin(), set.patches.end(), [](const Patch &patch) { return patch.images.empty(); }),
      set.patches.end());
  return set;
}

const char *name_of(std::int32_t method) {
  return method == RIIS_MEASURE_TRIANGLES  ? "triangulation"
         : method == RIIS_MEASURE_SAMPLING ? "sampling"
                                           : "minimisation";
}

MeasuredSurface::MeasuredSurface(const PatchSet &patches, std::int32_t method, double tolerance) {
  riis_surface_options options;
  check(riis_surface_options_init(&options, sizeof options));
  options.half_thickness = half_thickness;
  options.measure = method;
  (method == RIIS_MEASURE_TRIANGLES ? options.tolerance : options.measure_tolerance) = tolerance;
  const riis_valve valve{{}, Valve(fixed_patches_kind(), patches)};
  riis_surface *surface = nullptr;
  check(riis_surface_create(&valve, &options, &surface));
  surface_.reset(surface);
}

riis_closest MeasuredSurface::closest(const double *point) const {
  riis_closest closest;
  check(riis_closest_point(surface_.get(), point, &closest, sizeof closest));
  return closest;
}

std::int64_t MeasuredSurface::size() const {
  const riis::Surface &surface = content_of(surface_.get());
  const PatchDistance *other = surface.other_distance();
  if (!other) return surface.triangles().n_triangles();
  if (const auto *samples = dynamic_cast<const SampleSet *>(other)) return samples->n_samples();
  return static_cast<std::int64_t>(other->patches().patches.size());
}

}  // namespace riis::accuracy
