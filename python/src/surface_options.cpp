// SPDX-License-Identifier: Apache-2.0
// The keywords for how a surface is made and placed.
#include <cmath>
#include <cstring>

#include "common/elementary.hpp"
#include "module.hpp"

namespace riis_python {
namespace {

using Setter = void (*)(riis_surface_options &, nb::handle, const char *);

struct Keyword {
  const char *name;
  Setter set;
  bool is_placement;
};

// Returns the number. "auto" stands for a default that depends on other values.
double number_or_word(nb::handle value, const char *name) {
  if (!PyUnicode_Check(value.ptr())) return number_or_auto(value, name);
  choice(value, name, {{"auto", 0}});
  return RIIS_AUTO;
}

// Turns the valve's z axis into the direction of an axis by the smallest rotation. The rotation by half a turn is about x.
void set_axis(riis_surface_options &options, nb::handle value, const char *name) {
  double axis[3];
  three_numbers(value, name, axis);
  const double across = riis::hypotenuse(axis[0], axis[1]), length = riis::hypotenuse(across, axis[2]);
  if (!(length > 0 && std::isfinite(length)))
    refuse_value(name, "is (", axis[0], ", ", axis[1], ", ", axis[2], "), which gives no direction");
  const bool is_along_z = across == 0;
  options.rotation_axis[0] = is_along_z ? 1 : -axis[1];
  options.rotation_axis[1] = is_along_z ? 0 : axis[0];
  options.rotation_axis[2] = 0;
  options.rotation_angle = riis::arc_tangent(across, axis[2]) * (180 / riis::pi);
}

const Keyword keywords[] = {
    {"half_thickness",
     [](riis_surface_options &o, nb::handle value, const char *name) {
       o.half_thickness = number_or_word(value, name);
     },
     false},
    {"tolerance",
     [](riis_surface_options &o, nb::handle value, const char *name) { o.tolerance = number(value, name); }, false},
    {"scale", [](riis_surface_options &o, nb::handle value, const char *name) { o.scale = number(value, name); }, true},
    {"rotation_axis",
     [](riis_surface_options &o, nb::handle value, const char *name) { three_numbers(value, name, o.rotation_axis); },
     true},
    {"rotation_angle",
     [](riis_surface_options &o, nb::handle value, const char *name) { o.rotation_angle = number(value, name); }, true},
    {"axis", set_axis, true},
    {"translation",
     [](riis_surface_options &o, nb::handle value, const char *name) { three_numbers(value, name, o.translation); },
     true},
    {"zero_area",
     [](riis_surface_options &o, nb::handle value, const char *name) {
       o.zero_area = choice(value, name, {{"refuse", RIIS_ZERO_AREA_REFUSE}, {"skip", RIIS_ZERO_AREA_SKIP}});
     },
     false},
    {"flip_normals",
     [](riis_surface_options &o, nb::handle value, const char *name) { o.flip_normals = flag(value, name); }, false},
    {"measure",
     [](riis_surface_options &o, nb::handle value, const char *name) {
       o.measure = choice(value, name,
                          {{"triangles", RIIS_MEASURE_TRIANGLES},
                           {"sampling", RIIS_MEASURE_SAMPLING},
                           {"minimization", RIIS_MEASURE_MINIMIZATION}});
     },
     false},
    {"measure_tolerance",
     [](riis_surface_options &o, nb::handle value, const char *name) {
       o.measure_tolerance = number_or_word(value, name);
     },
     false},
    {"triangulation",
     [](riis_surface_options &o, nb::handle value, const char *name) {
       o.triangulation =
           choice(value, name, {{"adapted", RIIS_TRIANGULATION_ADAPTED}, {"fixed", RIIS_TRIANGULATION_FIXED}});
     },
     false},
    {"offset", [](riis_surface_options &o, nb::handle value, const char *name) { o.offset = number(value, name); },
     false},
    {"n_threads",
     [](riis_surface_options &o, nb::handle value, const char *name) { o.n_threads = thread_count(value, name); },
     false},
};

void set_options(riis_surface_options &options, nb::handle given, const char *argument, bool placement_only) {
  const auto all_given = nb::borrow<nb::dict>(given);
  for (const auto [key, value] : all_given) {
    const std::string name = text(key, argument);
    const Keyword *found = nullptr;
    std::string all;
    for (const Keyword &keyword : keywords) {
      if (placement_only && !keyword.is_placement) continue;
      if (name == keyword.name) found = &keyword;
      all += text_of(all.empty() ? "" : ", ", keyword.name);
    }
    if (!found) refuse_type(argument, "'", name, "' is not an option; the options are ", all);
    if (value.is_none()) continue;
    for (const char *other : {"rotation_axis", "rotation_angle"})
      if (name == "axis" && all_given.contains(other) && !all_given[other].is_none())
        refuse_value("axis", "cannot be combined with ", other);
    found->set(options, value, found->name);
  }
}

}  // namespace

void set_surface_options(riis_surface_options &options, nb::handle given, const char *name) {
  set_options(options, given, name, false);
}

void set_placement(riis_surface_options &options, nb::handle given, const char *name) {
  if (given.is_none()) return;
  if (!PyDict_Check(given.ptr())) refuse_type(name, "must be a dict, not ", name_of_type(given));
  set_options(options, given, name, true);
}

}  // namespace riis_python
