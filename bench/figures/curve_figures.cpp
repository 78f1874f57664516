// SPDX-License-Identifier: Apache-2.0
// Draws the stages by which a curve and a patch are made.
#include <algorithm>
#include <string>

#include "figures/figures.hpp"
#include "figures/shapes.hpp"
#include "figures/text.hpp"

namespace riis::figures {
namespace {

constexpr PictureSize curve_size{760, 560};

const Bezier example = Bezier::cubic({0, 0, 0}, {0.4, 2.5, 0}, {2.1, 2.9, 0}, {4.2, 0.3, 0});

Points controls(const Bezier &curve) { return control_points({curve}); }

Picture curve_picture(const std::string &title) {
  Points to_fit = controls(example);
  append(to_fit, {{-0.1, -0.2, 0}, {4.3, 2.9, 0}});
  Picture picture(curve_size, top_view, to_fit, 70);
  picture.add_title(title);
  return picture;
}

void add_controlled(Picture &picture, const Bezier &curve, const std::string &name, Colour colour, double above_first) {
  picture.add_dashed(controls(curve), paler(colour, 0.4), 3);
  picture.add_curve(samples({curve}), colour, 6);
  picture.add_points(controls(curve), colour, 17);
  const Points q = controls(curve);
  for (std::size_t i = 0; i < q.size(); ++i) {
    const bool is_inner = i > 0 && i + 1 < q.size();
    const double side = i == 0 ? -1 : i + 1 == q.size() ? 1 : 0;
    picture.add_label(q[i], name + std::to_string(i), side * 30, is_inner ? 28 : above_first, colour);
  }
}

Panel whole_curve() {
  Picture picture = curve_picture("curve and control polygon");
  add_controlled(picture, example, "Q", blue, -22);
  return {picture.png(),
          "A cubic Bézier curve, its control points Q0 to Q3 and its control polygon (dashed). Its length is " +
              number(arc_length(example), 4) + ", its flatness κ " + number(flatness(example)) + "."};
}

Panel halved_curve() {
  Picture picture = curve_picture("halved once");
  const double whole = arc_length(example), middle = parameter_at_length(example, whole, 0.5 * whole);
  const auto [left, right] = split(example, middle);
  add_controlled(picture, left, "L", orange, -26);
  add_controlled(picture, right, "R", green, -26);
  picture.add_points({left.last()}, dark, 17);
  return {picture.png(),
          "One step of the recursion, by de Casteljau's algorithm: left part L0 to L3, right part R0 to R3, L3 = "
          "R0 (dark). riis halves the length (here at the parameter " +
              number(middle, 4) + "), the paper the parameter (0.5). κ of the parts: " + number(flatness(left)) +
              " and " + number(flatness(right)) + "."};
}

Panel polyline(double max_error) {
  const Curve curve(example);
  const Flattened flat = flatten(curve, max_error);
  const Points points(flat.points.begin(), flat.points.end());
  const std::size_t n = points.size() - 1;
  Picture picture = curve_picture("error at most " + number(max_error) + ": " + count(n) + " segments");
  picture.add_curve(samples({example}), paler(blue, 0.6), 10);
  picture.add_curve(points, dark, 4, 2);
  picture.add_points(points, vermilion, n > 20 ? 11 : 16);
  double measured = 0;
  const double length_of_curve = curve.length();
  for (std::size_t i = 0; i < n; ++i) {
    for (int k = 0; k <= 50; ++k) {
      const double s = k / 50.0, share = (1 - s) * flat.t[i] + s * flat.t[i + 1];
      measured =
          std::max(measured, distance(mix(flat.points[i], flat.points[i + 1], s), curve.at(std::min(1.0, share))));
    }
  }
  if (n <= 10)
    for (std::size_t i = 0; i <= n; ++i) {
      const Vec3 along = curve.frame(flat.t[i]).tangent;
      picture.add_label_away(flat.points[i], flat.points[i] - Vec3{-along.y, along.x, 0}, number(flat.t[i], 5), 38,
                             dark, 20);
    }
  return {picture.png(), "The polyline of " + count(n) + " segments" +
                             (n <= 10 ? ", with the parameter t of every vertex: its share of the curve's length (" +
                                            number(length_of_curve, 4) + ")"
                                      : std::string()) +
                             ". Largest distance at equal t: bound " +
                             number(*std::max_element(flat.errors.begin(), flat.errors.end())) + ", measured " +
                             number(measured) + "."};
}

// The tolerance for the upper patch of half a cusp, so coarse that the grid lines can be distinguished.
constexpr double coarse = 0.2;
constexpr std::int32_t cusp = RIIS_LEAFLET_NON_CORONARY;
constexpr PictureSize patch_size{900, 680};
const char *const side_names[4] = {"v = 0, bending curve", "v = 1, leaflet curve", "u = 0, symmetry curve",
                                   "u = 1, sinus curve"};
constexpr Colour side_colours[4] = {blue, vermilion, green, purple};

// Returns a model with one image of one patch.
Model upper_half_patch() {
  const PatchSet set = Valve(find_valve_kind("aortic")).make_patches();
  Model model;
  model.patches.curves = set.curves;
  for (const Patch &patch : set.patches)
    if (patch.images.front().leaflet_id == cusp && set.curves[patch.v0.curve].length() > 0)
      model.patches.patches = {patch};
  model.patches.patches.at(0).images.resize(1);
  model.grids = make_grids(model.patches, coarse * half_thickness);
  model.triangles =
      triangulate_adapted(model.patches, {coarse * half_thickness, {1, rotation_xyz({0, 0, 0}), {0, 0, 0}}, false, 1});
  return model;
}

class PatchPictures {
 public:
  PatchPictures()
      : model_(upper_half_patch()),
        image_(model_.patches.patches[0].images[0]),
        grid_(model_.grids[0]),
        sides_(boundary_polylines(model_.patches, model_.patches.patches[0], grid_)),
        quads_(quads_of(model_, cusp, paler(leaflet_colours, 0.55))),
        // The patch is seen from outside and above.
        view_(looking(image_.rotation * Vec3{-1, -0.35, -0.75}, {0, 0, 1})) {}

