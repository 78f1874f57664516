// SPDX-License-Identifier: Apache-2.0

#include "program/mark/mesh_marking.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "program/base/handles.hpp"
#include "program/base/progress.hpp"
#include "program/base/refusal.hpp"
#include "program/input/valve_source.hpp"

namespace riis::program {

Marks new_result() { return create<Marks>(riis_marks_create); }

Marks marks_of(const riis_surface *surface, riis_mesh *mesh, const riis_mark_options &how) {
  Marks marks = new_result();
  check(riis_mark_nodes(surface, mesh, &how, marks));
  return marks;
}

riis_mark_options how_to_mark_again(const MarkOptions &options, double limit) {
  riis_mark_options how = options.mark_options;
  how.search = RIIS_SEARCH_AUTO;
  how.distance_limit = limit;
  return how;
}

bool needs_adjacency(int32_t search) { return search == RIIS_SEARCH_NEIGHBOR || search == RIIS_SEARCH_PAPER; }

void rehearse_marking(const MarkOptions &options, const riis_surface *surface) {
  const double origin[3] = {0, 0, 0};
  const auto mesh = create<Mesh>(riis_mesh_create, 1, origin, origin + 1, origin + 2, 3);
  riis_mark_options mark_options = options.mark_options;
  if (needs_adjacency(mark_options.search)) mark_options.search = RIIS_SEARCH_EXHAUSTIVE;
  const Marks result = marks_of(surface, mesh, mark_options);
  auto dense = defaults<riis_dense_arrays>();
  dense.n_nodes = 1;
  dense.far_distance = options.far_distance;
  check(riis_marks_get_dense(result, &dense));
  ResistanceSum(1, ResistanceSum::WithVelocity::no).add(options, result);
}

void check_new_arrays(const MarkOptions &options, const std::vector<std::string> &names, const riis_vtk_mesh *mesh) {
  if (options.output.empty() || options.replace) return;
  for (const std::string &name : names) {
    int32_t has = 0;
    check(riis_vtk_mesh_has_point_array(mesh, name.c_str(), &has));
    if (!has) continue;
    refuse_usage(options.mesh + " already has an array " + name +
                 ": write --replace to replace it, or --prefix NAME for other arrays beside it");
  }
}

std::vector<std::string> names_of_marks(const std::string &prefix, int32_t fields) {
  std::vector<std::string> names = {prefix + "_marked", prefix + "_distance", prefix + "_leaflet"};
  if (fields & RIIS_FIELD_NORMAL) names.push_back(prefix + "_normal");
  if (fields & RIIS_FIELD_SIDE) names.push_back(prefix + "_side");
  if (fields & RIIS_FIELD_VELOCITY) names.push_back(prefix + "_velocity");
  return names;
}

ResistanceSum::ResistanceSum(int64_t n_nodes, WithVelocity with_velocity)
    : n_nodes_(n_nodes),
      K_(static_cast<std::size_t>(n_nodes), 0.0),
      K_u_surface_(with_velocity == WithVelocity::yes ? 3 * static_cast<std::size_t>(n_nodes) : 0, 0.0) {}

void ResistanceSum::add(const MarkOptions &options, const riis_marks *result) {
  if (!options.resistance) return;
  has_any_ = true;
  K_unit_ = options.K_unit;
  K_u_surface_unit_ = options.K_u_surface_unit;
  auto how = defaults<riis_resistance>();
  how.R = *options.resistance * options.K_factor;
  auto to = defaults<riis_resistance_arrays>();
  to.n_nodes = n_nodes_;
  to.K = K_.data();
  for (int c = 0; c < 3 && !K_u_surface_.empty(); ++c) to.K_u_surface[c] = K_u_surface_.data() + c;
  to.K_u_surface_stride = 3;
  check(riis_marks_add_resistance(result, &how, &to), "--resistance");
}

void ResistanceSum::set_arrays(const std::string &prefix, riis_vtk_mesh *file) const {
  if (!has_any_) return;
  const auto set = [&](const std::string &name, std::int64_t n_components, const std::vector<double> &values,
                       const std::string &unit) {
    check(riis_vtk_mesh_set_point_array(file, name.c_str(), n_nodes_, n_components, values.data()));
    if (!unit.empty()) check(riis_vtk_mesh_set_unit(file, name.c_str(), unit.c_str()));
  };
  set(prefix + "_K", 1, K_, K_unit_);
  if (!K_u_surface_.empty()) set(prefix + "_K_u_surface", 3, K_u_surface_, K_u_surface_unit_);
}

// ---- Steps ----

namespace {

// The times of the first steps do not count, because these steps sort the mesh's nodes and allocate memory that later steps
// reuse.
constexpr int n_first_steps = 2;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

StepTimes time_steps(const MarkOptions &options, const riis_valve *valve, const riis_vtk_mesh *file) {
  const Stage stage("timing " + std::to_string(options.n_steps) + " steps", options.quiet);
  const riis_mark_options &how = options.mark_options;
  FileNodes nodes(file, options.mesh);
  std::optional<FileNodes::Lent> lent;
  if (needs_adjacency(how.search)) {
    nodes.find_neighbors(how.n_threads);
    lent.emplace(nodes);
  }
  const Valve moved = copy_of(valve);
  const auto surface = create<Surface>(riis_surface_create, moved, &options.surface_options);
  const Marks result = new_result();
  std::vector<double> of_surface, of_marking;
  // The opening goes up to 1, then down to 0, and so on.
  double opening = opening_of(valve), change = opening_of_step;
  for (int i = 0; i < n_first_steps + options.n_steps; ++i) {
    if (opening + change > 1 || opening + change < 0) change = -change;
    opening = std::clamp(opening + change, 0.0, 1.0);
    const Stage step("", true);
    check(riis_valve_set_scalar(moved, "opening", opening), "--steps");
    check(riis_surface_update(surface, moved, nullptr), "--steps");
    const double updated = step.seconds();
    check(riis_mark_nodes(surface, nodes.mesh(), &how, result), options.mesh);
    const double marked = step.seconds();
    if (i < n_first_steps) continue;
    of_surface.push_back(updated);
    of_marking.push_back(marked - updated);
  }
  return {options.n_steps, stats_of(result).search, median(of_surface), median(of_marking)};
}

double distance_between(const double *p, const double *q) { return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]); }

FileNodes::FileNodes(const riis_vtk_mesh *file, std::string path) : file_(file), path_(std::move(path)) {
  check(riis_vtk_mesh_get_nodes(file, &n_, nullptr, &xyz_));
  mesh_ = create_for<Mesh>(path_, riis_mesh_create, n_, xyz_, xyz_ + 1, xyz_ + 2, 3);
}

void FileNodes::find_neighbors(std::int32_t n_threads) {
  if (neighbors_) return;
  neighbors_ = create_for<Adjacency>(path_, riis_vtk_mesh_create_adjacency, file_, n_threads);
  rows_ = get<riis_csr>(riis_adjacency_get_csr, neighbors_);
}

double FileNodes::longest_edge(std::int64_t node) const {
  double longest = 0;
  for_each_neighbor(
      node, [&](std::int64_t other) { longest = std::max(longest, distance_between(point(node), point(other))); });
  return longest;
}

FileNodes::Lent::Lent(const FileNodes &nodes, const riis_csr &rows) : mesh_(nodes.mesh()) {
  check(riis_mesh_set_adjacency(mesh_, &rows), nodes.path_);
}

}  // namespace riis::program
