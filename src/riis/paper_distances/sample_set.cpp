// SPDX-License-Identifier: Apache-2.0
#include "paper_distances/patch_distance.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/errors.hpp"
#include "common/array_view.hpp"

namespace riis {
namespace {

// Returns the least number of equal steps from 0 to 1 whose length is at most h. Returns at most too_many.
std::int64_t n_steps(double h) {
  constexpr double too_many = 1e15;
  return h < 1 ? static_cast<std::int64_t>(std::min(std::ceil(1 / h), too_many)) : 1;
}

}  // namespace

double covering_radius(const QuadGrid &grid, double h_u, double h_v) {
  double longest = 0;
  for_each_derivatives(grid, [&](const auto &along_u, const auto &along_v) {
    for (const Vec3 &u : along_u)
      for (const Vec3 &v : along_v) {
        const Vec3 a = h_u * u, b = h_v * v;
        longest = std::max({longest, length(a + b), length(a - b)});
      }
  });
  return 0.5 * longest;
}

SampleCounts samples_within(const QuadGrid &grid, double radius) {
  // Where grid lines meet at right angles, samples with these steps form squares. If the width or height of a patch is
  // negligible, one step spans it.
  const Speeds speeds = largest_speeds(grid);
  const double h_u = std::min(1.0, radius / speeds.u), h_v = std::min(1.0, radius / speeds.v);
  const double of_squares = covering_radius(grid, h_u, h_v);
  // If both steps are multiplied by a factor, so is the covering radius. The factor is chosen so that the covering radius equals
  // `radius`. A step above 1 counts as a step of 1.
  const double factor = of_squares > 0 ? radius / of_squares : 1;
  return {n_steps(factor * h_u), n_steps(factor * h_v)};
}

SampleSet::SampleSet(PlacedPatches patches, double max_error) : PatchDistance(std::move(patches)) {
  double n = 0;
  for (std::size_t i = 0; i < patches_.patches.size(); ++i) {
    counts_.push_back(samples_within(patches_.patches[i].grid, max_error - patches_.errors[i]));
    n += counts_.back().n();
  }
  if (!(n <= static_cast<double>(max_samples)))
    fail(RIIS_LIMIT_EXCEEDED, "sampling needs more than ", max_samples, " samples, about ", std::ceil(n),
         ", to be accurate to ", max_error, ", which is measure_tolerance * half_thickness");
  xyz_.reserve(3 * static_cast<std::size_t>(n));
  add_patches(0, static_cast<std::int32_t>(patches_.patches.size()));
}

// Adds a part of the tree of boxes. Each level halves the list of patches. Within a patch, each level halves the longer side of a
// block of samples.
std::int32_t SampleSet::add_patches(std::int32_t begin, std::int32_t end) {
  if (end - begin == 1) {
    const SampleCounts &counts = view(counts_)[begin];
    return add_samples(begin, {0, 0, static_cast<std::int32_t>(counts.u + 1), static_cast<std::int32_t>(counts.v + 1)});
  }
  const auto node = static_cast<std::int32_t>(nodes_.size());
  nodes_.emplace_back();
  const std::int32_t middle = begin + (end - begin) / 2;
  add_patches(begin, middle);
  join(node, add_patches(middle, end));
  return node;
}

std::int32_t SampleSet::add_samples(std::int32_t patch, const Samples &samples) {
  const auto node = static_cast<std::int32_t>(nodes_.size());
  nodes_.emplace_back();
  const auto &[column, row, n_columns, n_rows] = samples;
  if (std::int64_t{n_columns} * n_rows <= samples_per_leaf) {
    add_leaf(patch, samples, nodes_.back());
    return node;
  }
  // A step in u is about as long as a step in v, so the longer side has more steps.
  if (n_columns >= n_rows) {
    const std::int32_t half = n_columns / 2;
    add_samples(patch, {column, row, half, n_rows});
    join(node, add_samples(patch, {column + half, row, n_columns - half, n_rows}));
  } else {
    const std::int32_t half = n_rows / 2;
    add_samples(patch, {column, row, n_columns, half});
    join(node, add_samples(patch, {column, row + half, n_columns, n_rows - half}));
  }
  return node;
}

void SampleSet::add_leaf(std::int32_t patch, const Samples &samples, Node &node) {
  const SampleCounts &counts = view(counts_)[patch];
  const PlacedPatch &of = view(patches_.patches)[patch];
  node.leaf = static_cast<std::int32_t>(leaves_.size());
  leaves_.push_back({n_samples(), patch, samples.column, samples.row, samples.n_columns, samples.n_rows});
  for (std::int32_t j = samples.row; j < samples.row + samples.n_rows; ++j)
    for (std::int32_t i = samples.column; i < samples.column + samples.n_columns; ++i) {
      const Vec3 p = of.at(static_cast<double>(i) / static_cast<double>(counts.u),
                           static_cast<double>(j) / static_cast<double>(counts.v));
      for (const double x : {p.x, p.y, p.z}) xyz_.push_back(x);
      node.box.add(p);
    }
}

void SampleSet::join(std::int32_t node, std::int32_t second) {
  Node &of = view(nodes_)[node];
  of.second = second;
  of.box.add(view(nodes_)[node + 1].box);
  of.box.add(view(nodes_)[second].box);
}

struct SampleSet::Query {
  Vec3 p;
  double most;  // samples with a larger squared distance no longer matter
  double distance_sq = std::numeric_limits<double>::infinity();
  std::int64_t sample = -1;
  std::int32_t leaf = -1;
};

void SampleSet::visit(std::int32_t at, Query &query) const {
  const Node &node = view(nodes_)[at];
  if (node.second >= 0) {
    std::int32_t near = at + 1, far = node.second;
    double to_near = view(nodes_)[near].box.distance_sq_to(query.p);
    double to_far = view(nodes_)[far].box.distance_sq_to(query.p);
    if (to_far < to_near) {
      std::swap(near, far);
      std::swap(to_near, to_far);
    }
    // A box that is exactly as far as the nearest sample so far is also visited. Of several equally near samples, the search thus
    // always finds the first, in whatever order the boxes are visited.
    if (to_near <= query.most) visit(near, query);
    if (to_far <= query.most) visit(far, query);
    return;
  }
  const Leaf &leaf = view(leaves_)[node.leaf];
  const std::int64_t n = std::int64_t{leaf.n_columns} * leaf.n_rows;
  const double *xyz = xyz_.data() + 3 * leaf.first;
  for (std::int64_t k = 0; k < n; ++k) {
    const Vec3 to_sample = Vec3{xyz[3 * k], xyz[3 * k + 1], xyz[3 * k + 2]} - query.p;
    const double distance_sq = dot(to_sample, to_sample);
    if (distance_sq < query.distance_sq || (distance_sq == query.distance_sq && leaf.first + k < query.sample)) {
      query.distance_sq = distance_sq;
      query.sample = leaf.first + k;
      query.leaf = node.leaf;
    }
  }
  query.most = std::min(query.most, query.distance_sq);
}

ClosestOnPatches SampleSet::closest(Vec3 p, double limit) const {
  // The factor covers the rounding of limit * limit and of the square root below.
  Query query{p, limit * limit * (1 + 1e-15)};
  visit(0, query);
  if (query.sample < 0 || !(std::sqrt(query.distance_sq) <= limit)) return {};
  const Leaf &leaf = view(leaves_)[query.leaf];
  const SampleCounts &counts = view(counts_)[leaf.patch];
  const std::int64_t k = query.sample - leaf.first;
  const double *xyz = xyz_.data() + 3 * query.sample;
  return {query.distance_sq,
          leaf.patch,
          static_cast<double>(leaf.column + k % leaf.n_columns) / static_cast<double>(counts.u),
          static_cast<double>(leaf.row + k / leaf.n_columns) / static_cast<double>(counts.v),
          {xyz[0], xyz[1], xyz[2]}};
}

bool SampleSet::may_be_within(Vec3 p, double limit) const {
  return std::sqrt(nodes_.front().box.distance_sq_to(p)) <= limit;
}

}  // namespace riis