  Panel boundary() const {
    Picture picture = picture_of("four polylines and their t");
    Vec3 middle{0, 0, 0};
    for (const Vec3 &p : quads_.points) middle = middle + (1.0 / static_cast<double>(quads_.points.size())) * p;
    for (std::size_t k = 0; k < 4; ++k) {
      const Points points = placed(sides_[k]);
      picture.add_curve(points, side_colours[k], 5);
      picture.add_points(points, side_colours[k], 16);
      for (const std::size_t i : labelled(sides_[k])) {
        const Vec3 along = (1 / distance(points[i - 1], points[i + 1])) * (points[i + 1] - points[i - 1]),
                   out = points[i] - middle;
        picture.add_label_away(points[i], points[i] - (out - dot(out, along) * along), number(sides_[k].t[i], 6), 36,
                               side_colours[k], 22);
      }
    }
    return {picture.png(),
            "The boundary: four polylines that meet in the corners, and the t of their inner vertices where "
            "there is room for it. They have " +
                count(sides_[0].t.size() - 1) + ", " + count(sides_[1].t.size() - 1) + ", " +
                count(sides_[2].t.size() - 1) + " and " + count(sides_[3].t.size() - 1) +
                " segments, in the order of the key."};
  }

  Panel parameters() const {
    Picture picture(patch_size, top_view, {{0, 0, 0}, {1, 1, 0}}, 110);
    picture.add_title("the square of u and v");
    for (const double u : grid_.u) picture.add_curve({{u, 0, 0}, {u, 1, 0}}, light_grey, 2.5);
    for (const double v : grid_.v) picture.add_curve({{0, v, 0}, {1, v, 0}}, light_grey, 2.5);
    for (std::size_t k = 0; k < 4; ++k) {
      Points points;
      for (const double t : sides_[k].t)
        points.push_back(k == 0 ? Vec3{t, 0, 0} : k == 1 ? Vec3{t, 1, 0} : k == 2 ? Vec3{0, t, 0} : Vec3{1, t, 0});
      picture.add_curve({points.front(), points.back()}, side_colours[k], 5);
      picture.add_points(points, side_colours[k], 16);
      for (const std::size_t i : labelled(sides_[k])) {
        const std::string t = number(sides_[k].t[i], 6);
        if (k < 2)
          picture.add_label(points[i], t, 0, k == 0 ? -26 : 26, side_colours[k], 19);
        else
          picture.add_label(points[i], t, k == 2 ? -46 : 46, 0, side_colours[k], 19);
      }
    }
    picture.add_label({0.5, 0, 0}, "u", 0, -62);
    picture.add_label({0, 0.5, 0}, "v", -110, 0);
    return {picture.png(), "Grid lines stand at the union of the t of opposite sides: " + count(grid_.u.size()) +
                               " values of u, " + count(grid_.v.size()) + " of v."};
  }

  Panel points() const {
    Picture picture = picture_of("grid points");
    for (std::size_t k = 0; k < 4; ++k) picture.add_curve(placed(sides_[k]), paler(side_colours[k], 0.3), 4);
    picture.add_segments(edges_of(quads_), grey, 1.5);
    picture.add_points(quads_.points, dark, 11);
    return {picture.png(), "The Coons patch S(u,v) at these " + count(grid_.points.size()) + " points."};
  }

  Panel quads() const {
    Picture picture = picture_of("quads");
    picture.add_faces(quads_, Shading::flat);
    picture.add_segments(edges_of(quads_), dark, 2.5);
    return {picture.png(), count(quads_.size()) +
                               " quads. S is exactly bilinear in each of them, so no detail of the polylines is lost."};
  }

