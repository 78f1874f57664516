// SPDX-License-Identifier: Apache-2.0
// Meshes like the paper's: cylinders that a valve fits, of tetrahedra, of any number of nodes.
#pragma once

#include <cstdint>
#include <vector>

#include "handles.hpp"

namespace bench {

struct Cylinder {
  double radius, lower, upper;  // round the z axis, cm
  double centre_y;
};

// A structured grid bent to a cylinder, each cell cut into 6 tetrahedra.
class CylinderMesh {
 public:
  CylinderMesh(const Cylinder &cylinder, std::int64_t about_n_nodes);

  std::int64_t n_nodes() const { return n_across_ * n_across_ * n_along_; }
  std::int64_t n_across() const { return n_across_; }
  std::int64_t n_along() const { return n_along_; }
  const std::vector<double> &xyz() const { return xyz_; }
  std::vector<std::int32_t> tetrahedra() const;

  // With the adjacency by its tetrahedra; borrows from this.
  const riis_mesh *mesh() const { return mesh_.get(); }

 private:
  std::int64_t n_across_, n_along_;
  std::vector<double> xyz_;
  Adjacency adjacency_;
  Mesh mesh_;
};

Adjacency adjacency_of(std::int64_t n_nodes, const std::vector<std::int32_t> &tetrahedra, int n_threads);

}  // namespace bench
