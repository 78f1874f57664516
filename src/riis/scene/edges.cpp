// SPDX-License-Identifier: Apache-2.0
#include "scene/edges.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "common/array_view.hpp"
#include "scene/pseudonormals.hpp"
#include "valve/rims.hpp"
#include "valve/skirt.hpp"
namespace riis {
namespace {

// For each vertex, returns the first vertex that has the same coordinates.
std::vector<std::int64_t> first_with_place(const TriangleSet &set) {
  std::int64_t n_positions = 0;
  const auto position = distinct_positions(set, n_positions);
  std::vector<std::int64_t> first_of(static_cast<std::size_t>(n_positions), -1), made;
  made.reserve(static_cast<std::size_t>(set.n_vertices()));
  for (std::int64_t i = 0; i < set.n_vertices(); ++i) {
    std::int64_t &first = view(first_of)[view(position)[i]];
    if (first < 0) first = i;
    made.push_back(first);
  }
  return made;
}

std::vector<OpenEdge> edges_of_one_triangle(const TriangleSet &set, const std::vector<std::int64_t> &place,
                                            bool by_leaflet) {
  struct Use {
    std::int64_t low, high, triangle;
    std::int32_t leaflet_id;
    bool is_upwards;
    bool is_same_edge(const Use &other) const {
      return leaflet_id == other.leaflet_id && low == other.low && high == other.high;
    }
  };
  std::vector<Use> uses;
  uses.reserve(set.vertex_id.size());
  for (std::int64_t i = 0; i < set.n_triangles(); ++i)
    for (std::int64_t k = 0; k < 3; ++k) {
      const std::int64_t from = view(place)[view(set.vertex_id)[3 * i + k]],
                         to = view(place)[view(set.vertex_id)[3 * i + (k + 1) % 3]];
      uses.push_back({std::min(from, to), std::max(from, to), i, by_leaflet ? view(set.leaflet_id)[i] : 0, from < to});
    }
  std::sort(uses.begin(), uses.end(), [](const Use &a, const Use &b) {
    return std::tie(a.low, a.high, a.leaflet_id, a.triangle) < std::tie(b.low, b.high, b.leaflet_id, b.triangle);
  });
  std::vector<OpenEdge> open;
  for (std::size_t i = 0; i < uses.size();) {
    std::size_t end = i + 1;
    while (end < uses.size() && uses[end].is_same_edge(uses[i])) ++end;
    const Use &use = uses[i];
    if (end == i + 1)
      open.push_back({use.is_upwards ? use.low : use.high, use.is_upwards ? use.high : use.low, use.triangle});
    i = end;
  }
  std::sort(open.begin(), open.end(), [](const OpenEdge &a, const OpenEdge &b) {
    return std::tie(a.triangle, a.from) < std::tie(b.triangle, b.from);
  });
  return open;
}

// Removes open edges that cover each other. A patch of triangles may have vertices inside the edges of a neighbouring patch.
// Several short edges then cover a long edge, and lead from one end of the long edge to the other. The search follows these short
// edges from end to end.
class Cancelling {
 public:
  Cancelling(const TriangleSet &set, std::vector<OpenEdge> edges) : set_(set), edges_(std::move(edges)) {
    is_left_.assign(edges_.size(), true);
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      from_.with.emplace(edges_[i].from, i);
      to_.with.emplace(edges_[i].to, i);
    }
  }

  std::vector<OpenEdge> left() {
    for (std::size_t i = 0; i < edges_.size(); ++i)
      while (is_left_[i] && (shorten(i, from_, to_) || shorten(i, to_, from_))) continue;
    std::vector<OpenEdge> made;
    for (std::size_t i = 0; i < edges_.size(); ++i)
      if (is_left_[i]) made.push_back(edges_[i]);
    return made;
  }

 private:
  // For each vertex, either the edges that begin there, or the edges that end there. `end` says which of the two.
  struct Ends {
    std::int64_t OpenEdge::*end;
    std::multimap<std::int64_t, std::size_t> with;

