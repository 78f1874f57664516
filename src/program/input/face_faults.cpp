// SPDX-License-Identifier: Apache-2.0
#include "program/input/face_faults.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "common/array_view.hpp"
#include "common/elementary.hpp"
#include "common/sets.hpp"
#include "program/base/handles.hpp"
#include "program/base/units.hpp"
#include "program/input/valve_source.hpp"
#include "program/mark/mesh_pieces.hpp"
#include "program/mark/warnings.hpp"
#include "program/output/report.hpp"

namespace riis::program {
namespace {

// Disjoint sets of faces that are joined along their sides. The sets also tell which faces of a piece have the same orientation.
// The number i stands for face i as it is, and the number n + i stands for face i turned over. Two numbers are in one set if the
// faces are joined and have the same orientation.
class Pieces {
 public:
  explicit Pieces(std::int64_t n) : n_(n), sets_(2 * n) {}

  struct Place {
    std::int64_t piece;
    bool is_turned;
  };
  Place find(std::int64_t face) {
    const std::int64_t as_it_is = sets_.root(face), turned = sets_.root(n_ + face);
    return {std::min(as_it_is, turned), turned < as_it_is};
  }
  // Joins two faces. `turned` tells whether their orientations differ. Two faces that are already in one piece are not joined
  // again.
  void join(std::int64_t one, std::int64_t other, bool turned) {
    if (find(one).piece == find(other).piece) return;
    sets_.unite(one, turned ? n_ + other : other);
    sets_.unite(n_ + one, turned ? other : n_ + other);
  }

 private:
  const std::int64_t n_;
  DisjointSets sets_;
};

struct Faults {
  std::int64_t n_equal = 0, n_turned = 0, n_closed = 0;
};

class FaceCheck {
 public:
  explicit FaceCheck(const riis_triangles &triangles) : triangles_(triangles), corners_(joined_corners(triangles)) {}

  Faults run() {
    const std::vector<std::int64_t> faces = different_faces();
    Faults faults;
    faults.n_equal = triangles_.n_triangles - view(faces).size();
    Pieces pieces(triangles_.n_triangles);
    const std::vector<char> is_open = join_along_sides(faces, pieces);

    struct Piece {
      std::int64_t n_faces[2] = {0, 0};  // of each orientation
      bool is_open = false;
    };
    std::vector<Piece> all(static_cast<std::size_t>(triangles_.n_triangles));
    for (const std::int64_t face : faces) {
      const auto [piece, is_turned] = pieces.find(face);
      ++view(all)[piece].n_faces[is_turned ? 1 : 0];
      view(all)[piece].is_open |= view(is_open)[face] != 0;
    }
    constexpr std::int64_t least_faces = 4;  // of a closed piece
    for (const auto &[n, opens] : all) {
      faults.n_turned += std::min(n[0], n[1]);
      faults.n_closed += !opens && n[0] + n[1] >= least_faces;
    }
    return faults;
  }

 private:
  // Returns the faces that have different corners. If several faces have the same corners, returns only the first of them.
  std::vector<std::int64_t> different_faces() const {
    std::vector<std::pair<Triangles::Corners, std::int64_t>> sorted;
    for (std::int64_t face = 0; face < triangles_.n_triangles; ++face) {
      Triangles::Corners key = view(corners_)[face];
      std::sort(key.begin(), key.end());
      sorted.emplace_back(key, face);
    }
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::int64_t> faces;
    for (std::size_t i = 0; i < sorted.size(); ++i)
      if (i == 0 || sorted[i].first != sorted[i - 1].first) faces.push_back(sorted[i].second);
    return faces;
  }

  // Joins the faces of one leaflet that share a side. For each face, returns whether one of its sides is open. If more than two
  // faces share a side, the side joins none of the faces.
  std::vector<char> join_along_sides(const std::vector<std::int64_t> &faces, Pieces &pieces) const {
    std::vector<Triangles::Corners> corners;  // the leaflets share no numbers
    for (const std::int64_t face : faces) {
      corners.push_back(view(corners_)[face]);
      for (std::int64_t &id : corners.back()) id += triangles_.n_vertices * triangles_.leaflet_id[face];
    }
    std::vector<char> is_open(static_cast<std::size_t>(triangles_.n_triangles), 0);
    for_each_edge(sorted_sides(corners), [&](const TriangleSide *side, std::size_t n_sides) {
      const std::int64_t face = view(faces)[side->triangle];
      if (n_sides == 1) view(is_open)[face] = 1;
      if (n_sides == 2) pieces.join(face, view(faces)[side[1].triangle], side[0].is_forward == side[1].is_forward);
    });
    return is_open;
  }

