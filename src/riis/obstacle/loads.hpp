// SPDX-License-Identifier: Apache-2.0
// Spreads the forces of the leaflets over the nodes of the tissue that holds them (docs/theory/loads.md). The first step computes
// sums over the nodes. The second step computes a force at each node.
#pragma once

#include <cstdint>

#include "common/array_view.hpp"
#include "geometry/vec3.hpp"
#include "obstacle/nearest_edges.hpp"

namespace riis {

inline constexpr std::int64_t n_load_sums = 11;  // the number of sums of each leaflet

// The checked numbers of a riis_loads.
struct Loads {
  double radius;
  Vec3 about;
  std::int64_t n_leaflets;
  const double *force, *moment;  // (3, n_leaflets)
  Edges edges;
};

// The nodes of the tissue, with the area or volume that belongs to each node.
struct Tissue {
  ArrayView<const Vec3> nodes;
  const double *weight;  // (n), or null if each node has the weight 1
};

// Adds the sums of each leaflet to `sums`, (11, n_leaflets).
void add_load_sums(const Loads &loads, const Tissue &tissue, int n_threads, double *sums);
// Adds the forces to `node_force`, (3, n). The sums must be those over the nodes of all ranks. Fails with RIIS_INVALID_ARGUMENT
// if a leaflet's nodes are too few or lie nearly on a line. After a failure, nothing has been added.
void add_load_forces(const Loads &loads, const Tissue &tissue, int n_threads, const double *sums, double *node_force);

}  // namespace riis
