// SPDX-License-Identifier: Apache-2.0
#include "scene/pseudonormals.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>

#include "common/array_view.hpp"
#include "common/elementary.hpp"
#include "kernels/kernels.hpp"
#include "valve/rims.hpp"

namespace riis {
namespace {

std::uint64_t hash(Vec3 p) {
  std::uint64_t h = 0;
  for (const double coordinate : {p.x, p.y, p.z}) {
    const double positive_zero = coordinate + 0.0;  // -0 and 0 are the same position
    std::uint64_t bits;
    std::memcpy(&bits, &positive_zero, sizeof bits);
    h = (h ^ bits) * 0x9e3779b97f4a7c15;
    h ^= h >> 32;
  }
  return h;
}

// Computes the third angle from the other two, because computing an arc tangent takes long.
std::array<double, 3> angles_of(const TriangleMeasures &measures, int lane) {
  const double at_a = arc_tangent(measures.twice_area[lane], measures.product_at_a[lane]),
               at_b = arc_tangent(measures.twice_area[lane], measures.product_at_b[lane]);
  return {at_a, at_b, std::max(0.0, pi - at_a - at_b)};
}

// If faces are folded onto each other, the sum of their normals is 0 up to rounding. The triangle's own normal then replaces this
// sum.
bool has_direction(Vec3 sum) { return dot(sum, sum) > 1e-18; }

// Sorts edges by their second ends. Most lists are short. A list is already in the order of the edges' slots, and edges with
// equal ends stay in this order. The sort is written out here, because the standard library's stable sort would allocate memory.
template <class Edge>
void sort_few(Edge *begin, Edge *end) {
  constexpr std::ptrdiff_t few = 32;
  if (end - begin > few) {
    std::sort(begin, end, [](const Edge &a, const Edge &b) {
      return a.upper < b.upper || (a.upper == b.upper && a.slot < b.slot);
    });
    return;
  }
  for (Edge *next = begin + 1; next < end; ++next) {
    const Edge edge = *next;
    Edge *to = next;
    for (; to != begin && edge.upper < to[-1].upper; --to) *to = to[-1];
    *to = edge;
  }
}

}  // namespace

UnfilledShortVector<std::int32_t> distinct_positions(const TriangleSet &set, std::int64_t &n_positions) {
  // A hash table of vertices that is at most half full. Each vertex is stored at the first free place from its hash value on.
  constexpr std::int32_t none = -1;
  UnfilledShortVector<std::int32_t> position;
  resize(position, set.n_vertices());
  std::size_t size = 16;
  while (size < 2 * position.size()) size *= 2;
  Vector<std::int32_t> table(size, none);
  std::int32_t n = 0;
  for (std::int64_t i = 0; i < set.n_vertices(); ++i) {
    const Vec3 p = set.vertex(i);
    std::size_t at = hash(p) & (size - 1);
    while (table[at] != none && !(set.vertex(table[at]) == p)) at = (at + 1) & (size - 1);
    if (table[at] == none) {
      table[at] = static_cast<std::int32_t>(i);
      view(position)[i] = n++;
    } else {
      view(position)[i] = view(position)[table[at]];
    }
  }
  n_positions = n;
  return position;
}

Vec3 triangle_normal(const std::array<Vec3, 3> &corners) {
  const auto &[a, b, c] = corners;
  // Scales the edges first, so that the numbers stay within the range of doubles even for very small or very large triangles.
  const Vec3 ab = b - a, bc = c - b, ca = a - c;
  const double longest = std::sqrt(std::max({dot(ab, ab), dot(bc, bc), dot(ca, ca)}));
  const Vec3 n = cross((1.0 / longest) * (b - a), (1.0 / longest) * (c - a));
  return (1.0 / length(n)) * n;
}

Pseudonormals::Pseudonormals(const TriangleSet &set) {
  const std::int64_t n = set.n_triangles();
  std::int64_t n_positions = 0;
  const UnfilledShortVector<std::int32_t> position_of_vertex = distinct_positions(set, n_positions);
  resize(face_, n);
  resize(edge_, 3 * n);
  resize(position_, 3 * n);
  resize(edge_is_rim_, 3 * n);
  resize(corner_, n_positions);
  resize(corner_is_rim_, n_positions);
  // For each position, there is a list of the edges whose end with the lower number lies there. Each list is short. After the
  // list is sorted, equal edges follow each other.
  Vector<std::int32_t> end_of_list;
  resize(end_of_list, n_positions + 1);
  const auto ends_at = view(end_of_list);
  const Kernels &simd = kernels(best_instruction_set());
  for (std::int64_t first = 0; first < n; first += pairs_at_once) {
    const auto n_here = static_cast<std::int32_t>(std::min<std::int64_t>(pairs_at_once, n - first));
    TriangleMeasures measures;
    simd.measure_triangles(set.xyz.data(), set.vertex_id.data() + 3 * first, n_here, measures);
    for (std::int32_t lane = 0; lane < n_here; ++lane) {
      const std::int64_t i = first + lane;
      const Vec3 normal{measures.normal[0][lane], measures.normal[1][lane], measures.normal[2][lane]};
      view(face_)[i] = normal;
      const std::array<double, 3> angles = angles_of(measures, lane);
      for (std::int64_t k = 0; k < 3; ++k) {
        const std::int32_t position = view(position_of_vertex)[view(set.vertex_id)[3 * i + k]];
        view(position_)[3 * i + k] = position;
        Vec3 &sum = view(corner_)[position];
        sum = sum + view(angles)[k] * normal;
      }
      for (std::int64_t k = 0; k < 3; ++k) ++ends_at[ends_of(3 * i + k).lower];
    }
  }
  std::partial_sum(end_of_list.begin(), end_of_list.end(), end_of_list.begin());
  struct Edge {
    std::int32_t upper, slot;  // position of its upper end, index in edge_
  };
  UnfilledShortVector<Edge> edges;
  resize(edges, 3 * n);
  // Each list is filled from its end, which puts equal edges in the order of their slots. The sums thus have the same bits,
  // however the positions are numbered.
  for (std::int64_t slot = 3 * n; slot-- > 0;) {
    const auto [lower, upper] = ends_of(slot);
    view(edges)[--ends_at[lower]] = {upper, static_cast<std::int32_t>(slot)};
  }
  for (std::int64_t lower = 0; lower < n_positions; ++lower) {
    Edge *const end = edges.data() + ends_at[lower + 1];
    Edge *first = edges.data() + ends_at[lower];
    sort_few(first, end);
    while (first != end) {
      Vec3 sum{0, 0, 0};
      const Edge *last = first;
      for (; last != end && last->upper == first->upper; ++last) {
        sum = sum + view(face_)[last->slot / 3];
        for (const Edge *other = first; other != last; ++other) note_directions(other->slot, last->slot);
      }
      if (set.rim_sides.empty() && last - first == 1) note_rim(first->slot);
      for (; first != last; ++first) view(edge_)[first->slot] = sum;
    }
  }
  if (!set.rim_sides.empty()) note_rim_sides(set);
}

// Records that an edge and its ends are on the rim.
void Pseudonormals::note_rim(std::int64_t slot) {
  const auto [lower, upper] = ends_of(slot);
  view(edge_is_rim_)[slot] = view(corner_is_rim_)[lower] = view(corner_is_rim_)[upper] = 1;
}

// Records the two triangles of an edge if both have the edge in the same direction.
void Pseudonormals::note_directions(std::int64_t slot, std::int64_t other) {
  if (disagreeing_[0] >= 0 || view(position_)[slot] != view(position_)[other]) return;
  disagreeing_ = {slot / 3, other / 3};
}

void Pseudonormals::note_rim_sides(const TriangleSet &set) {
  UnfilledShortVector<std::uint8_t> sides;
  resize(sides, set.n_vertices());
  for (std::int64_t i = 0; i < set.n_vertices(); ++i) view(sides)[i] = sides_of_place(set.uv.data() + 2 * i);
  for (std::int64_t i = 0; i < set.n_triangles(); ++i) {
    const int rim = view(set.rim_sides)[view(set.patch_id)[i]];
    const std::int64_t *id = set.vertex_id.data() + 3 * i;
    const int a = rim & view(sides)[id[0]], b = rim & view(sides)[id[1]], c = rim & view(sides)[id[2]];
    if (((a & b) | (b & c) | (c & a)) == 0) continue;
    if (a & b) note_rim(3 * i);
    if (b & c) note_rim(3 * i + 1);
    if (c & a) note_rim(3 * i + 2);
  }
}

Pseudonormals::Ends Pseudonormals::ends_of(std::int64_t slot) const {
  const auto position = view(position_);
  const std::int32_t from = position[slot], to = position[slot % 3 == 2 ? slot - 2 : slot + 1];
  return from < to ? Ends{from, to} : Ends{to, from};
}

Pseudonormals::Simplex Pseudonormals::simplex_of(Vec3 barycentric) {
  // The index is a sum with a term for each weight that is 0: 1 for the first weight, 2 for the second, 4 for the third.
  static constexpr Simplex simplices[8] = {{Kind::face, 0}, {Kind::edge, 1},   {Kind::edge, 2},   {Kind::vertex, 2},
                                           {Kind::edge, 0}, {Kind::vertex, 1}, {Kind::vertex, 0}, {Kind::vertex, 0}};
  return simplices[(barycentric.x == 0 ? 1 : 0) + (barycentric.y == 0 ? 2 : 0) + (barycentric.z == 0 ? 4 : 0)];
}

Pseudonormals::Feature Pseudonormals::at_border(std::int64_t triangle, Vec3 barycentric) const {
  const auto [kind, corner] = simplex_of(barycentric);
  if (kind == Kind::face) return {of_face(triangle), false};
  const std::int64_t slot = 3 * triangle + corner, position = view(position_)[slot];
  const bool is_vertex = kind == Kind::vertex;
  const Vec3 normal = is_vertex ? view(corner_)[position] : view(edge_)[slot];
  const bool is_on_rim = (is_vertex ? view(corner_is_rim_)[position] : view(edge_is_rim_)[slot]) != 0;
  return {has_direction(normal) ? normal : of_face(triangle), is_on_rim};
}

namespace {

// The corners of a triangle and their rates.
struct MovingTriangle {
  std::array<Vec3, 3> corner, rate;