    void erase(std::int64_t vertex, std::size_t i) {
      for (auto [at, last] = with.equal_range(vertex); at != last; ++at)
        if (at->second == i) {
          with.erase(at);
          return;
        }
    }
  };

  // Looks for an edge in the opposite direction that covers edge i from one end up to some point of edge i. Removes the found
  // edge, and shortens edge i to the remaining part. Returns false if there is no such edge.
  bool shorten(std::size_t i, Ends &here, const Ends &there) {
    const OpenEdge edge = edges_[i];
    for (auto [at, last] = there.with.equal_range(edge.*here.end); at != last; ++at) {
      const std::size_t other = at->second;
      const std::int64_t point = edges_[other].*here.end;
      if (other == i || !is_left_[other] || !is_on(edge, point)) continue;
      drop(other);
      if (point == edge.*there.end) {
        drop(i);
      } else {
        here.erase(edge.*here.end, i);
        here.with.emplace(edges_[i].*here.end = point, i);
      }
      return true;
    }
    return false;
  }

  bool is_on(const OpenEdge &edge, std::int64_t vertex) const {
    if (vertex == edge.from || vertex == edge.to) return true;
    const Vec3 a = set_.vertex(edge.from), ab = set_.vertex(edge.to) - a, ap = set_.vertex(vertex) - a;
    const double size_sq = dot(ab, ab), share = dot(ap, ab) / size_sq;
    // The margin allows for coordinates that the caller rounded to single precision.
    const double near = 1e-6 * std::sqrt(size_sq) + 0x1p-22 * (std::abs(a.x) + std::abs(a.y) + std::abs(a.z));
    return share > 0 && share < 1 && length(ap - share * ab) <= near;
  }

  void drop(std::size_t i) {
    is_left_[i] = false;
    from_.erase(edges_[i].from, i);
    to_.erase(edges_[i].to, i);
  }

  const TriangleSet &set_;
  std::vector<OpenEdge> edges_;
  std::vector<bool> is_left_;
  Ends from_{&OpenEdge::from, {}}, to_{&OpenEdge::to, {}};
};

// The triangles around each vertex, in groups. The triangles of a group are connected by edges that begin at the vertex.
class Fans {
 public:
  Fans(const TriangleSet &set, const std::vector<std::int64_t> &place, const std::set<std::int64_t> &vertices) {
    std::map<std::int64_t, std::vector<std::int64_t>> around;
    for (std::int64_t i = 0; i < set.n_triangles(); ++i)
      for (std::int64_t k = 0; k < 3; ++k) {
        const std::int64_t vertex = view(place)[view(set.vertex_id)[3 * i + k]];
        if (vertices.count(vertex) != 0) around[vertex].push_back(i);
      }
    for (const auto &[vertex, triangles] : around) {
      // Two triangles belong to the same group if they share a second vertex. The number of a group is its lowest triangle.
      std::map<std::int64_t, std::int64_t> group_of, first_with;
      for (const std::int64_t triangle : triangles) group_of[triangle] = triangle;
      const auto root = [&](std::int64_t triangle) {
        while (group_of[triangle] != triangle) triangle = group_of[triangle];
        return triangle;
      };
      for (const std::int64_t triangle : triangles)
        for (std::int64_t k = 0; k < 3; ++k) {
          const std::int64_t other = view(place)[view(set.vertex_id)[3 * triangle + k]];
          if (other == vertex) continue;
          const auto [found, is_new] = first_with.try_emplace(other, triangle);
          if (is_new) continue;
          const std::int64_t a = root(triangle), b = root(found->second);
          group_of[std::max(a, b)] = std::min(a, b);
        }
      for (const std::int64_t triangle : triangles) fan_[{vertex, triangle}] = root(triangle);
    }
  }
  std::int64_t of(std::int64_t vertex, std::int64_t triangle) const { return fan_.at({vertex, triangle}); }

