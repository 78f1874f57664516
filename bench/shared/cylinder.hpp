// SPDX-License-Identifier: Apache-2.0
// Makes meshes like those of the paper: cylinders of tetrahedra around a valve, with any number of nodes.
#pragma once

#include <cstdint>
#include <vector>

#include "handles.hpp"

namespace bench {

struct Cylinder {
  double radius, lower, upper;  // around the z axis, cm
  double centre_y;
};

// The cylinders of the aortic and of the mitral valve. The aortic cylinder is slightly larger than the demo's cylinder, and the
// mitral cylinder equals the demo's. About 4 % of the nodes are marked. In the paper, one search takes 18 to 26 times as long as
// the other, which suggests this fraction of marked nodes.
inline constexpr Cylinder cylinders[] = {{1.8, -1.6, 0.9, 0}, {2.4, -1.35, 2.1, 0.3}};

// A wider cylinder around the aortic valve. About 3 % of the nodes are within 0.1 cm of the valve. The ratio of the two searches'
// times in the paper suggests that this fraction is also 3 % in the paper's meshes.
inline constexpr Cylinder wide_cylinder{2.0, -2.1, 1.3, 0};

// A structured grid, deformed into a cylinder.
class CylinderNodes {
 public:
  CylinderNodes(const Cylinder &cylinder, std::int64_t about_n_nodes);

  std::int64_t n_nodes() const { return n_across_ * n_across_ * n_along_; }
  std::int64_t n_across() const { return n_across_; }
  std::int64_t n_along() const { return n_along_; }
  const std::vector<double> &xyz() const { return xyz_; }
  // Cuts each cell into 6 tetrahedra.
  std::vector<std::int32_t> tetrahedra() const;

 private:
  std::int64_t n_across_, n_along_;
  std::vector<double> xyz_;
};

// Makes a riis_mesh from these nodes. The mesh borrows their coordinates.
Mesh mesh_over(const CylinderNodes &nodes);

// A mesh whose adjacency is computed from its tetrahedra.
class CylinderMesh : public CylinderNodes {
 public:
  CylinderMesh(const Cylinder &cylinder, std::int64_t about_n_nodes);

  // The rows have 64-bit offsets and 32-bit columns.
  riis_csr rows() const;
  // The mesh borrows the coordinates of this object.
  const riis_mesh *mesh() const { return mesh_.get(); }

 private:
  Adjacency adjacency_;
  Mesh mesh_;
};

Adjacency adjacency_of(std::int64_t n_nodes, const std::vector<std::int32_t> &tetrahedra, int n_threads);

// Returns the number of nodes: argv[at] in thousands, or a million without this argument. If the number is below
// fewest_thousands, ends the program with status 2 and a message.
std::int64_t n_nodes_given(int argc, char **argv, int at, std::int64_t fewest_thousands);

}  // namespace bench
