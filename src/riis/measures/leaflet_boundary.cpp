// SPDX-License-Identifier: Apache-2.0
#include "measures/leaflet_boundary.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "common/array_view.hpp"
#include "common/sets.hpp"
#include "scene/edges.hpp"
#include "scene/pseudonormals.hpp"

namespace riis {
namespace {

// A piece is a part of a leaflet whose triangles are connected by common vertices. For each triangle, returns the lowest number
// of a triangle in the same piece.
std::vector<std::int64_t> pieces_of(const TriangleSet &set) {
  std::int64_t n_positions = 0;
  const auto position = distinct_positions(set, n_positions);
  DisjointSets triangles(set.n_triangles());
  std::unordered_map<std::int64_t, std::int64_t> first_at;  // by the leaflet and the position of a corner
  first_at.reserve(static_cast<std::size_t>(n_positions));
  for (std::int64_t i = 0; i < set.n_triangles(); ++i)
    for (std::int64_t k = 0; k < 3; ++k) {
      const std::int64_t corner = view(position)[view(set.vertex_id)[3 * i + k]];
      const auto other = first_at.try_emplace(view(set.leaflet_id)[i] * n_positions + corner, i).first;
      triangles.unite(other->second, i);
    }
  std::vector<std::int64_t> lowest;
  for (std::int64_t i = 0; i < set.n_triangles(); ++i) lowest.push_back(triangles.root(i));
  return lowest;
}

// A side of a triangle. `low` and `high` are the numbers of the positions of its two ends.
struct TriangleSide {
  std::int64_t piece, low, high, triangle;
  bool is_upwards;

