// SPDX-License-Identifier: Apache-2.0
#include "api/surface_options.hpp"

#include "api/structs.hpp"
#include "base/errors.hpp"
#include "base/integer_array.hpp"

namespace riis {
namespace {

void check_flag(const char *name, std::int32_t value) {
  if (value != 0 && value != 1) fail(RIIS_INVALID_ARGUMENT, "options.", name, " is ", value, "; it must be 0 or 1");
}

}  // namespace

const riis_surface_options default_surface_options{sizeof(riis_surface_options),
                                                   RIIS_AUTO,
                                                   0.05,
                                                   1.0,
                                                   {0, 0, 1},
                                                   0,
                                                   {0, 0, 0},
                                                   RIIS_AUTO,
                                                   RIIS_MEASURE_TRIANGLES,
                                                   RIIS_TRIANGULATION_ADAPTED,
                                                   RIIS_ZERO_AREA_REFUSE,
                                                   0,
                                                   0,
                                                   0,
                                                   0};

void check_placement(const riis_surface_options &options, const char *name) {
  check_range(name, "scale", options.scale, 1e-12, 1e12);
  check_range(name, "rotation_angle", options.rotation_angle, -1e6, 1e6);
  for (const double value : options.rotation_axis) check_range(name, "rotation_axis", value, -1e50, 1e50);
  for (const double value : options.translation) check_range(name, "translation", value, -1e50, 1e50);
  const double *axis = options.rotation_axis;
  if (!(length(Vec3{axis[0], axis[1], axis[2]}) >= 1e-50))
    fail(RIIS_INVALID_ARGUMENT, name, ".rotation_axis is (", axis[0], ", ", axis[1], ", ", axis[2],
         "); it must be at least 1e-50 long");
}

void check_options(const riis_surface_options &options) {
  check_placement(options, "options");
  if (options.half_thickness != RIIS_AUTO)
    check_range("options", "half_thickness", options.half_thickness, 1e-50, 1e50);
  check_range("options", "tolerance", options.tolerance, 1e-6, 1.0);
  check_flag("zero_area", options.zero_area);
  check_flag("flip_normals", options.flip_normals);
  if (options.measure < RIIS_MEASURE_TRIANGLES || options.measure > RIIS_MEASURE_MINIMIZATION)
    fail(RIIS_INVALID_ARGUMENT, "options.measure is ", options.measure, "; it must be one of RIIS_MEASURE_*");
  if (options.triangulation < RIIS_TRIANGULATION_ADAPTED || options.triangulation > RIIS_TRIANGULATION_FIXED)
    fail(RIIS_INVALID_ARGUMENT, "options.triangulation is ", options.triangulation,
         "; it must be one of RIIS_TRIANGULATION_*");
  check_threads(options.n_threads, "options.n_threads");
  if (options.measure_tolerance != RIIS_AUTO)
    check_range("options", "measure_tolerance", options.measure_tolerance, 1e-6, 1.0);
  check_reserved("options.reserved", options.reserved);
  if (!(options.offset > -1 && options.offset < 1))
    fail(RIIS_INVALID_ARGUMENT, "options.offset is ", options.offset, "; it must be above -1 and below 1");
  if (options.offset != 0 && options.measure != RIIS_MEASURE_TRIANGLES)
    fail(RIIS_INVALID_ARGUMENT, "options.offset is ", options.offset, ", but options.measure is ", options.measure,
         ", which does not tell the sides of a surface apart: it must be RIIS_MEASURE_TRIANGLES, 0, or the offset must "
         "be 0");
}

Placement placement_of(const riis_surface_options &options) {
  const double *axis = options.rotation_axis, *t = options.translation;
  return {options.scale, rotation_about({axis[0], axis[1], axis[2]}, options.rotation_angle), {t[0], t[1], t[2]}};
}

double half_thickness_of(const riis_surface_options &options) {
  return options.half_thickness == RIIS_AUTO ? 0.1 * options.scale : options.half_thickness;
}

Band band_of(const riis_surface_options &options) { return {half_thickness_of(options), options.offset}; }

}  // namespace riis
