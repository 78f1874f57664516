// SPDX-License-Identifier: Apache-2.0
#include "peer_references.hpp"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/MeshToVolume.h>
#include <tbb/global_control.h>

#include <array>
#include <map>
#include <vector>

namespace bench {

struct OpenVdbBand::Implementation {
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  openvdb::math::Transform::Ptr transform;
  float band;  // in voxels
  openvdb::FloatGrid::Ptr grid;
};

OpenVdbBand::OpenVdbBand(const Triangles &triangles, double voxel, double limit)
    : implementation_(std::make_unique<Implementation>()) {
  openvdb::initialize();
  std::map<std::array<double, 3>, std::uint32_t> known;
  for (std::int64_t i = 0; i < triangles.n(); ++i) {
    openvdb::Vec3I ids;
    for (int corner = 0; corner < 3; ++corner) {
      const double *p = triangles.corners.data() + 9 * i + 3 * corner;
      const auto [at, is_new] =
          known.try_emplace({p[0], p[1], p[2]}, static_cast<std::uint32_t>(implementation_->points.size()));
      if (is_new) {
        implementation_->points.emplace_back(static_cast<float>(p[0]), static_cast<float>(p[1]),
                                             static_cast<float>(p[2]));
      }
      ids[corner] = at->second;
    }
    implementation_->triangles.push_back(ids);
  }
  implementation_->transform = openvdb::math::Transform::createLinearTransform(voxel);
  implementation_->band = static_cast<float>(limit / voxel) + 1;
}
OpenVdbBand::~OpenVdbBand() = default;

void OpenVdbBand::make() {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  Implementation &own = *implementation_;
  own.grid = openvdb::tools::meshToUnsignedDistanceField<openvdb::FloatGrid>(*own.transform, own.points, own.triangles,
                                                                             {}, own.band);
}

void OpenVdbBand::distances(std::int64_t n_nodes, const double *xyz, double *distance) const {
  const openvdb::FloatGrid::ConstAccessor voxels = implementation_->grid->getConstAccessor();
  const openvdb::tools::GridSampler<openvdb::FloatGrid::ConstAccessor, openvdb::tools::BoxSampler> sampler(
      voxels, implementation_->grid->transform());
  for (std::int64_t i = 0; i < n_nodes; ++i)
    distance[i] = static_cast<double>(sampler.wsSample(openvdb::Vec3d(xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2])));
}

}  // namespace bench