  Panel halved_quads() const {
    Picture picture = picture_of("quads, halved");
    picture.add_faces(shown_triangles(), Shading::flat);
    picture.add_segments(triangle_edges_of(model_, cusp).halving, vermilion, 2.5);
    picture.add_segments(edges_of(quads_), dark, 2.5, 1);
    double largest = 0;
    std::size_t n_halved = 0;
    for (std::size_t j = 0; j + 1 < grid_.v.size(); ++j)
      for (std::size_t i = 0; i + 1 < grid_.u.size(); ++i) {
        const Quad quad{grid_.point(i, j), grid_.point(i + 1, j), grid_.point(i + 1, j + 1), grid_.point(i, j + 1)};
        largest = std::max(largest, quad_flatness(quad));
        n_halved += split_error(quad) > coarse * half_thickness - grid_.error(i, j);
      }
    return {picture.png(),
            count(n_halved) +
                " quads are farther from their two triangles than the curves' errors leave room for: they are "
                "halved both ways (red) until all parts are close enough. The largest κ<sub>quad</sub> is " +
                number(largest) + " cm."};
  }

  Panel triangles() const {
    const TriangleEdges edges = triangle_edges_of(model_, cusp);
    Picture picture = picture_of("triangles");
    picture.add_faces(shown_triangles(), Shading::flat);
    picture.add_segments(edges.diagonals, dark, 1.5);
    picture.add_segments(edges.halving, dark, 1.5);
    picture.add_segments(edges_of(quads_), dark, 2.5, 1);
    return {picture.png(),
            "Every quad, or part of one, is cut into two triangles: " + count(model_.triangles.n_triangles()) + "."};
  }

 private:
  // Returns the inner vertices that are far enough from other vertices for a label.
  static std::vector<std::size_t> labelled(const BoundaryPolyline &polyline) {
    std::vector<std::size_t> found;
    double last = 1;
    for (std::size_t i = polyline.t.size() - 1; i-- > 1;)
      if (last - polyline.t[i] > 0.12 && polyline.t[i] > 0.12) {
        last = polyline.t[i];
        found.push_back(i);
      }
    return found;
  }

  Points placed(const BoundaryPolyline &polyline) const {
    Points points;
    for (const Vec3 &p : polyline.points) points.push_back(place(image_, p));
    return points;
  }

  Faces shown_triangles() const { return triangles_of(model_, cusp, paler(leaflet_colours, 0.55)); }

  Picture picture_of(const std::string &title) const {
    Picture picture(patch_size, view_, quads_.points, 90);
    picture.add_title(title);
    return picture;
  }

  Model model_;
  PatchImage image_;
  QuadGrid grid_;
  std::array<BoundaryPolyline, 4> sides_;
  Faces quads_;
  View view_;
};

}  // namespace

Figure bezier_figure() {
  Figure figure{"A Bézier curve becomes a polyline", {}, 3, {}, {}, {}, {}};
  figure.panels = {whole_curve(), halved_curve(), polyline(0.3), polyline(0.05), polyline(0.01), polyline(0.002)};
  figure.caption =
      "A curve is halved until every part is within the allowed error of its chord (here 0.3, 0.05, 0.01 and 0.002; "
      "the curve, "
      "pale, is 4.2 wide). More points stand where it bends more. t is the share of the curve's length, always a "
      "binary fraction, so "
      "that the parameters of two curves agree to the last bit or differ clearly.";
  figure.paper =
      "section 3.2, figures “Example of one step of recursive subdivision using de Casteljau algorithm” and “Polyline "
      "after "
      "recursive subdivision”; algorithm “Recursive de Casteljau subdivision for quadratic and cubic Bézier curves”.";
  return figure;
}

Figure coons_figure() {
  const PatchPictures pictures;
  Figure figure{"A Coons patch becomes quads and triangles", {}, 3, {}, {}, {}, {}};
  figure.panels = {pictures.boundary(), pictures.parameters(),   pictures.points(),
                   pictures.quads(),    pictures.halved_quads(), pictures.triangles()};
  for (std::size_t k = 0; k < 4; ++k) figure.key.push_back({side_colours[k], side_names[k]});
  figure.caption =
      "The upper patch of half the non-coronary aortic cusp, between bending curve and free edge, with the paper's "
      "parameters, seen from "
      "outside and above. The tolerance is " +
      percent(coarse) + " (" + number(coarse * half_thickness) +
      " cm), four times coarser than the default, so that single lines can be seen. The other half "
      "is a mirrored copy of the same patch.";
  figure.paper =
      "section 3.3, figure “Aortic valve cusp surface representations”; section 4.1, algorithm “Recursive quad "
      "subdivision for triangulation”.";
  return figure;
}

}  // namespace riis::figures
