// SPDX-License-Identifier: Apache-2.0
#include "measures/measures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "common/array_view.hpp"
#include "geometry/vec3.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

// Measures how deep two triangles penetrate each other, and finds the segment that they have in common. No
// triangle may have the area 0, and coordinates are at most 1e60.

using Triangle = std::array<Vec3, 3>;

struct CommonSegment {
  Vec3 middle;
  double length;
};

// Finds the least overlap of two triangles over the directions that are passed to along(). The penetration depth is the distance
// from the origin to the boundary of the triangles' Minkowski difference. This distance is the least overlap along the normals of
// the difference's faces. The normal of a face is either the normal of one triangle, or the cross product of one edge of each
// triangle.
class Overlap {
 public:
  Overlap(const Triangle &a, const Triangle &b, double limit) : a_(a), b_(b), limit_(limit) {}

  double least() const { return least_; }

  // Includes the overlap along w. Returns whether the least overlap so far is above the limit.
  bool along(Vec3 w) {
    const auto [a_low, a_high] = extent(w, a_);
    const auto [b_low, b_high] = extent(w, b_);
    least_ = std::min(least_, std::min(a_high - b_low, b_high - a_low) / length(w));
    return least_ > limit_;
  }

 private:
  static std::pair<double, double> extent(Vec3 w, const Triangle &t) {
    const double x = dot(w, t[0]), y = dot(w, t[1]), z = dot(w, t[2]);
    return {std::min({x, y, z}), std::max({x, y, z})};
  }

  const Triangle &a_, &b_;
  double limit_, least_ = std::numeric_limits<double>::infinity();
};

Triangle moved(const Triangle &t, Vec3 origin) { return {t[0] - origin, t[1] - origin, t[2] - origin}; }

std::array<Vec3, 3> edges_of(const Triangle &t) { return {t[1] - t[0], t[2] - t[1], t[0] - t[2]}; }

// Returns whether the triangle t extends farther than the limit on both sides of a plane. The corners of t are relative to a
// point of the plane, and w is the plane's normal.
bool cuts_plane(const Triangle &t, Vec3 w, double limit) {
  const double x = dot(w, t[0]), y = dot(w, t[1]), z = dot(w, t[2]), least = limit * length(w);
  return std::max({x, y, z}) > least && -std::min({x, y, z}) > least;
}

// Returns whether e and f are nearly parallel: the sine of their angle is at most 1e-8. The vector w is the cross product of e
// and f.
bool are_parallel(Vec3 w, Vec3 e, Vec3 f) { return dot(w, w) <= 1e-16 * dot(e, e) * dot(f, f); }

// Returns the shortest shift of one triangle after which the two triangles only touch. Returns 0 if this shift is at most
// `limit`, or if the triangles lie in one plane. The error is at most 2^-24 of the longest edge plus 2^-48 of the largest
// coordinate.
double penetration_depth(const Triangle &a, const Triangle &b, double limit) {
  // Most pairs of triangles are dismissed here, because one triangle does not cut the plane of the other. The corners of a
  // triangle are taken relative to a corner of the other triangle. The other triangle's plane then passes exactly through the
  // origin.
  const Vec3 normal_a = cross(a[1] - a[0], a[2] - a[0]), normal_b = cross(b[1] - b[0], b[2] - b[0]);
  const Triangle b_from_a = moved(b, a[0]);
  if (!cuts_plane(b_from_a, normal_a, limit) || !cuts_plane(moved(a, b[0]), normal_b, limit)) return 0;
  const Triangle a_from_a = moved(a, a[0]);
  Overlap overlap(a_from_a, b_from_a, limit);
  if (!overlap.along(normal_a) || !overlap.along(normal_b)) return 0;
  for (const Vec3 e : edges_of(a_from_a))
    for (const Vec3 f : edges_of(b)) {
      const Vec3 w = cross(e, f);
      if (!are_parallel(w, e, f) && !overlap.along(w)) return 0;
    }
  return overlap.least();
}