  MovingTriangle(const TriangleSet &set, const double *rates, std::int64_t triangle) : corner(set.corners(triangle)) {
    const std::int64_t *const id = set.vertex_id.data() + 3 * triangle;
    for (std::int64_t k = 0; k < 3; ++k) {
      const double *const v = rates + 3 * id[k];
      view(rate)[k] = {v[0], v[1], v[2]};
    }
  }

  // The two edges at a corner, and the rates of these edges.
  struct Edges {
    Vec3 ab, ac, ab_rate, ac_rate;
  };
  Edges edges_of(std::int64_t k) const {
    const std::int64_t b = (k + 1) % 3, c = (k + 2) % 3;
    return {view(corner)[b] - view(corner)[k], view(corner)[c] - view(corner)[k], view(rate)[b] - view(rate)[k],
            view(rate)[c] - view(rate)[k]};
  }

  Vec3 normal_rate(Vec3 normal) const {
    const auto [ab, ac, ab_rate, ac_rate] = edges_of(0);
    const Vec3 moved = cross(ab_rate, ac) + cross(ab, ac_rate);
    return (1 / length(cross(ab, ac))) * (moved - dot(normal, moved) * normal);
  }

  struct Angle {
    double value, rate;
  };
  Angle angle_at(std::int64_t k, Vec3 normal) const {
    const auto [ab, ac, ab_rate, ac_rate] = edges_of(k);
    const double sine = length(cross(ab, ac)), cosine = dot(ab, ac);
    const double sine_rate = dot(normal, cross(ab_rate, ac) + cross(ab, ac_rate)),
                 cosine_rate = dot(ab_rate, ac) + dot(ab, ac_rate);
    return {arc_tangent(sine, cosine), (cosine * sine_rate - sine * cosine_rate) / (sine * sine + cosine * cosine)};
  }
};

}  // namespace

Pseudonormals::Rates Pseudonormals::rates_of(const TriangleSet &set, const double *rates) const {
  const std::int64_t n = set.n_triangles();
  Rates made;
  resize(made.rim_edge, 3 * n);
  resize(made.corner, view(corner_).size());
  // Edges of triangles that coincide with an edge of the rim: both ends are the same. The list is ordered by these ends.
  struct Edge {
    Ends ends;
    std::int64_t slot;
  };
  Vector<Edge> edges;
  for (std::int64_t slot = 0; slot < 3 * n; ++slot) {
    const Ends ends = ends_of(slot);
    if (view(corner_is_rim_)[ends.lower] && view(corner_is_rim_)[ends.upper]) edges.push_back({ends, slot});
  }
  const auto precedes = [](const Edge &a, const Edge &b) {
    return a.ends.lower != b.ends.lower   ? a.ends.lower < b.ends.lower
           : a.ends.upper != b.ends.upper ? a.ends.upper < b.ends.upper
                                          : a.slot < b.slot;
  };
  std::sort(edges.begin(), edges.end(), precedes);
  Vector<Vec3> of_face;
  resize(of_face, n);
  for (std::int64_t i = 0; i < n; ++i) {
    const MovingTriangle moving(set, rates, i);
    const Vec3 normal = view(face_)[i], rate = view(of_face)[i] = moving.normal_rate(normal);
    for (std::int64_t k = 0; k < 3; ++k) {
      const MovingTriangle::Angle angle = moving.angle_at(k, normal);
      Vec3 &sum = view(made.corner)[view(position_)[3 * i + k]];
      sum = sum + angle.rate * normal + angle.value * rate;
    }
  }
  for (auto first = edges.begin(); first != edges.end();) {
    Vec3 sum{0, 0, 0};
    auto last = first;
    const auto is_same = [&](const Edge &edge) {
      return edge.ends.lower == first->ends.lower && edge.ends.upper == first->ends.upper;
    };
    for (; last != edges.end() && is_same(*last); ++last) sum = sum + view(of_face)[last->slot / 3];
    for (; first != last; ++first) view(made.rim_edge)[first->slot] = sum;
  }
  return made;
}

Vec3 Pseudonormals::rate_at_rim(const Rates &rates, const TriangleSet &set, const double *vertex_rates,
                                std::int64_t triangle, Vec3 barycentric) const {
  const auto [kind, corner] = simplex_of(barycentric);
  const std::int64_t slot = 3 * triangle + corner, position = view(position_)[slot];
  const Vec3 sum = kind == Kind::vertex ? view(corner_)[position] : view(edge_)[slot];
  if (!has_direction(sum)) return MovingTriangle(set, vertex_rates, triangle).normal_rate(view(face_)[triangle]);
  const Vec3 rate = kind == Kind::vertex ? view(rates.corner)[position] : view(rates.rim_edge)[slot];
  const double size = length(sum);
  const Vec3 normal = (1 / size) * sum;
  return (1 / size) * (rate - dot(normal, rate) * normal);
}

}  // namespace riis