  std::int64_t other_end(std::int64_t end) const { return end == low ? high : low; }
  bool begins_at(std::int64_t end) const { return (end == low) == is_upwards; }
};

// A neighbour of a triangle. Both triangles belong to the same piece.
struct Neighbour {
  std::int64_t triangle;
  bool is_turned;  // has the other winding
};

// Returns the neighbours of each triangle.
std::vector<std::vector<Neighbour>> neighbours_of(const TriangleSet &set, const std::vector<std::int64_t> &piece) {
  constexpr double same_direction = 1e-5;
  std::int64_t n_positions = 0;
  const auto position = distinct_positions(set, n_positions);
  std::vector<Vec3> place(static_cast<std::size_t>(n_positions));
  for (std::int64_t i = 0; i < set.n_vertices(); ++i) view(place)[view(position)[i]] = set.vertex(i);
  std::vector<TriangleSide> sides;
  sides.reserve(set.vertex_id.size());
  for (std::int64_t i = 0; i < 3 * set.n_triangles(); ++i) {
    const std::int64_t from = view(position)[view(set.vertex_id)[i]],
                       to = view(position)[view(set.vertex_id)[i % 3 == 2 ? i - 2 : i + 1]];
    sides.push_back({view(piece)[i / 3], std::min(from, to), std::max(from, to), i / 3, from < to});
  }
  const auto edge_of = [](const TriangleSide &side) { return std::tuple(side.piece, side.low, side.high); };
  std::sort(sides.begin(), sides.end(),
            [&](const TriangleSide &a, const TriangleSide &b) { return edge_of(a) < edge_of(b); });
  std::vector<std::vector<Neighbour>> made(static_cast<std::size_t>(set.n_triangles()));
  const auto join = [&](const TriangleSide &one, const TriangleSide &other, bool is_turned) {
    view(made)[one.triangle].push_back({other.triangle, is_turned});
    view(made)[other.triangle].push_back({one.triangle, is_turned});
  };
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<TriangleSide>> single_at;  // by the piece and an end
  for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
    while (end < sides.size() && edge_of(sides[end]) == edge_of(sides[i])) ++end;
    if (end == i + 2) join(sides[i], sides[i + 1], sides[i].is_upwards == sides[i + 1].is_upwards);
    if (end != i + 1) continue;
    for (const std::int64_t vertex : {sides[i].low, sides[i].high})
      single_at[{sides[i].piece, vertex}].push_back(sides[i]);
  }
  // A vertex may lie inside the edge of a neighbouring triangle. At an end of this edge, a shorter edge then leads in the same
  // direction as the longer edge.
  for (const auto &[at, single] : single_at) {
    const std::int64_t vertex = at.second;
    std::vector<Vec3> direction;
    for (const TriangleSide &side : single) {
      const Vec3 way = view(place)[side.other_end(vertex)] - view(place)[vertex];
      direction.push_back((1 / length(way)) * way);
    }
    for (std::size_t i = 0; i < single.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (distance(direction[i], direction[k]) < same_direction)
          join(single[i], single[k], single[i].begins_at(vertex) == single[k].begins_at(vertex));
  }
  return made;
}

// A sheet is a part of a piece whose triangles are connected by common sides. All triangles of a sheet have the same winding
// here.
struct WoundTriangles {
  TriangleSet set;
  std::vector<std::int64_t> sheet;  // of each triangle, from 0
  std::int64_t n_sheets;
};

// Turns triangles over until all triangles of a sheet have the winding of the sheet's first triangle.
WoundTriangles with_one_winding(const TriangleSet &set, const std::vector<std::int64_t> &piece) {
  const std::vector<std::vector<Neighbour>> neighbours = neighbours_of(set, piece);
  const auto n = static_cast<std::size_t>(set.n_triangles());
  WoundTriangles made{set, std::vector<std::int64_t>(n, -1), 0};
  std::vector<std::uint8_t> is_turned(n, 0);
  for (std::int64_t first = 0; first < set.n_triangles(); ++first) {
    if (view(made.sheet)[first] >= 0) continue;
    std::vector<std::int64_t> reached{first};
    view(made.sheet)[first] = made.n_sheets;
    while (!reached.empty()) {
      const std::int64_t at = reached.back();
      reached.pop_back();
      if (view(is_turned)[at] != 0)
        std::swap(view(made.set.vertex_id)[3 * at + 1], view(made.set.vertex_id)[3 * at + 2]);
      for (const Neighbour &next : view(neighbours)[at]) {
        if (view(made.sheet)[next.triangle] >= 0) continue;
        view(made.sheet)[next.triangle] = made.n_sheets;
        view(is_turned)[next.triangle] = (view(is_turned)[at] != 0) != next.is_turned;
        reached.push_back(next.triangle);
      }
    }
    ++made.n_sheets;
  }
  return made;
}

// Computes the centroids of the pieces, and the normal. For each triangle, `piece` has the number of its piece, or -1 if the
// triangle is to be left out.
void measure_pieces(const TriangleSet &set, const std::vector<std::int64_t> &piece, std::int64_t n_pieces,
                    LeafletBoundary &boundary) {
  std::vector<double> area(static_cast<std::size_t>(n_pieces), 0);
  boundary.centroids.assign(area.size(), {0, 0, 0});
  boundary.normal = {0, 0, 0};
  for (std::int64_t i = 0; i < set.n_triangles(); ++i) {
    const std::int64_t at = view(piece)[i];
    if (at < 0) continue;
    const auto [a, b, c] = set.corners(i);
    const Vec3 normal = 0.5 * cross(b - a, c - a);
    const double size = length(normal);
    boundary.normal = boundary.normal + normal;
    view(area)[at] += size;
    // The running mean keeps the rounding error small, even if the surface is far from the origin.
    if (size > 0)
      view(boundary.centroids)[at] = mix(view(boundary.centroids)[at], (1.0 / 3) * (a + b + c), size / view(area)[at]);
  }
}

// Sorts the distinct values. Returns the position of each value in this order, and the number of distinct values.
template <class Value>
std::pair<std::vector<std::int64_t>, std::int64_t> numbered(const std::vector<Value> &values) {
  std::map<Value, std::int64_t> number;
  for (const Value value : values) number.emplace(value, 0);
  std::int64_t n = 0;
  for (auto &[value, place] : number) place = n++;
  std::vector<std::int64_t> made;
  made.reserve(values.size());
  for (const Value value : values) made.push_back(number.at(value));
  return {std::move(made), n};
}

// A vertex at the boundary of a piece, with its place relative to the piece's centroid.
struct PieceVertex {
  std::int64_t vertex, piece;
  Vec3 at, from_centroid;
};

// Enlarges the pieces about their centroids by a share from 0 to `most`. Returns the share at which two vertices of different
// pieces come closest to each other.
double share_until_pieces_meet(const std::vector<PieceVertex> &vertices, double most) {
  double share = 0, least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < vertices.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      if (vertices[i].piece == vertices[k].piece) continue;
      const Vec3 gap = vertices[i].at - vertices[k].at, growth = vertices[i].from_centroid - vertices[k].from_centroid;
      const double wanted = -dot(gap, growth) / dot(growth, growth);
      if (!(wanted > 0 && wanted <= most)) continue;
      const Vec3 left = gap + wanted * growth;
      if (dot(left, left) < least) least = dot(left, left), share = wanted;
    }
  return share;
}

// For each vertex, returns the number of the nearest vertex of another piece. If no other piece is near, returns the vertex's own
// number. "Near" means within `share` times the vertex's distance from the centroid of its piece.
std::vector<std::size_t> nearest_of_other_pieces(const std::vector<PieceVertex> &vertices, double share) {
  std::vector<std::size_t> nearest;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    double least = share * length(vertices[i].from_centroid);
    nearest.push_back(i);
    for (std::size_t k = 0; k < vertices.size(); ++k)
      if (vertices[k].piece != vertices[i].piece && distance(vertices[k].at, vertices[i].at) < least)
        least = distance(vertices[k].at, vertices[i].at), nearest.back() = k;
  }
  return nearest;
}