 private:
  std::map<std::array<std::int64_t, 2>, std::int64_t> fan_;
};

double length_of(const TriangleSet &set, const std::vector<OpenEdge> &edges) {
  double sum = 0;
  for (const OpenEdge &edge : edges) sum += distance(set.vertex(edge.from), set.vertex(edge.to));
  return sum;
}

// For each edge, returns the next edge of its line. A line ends at a vertex whose open edges cannot be paired.
std::vector<std::optional<std::size_t>> next_edges(const TriangleSet &set, const std::vector<std::int64_t> &place,
                                                   const std::vector<OpenEdge> &edges) {
  std::map<std::int64_t, std::vector<std::size_t>> from, to;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    from[edges[i].from].push_back(i);
    to[edges[i].to].push_back(i);
  }
  std::set<std::int64_t> branches;
  for (const auto &[vertex, out] : from)
    if (out.size() > 1) branches.insert(vertex);
  const Fans fans(set, place, branches);
  std::vector<std::optional<std::size_t>> next(edges.size());
  for (auto &[vertex, out] : from) {
    const auto in = to.find(vertex);
    if (in == to.end() || in->second.size() != out.size()) continue;
    if (out.size() == 1) {
      next[in->second.front()] = out.front();
      continue;
    }
    const auto by_fan = [&, at = vertex](std::size_t a, std::size_t b) {
      return std::pair(fans.of(at, edges[a].triangle), a) < std::pair(fans.of(at, edges[b].triangle), b);
    };
    std::sort(out.begin(), out.end(), by_fan);
    std::sort(in->second.begin(), in->second.end(), by_fan);
    for (std::size_t k = 0; k < out.size(); ++k) next[in->second[k]] = out[(k + 1) % out.size()];
  }
  return next;
}

}  // namespace

std::vector<OpenEdge> open_edges(const TriangleSet &set, bool by_leaflet) {
  const std::vector<std::int64_t> place = first_with_place(set);
  if (!by_leaflet) return Cancelling(set, edges_of_one_triangle(set, place, false)).left();
  std::map<std::int32_t, std::vector<OpenEdge>> of_leaflets;
  for (const OpenEdge &edge : edges_of_one_triangle(set, place, true))
    of_leaflets[view(set.leaflet_id)[edge.triangle]].push_back(edge);
  std::vector<OpenEdge> made;
  for (auto &[leaflet_id, edges] : of_leaflets)
    for (const OpenEdge &edge : Cancelling(set, std::move(edges)).left()) made.push_back(edge);
  return made;
}

namespace {

std::vector<std::vector<OpenEdge>> closed_lines(const TriangleSet &set, const std::vector<OpenEdge> &edges) {
  const std::vector<std::optional<std::size_t>> next = next_edges(set, first_with_place(set), edges);
  std::vector<bool> is_done(edges.size(), false);
  std::vector<std::vector<OpenEdge>> closed;
  for (std::size_t first = 0; first < edges.size(); ++first) {
    std::vector<OpenEdge> line;
    std::size_t at = first;
    while (!is_done[at]) {
      is_done[at] = true;
      line.push_back(edges[at]);
      if (!next[at]) break;
      at = *next[at];
    }
    if (!line.empty() && at == first && next[at]) closed.push_back(std::move(line));
  }
  return closed;
}

Vec3 vector_area_of(const TriangleSet &set, const std::vector<OpenEdge> &line) {
  const Vec3 origin = set.vertex(line.front().from);
  Vec3 area{0, 0, 0};
  for (const OpenEdge &edge : line)
    area = area + 0.5 * cross(set.vertex(edge.from) - origin, set.vertex(edge.to) - origin);
  return area;
}

}  // namespace

std::vector<std::vector<OpenEdge>> closed_boundaries(const TriangleSet &set) {
  return closed_lines(set, open_edges(set, false));
}

LargestBoundary largest_boundary(const TriangleSet &set) { return largest_boundary(set, open_edges(set, false)); }

LargestBoundary largest_boundary(const TriangleSet &set, const std::vector<OpenEdge> &edges) {
  LargestBoundary best;
  for (std::vector<OpenEdge> &line : closed_lines(set, edges)) {
    const Vec3 area = vector_area_of(set, line);
    const double size = length(area), largest = length(best.area);
    best.second_area = std::max(best.second_area, std::min(size, largest));
    if (size > largest) best.edges = std::move(line), best.area = area;
  }
  return best;
}