  const riis_triangles &triangles_;
  std::vector<Triangles::Corners> corners_;
};

}  // namespace

std::vector<Triangles::Corners> joined_corners(const riis_triangles &triangles) {
  const std::vector<std::int64_t> places = equal_places(triangles.n_vertices, triangles.xyz);
  std::vector<Triangles::Corners> corners;
  for (const std::int64_t *id = triangles.vertex_id; id != triangles.vertex_id + 3 * triangles.n_triangles; id += 3)
    corners.push_back({view(places)[id[0]], view(places)[id[1]], view(places)[id[2]]});
  return corners;
}

namespace {

// Returns the leaflets whose orientation as a whole differs from that of the other leaflets. In a correct file, the normals of
// all leaflets point to the same side along the valve's axis.
std::vector<std::int32_t> turned_leaflets(const riis_surface *surface, const riis_triangles &triangles) {
  constexpr double least_share = 0.05;  // of the leaflet's area, seen along the axis
  const std::int32_t skirt = info_of(surface).skirt_leaflet_id;
  constexpr double most_along = 0.5;  // of the way from the middle to a leaflet, along the axis
  struct Area {
    double vector[3] = {0, 0, 0}, all = 0, moment[3] = {0, 0, 0};
  };
  std::map<std::int32_t, Area> areas;
  for (std::int64_t face = 0; face < triangles.n_triangles; ++face) {
    if (triangles.leaflet_id[face] == skirt && skirt >= 0) continue;
    double edges[2][3];
    const std::int64_t *const id = triangles.vertex_id + 3 * face;
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 2; ++i) edges[i][k] = triangles.xyz[3 * id[i + 1] + k] - triangles.xyz[3 * id[0] + k];
    const double normal[3] = {edges[0][1] * edges[1][2] - edges[0][2] * edges[1][1],
                              edges[0][2] * edges[1][0] - edges[0][0] * edges[1][2],
                              edges[0][0] * edges[1][1] - edges[0][1] * edges[1][0]};
    Area &area = areas[triangles.leaflet_id[face]];
    const double size = hypotenuse(normal[0], normal[1], normal[2]);
    area.all += size;
    for (int k = 0; k < 3; ++k) {
      area.vector[k] += normal[k];
      for (int i = 0; i < 3; ++i) area.moment[k] += size / 3 * triangles.xyz[3 * id[i] + k];
    }
  }
  if (areas.size() < 2 || std::any_of(areas.begin(), areas.end(), [](const auto &of) { return !(of.second.all > 0); }))
    return {};
  riis_orifice orifice;
  if (riis_surface_get_orifice(surface, nullptr, &orifice, sizeof orifice) != RIIS_OK)
    return {};  // the axis is not known
  // Leaflets lie beside each other around the axis. If the axis leads from one leaflet to another, it is not the valve's axis.
  double middle[3] = {0, 0, 0};
  for (const auto &[leaflet, area] : areas)
    for (int k = 0; k < 3; ++k) middle[k] += area.moment[k] / (area.all * static_cast<double>(areas.size()));
  for (const auto &[leaflet, area] : areas) {
    double along = 0, way[3];
    for (int k = 0; k < 3; ++k) way[k] = area.moment[k] / area.all - middle[k], along += way[k] * orifice.axis[k];
    if (std::abs(along) > most_along * hypotenuse(way[0], way[1], way[2])) return {};
  }
  std::vector<std::int32_t> of_side[2];
  double area_of_side[2] = {0, 0};
  for (const auto &[leaflet, area] : areas) {
    double along = 0;
    for (int k = 0; k < 3; ++k) along += area.vector[k] * orifice.axis[k];
    if (std::abs(along) < least_share * area.all) continue;
    const int side = along < 0 ? 1 : 0;
    of_side[side].push_back(leaflet);
    area_of_side[side] += area.all;
  }
  return of_side[area_of_side[0] < area_of_side[1] ? 0 : 1];
}

}  // namespace

void warn_of_faces(const ValveOptions &options, const riis_surface *surface) {
  const std::string &name = options.surface;
  const riis_triangles triangles = triangles_of(surface);
  const Faults faults = FaceCheck(triangles).run();
  if (faults.n_turned > 0)
    warn(name + ": " + grouped(faults.n_turned) + " of " + counted(triangles.n_triangles, "triangle") +
         (faults.n_turned == 1 ? " is" : " are") +
         " turned over relative to the neighbours: normals and sides change there; ParaView's filter Surface Normals "
         "turns them back");
  // A leaflet with scattered turned triangles or with closed pieces has no definite side.
  if (faults.n_turned == 0 && faults.n_closed == 0)
    for (const std::int32_t leaflet : turned_leaflets(surface, triangles))
      warn(name + ": the leaflet " + name_of_leaflet(options, info_of(surface), leaflet, "") +
           " is turned over relative to the other leaflets: its normals and sides are opposite; ParaView's filter "
           "Reverse "
           "Sense turns it back");
  if (faults.n_equal > 0)
    warn(name + ": " + counted(faults.n_equal, "triangle") + (faults.n_equal == 1 ? " is" : " are") +
         " in the file twice, and areas count both copies");
  if (faults.n_closed > 0)
    warn(name + ": " + counted(faults.n_closed, "piece") + (faults.n_closed == 1 ? " is" : " are") +
         " closed like a thick leaflet, and areas count both faces");
}

OpenLine longest_open_line(const riis_surface *surface, double most) {
  const riis_triangles triangles = triangles_of(surface);
  const std::vector<Triangles::Corners> corners = joined_corners(triangles);
  std::vector<TriangleSide> open;
  for_each_edge(sorted_sides(corners), [&](const TriangleSide *side, std::size_t n_sides) {
    if (n_sides == 1 && side->a != side->b) open.push_back(*side);
  });
  DisjointSets joined(triangles.n_vertices);
  for (const TriangleSide &side : open) joined.unite(side.a, side.b);
  struct Line {
    OpenLine line;
    Box box = empty_box();
  };
  std::map<std::int64_t, Line> lines;
  for (const TriangleSide &side : open) {
    const auto point = [&](std::size_t k) {
      return triangles.xyz + 3 * triangles.vertex_id[3 * side.triangle + static_cast<std::int64_t>(k % 3)];
    };
    Line &of_edge = lines[joined.root(side.a)];
    ++of_edge.line.n_edges;
    of_edge.line.length += distance_between(point(side.k), point(side.k + 1));
    of_edge.box.grow(point(side.k));
    of_edge.box.grow(point(side.k + 1));
  }
  OpenLine longest;
  for (auto &[root, found] : lines) {
    if (found.line.length > most || found.line.length <= longest.length) continue;
    longest = found.line;
    for (int k = 0; k < 3; ++k) longest.point[k] = 0.5 * (found.box.lower[k] + found.box.upper[k]);
  }
  return longest;
}

}  // namespace riis::program
