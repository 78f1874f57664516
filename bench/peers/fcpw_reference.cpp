// SPDX-License-Identifier: Apache-2.0
#include "peer_references.hpp"

#include <fcpw/fcpw.h>

#include <vector>

namespace bench {

struct FcpwQuery::Implementation {
  fcpw::Scene<3> scene;
};

FcpwQuery::FcpwQuery(const Triangles &triangles) : implementation_(std::make_unique<Implementation>()) {
  std::vector<fcpw::Vector<3>> corners;
  std::vector<fcpw::Vector3i> ids;
  for (std::int64_t i = 0; i < triangles.n(); ++i) {
    const double *c = triangles.corners.data() + 9 * i;
    for (int k = 0; k < 3; ++k)
      corners.emplace_back(static_cast<float>(c[3 * k]), static_cast<float>(c[3 * k + 1]),
                           static_cast<float>(c[3 * k + 2]));
    const auto first = static_cast<int>(3 * i);
    ids.emplace_back(first, first + 1, first + 2);
  }
  fcpw::Scene<3> &scene = implementation_->scene;
  scene.setObjectCount(1);
  scene.setObjectVertices(corners, 0);
  scene.setObjectTriangles(ids, 0);
  scene.build(fcpw::AggregateType::Bvh_SurfaceArea, true);
}
FcpwQuery::~FcpwQuery() = default;

void FcpwQuery::distances(std::int64_t n_nodes, const double *xyz, double *distance) const {
  for (std::int64_t i = 0; i < n_nodes; ++i) {
    const fcpw::Vector<3> p(static_cast<float>(xyz[3 * i]), static_cast<float>(xyz[3 * i + 1]),
                            static_cast<float>(xyz[3 * i + 2]));
    fcpw::Interaction<3> closest;
    implementation_->scene.findClosestPoint(p, closest);
    distance[i] = static_cast<double>(closest.d);
  }
}

}  // namespace bench
