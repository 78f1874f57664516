// SPDX-License-Identifier: Apache-2.0

#include "program/mark/mesh_marking.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "common/elementary.hpp"
#include "program/base/handles.hpp"
#include "program/base/refusal.hpp"

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

ResistanceSum::ResistanceSum(int64_t n_nodes, WithVelocity with_velocity)
    : n_nodes_(n_nodes), with_velocity_(with_velocity == WithVelocity::yes) {}

void ResistanceSum::add(const MarkOptions &options, const riis_marks *result) {
  if (!options.resistance) return;
  has_any_ = true;
  K_.resize(static_cast<std::size_t>(n_nodes_));
  if (with_velocity_) K_u_surface_.resize(3 * static_cast<std::size_t>(n_nodes_));
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

double distance_between(const double *p, const double *q) { return hypotenuse(p[0] - q[0], p[1] - q[1], p[2] - q[2]); }

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

NodePoints::NodePoints(const riis_vtk_mesh *file) : axes_(get<riis_grid>(riis_vtk_mesh_get_axes, file)) {
  check(riis_vtk_mesh_get_nodes(file, &n_, nullptr, axes() ? nullptr : &xyz_));
  std::size_t axis = 0;
  for (const void *const x : {axes_.x, axes_.y, axes_.z}) x_[axis++] = static_cast<const double *>(x);
}

FileNodes::FileNodes(const riis_vtk_mesh *file, std::string path)
    : NodePoints(file), file_(file), path_(std::move(path)) {
  mesh_ = is_grid() ? create_for<Mesh>(path_, riis_mesh_create_grid, axes())
                    : create_for<Mesh>(path_, riis_mesh_create, n(), xyz(), xyz() + 1, xyz() + 2, 3);
}

void FileNodes::find_neighbors(std::int32_t n_threads) {
  if (neighbors_ || is_grid()) return;
  neighbors_ = create_for<Adjacency>(path_, riis_vtk_mesh_create_adjacency, file_, n_threads);
  rows_ = get<riis_csr>(riis_adjacency_get_csr, neighbors_);
}

double FileNodes::longest_edge(std::int64_t node) const {
  double longest = 0;
  for_each_neighbor(node, [&](std::int64_t other) {
    longest = std::max(longest, distance_between(point(node).data(), point(other).data()));
  });
  return longest;
}

FileNodes::Lent::Lent(const FileNodes &nodes, const riis_csr &rows) : mesh_(nodes.is_grid() ? nullptr : nodes.mesh()) {
  if (mesh_) check(riis_mesh_set_adjacency(mesh_, &rows), nodes.path_);
}

}  // namespace riis::program
