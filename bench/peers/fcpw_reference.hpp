// SPDX-License-Identifier: Apache-2.0
// A competitor of every distance: FCPW's tree with eight branches and eight triangles at a time, in single precision. It is built
// if RIIS_FCPW_DIR is FCPW's source folder. FCPW's package on PyPI has four branches (peers.py).
#pragma once

#include <cstdint>
#include <memory>

#include "shared/references.hpp"

namespace bench {

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

}  // namespace bench
