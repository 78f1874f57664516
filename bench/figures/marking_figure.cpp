// SPDX-License-Identifier: Apache-2.0
// Draws the marked tetrahedra around both valves.
#include <string>
#include <utility>

#include "figures/figures.hpp"
#include "figures/tetrahedra.hpp"
#include "figures/text.hpp"

namespace riis::figures {
namespace {

constexpr PictureSize size{1160, 940};
constexpr double tolerance = 0.05, edge = 0.08;

struct Marked {
  TetrahedralMesh mesh;
  Marks marks;
  Cylinder cylinder;
};

Marked marked(const char *kind, double opening, const Cylinder &cylinder) {
  TetrahedralMesh mesh = mesh_cylinder(cylinder, edge);
  Marks marks = mark(mesh, kind, opening, tolerance);
  return {std::move(mesh), std::move(marks), cylinder};
}

// Returns the edges of the cylinder's ends.
std::vector<Points> outline(const Cylinder &cylinder) {
  std::vector<Points> rims;
  for (const double up : {-0.5, 0.5}) {
    Points rim;
    for (int i = 0; i <= 120; ++i) {
      const SineCosine turn = sine_cosine_degrees(3 * i);
      rim.push_back(cylinder.middle +
                    Vec3{cylinder.radius * turn.cosine, cylinder.radius * turn.sine, up * cylinder.height});
    }
    rims.push_back(rim);
  }
  for (const double across : {-1.0, 1.0})
    rims.push_back({cylinder.middle + Vec3{across * cylinder.radius, 0, -0.5 * cylinder.height},
                    cylinder.middle + Vec3{across * cylinder.radius, 0, 0.5 * cylinder.height}});
  return rims;
}

void add_panels(Figure &figure, const Marked &of, const std::string &name, const View &side, const View &cut_view,
                const std::string &plane) {
  Points to_fit;
  for (const Points &line : outline(of.cylinder)) append(to_fit, line);
  const Faces faces = marked_faces(of.mesh, of.marks);
  const auto outside = [&](const View &view, const std::string &title) {
    Picture picture(size, view, to_fit);
    picture.add_title(name + ", " + title);
    for (const Points &line : outline(of.cylinder)) picture.add_curve(line, light_grey, 2.5);
    picture.add_faces(faces, Shading::flat);
    picture.add_segments(edges_of(faces), {70, 70, 70}, 1);
    picture.add_scale_and_axes();
    return picture.png();
  };
  Picture cut(size, cut_view, to_fit);
  cut.add_title(name + ", cut at " + plane);
  Segments edges;
  cut.add_faces(slice(of.mesh, of.marks, cut_view.direction, edges), Shading::flat);
  cut.add_segments(edges, grey, 1);
  cut.add_scale_and_axes();
  figure.panels.push_back({outside(top_view, "top"), "From above: the " + count(of.marks.n_whole) +
                                                         " tetrahedra of which all four nodes are marked."});
  figure.panels.push_back({outside(side, "side"), "The same from the side."});
  figure.panels.push_back({cut.png(), "The mesh cut by the plane " + plane +
                                          "; pale: tetrahedra of which only some nodes are "
                                          "marked."});
  figure.caption += count(of.marks.n_marked) + " of " + count(of.mesh.n_nodes()) + " nodes, " +
                    count(of.marks.n_whole) + " of " + count(of.mesh.tetrahedra.size()) + " tetrahedra wholly and " +
                    count(of.marks.n_touched - of.marks.n_whole) + " in part (" + name + ")";
}

}  // namespace

Figure marking_figure() {
  const Marked aortic = marked("aortic", 0, {{0, 0, -0.5}, 1.75, 1.6});
  const Marked mitral = marked("mitral", 1, {{0, 0.1, 0}, 2.3, 2.5});
  Figure figure{"Marked tetrahedra", {}, 3, {}, {}, {}, {}};
  figure.caption =
      "Nodes within the half thickness, 0.1 cm, of the leaflets are marked; a tetrahedron is shown when all its nodes "
      "are, in the "
      "colour of the leaflet closest to it. The meshes know nothing of the valves: cylinders of hexahedra of about " +
      number(edge) + " cm, each cut into six tetrahedra; surfaces at a tolerance of " + percent(tolerance) +
      ", the mitral valve open. Marked: ";
  add_panels(figure, aortic, "aortic valve", looking({-0.15, 1, -0.28}, {0, 0, 1}), looking({0, 1, 0}, {0, 0, 1}),
             "y = 0");
  figure.caption += ", ";
  add_panels(figure, mitral, "mitral valve", looking({-1, 0.3, -0.15}, {0, 0, 1}), looking({-1, 0, 0}, {0, 0, 1}),
             "x = 0");
  figure.caption += ".";
  figure.key = {{leaflet_colours[0], "right cusp; anterior leaflet"},
                {leaflet_colours[1], "left cusp; posterior leaflet"},
                {leaflet_colours[2], "non-coronary cusp"}};
  figure.paper = "section 4.2, figure “Results of mesh traversal algorithms with aortic and mitral valves”.";
  return figure;
}

}  // namespace riis::figures
