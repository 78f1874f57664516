// SPDX-License-Identifier: Apache-2.0
// A competitor of the library's marking, built if OpenVDB was found. It makes a narrow band of voxels with distances, and
// interpolates them at the nodes. It runs on one thread and in single precision.
#pragma once

#include <cstdint>
#include <memory>

#include "shared/references.hpp"

namespace bench {

class OpenVdbBand {
 public:
  // The band reaches one voxel beyond the limit.
  OpenVdbBand(const Triangles &triangles, double voxel, double limit);
  ~OpenVdbBand();
  // Makes the band. This must be repeated if the surface moved.
  void make();
  // distance: (n_nodes); about the limit for nodes outside the band. xyz: (3, n_nodes).
  void distances(std::int64_t n_nodes, const double *xyz, double *distance) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace bench