// Returns the segment that two triangles have in common. The depth of the triangles must exceed the error of penetration_depth.
CommonSegment common_segment(const Triangle &a, const Triangle &b) {
  const Vec3 normal = cross(b[1] - b[0], b[2] - b[0]);
  const Triangle from_b = moved(a, b[0]);
  std::array<double, 3> height{};
  for (std::size_t k = 0; k < 3; ++k) height[k] = dot(normal, from_b[k]);
  // The plane of b has one corner of a on one side, and two on the other. `lone` is the number of the single corner.
  const auto is_below = [&](std::size_t k) { return height[k % 3] < 0; };
  std::size_t lone = 0;
  while (lone < 2 && (is_below(lone) == is_below(lone + 1) || is_below(lone) == is_below(lone + 2))) ++lone;
  const auto cut = [&](std::size_t other) {
    return mix(from_b[lone], from_b[other], height[lone] / (height[lone] - height[other]));
  };
  const Vec3 p = cut((lone + 1) % 3), q = cut((lone + 2) % 3);
  double low = 0, high = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 inward = cross(normal, b[(k + 1) % 3] - b[k]), corner = b[k] - b[0];
    const double at_p = dot(inward, p - corner), at_q = dot(inward, q - corner);
    if (at_p < 0 && at_q > at_p) low = std::max(low, at_p / (at_p - at_q));
    if (at_q < 0 && at_p > at_q) high = std::min(high, at_p / (at_p - at_q));
  }
  return {b[0] + mix(p, q, 0.5 * low + 0.5 * high), std::max(high - low, 0.0) * distance(p, q)};
}

constexpr float nowhere = std::numeric_limits<float>::infinity();

// A box in the groups' frame, in single precision. Rounding keeps the order of numbers, so boxes that overlap still overlap after
// rounding.
struct Box {
  float lower[3]{nowhere, nowhere, nowhere}, upper[3]{-nowhere, -nowhere, -nowhere};

  void add(const Box &other) {
    for (int i = 0; i < 3; ++i) {
      lower[i] = std::min(lower[i], other.lower[i]);
      upper[i] = std::max(upper[i], other.upper[i]);
    }
  }
  bool overlaps(const Box &other) const {
    bool overlaps = true;
    for (int i = 0; i < 3; ++i) overlaps = overlaps && lower[i] <= other.upper[i] && other.lower[i] <= upper[i];
    return overlaps;
  }
};

// The boxes of a group's triangles, one in each lane. In lanes without a triangle, lower is above upper.
struct TriangleBoxes {
  float lower[3][triangles_per_group], upper[3][triangles_per_group];

  Box at(int lane) const {
    Box box;
    for (int i = 0; i < 3; ++i) box.lower[i] = lower[i][lane], box.upper[i] = upper[i][lane];
    return box;
  }
  // Returns one bit for each lane, which is set if the lane's box overlaps the given box.
  std::uint32_t overlapping(const Box &box) const {
    std::uint8_t hit[triangles_per_group];  // an array, because compilers vectorise a loop over it
    for (int k = 0; k < triangles_per_group; ++k)
      hit[k] = (lower[0][k] <= box.upper[0]) & (box.lower[0] <= upper[0][k]) & (lower[1][k] <= box.upper[1]) &
               (box.lower[1] <= upper[1][k]) & (lower[2][k] <= box.upper[2]) & (box.lower[2] <= upper[2][k]);
    std::uint32_t bits = 0;
    for (int k = 0; k < triangles_per_group; ++k) bits |= static_cast<std::uint32_t>(hit[k]) << k;
    return bits;
  }
};

template <class Visit>
void for_each_bit(std::uint32_t bits, const Visit &visit) {
  for (; bits != 0; bits &= bits - 1) visit(__builtin_ctz(bits));
}

