// SPDX-License-Identifier: Apache-2.0
// ./run bench proof, its first part: shows that the search over clusters marks the same nodes as a loop over triangles. The
// search and the loop also find the same triangles, and the same distances to the last bit. The proof covers a million nodes,
// both valves, three positions, three half thicknesses, every instruction set of the processor, and 1 to 4 threads. The loop runs
// the scalar form of the library's decision kernel on every triangle whose box is near the node. A separate grid finds the
// triangles near a node. For a sample of nodes, the loop runs over every triangle. The program prints a table and fails on any
// difference.
//   argv[1]  the number of nodes in thousands, 1000 by default
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "../../tests/support/brute_force.hpp"
#include "api/handles.hpp"
#include "shared/cylinder.hpp"
#include "shared/time_steps.hpp"

namespace {

using namespace bench;

// Finds the triangles whose boxes are near a point. Each cell of the grid over the surface has a list of triangles.
class NearTriangles {
 public:
  // A triangle is ignored at points that are farther than `reach` from its box.
  NearTriangles(const riis::TriangleSet &set, double reach) : set_(set), edge_(std::max(reach, 0.05)) {
    boxes_.reserve(set.triangle_id.size());
    for (std::int64_t i = 0; i < set.n_triangles(); ++i) {
      const auto [a, b, c] = set.corners(i);
      boxes_.push_back(
          {{std::min({a.x, b.x, c.x}) - reach, std::min({a.y, b.y, c.y}) - reach, std::min({a.z, b.z, c.z}) - reach},
           {std::max({a.x, b.x, c.x}) + reach, std::max({a.y, b.y, c.y}) + reach, std::max({a.z, b.z, c.z}) + reach}});
    }
    whole_ = boxes_.front();
    for (const Box &box : boxes_)
      for (int i = 0; i < 3; ++i) {
        whole_.lower[i] = std::min(whole_.lower[i], box.lower[i]);
        whole_.upper[i] = std::max(whole_.upper[i], box.upper[i]);
      }
    for (int i = 0; i < 3; ++i) n_[i] = cell_of(whole_.upper[i], i) + 1;
    cells_.resize(n_[0] * n_[1] * n_[2]);
    for (std::size_t t = 0; t < boxes_.size(); ++t)
      for (std::size_t k = cell_of(boxes_[t].lower[2], 2); k <= cell_of(boxes_[t].upper[2], 2); ++k)
        for (std::size_t j = cell_of(boxes_[t].lower[1], 1); j <= cell_of(boxes_[t].upper[1], 1); ++j)
          for (std::size_t i = cell_of(boxes_[t].lower[0], 0); i <= cell_of(boxes_[t].upper[0], 0); ++i)
            cells_[i + n_[0] * (j + n_[1] * k)].push_back(t);
  }

  // Returns the closest of the triangles whose boxes are within reach. If several are equally close, returns the lowest. Counts
  // the pairs of points and triangles that are measured.
  riis::ClosestTriangle closest(const double *p, std::int64_t &n_pairs) const {
    riis::ClosestTriangle best{INFINITY, -1};
    if (!has(whole_, p)) return best;
    for (const std::size_t t : cells_[cell_of(p[0], 0) + n_[0] * (cell_of(p[1], 1) + n_[1] * cell_of(p[2], 2))]) {
      if (!has(boxes_[t], p)) continue;
      const auto [a, b, c] = set_.corners(t);
      const double sq = riis::closest_point_on_triangle({p[0], p[1], p[2]}, a, b, c).distance_sq;
      if (sq < best.distance_sq) best = {sq, static_cast<std::int64_t>(t)};  // positions ascend, so the lowest wins
      ++n_pairs;
    }
    return best;
  }

 private:
  struct Box {
    double lower[3], upper[3];
  };
  static bool has(const Box &box, const double *p) {
    for (int i = 0; i < 3; ++i)
      if (p[i] < box.lower[i] || p[i] > box.upper[i]) return false;
    return true;
  }
  // A larger coordinate never gives a lower cell number. If a box contains a point, the point's cell is therefore one of the
  // box's cells.
  std::size_t cell_of(double coordinate, int i) const {
    return static_cast<std::size_t>((coordinate - whole_.lower[i]) / edge_);
  }

