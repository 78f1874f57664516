// SPDX-License-Identifier: Apache-2.0
// Checks the arguments of riis_loads_*. The work is in obstacle/loads.cpp.
#include <cmath>
#include <limits>
#include <utility>

#include "api/structs.hpp"
#include "base/errors.hpp"
#include "base/integer_array.hpp"
#include "geometry/strided.hpp"
#include "obstacle/loads.hpp"

using riis::guarded;
using riis::require;

namespace {

const riis_loads default_loads{sizeof(riis_loads),
                               std::numeric_limits<double>::quiet_NaN(),
                               {0, 0, 0},
                               0,
                               nullptr,
                               nullptr,
                               0,
                               nullptr,
                               nullptr,
                               0,
                               0};

// Checks a vector of three numbers for each leaflet.
const double *checked_vectors(const double *vectors, const char *name, std::int64_t n_leaflets) {
  require(vectors, name);
  for (std::int64_t i = 0; i < 3 * n_leaflets; ++i)
    if (!(std::abs(vectors[i]) <= 1e120))
      riis::fail(RIIS_INVALID_ARGUMENT, name, ": ", "xyz"[i % 3], " of leaflet ", i / 3, " is ", vectors[i],
                 "; it must be finite, of magnitude at most 1e+120");
  return vectors;
}

riis::Loads checked_loads(const riis_loads &loads, bool need_forces) {
  riis::check_range("loads", "radius", loads.radius, 1e-50, 1e50);
  for (int c = 0; c < 3; ++c)
    if (!(std::abs(loads.about[c]) <= 1e60))
      riis::fail(RIIS_INVALID_ARGUMENT, "loads.about[", c, "] is ", loads.about[c],
                 "; it must be finite, of magnitude at most 1e+60");
  if (loads.n_leaflets < 1 || loads.n_leaflets > (std::int64_t{1} << 31))
    riis::fail(RIIS_INVALID_ARGUMENT, "loads.n_leaflets is ", loads.n_leaflets, "; it must be from 1 to 2^31");
  if (loads.n_edges < 1 || loads.n_edges > (std::int64_t{1} << 40))
    riis::fail(RIIS_INVALID_ARGUMENT, "loads.n_edges is ", loads.n_edges,
               "; it must be from 1 to 2^40: a surface without an attachment needs edges of the caller");
  riis::check_threads(loads.n_threads, "loads.n_threads");
  riis::check_reserved("loads.reserved", loads.reserved);
  riis::Loads checked{
      loads.radius, {loads.about[0], loads.about[1], loads.about[2]}, loads.n_leaflets, nullptr, nullptr, {}};
  if (need_forces) {
    checked.force = checked_vectors(loads.leaflet_force, "loads.leaflet_force", loads.n_leaflets);
    checked.moment = checked_vectors(loads.leaflet_moment, "loads.leaflet_moment", loads.n_leaflets);
  }
  checked.edges = riis::checked_edges("loads", loads.n_edges, loads.edges, loads.edge_leaflet_id);
  return checked;
}

// Checks the nodes and their weights, and calls use(tissue, number of threads).
template <class Use>
void with_tissue(const riis_loads &loads, const riis_points *nodes, const double *weight, const Use &use) {
  const riis_points from = riis::completed(require(nodes, "nodes"), "nodes", riis::default_points);
  const std::int64_t n = from.n_points;
  if (n < 0 || n > (std::int64_t{1} << 40))
    riis::fail(RIIS_INVALID_ARGUMENT, "nodes.n_points is ", n, "; it must be from 0 to 2^40");
  riis::check_bits("nodes.real_bits", from.real_bits);
  riis::check_reserved("nodes.reserved", from.reserved);
  riis::Vector<riis::Vec3> places;
  riis::with_points(n, {from.x, from.y, from.z}, from.stride, from.real_bits, [&](const auto &points) {
    if (n == 0) return;
    riis::check_points(points, "node", RIIS_INVALID_ARGUMENT, "nodes.");
    riis::resize(places, n);
    for (std::int64_t i = 0; i < n; ++i) riis::view(places)[i] = points[i];
  });
  for (std::int64_t i = 0; weight && i < n; ++i)
    if (!(weight[i] >= 0 && weight[i] <= 1e60))
      riis::fail(RIIS_INVALID_ARGUMENT, "weight of node ", i, " is ", weight[i], "; it must be from 0 to 1e+60");
  use(riis::Tissue{riis::view(std::as_const(places)), weight},
      riis::threads_for(loads.n_threads, "loads.n_threads", n, riis::points_per_thread));
}

}  // namespace

extern "C" {

RIIS_DEFINE_INIT(riis_loads_init, riis_loads, loads, default_loads)

riis_status riis_loads_add_sums(const riis_loads *loads, const riis_points *nodes, const double *weight, double *sums) {
  return guarded([&] {
    const riis_loads whole = riis::completed(require(loads, "loads"), "loads", default_loads);
    const riis::Loads checked = checked_loads(whole, false);
    with_tissue(whole, nodes, weight, [&](const riis::Tissue &tissue, int n_threads) {
      riis::add_load_sums(checked, tissue, n_threads, require(sums, "sums"));
    });
  });
}

riis_status riis_loads_add_forces(const riis_loads *loads, const riis_points *nodes, const double *weight,
                                  const double *sums, double *node_force) {
  return guarded([&] {
    const riis_loads whole = riis::completed(require(loads, "loads"), "loads", default_loads);
    const riis::Loads checked = checked_loads(whole, true);
    with_tissue(whole, nodes, weight, [&](const riis::Tissue &tissue, int n_threads) {
      if (tissue.nodes.size() > 0) require(node_force, "node_force");
      riis::add_load_forces(checked, tissue, n_threads, require(sums, "sums"), node_force);
    });
  });
}
}