std::vector<OpenEdge> longest_boundary(const TriangleSet &set) {
  std::vector<OpenEdge> longest;
  double longest_length = 0;
  for (std::vector<OpenEdge> &line : closed_boundaries(set)) {
    const double length = length_of(set, line);
    if (length > longest_length) longest = std::move(line), longest_length = length;
  }
  return longest;
}

namespace {

// Finds the vertices on a side of a patch, in their order along the side. If several vertices lie at the same place, as in a
// subdivided quad, only the first of them is returned.
Vector<std::int64_t> vertices_on(const TriangleSet &set, std::int64_t begin, std::int64_t end, PatchRim side) {
  const std::int64_t of_along = side == rim_v0 || side == rim_v1 ? 0 : 1;
  const auto along = [&](std::int64_t id) { return view(set.uv)[2 * id + of_along]; };
  Vector<std::int64_t> found;
  for (std::int64_t id = begin; id < end; ++id)
    if (sides_of_place(&view(set.uv)[2 * id]) & side) found.push_back(id);
  std::sort(found.begin(), found.end(),
            [&](std::int64_t a, std::int64_t b) { return along(a) != along(b) ? along(a) < along(b) : a < b; });
  const auto is_same = [&](std::int64_t a, std::int64_t b) { return along(a) == along(b); };
  found.erase(std::unique(found.begin(), found.end(), is_same), found.end());
  return found;
}

// For each patch, returns the side that choose(patch, rim) returns. `rim` has the bits PatchRim of the patch. For a patch without
// such a side, choose() returns 0.
template <class Choose>
std::vector<SideLine> sides(const TriangleSet &set, const Choose &choose) {
  std::vector<SideLine> lines;
  const std::int64_t n = view(set.patches).size();
  for (std::int64_t i = 0; i < n; ++i) {
    const VerticesOfPatch &patch = view(set.patches)[i];
    const std::int64_t end = i + 1 < n ? view(set.patches)[i + 1].first : set.n_vertices();
    const int side = choose(patch, view(set.rim_sides)[patch.patch_id]);
    if (side == 0) continue;
    SideLine line{patch.leaflet_id, patch.patch_id, vertices_on(set, patch.first, end, static_cast<PatchRim>(side)),
                  patch.axis};
    if (length_of(set, line) > 0) lines.push_back(std::move(line));
  }
  std::sort(lines.begin(), lines.end(), [](const SideLine &a, const SideLine &b) { return a.patch_id < b.patch_id; });
  return lines;
}

}  // namespace

double length_of(const TriangleSet &set, const SideLine &side) {
  double length = 0;
  for (std::size_t i = 1; i < side.vertex_id.size(); ++i)
    length += distance(set.vertex(side.vertex_id[i - 1]), set.vertex(side.vertex_id[i]));
  return length;
}

std::vector<SideLine> free_edges(const TriangleSet &set) {
  return sides(set, [](const VerticesOfPatch &, int rim) { return rim & free_v1 ? rim_v1 : 0; });
}

std::vector<SideLine> attached_sides(const TriangleSet &set) {
  return sides(set, [](const VerticesOfPatch &patch, int rim) {
    if ((rim & held) == 0) return 0;
    return static_cast<int>(patch.attached == AttachedSide::v0 ? rim_v0 : rim_u1);
  });
}

std::vector<SideLine> boundary_sides(const TriangleSet &set, std::int32_t skirt) {
  std::vector<SideLine> lines;
  for (const int wanted : {rim_v0, rim_v1, rim_u0, rim_u1})
    for (SideLine &line : sides(set, [&](const VerticesOfPatch &patch, int rim) {
           if (patch.leaflet_id == skirt) return 0;
           const int attached = patch.attached == AttachedSide::v0 ? rim_v0 : rim_u1;
           const int bounding = rim | (rim & held ? attached : 0) | (rim & free_v1 ? rim_v1 : 0);
           return bounding & wanted;
         }))
      lines.push_back(std::move(line));
  return lines;
}