// Leaflets with gaps between them have no common attachment. Returns the triangles after each piece has grown about its centroid,
// until neighbouring pieces meet. Vertices that are then close together are moved to a common point. Returns nothing if pieces
// already touch, or if the boundary has too many vertices to compare all pairs.
std::optional<TriangleSet> joined_pieces(const TriangleSet &set, const std::vector<OpenEdge> &edges,
                                         const std::vector<std::int64_t> &piece, const LeafletBoundary &boundary) {
  constexpr double most_growth = 0.05, closeness = 1e-3;
  constexpr std::size_t most_vertices = 10000;
  std::int64_t n_places = 0;
  const auto place = distinct_positions(set, n_places);
  std::vector<std::int64_t> piece_at(static_cast<std::size_t>(n_places), -1);
  for (std::int64_t i = 0; i < 3 * set.n_triangles(); ++i) {
    std::int64_t &at = view(piece_at)[view(place)[view(set.vertex_id)[i]]];
    if (at >= 0 && at != view(piece)[i / 3]) return std::nullopt;
    at = view(piece)[i / 3];
  }
  std::vector<PieceVertex> vertices;
  for (const OpenEdge &edge : edges) {
    const std::int64_t of = view(piece)[edge.triangle];
    vertices.push_back({edge.from, of, set.vertex(edge.from), set.vertex(edge.from) - view(boundary.centroids)[of]});
  }
  if (vertices.size() > most_vertices) return std::nullopt;
  const double share = share_until_pieces_meet(vertices, most_growth);
  if (share == 0) return std::nullopt;
  for (PieceVertex &vertex : vertices) vertex.at = vertex.at + share * vertex.from_centroid;
  const std::vector<std::size_t> nearest = nearest_of_other_pieces(vertices, closeness);
  std::vector<std::optional<Vec3>> at_place(static_cast<std::size_t>(n_places));
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (const std::size_t other = nearest[i]; nearest[other] == i)
      view(at_place)[view(place)[vertices[i].vertex]] = vertices[std::min(i, other)].at;
  // Vertices inside a piece also move, so that a vertex on an edge of a neighbouring triangle stays on this edge.
  TriangleSet joined = set;
  for (std::int64_t i = 0; i < set.n_vertices(); ++i) {
    const std::int64_t where = view(place)[i], of = view(piece_at)[where];
    if (of < 0) continue;
    std::optional<Vec3> &to = view(at_place)[where];
    if (!to) to = set.vertex(i) + share * (set.vertex(i) - view(boundary.centroids)[of]);
    for (std::int64_t c = 0; c < 3; ++c) view(joined.xyz)[3 * i + c] = c == 0 ? to->x : c == 1 ? to->y : to->z;
  }
  return joined;
}

}  // namespace

