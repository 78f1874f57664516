// SPDX-License-Identifier: Apache-2.0
// Draws the mitral valve: its curves, its surfaces from closed to open, its quads and triangles.
#include <string>

#include "figures/figures.hpp"
#include "figures/shapes.hpp"
#include "figures/text.hpp"

namespace riis::figures {
namespace {

constexpr PictureSize top_size{960, 780}, side_size{960, 620}, surface_size{860, 700}, quads_size{860, 680};
constexpr Colour annulus_colour = dark, anterior_colour = blue, posterior_colour = vermilion;
constexpr LeafletColours colours = {blue, orange, green};
// The view from the side has the anterior point of the annulus on the right and the ventricle below.
const View side_view = looking({-1, 0, 0}, {0, 0, 1});

Valve valve_at(double opening) {
  Valve valve(find_valve_kind("mitral"));
  valve.set("opening", 1, &opening);
  return valve;
}

void add_controlled(Picture &picture, const Pieces &pieces, Colour colour, double width, double diameter) {
  for (const Points &polygon : control_polygons(pieces)) picture.add_dashed(polygon, paler(colour, 0.35), 2.5);
  picture.add_curve(samples(pieces), colour, width);
  picture.add_points(control_points(pieces), colour, diameter);
}

// Labels the joints of the annulus' pieces in the order of the paper's points P0 to P5, anticlockwise from the posterior point.
void name_annulus_points(Picture &picture, const Pieces &annulus, bool from_top) {
  Vec3 middle{0, 0, 0};
  for (const Bezier &piece : annulus) middle = middle + (1.0 / static_cast<double>(annulus.size())) * piece.first();
  const std::size_t n = annulus.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t of_paper = annulus[1].first().x > annulus[0].first().x ? i : (n - i) % n;
    // Seen from the side, points with x > 0 hide points with x < 0.
    if (!from_top && annulus[i].first().x < -1e-9) continue;
    const std::string name = "A" + std::to_string(of_paper);
    if (from_top)
      picture.add_label_away(annulus[i].first(), middle, name, 34, annulus_colour, 26);
    else  // A2 and A3 nearly coincide in this view, so their labels are apart
      picture.add_label(annulus[i].first(), name,
                        of_paper == 2   ? 30
                        : of_paper == 3 ? -14
                                        : 0,
                        of_paper == 2 ? 10 : 30);
  }
}

struct Curves {
  MitralCurves curves;
  Points all() const {
    Points points;
    for (const Pieces *pieces : {&curves.annulus, &curves.anterior, &curves.posterior})
      append(points, control_points(*pieces));
    return points;
  }
};

Panel curves_panel(const Curves &of, bool is_closed, bool from_top, const Points &to_fit, const std::string &title,
                   const std::string &caption) {
  Picture picture(from_top ? top_size : side_size, from_top ? top_view : side_view, to_fit, 70);
  picture.add_title(title);
  add_controlled(picture, of.curves.annulus, annulus_colour, 5, 15);
  if (!is_closed) add_controlled(picture, of.curves.posterior, posterior_colour, 5, 15);
  add_controlled(picture, of.curves.anterior, anterior_colour, 5, 15);
  name_annulus_points(picture, of.curves.annulus, from_top);
  picture.add_scale_and_axes();
  return {picture.png(), caption};
}

}  // namespace

Figure mitral_curves_figure() {
  const PatchSet closed_set = valve_at(0).make_patches(), open_set = valve_at(1).make_patches();
  const Curves closed{mitral_curves(closed_set)}, open{mitral_curves(open_set)};
  Points to_fit = closed.all();
  append(to_fit, open.all());
  Figure figure{"The mitral valve: annulus and free edges", {}, 2, {}, {}, {}, {}};
  const auto counts = [](const Pieces &pieces) {
    return count(pieces.size()) + (pieces.size() == 1 ? " piece" : " pieces") + " and " +
           count(control_points(pieces).size()) + " control points";
  };
  figure.panels = {
      curves_panel(closed, true, true, to_fit, "closed, top",
                   "Closed, from the atrium. Both free edges are one curve."),
      curves_panel(open, false, true, to_fit, "open, top",
                   "Open, from the atrium: the posterior edge has three scallops."),
      curves_panel(closed, true, false, to_fit, "closed, side",
                   "Closed, from the posteromedial side: the saddle of the annulus; the free edge lies in a plane."),
      curves_panel(open, false, false, to_fit, "open, side",
                   "Open, from the side: the annulus is flat, the free edges hang into the ventricle.")};
  figure.key = {{annulus_colour, "annulus, A0 posterior to A3 anterior point"},
                {anterior_colour, "anterior free edge (closed: both)"},
                {posterior_colour, "posterior free edge"}};
  figure.caption =
      "Curves with the control points of all their Bézier pieces, which are all cubic; A0 to A5 are the paper's "
      "P<sub>an</sub><sup>0</sup> to P<sub>an</sub><sup>5</sup>. The annulus has " +
      counts(open.curves.annulus) + ", the anterior edge " + counts(open.curves.anterior) +
      ", the posterior edge when open " + counts(open.curves.posterior) +
      " (closed: " + counts(closed.curves.posterior) +
      ", those of the anterior edge). Parameters: the paper's, with opening 0 and 1, moved by (0, 0, 1). Between the "
      "two, every "
      "control point moves on a straight line.";
  figure.paper =
      "appendix, figures “Top and side view of the mitral valve model in a closed state” and “… in an open state”; its "
      "misprints are corrected as docs/theory/mitral.md says.";
  return figure;
}