// A tree of boxes. On the lowest level are the boxes of groups. A box of a higher level encloses several boxes of the level
// below. Successive groups are neighbours on the surface, so even boxes of higher levels are small.
class BoxTree {
 public:
  explicit BoxTree(Vector<Box> groups) {
    levels_.push_back(std::move(groups));
    while (view(levels_.back()).size() > 1) {
      const std::int64_t n = view(levels_.back()).size();
      Vector<Box> next(static_cast<std::size_t>((n + run - 1) / run));
      for (std::int64_t i = 0; i < n; ++i) view(next)[i / run].add(view(levels_.back())[i]);
      levels_.push_back(std::move(next));
    }
  }

  const Box &group(std::int64_t g) const { return view(levels_[0])[g]; }

  // Visits group g and the groups after it, if their boxes overlap the box of g.
  template <class Visit>
  void for_each_from(std::int64_t g, const Visit &visit) const {
    descend(view(levels_).size() - 1, 0, g, group(g), visit);
  }

 private:
  static constexpr std::int64_t run = 8;

  template <class Visit>
  void descend(std::int64_t level, std::int64_t at, std::int64_t g, const Box &box, const Visit &visit) const {
    if (!view(view(levels_)[level])[at].overlaps(box)) return;
    if (level == 0) return visit(at);
    std::int64_t first = g;  // the ancestor of g in the level below
    for (std::int64_t i = 1; i < level; ++i) first /= run;
    const std::int64_t end = std::min((at + 1) * run, view(view(levels_)[level - 1]).size());
    for (std::int64_t i = std::max(at * run, first); i < end; ++i) descend(level - 1, i, g, box, visit);
  }

  Vector<Vector<Box>> levels_;
};

struct Pair {
  std::int32_t a, b;  // a < b
  double depth, length;
  Vec3 point;

  bool operator<(const Pair &other) const { return std::tie(a, b) < std::tie(other.a, other.b); }
};

class Finder {
 public:
  Finder(const TriangleSet &set, const TriangleGroups &groups, double least_depth, int n_threads)
      : set_(set), groups_(groups), least_depth_(least_depth), n_threads_(n_threads), tree_(group_boxes()) {
    resize(boxes_, n_groups());
    parallel_for_ranges(n_groups(), groups_per_task, n_threads_, [&](const Range &range, int) {
      for (std::int64_t g = range.begin; g < range.end; ++g) enclose(view(groups_.bounds)[g], view(boxes_)[g]);
    });
    rounding_ = 0x1p-46 * groups.of_all.largest_coordinate();
  }

