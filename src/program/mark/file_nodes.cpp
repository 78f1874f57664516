// SPDX-License-Identifier: Apache-2.0
#include "program/mark/file_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "program/base/refusal.hpp"

namespace riis::program {

double distance_between(const double *p, const double *q) { return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]); }

FileNodes::FileNodes(const riis_vtk_mesh *file, std::string path) : file_(file), path_(std::move(path)) {
  check(riis_vtk_mesh_get_nodes(file, &n_, nullptr, &xyz_));
  riis_mesh *mesh = nullptr;
  check(riis_mesh_create(n_, xyz_, xyz_ + 1, xyz_ + 2, 3, &mesh), path_);
  mesh_.reset(mesh);
}

void FileNodes::find_neighbors(std::int32_t n_threads) {
  if (neighbors_) return;
  riis_adjacency *handle = nullptr;
  check(riis_vtk_mesh_create_adjacency(file_, n_threads, &handle), path_);
  neighbors_.reset(handle);
  check(riis_adjacency_get_csr(handle, &rows_, sizeof rows_));
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
