// SPDX-License-Identifier: Apache-2.0
// Declares competitors in single precision. Each competitor is built if its library was found.
#pragma once

#include <cstdint>
#include <memory>

#include "shared/references.hpp"

namespace bench {

// A competitor that computes the distance of every node: FCPW's tree with eight branches and eight triangles at a time. This
// competitor is built if RIIS_FCPW_DIR is FCPW's source folder. FCPW's package on PyPI has only four branches (peers.py).
class FcpwQuery {
 public:
  explicit FcpwQuery(const Triangles &triangles);
  ~FcpwQuery();
  // distance: (n_nodes). xyz: (3, n_nodes).
  void distances(std::int64_t n_nodes, const double *xyz, double *distance) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

// A competitor of the library's marking. OpenVDB makes a narrow band of voxels with distances. The distances at the nodes are
// interpolated. Everything runs on one thread.
class OpenVdbBand {
 public:
  // The band reaches one voxel beyond the limit.
  OpenVdbBand(const Triangles &triangles, double voxel, double limit);
  ~OpenVdbBand();
  // Makes the band. A new band is needed after the surface has moved.
  void make();
  // distance: (n_nodes); nodes outside the band get about the limit as their distance. xyz: (3, n_nodes).
  void distances(std::int64_t n_nodes, const double *xyz, double *distance) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace bench
