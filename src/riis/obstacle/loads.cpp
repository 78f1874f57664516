// SPDX-License-Identifier: Apache-2.0
#include "obstacle/loads.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/errors.hpp"
#include "base/recycled.hpp"
#include "base/sum.hpp"
#include "common/elementary.hpp"
#include "landmarks/fit.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

constexpr std::int64_t nodes_per_block = 512;  // the search for nearest edges takes most of the time

// The width of a set of nodes is their root-mean-square distance from a line. Their extent is their root-mean-square distance
// from their middle. The nodes of a leaflet lie nearly on a line if their width is less than `least_width` times their extent. If
// they do not, the equations for the moment have a condition number of at most 1 / least_width^2 = 1e4. Sums over nodes that lie
// close together lose digits, so the width must also be at least `least_width_in_frame` times the size of the frame.
constexpr double least_width = 0.01, least_width_in_frame = 0.001;

// The edges that hold a leaflet, and a frame for the nodes near them. The frame consists of the middle of the edges and a size.
// No node within the radius of the edges is farther from the middle than this size. All ranks have the same frame.
struct Hold {
  const NearestEdges *search;
  std::int32_t leaflet;
  Bounds bounds;
  Vec3 middle;
  double size;

  Vec3 local(Vec3 p) const { return (1 / size) * (p - middle); }
};

// For each leaflet, finds the edges that hold it. A leaflet without its own edges is held by all edges.
class Holds {
 public:
  explicit Holds(const Loads &loads) : loads_(loads), own_(loads.edges) {
    if (loads.edges.leaflet_id) all_.emplace(Edges{loads.edges.n, loads.edges.ends, nullptr});
  }

  Hold of(std::int32_t leaflet) const {
    const Edges &edges = loads_.edges;
    const bool has_own = edges.leaflet_id && own_.has(leaflet);
    Hold hold{has_own || !all_ ? &own_ : &*all_, leaflet, {}, {}, 0};
    for (std::int64_t i = 0; i < edges.n; ++i) {
      if (has_own && edges.leaflet_id[i] != leaflet) continue;
      hold.bounds.add(edges.first(i));
      hold.bounds.add(edges.second(i));
    }
    hold.middle = hold.bounds.middle();
    hold.size = length(hold.bounds.half_extent()) + loads_.radius;
    return hold;
  }

  // Returns the weight w(d) of a point at the distance d from the edges. The weight is 1 on the edges, and 0 from the radius on.
  double share(const Hold &hold, Vec3 point) const {
    const double radius_sq = loads_.radius * loads_.radius;
    if (!(hold.bounds.distance_sq_to(point) < radius_sq)) return 0;
    const double here = distance_sq(loads_.edges, hold.search->of(hold.leaflet, point), point);
    return here < radius_sq ? (1 + cosine_of_pi(std::sqrt(here) / loads_.radius)) / 2 : 0;
  }

 private:
  const Loads &loads_;
  NearestEdges own_;                 // the edges by leaflet, if the edges have leaflets
  std::optional<NearestEdges> all_;  // all edges together, if the edges have leaflets
};

// For each node, returns m w(d), where m is the node's area or volume.
Vector<double> weights_of(const Holds &holds, const Hold &hold, const Tissue &tissue, int n_threads) {
  Vector<double> weights(static_cast<std::size_t>(tissue.nodes.size()));
  parallel_for_ranges(tissue.nodes.size(), nodes_per_block, n_threads, [&](const Range &range, int) {
    for (std::int64_t i = range.begin; i < range.end; ++i) {
      const double own = tissue.weight ? tissue.weight[i] : 1;
      if (own > 0) view(weights)[i] = own * holds.share(hold, tissue.nodes[i]);
    }
  });
  return weights;
}

// The force of a leaflet at a node of weight w is w / whole (force + turn x s) with s = (node - middle) / size.
struct Field {
  double whole;  // the sum of the weights
  Vec3 force, turn;
  Vec3 middle;
  double size;

  Vec3 at(Vec3 node, double w) const { return (w / whole) * (force + cross(turn, (1 / size) * (node - middle))); }
};

Vec3 column(const double *array, std::int64_t i) { return {array[3 * i], array[3 * i + 1], array[3 * i + 2]}; }

void check_width(const Loads &loads, const Hold &hold, double n_nodes, const std::vector<double> &variance) {
  const double beside_sq = std::max(0.0, variance[0] + variance[1]), from_middle_sq = beside_sq + variance[2];
  if (beside_sq >= least_width * least_width * from_middle_sq &&
      beside_sq >= least_width_in_frame * least_width_in_frame)
    return;
  fail(RIIS_INVALID_ARGUMENT, "the ", n_nodes, " nodes of tissue within the radius ", loads.radius,
       " of the edges that hold leaflet ", hold.leaflet, " lie nearly on a line: their root-mean-square distance is ",
       hold.size * std::sqrt(beside_sq), " from the line and ", hold.size * std::sqrt(from_middle_sq),
       " from their middle; give a larger loads.radius, or more rows of nodes");
}

