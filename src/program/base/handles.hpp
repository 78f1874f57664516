// SPDX-License-Identifier: Apache-2.0
// Wraps riis_vtk's objects in handles, as riis.hpp wraps the library's objects. Other functions copy the content of a handle into
// a struct.
#pragma once

#include <riis/riis_vtk.h>
#include <riis/riis.hpp>

#include <algorithm>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "common/array_view.hpp"
#include "common/triangles.hpp"
#include "program/base/refusal.hpp"
#include "program/base/units.hpp"

namespace riis::program {

using MeshFile = Handle<riis_vtk_mesh, riis_vtk_mesh_destroy>;
using Motion = Handle<riis_vtk_motion, riis_vtk_motion_destroy>;
using Film = Handle<riis_vtk_film, riis_vtk_film_destroy>;
using SurfaceFile = Handle<riis_vtk_surface, riis_vtk_surface_destroy>;

// Calls a library function whose last argument receives a new object, and returns this object. Refusals begin with `subject`,
// like the refusals of the function check.
template <class Object, class Call, class... Arguments>
Object create_for(const std::string &subject, const Call &call, const Arguments &...arguments) {
  Object object;
  check(call(arguments..., object.out()), subject);
  return object;
}
template <class Object, class Call, class... Arguments>
Object create(const Call &call, const Arguments &...arguments) {
  return create_for<Object>("", call, arguments...);
}

// The functions below copy the content of a library's handle into a struct.
inline riis_triangles triangles_of(const riis_surface *surface) {
  return get<riis_triangles>(riis_surface_get_triangles, surface);
}
inline riis_surface_info info_of(const riis_surface *surface) {
  return get<riis_surface_info>(riis_surface_get_info, surface);
}
inline Box box_of(const riis_surface_info &info) {
  return {{info.lower[0], info.lower[1], info.lower[2]}, {info.upper[0], info.upper[1], info.upper[2]}};
}
inline riis_mark_list list_of(const riis_marks *marks, int32_t which) {
  return get<riis_mark_list>(riis_marks_get_list, marks, which);
}
inline riis_mark_stats stats_of(const riis_marks *marks) { return get<riis_mark_stats>(riis_marks_get_stats, marks); }

// all_parameters returns the parameters of a valve, and values_of returns the values of a parameter.
inline std::vector<riis_parameter> all_parameters(const riis_valve *valve) {
  std::int64_t n = 0;
  check(riis_valve_get_n_parameters(valve, &n));
  std::vector<riis_parameter> parameters;
  for (std::int64_t i = 0; i < n; ++i) parameters.push_back(get<riis_parameter>(riis_valve_get_parameter, valve, i));
  return parameters;
}
inline std::vector<double> values_of(const riis_valve *valve, const riis_parameter &parameter) {
  std::vector<double> values(static_cast<std::size_t>(parameter.n_values));
  check(riis_valve_get(valve, parameter.name, parameter.n_values, values.data()));
  return values;
}
// Returns whether all parameters of a valve have their default values. The parameters in `others` may have any values.
inline bool has_default_values(const riis_valve *valve, const std::set<std::string> &others) {
  const std::vector<riis_parameter> all = all_parameters(valve);
  return std::all_of(all.begin(), all.end(), [&](const riis_parameter &parameter) {
    const std::vector<double> values = values_of(valve, parameter);
    return others.count(parameter.name) > 0 || std::equal(values.begin(), values.end(), parameter.default_values);
  });
}

// Returns a view of the points in the given array (3, n). Coordinates are not copied.
inline riis_points points_of(const std::vector<double> &xyz) {
  auto points = defaults<riis_points>();
  points.n_points = view(xyz).size() / 3;
  points.x = xyz.data();
  points.y = xyz.data() + 1;
  points.z = xyz.data() + 2;
  points.stride = 3;
  return points;
}
// Returns arrays that refer to the given triangles.
inline riis_surface_arrays arrays_of(const Triangles &triangles) {
  const auto *const xyz = reinterpret_cast<const double *>(triangles.points.data());
  auto arrays = defaults<riis_surface_arrays>();
  arrays.n_vertices = view(triangles.points).size();
  arrays.x = xyz;
  arrays.y = xyz + 1;
  arrays.z = xyz + 2;
  arrays.stride = 3;
  arrays.n_faces = triangles.n();
  arrays.vertex_ids = triangles.corners.data();
  arrays.id_bits = 64;
  return arrays;
}
// Returns the distances of points to a surface. The points are an array (3, n). If `closest` is given, it gets the surface's
// closest points, (3, n).
inline std::vector<double> distances_to(const riis_surface *surface, const std::vector<double> &xyz,
                                        std::vector<double> *closest = nullptr) {
  const riis_points points = points_of(xyz);
  std::vector<double> made(xyz.size() / 3);
  auto arrays = defaults<riis_closest_arrays>();
  arrays.distance = made.data();
  if (closest) {
    closest->resize(xyz.size());
    arrays.point = closest->data();
  }
  check(riis_closest_points(surface, &points, nullptr, &arrays));
  return made;
}

}  // namespace riis::program