  const riis::TriangleSet &set_;
  double edge_;
  std::vector<Box> boxes_;
  Box whole_;
  std::size_t n_[3];
  std::vector<std::vector<std::size_t>> cells_;
};

struct Expected {
  std::vector<std::int64_t> node_id, triangle_id;
  std::vector<double> distance;
  std::int64_t n_pairs = 0;
};

Expected by_brute_force(const CylinderNodes &nodes, const riis::TriangleSet &set, double half_thickness) {
  // The slack is a billion times the kernel's rounding error, for coordinates of some centimetres.
  const double slack = 1e-6;
  const NearTriangles near(set, half_thickness + slack);
  const std::int64_t n = nodes.n_nodes();
  std::vector<riis::ClosestTriangle> closest(static_cast<std::size_t>(n));
  Expected expected;
  std::int64_t n_pairs = 0;
#pragma omp parallel for schedule(dynamic, 1024) reduction(+ : n_pairs)
  for (std::int64_t i = 0; i < n; ++i)
    closest[static_cast<std::size_t>(i)] = near.closest(nodes.xyz().data() + 3 * i, n_pairs);
  expected.n_pairs = n_pairs;
  for (std::int64_t i = 0; i < n; ++i) {
    const auto [sq, triangle] = closest[static_cast<std::size_t>(i)];
    const double distance = std::sqrt(sq);
    if (!(distance <= half_thickness)) continue;
    expected.node_id.push_back(i);
    expected.distance.push_back(distance);
    expected.triangle_id.push_back(set.triangle_id[static_cast<std::size_t>(triangle)]);
  }
  return expected;
}

struct Differences {
  std::int64_t marks = 0, distances = 0, triangles = 0;
  std::int64_t all() const { return marks + distances + triangles; }
  void compare(double a, std::int64_t triangle_a, double b, std::int64_t triangle_b) {
    distances += std::memcmp(&a, &b, sizeof a) != 0;
    triangles += triangle_a != triangle_b;
  }
};

Differences compare(const Expected &expected, const riis_mark_list &marked) {
  Differences d;
  const auto n = static_cast<std::int64_t>(expected.node_id.size());
  std::int64_t i = 0, k = 0;
  while (i < n && k < marked.n_nodes) {
    const auto at = static_cast<std::size_t>(i);
    if (expected.node_id[at] != marked.node_id[k]) {
      ++d.marks;
      ++(expected.node_id[at] < marked.node_id[k] ? i : k);
      continue;
    }
    d.compare(expected.distance[at], expected.triangle_id[at], marked.distance[k], marked.triangle_id[k]);
    ++i, ++k;
  }
  d.marks += (n - i) + (marked.n_nodes - k);
  return d;
}

// Checks that the grid misses nothing. Every 997th node and a thousand marked nodes are compared with every triangle.
Differences compare_sample(const CylinderNodes &nodes, const riis::TriangleSet &set, double half_thickness,
                           const Expected &expected) {
  Differences d;
  std::int64_t marks = 0, distances = 0, triangles = 0;
  const std::int64_t every = 997, n_marked = static_cast<std::int64_t>(expected.node_id.size());
#pragma omp parallel for schedule(dynamic, 8) reduction(+ : marks)
  for (std::int64_t node = 0; node < nodes.n_nodes(); node += every) {
    const double *p = nodes.xyz().data() + 3 * node;
    const bool is_marked =
        std::sqrt(riis::closest_by_brute_force(set, {p[0], p[1], p[2]}).distance_sq) <= half_thickness;
    marks += is_marked != std::binary_search(expected.node_id.begin(), expected.node_id.end(), node);
  }
#pragma omp parallel for schedule(dynamic, 8) reduction(+ : distances, triangles)
  for (std::int64_t k = 0; k < std::min<std::int64_t>(1000, n_marked); ++k) {
    const auto at = static_cast<std::size_t>(k * n_marked / std::min<std::int64_t>(1000, n_marked));
    const double *p = nodes.xyz().data() + 3 * expected.node_id[at];
    const riis::ClosestTriangle closest = riis::closest_by_brute_force(set, {p[0], p[1], p[2]});
    Differences of_this;
    of_this.compare(std::sqrt(closest.distance_sq), set.triangle_id[static_cast<std::size_t>(closest.triangle)],
                    expected.distance[at], expected.triangle_id[at]);
    distances += of_this.distances;
    triangles += of_this.triangles;
  }
  d.marks = marks, d.distances = distances, d.triangles = triangles;
  return d;
}

// Prints one row of the table and returns the number of differences.
std::int64_t prove(const CylinderNodes &nodes, riis_mesh *mesh, StepOptions options, double position) {
  TimeSteps expected_steps(mesh, options);
  expected_steps.move_to(position);
  expected_steps.update();
  const riis::TriangleSet &set = riis::content_of(expected_steps.surface()).triangles();
  const Expected expected = by_brute_force(nodes, set, options.half_thickness);
  const Differences sample = compare_sample(nodes, set, options.half_thickness, expected);
  Differences sum;
  int n_markings = 0;
  for (options.instructions = RIIS_INSTRUCTIONS_BASELINE; options.instructions <= RIIS_INSTRUCTIONS_AVX512;
       ++options.instructions)
    for (options.n_threads = 1; options.n_threads <= 4; ++options.n_threads) {
      TimeSteps steps(mesh, options);
      if (!steps.can_mark()) continue;
      steps.move_to(position);
      const Differences d = compare(expected, steps.step());
      const riis_mark_stats stats = steps.stats();
      if (stats.search != RIIS_SEARCH_CLUSTERS || stats.instructions != options.instructions || !stats.complete) {
        std::fprintf(stderr, "search %d ran, instructions %d, complete %d\n", stats.search, stats.instructions,
                     stats.complete);
        std::exit(1);
      }
      sum.marks += d.marks, sum.distances += d.distances, sum.triangles += d.triangles;
      ++n_markings;
    }
  std::printf("| %s | %g | %g | %zu | %zu | %.1f | %d | %lld | %lld | %lld | %lld |\n", options.kind, position,
              options.half_thickness, set.triangle_id.size(), expected.node_id.size(),
              1e-6 * static_cast<double>(expected.n_pairs), n_markings, static_cast<long long>(sum.marks),
              static_cast<long long>(sum.distances), static_cast<long long>(sum.triangles),
              static_cast<long long>(sample.all()));
  std::fflush(stdout);
  // The row proves something only if nodes are marked and an instruction set ran.
  if (expected.node_id.empty() || n_markings < 4) {
    std::fprintf(stderr, "nothing was compared\n");
    std::exit(1);
  }
  return sum.all() + sample.all();
}

}  // namespace

int main(int argc, char **argv) {
  const std::int64_t about_n_nodes = n_nodes_given(argc, argv, 1, 10);
  std::printf(
      "| valve | position | half thickness | triangles | marked | million pairs asked | markings compared | marks that "
      "differ | distances | triangles | of the sample |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  std::int64_t n_differences = 0;
  for (const char *kind : {"aortic", "mitral"}) {
    StepOptions options;
    options.kind = kind;
    const CylinderNodes nodes(*kind == 'a' ? wide_cylinder : cylinders[1], about_n_nodes);
    const Mesh mesh = mesh_over(nodes);
    check(riis_mesh_prepare(mesh.get(), 0));
    for (const double position : {0.0, 0.5, 1.0})
      for (const double half_thickness : {0.03, 0.1, 0.3}) {
        options.half_thickness = half_thickness;
        n_differences += prove(nodes, mesh.get(), options, position);
      }
  }
  std::printf("\n%lld differences\n", static_cast<long long>(n_differences));
  return n_differences == 0 ? 0 : 1;
}
