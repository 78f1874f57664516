// SPDX-License-Identifier: Apache-2.0
// The keywords for how a surface is made and placed.
#include <cstring>

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
double number_or_auto(nb::handle value, const char *name) {
  return PyUnicode_Check(value.ptr()) ? choice(value, name, {{"auto", -1}}) * -RIIS_AUTO : number(value, name);
}

const Keyword keywords[] = {
    {"half_thickness",
     [](riis_surface_options &o, nb::handle value, const char *name) {
       o.half_thickness = number_or_auto(value, name);
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
       o.measure_tolerance = number_or_auto(value, name);
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
  for (const auto [key, value] : nb::borrow<nb::dict>(given)) {
    const std::string name = text(key, argument);
    const Keyword *found = nullptr;
    std::string all;
    for (const Keyword &keyword : keywords) {
      if (placement_only && !keyword.is_placement) continue;
      if (name == keyword.name) found = &keyword;
      all += text_of(all.empty() ? "" : ", ", keyword.name);
    }
    if (!found) refuse_type(argument, "'", name, "' is not an option; the options are ", all);
    if (!value.is_none()) found->set(options, value, found->name);
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
