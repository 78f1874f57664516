// SPDX-License-Identifier: Apache-2.0
// A tetrahedral mesh of a cylinder around the z axis, and its marks.
// Input: the cylinder, the size of cells, a valve. Output: nodes, tetrahedra, marks, and faces to draw.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "figures/shapes.hpp"

namespace riis::figures {

struct Cylinder {
  Vec3 middle;
  double radius, height;
};

struct TetrahedralMesh {
  std::vector<double> xyz;  // (3, n_nodes)
  std::vector<std::array<std::int64_t, 4>> tetrahedra;

  std::size_t n_nodes() const { return xyz.size() / 3; }
  Vec3 node(std::int64_t i) const {
    const double *p = xyz.data() + 3 * i;
    return {p[0], p[1], p[2]};
  }
};

// Makes hexahedra and cuts each into 6 tetrahedra along the same diagonal, so that neighbours match.
TetrahedralMesh mesh_cylinder(const Cylinder &cylinder, double edge);

struct Marks {
  std::size_t n_marked;               // number of marked nodes
  std::vector<std::int32_t> leaflet;  // for each tetrahedron, the leaflet of its closest marked node, or -1
  std::vector<bool> is_whole;         // whether all four nodes are marked
  std::size_t n_whole, n_touched;     // number of tetrahedra with all nodes marked, and with at least one
};
// Marks nodes through the public interface, as users do. The valve has the given kind, its default parameters and the given
// opening.
Marks mark(const TetrahedralMesh &mesh, const char *kind, double opening, double tolerance);

// Returns the outer faces of the tetrahedra with all nodes marked.
Faces marked_faces(const TetrahedralMesh &mesh, const Marks &marks);

// Cuts the mesh by the plane through the origin with the given normal. Faces have the colour of their tetrahedron's leaflet,
// paler if only some of its nodes are marked, or light grey if none is.
Faces slice(const TetrahedralMesh &mesh, const Marks &marks, Vec3 normal, Segments &edges);

}  // namespace riis::figures