// Returns the field of a leaflet. Of all fields with the leaflet's force and moment, this field has the least sum of |force|^2 /
// w over the nodes. If moments are taken about the nodes' middle, the equations for the force and for the moment are separate.
// The matrix of the equations for the moment is 3 x 3. It is diagonal in the axes of the nodes' covariance.
Field field_of(const Loads &loads, const Hold &hold, Vec3 force, Vec3 moment, const double *sums) {
  for (std::int64_t k = 0; k < n_load_sums; ++k)
    if (!(std::abs(sums[k]) <= 1e120))
      fail(RIIS_INVALID_ARGUMENT, "sums: entry ", k, " of leaflet ", hold.leaflet, " is ", sums[k],
           "; it must come from riis_loads_add_sums");
  const double n_nodes = sums[0], whole = sums[1];
  if (!(n_nodes >= 3 && whole > 0))
    fail(RIIS_INVALID_ARGUMENT, "tissue has ", n_nodes, " nodes within the radius ", loads.radius,
         " of the edges that hold leaflet ", hold.leaflet,
         ", whose force needs at least 3: give a larger loads.radius or more nodes, and add up the sums of all ranks");
  const Vec3 mean{sums[2] / whole, sums[3] / whole, sums[4] / whole};
  const double xy = sums[8] / whole - mean.x * mean.y, xz = sums[9] / whole - mean.x * mean.z,
               yz = sums[10] / whole - mean.y * mean.z;
  const Eigen axes = symmetric_eigen({sums[5] / whole - mean.x * mean.x, xy, xz,  //
                                      xy, sums[6] / whole - mean.y * mean.y, yz,  //
                                      xz, yz, sums[7] / whole - mean.z * mean.z},
                                     3);
  check_width(loads, hold, n_nodes, axes.values);
  Field field{whole, force, {0, 0, 0}, hold.middle + hold.size * mean, hold.size};
  const Vec3 of_middle = (1 / hold.size) * (moment - cross(field.middle - loads.about, force));
  const double spread = axes.values[0] + axes.values[1] + axes.values[2];
  for (std::int64_t k = 0; k < 3; ++k) {
    const Vec3 axis = column(axes.vectors.data(), k);
    field.turn = field.turn + (dot(axis, of_middle) / (spread - view(axes.values)[k])) * axis;
  }
  return field;
}

}  // namespace

void add_load_sums(const Loads &loads, const Tissue &tissue, int n_threads, double *sums) {
  const Holds holds(loads);
  for (std::int64_t leaflet = 0; leaflet < loads.n_leaflets; ++leaflet) {
    const Hold hold = holds.of(static_cast<std::int32_t>(leaflet));
    const Vector<double> weights = weights_of(holds, hold, tissue, n_threads);
    // To get the same bits for any number of threads, a single thread adds the numbers in the order of the nodes.
    std::array<Sum, n_load_sums> added;
    for (std::int64_t i = 0; i < tissue.nodes.size(); ++i) {
      const double w = view(weights)[i];
      if (!(w > 0)) continue;
      const Vec3 s = hold.local(tissue.nodes[i]);
      const std::array<double, n_load_sums> of_node{1,
                                                    w,
                                                    w * s.x,
                                                    w * s.y,
                                                    w * s.z,
                                                    w * s.x * s.x,
                                                    w * s.y * s.y,
                                                    w * s.z * s.z,
                                                    w * s.x * s.y,
                                                    w * s.x * s.z,
                                                    w * s.y * s.z};
      for (std::int64_t k = 0; k < n_load_sums; ++k) view(added)[k].add(view(of_node)[k]);
    }
    for (std::int64_t k = 0; k < n_load_sums; ++k) sums[n_load_sums * leaflet + k] += view(added)[k].total();
  }
}

void add_load_forces(const Loads &loads, const Tissue &tissue, int n_threads, const double *sums, double *node_force) {
  const Holds holds(loads);
  std::vector<std::pair<Hold, Field>> loaded;
  for (std::int64_t leaflet = 0; leaflet < loads.n_leaflets; ++leaflet) {
    const Vec3 force = column(loads.force, leaflet), moment = column(loads.moment, leaflet), none{0, 0, 0};
    if (force == none && moment == none) continue;
    const Hold hold = holds.of(static_cast<std::int32_t>(leaflet));
    loaded.emplace_back(hold, field_of(loads, hold, force, moment, sums + n_load_sums * leaflet));
  }
  for (const auto &[hold, field] : loaded) {
    const Vector<double> weights = weights_of(holds, hold, tissue, n_threads);
    for (std::int64_t i = 0; i < tissue.nodes.size(); ++i) {
      const double w = view(weights)[i];
      if (!(w > 0)) continue;
      const Vec3 force = field.at(tissue.nodes[i], w);
      node_force[3 * i] += force.x;
      node_force[3 * i + 1] += force.y;
      node_force[3 * i + 2] += force.z;
    }
  }
}

}  // namespace riis
