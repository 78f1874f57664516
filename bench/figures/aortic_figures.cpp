// SPDX-License-Identifier: Apache-2.0
// Draws the whole aortic valve, and one of its cusps.
#include <algorithm>
#include <limits>
#include <string>

#include "figures/figures.hpp"
#include "figures/shapes.hpp"
#include "figures/text.hpp"

namespace riis::figures {
namespace {

constexpr const char *cusp_names[3] = {"right", "left", "non-coronary"};
constexpr PictureSize valve_size{900, 760}, cusp_size{860, 640};
const View side_view = looking({-0.15, 1, -0.28}, {0, 0, 1});

// The colours of the four defining curves.
constexpr Colour leaflet_colour = vermilion, bending_colour = blue, sinus_colour = purple, symmetry_colour = green;

struct NamedCurve {
  const Pieces *pieces;
  Colour colour;
};

std::vector<NamedCurve> curves_of(const CuspCurves &curves, bool with_mirrored) {
  std::vector<NamedCurve> all = {{&curves.symmetry, symmetry_colour}};
  for (std::size_t k = 0; k < (with_mirrored ? 2u : 1u); ++k) {
    all.push_back({&curves.leaflet[k], leaflet_colour});
    all.push_back({&curves.bending[k], bending_colour});
    all.push_back({&curves.sinus[k], sinus_colour});
  }
  return all;
}

void add_controlled(Picture &picture, const NamedCurve &curve, double width, double diameter) {
  for (const Points &polygon : control_polygons(*curve.pieces))
    picture.add_dashed(polygon, paler(curve.colour, 0.3), 2.5);
  picture.add_curve(samples(*curve.pieces), curve.colour, width);
  picture.add_points(control_points(*curve.pieces), curve.colour, diameter);
}

// Returns the widest gap between the ends of neighbouring cusps' free edges.
double widest_gap(const std::vector<CuspCurves> &cusps) {
  double widest = 0;
  for (std::size_t i = 0; i < cusps.size(); ++i)
    for (const Pieces &edge : cusps[i].leaflet) {
      double to_nearest = std::numeric_limits<double>::infinity();
      for (std::size_t j = 0; j < cusps.size(); ++j)
        for (const Pieces &other : cusps[j].leaflet)
          if (j != i) to_nearest = std::min(to_nearest, distance(edge.back().last(), other.back().last()));
      widest = std::max(widest, to_nearest);
    }
  return widest;
}

const std::vector<KeyEntry> curve_key = {{leaflet_colour, "leaflet curve (free edge)"},
                                         {bending_colour, "bending curve"},
                                         {sinus_colour, "sinus curve"},
                                         {symmetry_colour, "symmetry curve"}};

}  // namespace

Figure aortic_valve_figure() {
  const Valve valve(find_valve_kind("aortic"));
  constexpr double fine = 0.01;
  const Model model = make_model(valve, fine);
  const Faces faces = triangles_of(model, every_leaflet);
  std::vector<CuspCurves> cusps;
  Points to_fit = faces.points;
  std::size_t n_curves = 0, n_control_points = 0;
  for (std::int32_t cusp = 0; cusp < 3; ++cusp) {
    cusps.push_back(cusp_curves(model.patches, cusp));
    for (const NamedCurve &curve : curves_of(cusps.back(), true)) {
      append(to_fit, control_points(*curve.pieces));
      ++n_curves;
      n_control_points += control_points(*curve.pieces).size();
    }
  }
  const auto curves_panel = [&](const View &view, const std::string &title, const std::string &caption) {
    Picture picture(valve_size, view, to_fit);
    picture.add_title(title);
    picture.add_faces(faces, Shading::ghost);
    for (const CuspCurves &cusp : cusps)
      for (const NamedCurve &curve : curves_of(cusp, true)) add_controlled(picture, curve, 5, 13);
    picture.add_scale_and_axes();
    return Panel{picture.png(), caption};
  };
  const auto surface_panel = [&](const View &view, const std::string &title, const std::string &caption) {
    Picture picture(valve_size, view, to_fit);
    picture.add_title(title);
    picture.add_faces(faces, Shading::smooth);
    picture.add_scale_and_axes();
    return Panel{picture.png(), caption};
  };
  Figure figure{"The aortic valve", {}, 2, {}, {}, {}, {}};
  figure.panels = {
      curves_panel(top_view, "curves, top",
                   "Curves and control points from the aorta; control polygons dashed; surfaces see-through."),
      curves_panel(side_view, "curves, side", "The same from the side and slightly above; the aorta is up."),
      surface_panel(top_view, "surfaces, top", "Surfaces of the three cusps from the aorta."),
      surface_panel(side_view, "surfaces, side", "The same from the side and slightly above.")};
  figure.key = curve_key;
  for (std::size_t cusp = 0; cusp < 3; ++cusp)
    figure.key.push_back({leaflet_colours[cusp], std::string(cusp_names[cusp]) + " cusp"});
  figure.caption =
      "Each of the three cusps has two mirrored halves. Four curves make a half, and the halves share the symmetry "
      "curve: " +
      count(n_curves) + " curves with " + count(n_control_points) +
      " control points in all. Parameters: the paper's. Surfaces: " + count(faces.size()) +
      " triangles at a tolerance of " + percent(fine) +
      ". Neighbouring cusps have different radii where they meet the wall, so their free edges end up to " +
      number(widest_gap(cusps), 2) + " cm apart there: the surfaces are three separate pieces.";
  figure.paper = "section 2.1, figure “Overview of the cusps in the aortic valve”; table “Aortic valve parameters”.";
  return figure;
}

Figure aortic_cusp_figure() {
  constexpr std::int32_t cusp = RIIS_LEAFLET_RIGHT;
  constexpr double tolerance = 0.05, fine = 0.005;
  const Valve valve(find_valve_kind("aortic"));
  const Model model = make_model(valve, tolerance), fine_model = make_model(valve, fine);
  const CuspCurves curves = cusp_curves(model.patches, cusp);
  const Faces quads = quads_of(model, cusp), triangles = triangles_of(model, cusp),
              smooth = triangles_of(fine_model, cusp);
  Points to_fit = quads.points;
  for (const NamedCurve &curve : curves_of(curves, true)) append(to_fit, control_points(*curve.pieces));
  // The cusps are seen from outside and above.
  const View view = looking({-1, 0.35, -0.55}, {0, 0, 1});
  const auto picture_of = [&](const std::string &title) {
    Picture picture(cusp_size, view, to_fit);
    picture.add_title(title);
    picture.add_scale_and_axes();
    return picture;
  };
  const LeafletColours pale = paler(leaflet_colours, 0.5);

  Picture controlled = picture_of("curves and control points");
  controlled.add_faces(smooth, Shading::ghost);
  std::size_t n_control_points = 0;
  for (const NamedCurve &curve : curves_of(curves, true)) {
    add_controlled(controlled, curve, 6, 16);
    n_control_points += control_points(*curve.pieces).size();
  }

  Picture lines = picture_of("polylines");
  for (std::size_t i = 0; i < model.grids.size(); ++i) {
    const Patch &patch = model.patches.patches[i];
    for (const PatchImage &image : patch.images) {
      if (image.leaflet_id != cusp) continue;
      const auto polylines = boundary_polylines(model.patches, patch, model.grids[i]);
      const bool is_lower = polylines[0].points.size() == 1;  // v = 0 is the root point
      const Colour of_sides[4] = {is_lower ? symmetry_colour : bending_colour,
                                  is_lower ? bending_colour : leaflet_colour, symmetry_colour, sinus_colour};
      for (std::size_t k = 0; k < 4; ++k) {
        Points points;
        for (const Vec3 &p : polylines[k].points) points.push_back(place(image, p));
        if (points.size() > 1) lines.add_curve(points, of_sides[k], 4);
        lines.add_points(points, dark, 10);
      }
    }
  }

  Picture dots = picture_of("interpolated points");
  dots.add_points(quads.points, blue, 9);

  Picture quad_picture = picture_of("quads");
  quad_picture.add_faces(quads_of(model, cusp, pale), Shading::flat);
  quad_picture.add_segments(edges_of(quads), dark, 1.5);

  Picture triangle_picture = picture_of("triangles");
  triangle_picture.add_faces(triangles_of(model, cusp, pale), Shading::flat);
  const TriangleEdges edges = triangle_edges_of(model, cusp);
  triangle_picture.add_segments(edges.diagonals, grey, 1);
  triangle_picture.add_segments(edges.halving, dark, 1.5);

  Picture surface = picture_of("surface");
  surface.add_faces(smooth, Shading::smooth);

  Figure figure{"One cusp, from curves to its surface", {}, 3, curve_key, {}, {}, {}};
  figure.panels = {
      {controlled.png(), "The " + count(curves_of(curves, true).size()) + " curves of the cusp with " +
                             count(n_control_points) + " control points."},
      {lines.png(), "Their polylines, cut where the bending curve cuts them, at the tolerance of the quads."},
      {dots.png(), "Points of the four Coons patches at the union of the parameters of opposite sides."},
      {quad_picture.png(), count(quads.size()) + " quads."},
      {triangle_picture.png(),
       count(triangles.size()) + " triangles: quads that are not flat enough are halved both ways, then cut."},
      {surface.png(), "The surface (" + count(smooth.size()) + " triangles at " + percent(fine) + ")."}};
  figure.caption = "The right cusp, seen from outside and above, with the paper's parameters; tolerance " +
                   percent(tolerance) +
                   " except in the last picture. A half is made once and placed twice, unchanged and mirrored, so "
                   "the halves meet "
                   "to the last bit. At the root the lower patches end in one point: " +
                   "the quads there are triangles, and triangles without area are dropped.";
  figure.paper =
      "figures “Curves used for defining the aortic valve cusp” (section 2.1) and “Aortic valve cusp surface "
      "representations” "
      "(section 3.3); algorithm “Recursive quad subdivision for triangulation” (section 4.1).";
  return figure;
}

}  // namespace riis::figures
