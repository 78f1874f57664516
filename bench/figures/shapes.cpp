// SPDX-License-Identifier: Apache-2.0
#include "figures/shapes.hpp"

#include <algorithm>
#include <stdexcept>

namespace riis::figures {
namespace {

bool wanted(std::int32_t leaflet, const PatchImage &image) {
  return leaflet == every_leaflet || leaflet == image.leaflet_id;
}

Colour colour_of(const LeafletColours &colours, std::int32_t leaflet) {
  return colours.at(static_cast<std::size_t>(leaflet));
}

Bezier placed(const Bezier &piece, const PatchImage &image) {
  Bezier made = piece;
  for (Vec3 &control : made.control) control = place(image, control);
  return made;
}

Pieces concatenated(Pieces a, const Pieces &b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

double largest_difference(const Bezier &a, const Bezier &b) {
  double largest = 0;
  for (std::size_t i = 0; i <= static_cast<std::size_t>(a.degree); ++i)
    largest = std::max(largest, distance(a.control[i], b.control[i]));
  return largest;
}

// Finds the curve whose parts are a and b, by de Casteljau's algorithm in reverse. Returns false if there is none.
bool join(const Bezier &a, const Bezier &b, Bezier &whole) {
  if (a.degree != b.degree) return false;
  const auto n = static_cast<std::size_t>(a.degree);
  const double before = distance(a.control[n - 1], a.control[n]), after = distance(b.control[0], b.control[1]);
  if (!(before > 0 && after > 0)) return false;
  const double t = before / (before + after);
  const Vec3 second = a.control[0] + (1 / t) * (a.control[1] - a.control[0]);
  const Vec3 last_but_one = b.control[n] - (1 / (1 - t)) * (b.control[n] - b.control[n - 1]);
  whole = n == 2 ? Bezier::quadratic(a.control[0], second, b.control[n])
                 : Bezier::cubic(a.control[0], second, last_but_one, b.control[n]);
  const auto [left, right] = split(whole, t);
  return largest_difference(left, a) < 1e-9 && largest_difference(right, b) < 1e-9;
}

}  // namespace

Model make_model(const Valve &valve, double tolerance) {
  Model model;
  model.patches = valve.make_patches();
  const double max_error = tolerance * half_thickness;
  model.grids = make_grids(model.patches, max_error);
  model.triangles = triangulate_adapted(model.patches, {max_error, {1, rotation_xyz({0, 0, 0}), {0, 0, 0}}, false, 1});
  return model;
}

LeafletColours paler(const LeafletColours &colours, double white) {
  return {paler(colours[0], white), paler(colours[1], white), paler(colours[2], white)};
}

Faces quads_of(const Model &model, std::int32_t leaflet, const LeafletColours &colours) {
  Faces faces{4, {}, {}, {}};
  for (std::size_t k = 0; k < model.grids.size(); ++k) {
    const QuadGrid &grid = model.grids[k];
    for (const PatchImage &image : model.patches.patches[k].images) {
      if (!wanted(leaflet, image)) continue;
      const auto first = static_cast<std::int64_t>(faces.points.size()), n_u = static_cast<std::int64_t>(grid.u.size()),
                 n_v = static_cast<std::int64_t>(grid.v.size());
      for (const Vec3 &p : grid.points) faces.points.push_back(place(image, p));
      for (std::int64_t j = 0; j + 1 < n_v; ++j)
        for (std::int64_t i = 0; i + 1 < n_u; ++i) {
          const std::int64_t corner = first + j * n_u + i;
          faces.corners.insert(faces.corners.end(), {corner, corner + 1, corner + n_u + 1, corner + n_u});
          faces.colours.push_back(colour_of(colours, image.leaflet_id));
        }
    }
  }
  return faces;
}

Faces triangles_of(const Model &model, std::int32_t leaflet, const LeafletColours &colours) {
  const TriangleSet &set = model.triangles;
  Faces faces{3, {}, {}, {}};
  for (std::int64_t i = 0; i < set.n_vertices(); ++i) faces.points.push_back(set.vertex(i));
  for (std::size_t i = 0; i < set.triangle_id.size(); ++i) {
    if (leaflet != every_leaflet && set.leaflet_id[i] != leaflet) continue;
    faces.corners.insert(faces.corners.end(), set.vertex_id.begin() + static_cast<std::ptrdiff_t>(3 * i),
                         set.vertex_id.begin() + static_cast<std::ptrdiff_t>(3 * i + 3));
    faces.colours.push_back(colour_of(colours, set.leaflet_id[i]));
  }
  return faces;
}

Segments edges_of(const Faces &faces) {
  Segments edges;
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (std::size_t k = 0; k < faces.n_corners; ++k) {
      const auto point = [&](std::size_t corner) {
        return faces.points[static_cast<std::size_t>(faces.corners[faces.n_corners * i + corner % faces.n_corners])];
      };
      edges.push_back({point(k), point(k + 1)});
    }
  return edges;
}

TriangleEdges triangle_edges_of(const Model &model, std::int32_t leaflet) {
  const TriangleSet &set = model.triangles;
  TriangleEdges edges;
  for (std::size_t i = 0; i < set.triangle_id.size(); ++i) {
    if (leaflet != every_leaflet && set.leaflet_id[i] != leaflet) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t a = set.vertex_id[3 * i + k], b = set.vertex_id[3 * i + (k + 1) % 3];
      const auto parameter = [&](std::int64_t vertex, int which) {
        return set.uv[static_cast<std::size_t>(2 * vertex + which)];
      };
      const bool is_diagonal = parameter(a, 0) != parameter(b, 0) && parameter(a, 1) != parameter(b, 1);
      (is_diagonal ? edges.diagonals : edges.halving).push_back({set.vertex(a), set.vertex(b)});
    }
  }
  return edges;
}

Pieces placed(const PatchSet &set, const Side &side, const PatchImage &image) {
  Pieces pieces;
  for (const Bezier &piece : set.curve_of(side).spans()) pieces.push_back(placed(piece, image));
  return side.reversed ? reversed(pieces) : pieces;
}

Pieces reversed(Pieces pieces) {
  std::reverse(pieces.begin(), pieces.end());
  for (Bezier &piece : pieces) piece = piece.reversed();
  return pieces;
}

Pieces joined(const Pieces &pieces) {
  Pieces made;
  for (const Bezier &piece : pieces) {
    Bezier whole{};
    if (!made.empty() && join(made.back(), piece, whole))
      made.back() = whole;
    else
      made.push_back(piece);
  }
  return made;
}

Points samples(const Pieces &pieces) {
  constexpr int n = 64;
  Points points;
  for (const Bezier &piece : pieces)
    for (int i = points.empty() ? 0 : 1; i <= n; ++i) points.push_back(evaluate(piece, static_cast<double>(i) / n));
  return points;
}

std::vector<Points> control_polygons(const Pieces &pieces) {
  std::vector<Points> polygons;
  for (const Bezier &piece : pieces)
    polygons.emplace_back(piece.control.begin(), piece.control.begin() + piece.degree + 1);
  return polygons;
}

Points control_points(const Pieces &pieces) {
  Points points;
  for (const Bezier &piece : pieces)
    for (int i = points.empty() ? 0 : 1; i <= piece.degree; ++i)
      points.push_back(piece.control[static_cast<std::size_t>(i)]);
  if (points.size() > 1 && distance(points.front(), points.back()) < 1e-9) points.pop_back();
  return points;
}

std::array<BoundaryPolyline, 4> boundary_polylines(const PatchSet &set, const Patch &patch, const QuadGrid &grid) {
  const std::size_t n_u = grid.u.size(), n_v = grid.v.size();
  const auto vertices = [&](const Side &side, const Vector<double> &t, const auto &point) {
    const Curve curve = along(set, side);
    BoundaryPolyline made;
    if (curve.length() == 0) return BoundaryPolyline{{curve.first()}, {0}};
    for (std::size_t i = 0; i < t.size(); ++i) {
      if (distance(point(i), curve.at(t[i])) > 1e-9) continue;
      made.points.push_back(point(i));
      made.t.push_back(t[i]);
    }
    return made;
  };
  return {vertices(patch.v0, grid.u, [&](std::size_t i) { return grid.point(i, 0); }),
          vertices(patch.v1, grid.u, [&](std::size_t i) { return grid.point(i, n_v - 1); }),
          vertices(patch.u0, grid.v, [&](std::size_t j) { return grid.point(0, j); }),
          vertices(patch.u1, grid.v, [&](std::size_t j) { return grid.point(n_u - 1, j); })};
}

CuspCurves cusp_curves(const PatchSet &set, std::int32_t cusp) {
  const Patch *below = nullptr, *above = nullptr;
  std::vector<PatchImage> images;  // the images of the patch below: unchanged and mirrored
  for (const Patch &patch : set.patches) {
    std::vector<PatchImage> of_cusp;
    for (const PatchImage &image : patch.images)
      if (image.leaflet_id == cusp) of_cusp.push_back(image);
    if (of_cusp.empty()) continue;
    const bool is_below = set.curve_of(patch.v0).length() == 0;
    (is_below ? below : above) = &patch;
    if (is_below) images = of_cusp;
  }
  if (!below || !above) throw std::runtime_error("a cusp has two patches");
  CuspCurves curves;
  for (std::size_t k = 0; k < 2; ++k) {
    const PatchImage &image = images.at(k);
    curves.leaflet[k] = placed(set, above->v1, image);
    curves.bending[k] = placed(set, below->v1, image);
    curves.sinus[k] = joined(concatenated(placed(set, below->u1, image), placed(set, above->u1, image)));
  }
  curves.symmetry = joined(concatenated(placed(set, below->u0, images[0]), placed(set, above->u0, images[0])));
  return curves;
}

// The patches of one half of the valve are listed from the anterior point of the annulus to the posterior point.
MitralCurves mitral_curves(const PatchSet &set) {
  std::array<Pieces, 2> annulus, anterior, posterior;  // each array has a curve and its mirror image
  for (const Patch &patch : set.patches)
    for (std::size_t k = 0; k < 2; ++k) {
      const PatchImage &image = patch.images.at(k);
      annulus[k] = concatenated(annulus[k], placed(set, patch.v0, image));
      if (set.curve_of(patch.v1).length() == 0) continue;
      Pieces &edge = (image.leaflet_id == RIIS_LEAFLET_ANTERIOR ? anterior : posterior)[k];
      edge = concatenated(edge, placed(set, patch.v1, image));
    }
  return {joined(concatenated(reversed(annulus[0]), annulus[1])),
          joined(concatenated(reversed(anterior[0]), anterior[1])),
          joined(concatenated(posterior[0], reversed(posterior[1])))};
}

void append(Points &to, const Points &from) { to.insert(to.end(), from.begin(), from.end()); }

}  // namespace riis::figures
