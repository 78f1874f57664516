// SPDX-License-Identifier: Apache-2.0
#include "cylinder.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace bench {

CylinderNodes::CylinderNodes(const Cylinder &cylinder, std::int64_t about_n_nodes) {
  // Along the axis, edges are as long as the average edge across the axis.
  const double width = std::sqrt(M_PI) * cylinder.radius, length = cylinder.upper - cylinder.lower;
  const double edge = std::cbrt(width * width * length / static_cast<double>(about_n_nodes));
  n_across_ = std::lround(width / edge) + 1;
  n_along_ = std::lround(static_cast<double>(about_n_nodes) / static_cast<double>(n_across_ * n_across_));
  xyz_.reserve(static_cast<std::size_t>(3 * n_nodes()));
  for (std::int64_t k = 0; k < n_along_; ++k) {
    for (std::int64_t j = 0; j < n_across_; ++j) {
      for (std::int64_t i = 0; i < n_across_; ++i) {
        // Maps a square onto a disc.
        const double u = 2.0 * static_cast<double>(i) / static_cast<double>(n_across_ - 1) - 1;
        const double v = 2.0 * static_cast<double>(j) / static_cast<double>(n_across_ - 1) - 1;
        xyz_.push_back(cylinder.radius * u * std::sqrt(1 - v * v / 2));
        xyz_.push_back(cylinder.centre_y + cylinder.radius * v * std::sqrt(1 - u * u / 2));
        xyz_.push_back(cylinder.lower + length * static_cast<double>(k) / static_cast<double>(n_along_ - 1));
      }
    }
  }
}

Mesh mesh_over(const CylinderNodes &nodes) {
  const double *xyz = nodes.xyz().data();
  riis_mesh *mesh = nullptr;
  check(riis_mesh_create(nodes.n_nodes(), xyz, xyz + 1, xyz + 2, 3, &mesh));
  return Mesh(mesh);
}

CylinderMesh::CylinderMesh(const Cylinder &cylinder, std::int64_t about_n_nodes)
    : CylinderNodes(cylinder, about_n_nodes),
      adjacency_(adjacency_of(n_nodes(), tetrahedra(), 0)),
      mesh_(mesh_over(*this)) {
  const riis_csr of_tetrahedra = rows();
  check(riis_mesh_set_adjacency(mesh_.get(), &of_tetrahedra));
}

riis_csr CylinderMesh::rows() const {
  riis_csr rows;
  check(riis_adjacency_get_csr(adjacency_.get(), &rows, sizeof rows));
  return rows;
}

std::vector<std::int32_t> CylinderNodes::tetrahedra() const {
  // The six paths along the edges of a box from one corner to the opposite corner.
  constexpr int paths[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  const std::int64_t step[3] = {1, n_across_, n_across_ * n_across_};
  std::vector<std::int32_t> nodes;
  nodes.reserve(static_cast<std::size_t>(24 * (n_across_ - 1) * (n_across_ - 1) * (n_along_ - 1)));
  for (std::int64_t k = 0; k + 1 < n_along_; ++k) {
    for (std::int64_t j = 0; j + 1 < n_across_; ++j) {
      for (std::int64_t i = 0; i + 1 < n_across_; ++i) {
        for (const auto &path : paths) {
          std::int64_t node = i + n_across_ * (j + n_across_ * k);
          nodes.push_back(static_cast<std::int32_t>(node));
          for (const int axis : path) nodes.push_back(static_cast<std::int32_t>(node += step[axis]));
        }
      }
    }
  }
  return nodes;
}

Adjacency adjacency_of(std::int64_t n_nodes, const std::vector<std::int32_t> &tetrahedra, int n_threads) {
  riis_mesh_cells cells;
  check(riis_mesh_cells_init(&cells, sizeof cells));
  cells.n_nodes = n_nodes;
  cells.n_cells = static_cast<std::int64_t>(tetrahedra.size() / 4);
  cells.node_ids = tetrahedra.data();
  cells.n_threads = n_threads;
  riis_adjacency *adjacency = nullptr;
  check(riis_adjacency_create_from_cells(&cells, &adjacency));
  return Adjacency(adjacency);
}

std::int64_t n_nodes_given(int argc, char **argv, int at, std::int64_t fewest_thousands) {
  const std::int64_t thousands = argc > at ? std::strtoll(argv[at], nullptr, 10) : 1000;
  if (thousands < fewest_thousands) {
    std::fprintf(stderr, "%s: not a number of thousands of nodes, %lld or more: %s\n", argv[0],
                 static_cast<long long>(fewest_thousands), argv[at]);
    std::exit(2);
  }
  return 1000 * thousands;
}

}  // namespace bench