Figure mitral_surfaces_figure() {
  constexpr double fine = 0.01;
  std::vector<Model> models;
  Points to_fit;
  const double openings[3] = {0, 0.5, 1};
  for (const double opening : openings) {
    models.push_back(make_model(valve_at(opening), fine));
    append(to_fit, triangles_of(models.back(), every_leaflet, colours).points);
  }
  Figure figure{"The mitral valve: surfaces, closed, half open and open", {}, 3, {}, {}, {}, {}};
  const auto add_row = [&](const View &view, const std::string &from, const std::string &caption) {
    const char *names[3] = {"closed", "half open", "open"};
    for (std::size_t k = 0; k < 3; ++k) {
      Picture picture(surface_size, view, to_fit);
      picture.add_title(std::string(names[k]) + ", " + from);
      picture.add_faces(triangles_of(models[k], every_leaflet, colours), Shading::smooth);
      picture.add_scale_and_axes();
      figure.panels.push_back({picture.png(), "Opening " + number(openings[k]) + ", " + caption});
    }
  };
  add_row(top_view, "top", "from the atrium.");
  add_row(side_view, "side", "from the posteromedial side.");
  add_row(looking({-0.3, 1, 0.55}, {0, 0, 1}), "from the ventricle", "from the ventricle, posterior leaflet in front.");
  figure.key = {{colours[0], "anterior leaflet"}, {colours[1], "posterior leaflet"}};
  figure.caption =
      "The leaflets, made of arcs from the annulus to the free edges that leave the straight line by 20 degrees. "
      "Parameters: the paper's; tolerance " +
      percent(fine) + ", " + count(models[0].triangles.n_triangles()) + ", " +
      count(models[1].triangles.n_triangles()) + " and " + count(models[2].triangles.n_triangles()) + " triangles.";
  figure.paper =
      "figures “Example of mitral valve in open state” (section 2.2) and “Closed mitral valve surfaces” (appendix).";
  return figure;
}

Figure mitral_quads_figure() {
  constexpr double tolerance = 0.05;
  Figure figure{"The mitral valve: quads and triangles", {}, 3, {}, {}, {}, {}};
  const LeafletColours pale = paler(colours, 0.5);
  std::string counts;
  for (const double opening : {0.0, 1.0}) {
    const std::string state = opening == 0 ? "closed" : "open";
    const Model model = make_model(valve_at(opening), tolerance);
    const Faces quads = quads_of(model, every_leaflet, pale), triangles = triangles_of(model, every_leaflet, pale);
    const View view = opening == 0 ? looking({-0.25, 0.8, -1}, {0, 0, 1}) : looking({-0.45, 1, -0.25}, {0, 0, 1});
    const auto picture_of = [&](const std::string &title) {
      Picture picture(quads_size, view, quads.points);
      picture.add_title(state + ": " + title);
      picture.add_scale_and_axes();
      return picture;
    };
    Picture boundaries = picture_of("curves of the patches");
    std::size_t n_patches = 0;
    for (std::size_t i = 0; i < model.grids.size(); ++i) {
      const Patch &patch = model.patches.patches[i];
      for (const PatchImage &image : patch.images) {
        ++n_patches;
        for (const Side &side : {patch.v0, patch.v1, patch.u0, patch.u1}) {
          const bool is_arc = side.curve == patch.u0.curve || side.curve == patch.u1.curve;
          const Pieces pieces = placed(model.patches, side, image);
          if (model.patches.curves[side.curve].length() == 0) continue;
          const Colour colour = is_arc                                      ? grey
                                : side.curve == patch.v0.curve              ? annulus_colour
                                : image.leaflet_id == RIIS_LEAFLET_ANTERIOR ? anterior_colour
                                                                            : posterior_colour;
          boundaries.add_curve(samples(pieces), colour, is_arc ? 3 : 5);
        }
      }
    }
    Picture quad_picture = picture_of("quads");
    quad_picture.add_faces(quads, Shading::flat);
    quad_picture.add_segments(edges_of(quads), dark, 1.2);
    Picture triangle_picture = picture_of("triangles");
    triangle_picture.add_faces(triangles, Shading::flat);
    const TriangleEdges edges = triangle_edges_of(model, every_leaflet);
    triangle_picture.add_segments(edges.diagonals, grey, 1);
    triangle_picture.add_segments(edges.halving, dark, 1.2);
    figure.panels.push_back(
        {boundaries.png(), "Opening " + number(opening) + ": the sides of the " + count(n_patches) +
                               " patches: parts of the annulus and of the free edges, and the arcs between them."});
    figure.panels.push_back({quad_picture.png(), count(quads.size()) + " quads."});
    figure.panels.push_back({triangle_picture.png(), count(triangles.size()) + " triangles."});
  }
  figure.key = {{annulus_colour, "annulus"},
                {anterior_colour, "anterior free edge"},
                {posterior_colour, "posterior free edge"},
                {grey, "arcs that patches share"},
                {pale[0], "anterior leaflet"},
                {pale[1], "posterior leaflet"}};
  figure.caption = "The valve at a tolerance of " + percent(tolerance) +
                   ", with the paper's parameters. Half a valve consists of five patches, which are placed twice, "
                   "unchanged and mirrored in x. "
                   "Beside each commissure a patch has a part of the annulus on one side and a single point, the end "
                   "of the free edge, on "
                   "the other: the paper's triangle regions.";
  figure.paper = "appendix, “Leaflet surfaces”; section 4.1 for the triangles.";
  return figure;
}

}  // namespace riis::figures
