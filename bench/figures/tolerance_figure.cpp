// SPDX-License-Identifier: Apache-2.0
// Draws the effect of the tolerance on the triangles.
#include <string>

#include "figures/figures.hpp"
#include "figures/shapes.hpp"
#include "figures/text.hpp"

namespace riis::figures {
namespace {

constexpr PictureSize size{1000, 720};
constexpr double tolerances[4] = {0.1, 0.05, 0.02, 0.005};

struct Subject {
  const char *valve, *name;
  std::int32_t leaflet;
  View view;
};

}  // namespace

Figure tolerance_figure() {
  Figure figure{"What the tolerance does", {}, 2, {}, {}, {}, {}};
  const Subject subjects[2] = {
      {"aortic", "right cusp", RIIS_LEAFLET_RIGHT, looking({-1, 0.35, -0.55}, {0, 0, 1})},
      {"mitral", "anterior leaflet", RIIS_LEAFLET_ANTERIOR, looking({-0.35, -1, -0.35}, {0, 0, 1})}};
  std::vector<std::vector<std::string>> rows = {{"tolerance", "bound (cm)"}};
  for (const double tolerance : tolerances) rows.push_back({percent(tolerance), number(tolerance * half_thickness)});
  for (const Subject &subject : subjects) {
    rows[0].insert(rows[0].end(), {std::string(subject.name) + ": quads", "triangles",
                                   std::string(subject.valve) + " valve: quads", "triangles"});
    for (std::size_t k = 0; k < 4; ++k) {
      const Model model = make_model(Valve(find_valve_kind(subject.valve)), tolerances[k]);
      const Faces quads = quads_of(model, subject.leaflet),
                  triangles = triangles_of(model, subject.leaflet, paler(leaflet_colours, 0.5));
      Picture picture(size, subject.view, quads.points, 45);
      picture.add_title(percent(tolerances[k]));
      picture.add_faces(triangles, Shading::flat);
      // The finest triangles have edges in the leaflet's colour, because dark edges would cover them.
      picture.add_segments(edges_of(triangles), k == 3 ? leaflet_colours[0] : dark, 1);
      figure.panels.push_back({picture.png(), "The " + std::string(subject.name) + " at " + percent(tolerances[k]) +
                                                  ": " + count(quads.size()) + " quads, " + count(triangles.size()) +
                                                  " triangles."});
      rows[k + 1].insert(rows[k + 1].end(),
                         {count(quads.size()), count(triangles.size()), count(quads_of(model, every_leaflet).size()),
                          count(model.triangles.n_triangles())});
    }
  }
  figure.caption =
      "Triangles of an aortic cusp and of a mitral leaflet (open) at tolerances of 10, 5, 2 and 0.5 %, with the "
      "paper's "
      "parameters. Whatever the tolerance, distances to the triangles differ from distances to the smooth surface by "
      "no "
      "more than the bound, everywhere; curved parts get more triangles, flat ones fewer.";
  figure.table = html_table(rows);
  figure.paper =
      "section 4.1: the threshold φ of the triangulation, and its performance evaluation, which varies the tolerance.";
  return figure;
}

}  // namespace riis::figures