LeafletBoundary boundary_of_leaflets(const TriangleSet &set) {
  if (!set.is_of_patches() && set.skirt >= 0) return boundary_of_leaflets(without_skirt(set));
  const std::int32_t skirt = set.skirt;
  LeafletBoundary boundary;
  auto [piece, n_pieces] = set.is_of_patches() ? numbered(set.leaflet_id) : numbered(pieces_of(set));
  std::map<std::int32_t, std::int64_t> piece_of_leaflet;
  for (std::int64_t i = 0; i < set.n_triangles(); ++i) {
    if (view(set.leaflet_id)[i] == skirt && skirt >= 0) view(piece)[i] = -1;
    piece_of_leaflet[view(set.leaflet_id)[i]] = view(piece)[i];
  }
  measure_pieces(set, piece, n_pieces, boundary);
  if (set.is_of_patches()) {
    for (const SideLine &side : boundary_sides(set, skirt)) {
      const auto found = piece_of_leaflet.find(side.leaflet_id);
      if (found == piece_of_leaflet.end()) continue;  // the leaflet has no area
      for (std::size_t k = 1; k < side.vertex_id.size(); ++k)
        boundary.edges.push_back({set.vertex(side.vertex_id[k - 1]), set.vertex(side.vertex_id[k]), found->second});
    }
    return boundary;
  }
  WoundTriangles wound = with_one_winding(set, piece);
  std::vector<OpenEdge> edges = open_edges(wound.set, false);
  for (const OpenEdge &edge : edges)
    boundary.edges.push_back({set.vertex(edge.from), set.vertex(edge.to), view(piece)[edge.triangle]});
  if (std::optional<TriangleSet> joined =
          n_pieces > 1 ? joined_pieces(wound.set, edges, piece, boundary) : std::nullopt) {
    wound.set = std::move(*joined);
    edges = open_edges(wound.set, false);
  }
  // In a file that does not name its leaflets, leaflets that touch are one piece with several sheets.
  const std::vector<std::int64_t> &part = n_pieces > 1 ? piece : wound.sheet;
  // Leaflets may have opposite windings, so every sheet except the last is tried with both windings.
  constexpr std::int64_t most_sheets = 5;
  const std::int64_t n_windings = wound.n_sheets <= most_sheets ? std::int64_t{1} << (wound.n_sheets - 1) : 1;
  for (std::int64_t turned = 0; turned < n_windings; ++turned) {  // a bit for each sheet that is turned over
    std::vector<OpenEdge> edges_of_winding = edges;
    for (OpenEdge &edge : edges_of_winding)
      if (turned >> view(wound.sheet)[edge.triangle] & 1) std::swap(edge.from, edge.to);
    const LargestBoundary largest = largest_boundary(wound.set, edges_of_winding);
    ClosedLine line{{}, length(largest.area)};
    for (const OpenEdge &edge : largest.edges)
      line.edges.push_back({wound.set.vertex(edge.from), wound.set.vertex(edge.to), view(part)[edge.triangle]});
    boundary.perhaps_attached.push_back(std::move(line));
  }
  return boundary;
}

LeafletBoundary boundary_of_wall(const TriangleSet &wall) {
  const std::vector<OpenEdge> edges = open_edges(wall, false);
  DisjointSets lines(wall.n_vertices());
  for (const OpenEdge &edge : edges) lines.unite(edge.from, edge.to);
  const auto length_of = [&](const OpenEdge &edge) { return distance(wall.vertex(edge.from), wall.vertex(edge.to)); };
  std::map<std::int64_t, double> length;
  for (const OpenEdge &edge : edges) length[lines.root(edge.from)] += length_of(edge);
  const auto longest =
      std::max_element(length.begin(), length.end(), [](const auto &a, const auto &b) { return a.second < b.second; });
  LeafletBoundary boundary{{}, {}, {{0, 0, 0}}, {0, 0, 0}};
  for (const OpenEdge &edge : edges)
    if (lines.root(edge.from) == longest->first)
      boundary.edges.push_back({wall.vertex(edge.from), wall.vertex(edge.to), 0});
  return boundary;
}

}  // namespace riis