Attachment attachment_of(const TriangleSet &set) {
  Attachment made;
  const auto add = [&](const AttachedEdge &edge, std::int32_t patch_id, const AxisLine &axis) {
    const Vec3 a = set.vertex(edge.from), b = set.vertex(edge.to);
    if (a == b) return;
    for (const Vec3 end : {a, b}) {
      const bool is_aimed = !(axis.direction == Vec3{0, 0, 0});
      const Vec3 out = is_aimed ? outwards(axis, end) : Vec3{0, 0, 0};
      for (const double x : {end.x, end.y, end.z}) made.edges.push_back(x);
      for (const double x : {out.x, out.y, out.z}) made.outwards.push_back(x);
    }
    made.vertex_id.push_back(edge.from);
    made.vertex_id.push_back(edge.to);
    made.leaflet_id.push_back(edge.leaflet_id);
    made.patch_id.push_back(patch_id);
  };
  for (const SideLine &side : attached_sides(set))
    for (std::size_t k = 1; k < side.vertex_id.size(); ++k)
      add({side.vertex_id[k - 1], side.vertex_id[k], side.leaflet_id}, side.patch_id, side.axis);
  for (const AttachedEdge &edge : set.attached) add(edge, 0, set.attached_axis);
  return made;
}

namespace {

// Returns the open edges of each leaflet, except those on the outline of the orifice. An edge between two leaflets counts as an
// open edge.
std::vector<EdgePart> free_edges_of_arrays(const TriangleSet &given) {
  const std::optional<TriangleSet> leaflets = given.skirt < 0 ? std::nullopt : std::optional(without_skirt(given));
  const TriangleSet &set = leaflets ? *leaflets : given;
  std::set<std::pair<std::int64_t, std::int64_t>> on_outline;
  for (const OpenEdge &edge : longest_boundary(set)) on_outline.emplace(edge.from, edge.to);
  std::vector<EdgePart> parts;
  for (const OpenEdge &edge : open_edges(set, true))
    if (on_outline.count({edge.from, edge.to}) == 0)
      parts.push_back({view(set.leaflet_id)[edge.triangle], set.vertex(edge.from), set.vertex(edge.to)});
  return parts;
}

}  // namespace

std::vector<EdgePart> free_edge_parts(const TriangleSet &set) {
  if (!set.is_of_patches()) return free_edges_of_arrays(set);
  std::vector<EdgePart> parts;
  for (const SideLine &edge : free_edges(set))
    for (std::size_t k = 1; k < edge.vertex_id.size(); ++k)
      parts.push_back({edge.leaflet_id, set.vertex(edge.vertex_id[k - 1]), set.vertex(edge.vertex_id[k])});
  return parts;
}

std::vector<riis_leaflet> leaflets_of(const TriangleSet &set) {
  std::map<std::int32_t, riis_leaflet> found;
  for (std::int64_t i = 0; i < set.n_triangles(); ++i) {
    const std::int32_t id = view(set.leaflet_id)[i];
    riis_leaflet &leaflet = found.try_emplace(id, riis_leaflet{0, 0, 0, id, 0}).first->second;
    ++leaflet.n_triangles;
    leaflet.area += set.area(i);
  }
  if (set.is_of_patches())
    for (const SideLine &edge : free_edges(set)) found.at(edge.leaflet_id).free_edge += length_of(set, edge);
  else
    for (const EdgePart &part : free_edges_of_arrays(set))
      found.at(part.leaflet_id).free_edge += distance(part.from, part.to);
  std::vector<riis_leaflet> leaflets;
  for (const auto &[id, leaflet] : found) leaflets.push_back(leaflet);
  return leaflets;
}

double area_without(const std::vector<riis_leaflet> &leaflets, std::int32_t leaflet_id) {
  double area = 0;
  for (const riis_leaflet &leaflet : leaflets)
    if (leaflet.leaflet_id != leaflet_id) area += leaflet.area;
  return area;
}

}  // namespace riis
