// SPDX-License-Identifier: Apache-2.0
// The parts of the module, and the objects that several parts use.
#pragma once

#include <nanobind/nanobind.h>

#include <set>
#include <tuple>
#include <utility>

#include "arrays.hpp"
#include "handles.hpp"

namespace riis_python {

struct Valve : Handle<riis_valve, riis_valve_destroy> {
  static constexpr const char *python_name = "Valve";
  std::string kind;
  // Values that the library does not return: the arguments of from_patches, and a copy of the valve that gave the open state.
  nb::object patches = nb::none(), open = nb::none();
  nb::object warp = nb::none();   // the states of both warps, or None
  bool has_wall_lengths = false;  // whether its skirt has lengths to a wall
};

struct Warp : Handle<riis_warp, riis_warp_destroy> {
  static constexpr const char *python_name = "Warp";
  // Copies of the arguments, from which pickle makes the warp.
  nb::object sources = nb::none(), placement = nb::none(), targets = nb::none();
  double noise = 0;
};

struct Keyframes : Handle<riis_keyframes, riis_keyframes_destroy> {
  static constexpr const char *python_name = "Keyframes";
};

struct Surface : Handle<riis_surface, riis_surface_destroy> {
  static constexpr const char *python_name = "Surface";
  riis_surface_options options{};  // the options in use
  // Copies of arrays that the user requested. The library's arrays are copied, because an update overwrites its memory.
  nb::object vertices, uv, velocities, triangles;
  // The meshes, scales and half thicknesses with which the marks have been judged. A time loop thus warns once.
  std::set<std::tuple<std::int64_t, double, double>> judged;
  nb::object valve;  // the caller's valve, for advice; none for a surface from arrays or keyframes

  void close(const char *name);
  void drop_copies() { vertices = uv = velocities = triangles = nb::object(); }
};

struct Adjacency : Handle<riis_adjacency, riis_adjacency_destroy> {
  static constexpr const char *python_name = "Adjacency";
};

struct Mesh : Handle<riis_mesh, riis_mesh_destroy> {
  static constexpr const char *python_name = "Mesh";
  Points points;  // the caller's coordinates, kept alive, or the axes of a grid
  bool is_grid = false;
  std::vector<Array> rows;  // the caller's arrays of rows
  nb::object adjacency;     // an Adjacency whose rows are used, kept alive
  std::int64_t places = new_places();
  const std::int64_t number = places;  // differs for every mesh, and stays the same after updates
  nb::object judged_nodes;             // what riis._tube knows of the nodes at their present positions

  // Returns a number for the nodes' present positions. The number differs for every mesh, and after every update.
  static std::int64_t new_places();

  ~Mesh() { riis_mesh_destroy(&handle); }  // destroys the handle before the borrowed arrays
  void close(const char *name);
};

struct Marks : Handle<riis_marks, riis_marks_destroy> {
  static constexpr const char *python_name = "Marks";
  std::int64_t n_nodes = -1;   // number of nodes in the last marking, -1 before the first
  std::int32_t n_threads = 0;  // the number of threads that the marking requested
  int marking_fork = 0;        // fork_number() at the marking
  std::int64_t places = 0;     // the mesh's number `places` at the marking
  double half_thickness = 0;   // the surface's half thickness at the marking

  // Refuses calls that would need several threads, which a child of fork() lacks.
  void check_threads(const char *name) const;
};

// Returns a class of riis._records, which makes a record when called.
nb::object record(const char *name);

// The options of a marking, which several calls share.
struct MarkOptions {
  // Refuses a mask that does not match the mesh.
  MarkOptions(const Mesh &mesh, nb::handle mask, nb::handle n_threads);
  riis_mark_options options;
  std::optional<Array> mask;
};

// Changes the options that the keywords name. If a keyword is None, its option does not change.
void set_surface_options(riis_surface_options &options, nb::handle keywords, const char *name);
// Changes scale, rotation and translation as the placement says, and no other options.
void set_placement(riis_surface_options &options, nb::handle placement, const char *name);

// Adds a method to a class that another source file defined.
template <class Function, class... Extra>
void add_method(nb::module_ &module, const char *type, const char *name, Function function, const Extra &...extra) {
  nb::cpp_function_def(function, nb::scope(module.attr(type)), nb::name(name), nb::is_method(), extra...);
}

// Gives a valve the warps that pickled states describe.
void warp_as_pickled(nb::handle valve, nb::handle state);
void add_warp(nb::module_ &module);

void add_log(nb::module_ &module);
void add_valve(nb::module_ &module);
void add_keyframes(nb::module_ &module);
void add_surface(nb::module_ &module);
void add_closest(nb::class_<Surface> &surface);
void add_mesh(nb::module_ &module);
void add_marking(nb::module_ &module);
// rim may be None.
riis_resistance resistance_of(nb::handle R, nb::handle half_thickness, nb::handle rim);
void add_resistance(nb::class_<Marks> &result);
void add_leaks(nb::module_ &module);
void add_loads(nb::module_ &module);
void add_patient(nb::module_ &module);
void add_laws(nb::module_ &module);
void add_measures(nb::module_ &module);

}  // namespace riis_python
