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

// Of the aortic and of the mitral valve: somewhat larger than the demo's round the one, the same round the other. About 4 %
// of the nodes are marked, as many as the paper's ratio of 18 to 26 lets suppose.
inline constexpr Cylinder cylinders[] = {{1.8, -1.6, 0.9, 0}, {2.4, -1.35, 2.1, 0.3}};

// Wider, round the aortic valve: about 3 % of the nodes are within 0.1 cm of it, as in the paper's meshes by the ratio of
// its searches.
inline constexpr Cylinder wide_cylinder{2.0, -2.1, 1.3, 0};

// A structured grid bent to a cylinder.
class CylinderNodes {
 public:
  CylinderNodes(const Cylinder &cylinder, std::int64_t about_n_nodes);

  std::int64_t n_nodes() const { return n_across_ * n_across_ * n_along_; }
  std::int64_t n_across() const { return n_across_; }
  std::int64_t n_along() const { return n_along_; }
  const std::vector<double> &xyz() const { return xyz_; }
  // Each cell cut into 6.
  std::vector<std::int32_t> tetrahedra() const;

 private:
  std::int64_t n_across_, n_along_;
  std::vector<double> xyz_;
};

// These nodes as a mesh of the library's, which borrows their coordinates.
Mesh mesh_over(const CylinderNodes &nodes);

// With the adjacency by the tetrahedra.
class CylinderMesh : public CylinderNodes {
 public:
  CylinderMesh(const Cylinder &cylinder, std::int64_t about_n_nodes);

  // 64-bit offsets, 32-bit columns.
  riis_csr rows() const;
  // Borrows from this.
  const riis_mesh *mesh() const { return mesh_.get(); }

 private:
  Adjacency adjacency_;
  Mesh mesh_;
};

Adjacency adjacency_of(std::int64_t n_nodes, const std::vector<std::int32_t> &tetrahedra, int n_threads);

// The number of nodes that argv[at] gives in thousands, a million without it. Ends the program with status 2 and a message unless
// there are at least so many thousands.
std::int64_t n_nodes_given(int argc, char **argv, int at, std::int64_t fewest_thousands);

}  // namespace bench