  std::vector<Pair> find() const {
    std::vector<std::vector<Pair>> of_threads(static_cast<std::size_t>(n_threads_));
    parallel_for_ranges(n_groups(), groups_per_task, n_threads_, [&](const Range &range, int thread) {
      for (std::int64_t g = range.begin; g < range.end; ++g)
        tree_.for_each_from(g, [&](std::int64_t h) { search(g, h, view(of_threads)[thread]); });
    });
    std::vector<Pair> found;
    for (const auto &pairs : of_threads) found.insert(found.end(), pairs.begin(), pairs.end());
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  static constexpr std::int64_t groups_per_task = 8;

  std::int64_t n_groups() const { return view(groups_.bounds).size(); }

  Vector<Box> group_boxes() const {
    Vector<Box> boxes(groups_.bounds.size());
    for (std::int64_t g = 0; g < n_groups(); ++g)
      for (int i = 0; i < 3; ++i) {
        view(boxes)[g].lower[i] = view(groups_.bounds)[g].lower[i];
        view(boxes)[g].upper[i] = view(groups_.bounds)[g].upper[i];
      }
    return boxes;
  }

  Triangle corners(std::int32_t triangle) const {
    const double *c = groups_.corners.data() + 9 * static_cast<std::ptrdiff_t>(triangle);
    return {{{c[0], c[1], c[2]}, {c[3], c[4], c[5]}, {c[6], c[7], c[8]}}};
  }

  void enclose(const GroupBounds &group, TriangleBoxes &boxes) const {
    for (int lane = 0; lane < triangles_per_group; ++lane) {
      Bounds bounds;
      if (lane < group.n)
        for (const Vec3 p : corners(group.triangle[lane])) bounds.add(groups_.frame(p));
      const double lower[3] = {bounds.lower.x, bounds.lower.y, bounds.lower.z};
      const double upper[3] = {bounds.upper.x, bounds.upper.y, bounds.upper.z};
      for (int i = 0; i < 3; ++i) {
        boxes.lower[i][lane] = round_down(lower[i]);
        boxes.upper[i][lane] = round_up(upper[i]);
      }
    }
  }

  void search(std::int64_t g, std::int64_t h, std::vector<Pair> &found) const {
    const TriangleBoxes &of_g = view(boxes_)[g], &of_h = view(boxes_)[h];
    const GroupBounds &in_g = view(groups_.bounds)[g], &in_h = view(groups_.bounds)[h];
    for_each_bit(of_g.overlapping(tree_.group(h)), [&](int i) {
      const std::uint32_t later = g == h ? ~0u << (i + 1) : ~0u;
      for_each_bit(of_h.overlapping(of_g.at(i)) & later, [&](int j) {
        const std::int32_t s = in_g.triangle[i], t = in_h.triangle[j];
        compare(std::min(s, t), std::max(s, t), found);
      });
    });
  }

  void compare(std::int32_t s, std::int32_t t, std::vector<Pair> &found) const {
    const bool is_one_leaflet = view(set_.leaflet_id)[s] == view(set_.leaflet_id)[t];
    if (is_one_leaflet && share_vertex_id(s, t)) return;
    const Triangle a = corners(s), b = corners(t);
    const double depth = penetration_depth(a, b, least_depth_);
    if (depth == 0 || depth <= rounding_of(a, b)) return;
    if (is_one_leaflet && share_vertex(a, b)) return;
    const CommonSegment common = common_segment(a, b);
    found.push_back({s, t, depth, common.length, common.middle});
  }

  bool share_vertex_id(std::int32_t s, std::int32_t t) const {
    const std::int64_t *a = set_.vertex_id.data() + 3 * static_cast<std::ptrdiff_t>(s);
    const std::int64_t *b = set_.vertex_id.data() + 3 * static_cast<std::ptrdiff_t>(t);
    bool share = false;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) share |= a[i] == b[j];
    return share;
  }

  static bool share_vertex(const Triangle &a, const Triangle &b) {
    return std::any_of(a.begin(), a.end(), [&](Vec3 p) { return std::find(b.begin(), b.end(), p) != b.end(); });
  }

  // Bounds the error of a computed depth.
  double rounding_of(const Triangle &a, const Triangle &b) const {
    double longest = 0;
    for (const Triangle &t : {a, b})
      longest = std::max({longest, distance(t[0], t[1]), distance(t[1], t[2]), distance(t[2], t[0])});
    return 0x1p-24 * longest + rounding_;
  }

  const TriangleSet &set_;
  const TriangleGroups &groups_;
  double least_depth_;
  int n_threads_;
  BoxTree tree_;
  Vector<TriangleBoxes> boxes_;
  double rounding_ = 0;
};

}  // namespace

Crossings find_crossings(const TriangleSet &set, const TriangleGroups &groups, double least_depth, int n_threads) {
  const std::vector<Pair> pairs = Finder(set, groups, least_depth, n_threads).find();
  Crossings crossings;
  for (const Pair &pair : pairs) {
    for (const std::int32_t triangle : {pair.a, pair.b}) {
      crossings.triangle.push_back(triangle);
      crossings.triangle_id.push_back(view(set.triangle_id)[triangle]);
    }
    for (const double x : {pair.point.x, pair.point.y, pair.point.z}) crossings.point.push_back(x);
    crossings.depth.push_back(pair.depth);
    crossings.length.push_back(pair.length);
  }
  return crossings;
}

double depth_of_contacts(const Surface &surface) {
  // Rounding cannot cause a depth of `beyond_rounding` half thicknesses.
  constexpr double beyond_rounding = 1e-3;
  const bool is_exact = surface.source() && surface.source()->kind->has_exact_contacts;
  return is_exact ? beyond_rounding * surface.half_thickness() : 2 * surface.triangles().error_bound;
}

}  // namespace riis
