// SPDX-License-Identifier: Apache-2.0
#include "figures/state_figures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "base/constants.hpp"
#include "figures/shapes.hpp"
#include "figures/text.hpp"

namespace riis::figures {
namespace {

constexpr PictureSize size{480, 400};
constexpr std::size_t most_openings = 6;  // at most this many pictures stand side by side
constexpr double margin = 26, tolerance = 0.01;
constexpr Colour orifice_colour{247, 196, 190}, outline_colour = dark;
// The housing is higher than the closed leaflets, so that they lie inside it.
constexpr double housing_height = 1.1;

struct Subject {
  const char *kind, *title, *from_above, *from_the_side;
  View side;
  std::vector<const char *> leaflets;
  const char *disc;  // the name of the disc that contains the orifice
  const char *caption, *paper;
};

const char *const not_in_the_paper = "none: the paper has no such valve.";

const std::vector<Subject> &subjects() {
  static const View of_cusps = looking({-0.5, 0.87, -0.3}, {0, 0, 1});
  static const std::vector<Subject> all = {
      {"aortic",
       "The aortic valve of the paper, from its one state to an open state",
       "from the aorta",
       "from the side and slightly above, the aorta up",
       of_cusps,
       {"right cusp", "left cusp", "non-coronary cusp"},
       "the disc of <code>root_radius</code>",
       "At opening 0 the valve is the paper's, which does not close: a hole stays in its middle. The open state "
       "follows "
       "from the same parameters and from <code>open_radius_ratio</code> and <code>commissure_expansion</code>.",
       "section 2.1 and table “Aortic valve parameters” for opening 0. The paper has no open state of this valve."},
      {"trileaflet",
       "The trileaflet valve, from closed to open",
       "from the aorta",
       "from the side and slightly above, the aorta up",
       of_cusps,
       {"right cusp", "left cusp", "non-coronary cusp"},
       "the disc of <code>root_radius</code>",
       "Three equal cusps, whose free edges meet along the lines from the commissures to the axis when the valve is "
       "closed. "
       "Only slivers at the wall stay uncovered then.",
       not_in_the_paper},
      {"coapting",
       "The coapting valve, from closed to open",
       "from the aorta",
       "from the side and slightly above, the aorta up",
       of_cusps,
       {"right cusp", "left cusp", "non-coronary cusp"},
       "the disc of <code>root_radius</code>",
       "Three equal cusps that lie side by side in a coaptation zone when the valve is closed. Their free edges keep "
       "their length: the middle of an edge sinks at first, and rises again.",
       not_in_the_paper},
      {"mitral",
       "The mitral valve, from closed to open",
       "from the atrium",
       "from the posteromedial side, the ventricle down",
       looking({-1, 0, 0}, {0, 0, 1}),
       {"anterior leaflet", "posterior leaflet"},
       "the inside of the annulus",
       "The saddle of the annulus flattens while the leaflets turn into the ventricle. The paper's free edges lengthen "
       "more than "
       "tissue does, and its open orifice is large: docs/theory/measures.md has published values.",
       "appendix, table of the mitral valve's parameters, of which <i>t</i> is the opening."},
      {"bileaflet",
       "The bileaflet mechanical valve, from closed to open",
       "from downstream",
       "from the side and above, along the hinges; downstream is up",
       looking({0.05, 1, -0.42}, {0, 0, 1}),
       {"leaflet x &gt; 0", "leaflet x &lt; 0"},
       "the disc of <code>radius</code>",
       "Rigid leaflets turn about hinges from 30 to 85 degrees. The pictures from the side show a housing, "
       "see-through, which "
       "the valve has for a <code>ring_height</code> above 0.",
       not_in_the_paper}};
  return all;
}

const Subject &subject_of(const std::string &kind) {
  for (const Subject &subject : subjects())
    if (subject.kind == kind) return subject;
  throw std::runtime_error(kind + ".csv: the page has no states of a valve '" + kind + "'");
}

Valve valve_at(const Subject &subject, double opening) {
  Valve valve(find_valve_kind(subject.kind));
  valve.set("opening", 1, &opening);
  return valve;
}

Points circle(double radius, Vec3 centre) {
  constexpr int n = 180;
  Points points;
  for (int i = 0; i <= n; ++i)
    points.push_back(centre + Vec3{radius * std::cos(2 * pi * i / n), radius * std::sin(2 * pi * i / n), 0});
  return points;
}

// Returns the edge of the disc that contains the orifice.
Points edge_of_disc(const Valve &valve, const PatchSet &set) {
  const std::string kind = valve.kind().name;
  if (kind == "mitral") return samples(mitral_curves(set).annulus);
  const auto value = [&](const std::string &name, std::size_t i = 0) {
    for (std::size_t k = 0; k < valve.kind().parameters.size(); ++k)
      if (valve.kind().parameters[k].name == name) return valve.values()[k][i];
    throw std::runtime_error("a " + kind + " valve has no " + name);
  };
  if (kind == "bileaflet") return circle(value("radius"), {0, 0, 0});
  const std::string translation = kind == "aortic" ? "right.translation" : "translation";
  return circle(value("root_radius"), {value(translation, 0), value(translation, 1), value(translation, 2)});
}

// The lines that bound the leaflets.
std::vector<Points> outlines(const std::string &kind, const PatchSet &set) {
  std::vector<Points> lines;
  if (kind == "mitral") {
    const MitralCurves curves = mitral_curves(set);
    return {samples(curves.annulus), samples(curves.anterior), samples(curves.posterior)};
  }
  if (kind == "bileaflet") {
    for (const Patch &patch : set.patches)
      for (const PatchImage &image : patch.images)
        for (const Side &side : {patch.v0, patch.v1}) lines.push_back(samples(placed(set, side, image)));
    return lines;
  }
  for (std::int32_t cusp = 0; cusp < 3; ++cusp) {
    const CuspCurves curves = cusp_curves(set, cusp);
    for (std::size_t k = 0; k < 2; ++k) {
      lines.push_back(samples(curves.leaflet[k]));
      lines.push_back(samples(curves.sinus[k]));
    }
  }
  return lines;
}

// Returns the disc, moved below everything else. Seen from above, its uncovered part is the orifice.
Faces disc_below(const Points &edge, double z) {
  Faces faces{3, {}, {}, {}};
  Vec3 middle{0, 0, z};
  for (const Vec3 &p : edge) {
    middle = middle + (1.0 / static_cast<double>(edge.size())) * Vec3{p.x, p.y, 0};
    faces.points.push_back({p.x, p.y, z});
  }
  faces.points.push_back(middle);
  const auto last = static_cast<std::int64_t>(edge.size());
  for (std::int64_t i = 0; i + 1 < last; ++i) {
    faces.corners.insert(faces.corners.end(), {i, i + 1, last});
    faces.colours.push_back(orifice_colour);
  }
  return faces;
}

struct State {
  double opening;
  Faces faces;
  std::vector<Points> outlines;
  Points disc;
};

State make_state(const Subject &subject, double opening) {
  const Valve valve = valve_at(subject, opening);
  const Model model = make_model(valve, tolerance);
  return {opening, triangles_of(model, every_leaflet), outlines(subject.kind, model.patches),
          edge_of_disc(valve, model.patches)};
}

Faces housing() {
  Valve valve(find_valve_kind("bileaflet"));
  valve.set("ring_height", 1, &housing_height);
  return triangles_of(make_model(valve, tolerance), RIIS_LEAFLET_HOUSING, {grey, grey, grey});
}

double lowest(const Points &points) {
  double z = std::numeric_limits<double>::infinity();
  for (const Vec3 &p : points) z = std::min(z, p.z);
  return z;
}

// Draws all states at the same scale.
class StatePictures {
 public:
  StatePictures(const Subject &subject, const std::vector<double> &openings) : subject_(subject) {
    for (const double opening : openings) {
      states_.push_back(make_state(subject, opening));
      append(all_, states_.back().faces.points);
      append(all_, states_.back().disc);
    }
    if (subject.kind != std::string("bileaflet")) return;
    housing_ = housing();
    append(all_, housing_.points);
  }

  void add_from_above(Figure &figure) const {
    for (const State &state : states_) {
      Picture picture = picture_of(state, top_view);
      picture.add_faces(disc_below(state.disc, lowest(all_)), Shading::painted);
      add_leaflets(picture, state);
      figure.panels.push_back({picture.png(), "Opening " + number(state.opening) + ", " + subject_.from_above + "."});
    }
  }

  void add_from_the_side(Figure &figure) const {
    for (const State &state : states_) {
      Picture picture = picture_of(state, subject_.side);
      if (housing_.size() > 0) picture.add_faces(housing_, Shading::ghost);
      add_leaflets(picture, state);
      figure.panels.push_back(
          {picture.png(), "Opening " + number(state.opening) + ", " + subject_.from_the_side + "."});
    }
  }

 private:
  Picture picture_of(const State &state, const View &view) const {
    Picture picture(size, view, all_, margin);
    picture.add_title("opening " + number(state.opening));
    picture.add_curve(state.disc, grey, 2.5);
    return picture;
  }
  static void add_leaflets(Picture &picture, const State &state) {
    picture.add_faces(state.faces, Shading::smooth);
    for (const Points &line : state.outlines) picture.add_curve(line, outline_colour, 3);
  }

  const Subject &subject_;
  std::vector<State> states_;
  Points all_;
  Faces housing_{3, {}, {}, {}};
};

std::string fixed(double value, int n_digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", n_digits, value);
  return text;
}

// Returns a table cell: the value, and its change from the closed valve.
std::string cell_of(const Measure &measure, std::size_t i) {
  std::string text = fixed(measure.values[i], 2);
  if (i == 0 || measure.shares.empty()) return text;
  const double change = 100 * (measure.shares[i] - 1);
  if (std::abs(change) < 0.05) return text + " (0 %)";
  return text + " (" + (change < 0 ? "−" : "+") + fixed(std::abs(change), 1) + " %)";
}

std::string table_of(const StateTable &table, const Subject &subject) {
  std::vector<std::vector<std::string>> rows = {{"opening"}};
  for (const double opening : table.openings) rows[0].push_back(number(opening));
  const auto add = [&](const std::string &name, const Measure &measure) {
    rows.push_back({name});
    for (std::size_t i = 0; i < table.openings.size(); ++i) rows.back().push_back(cell_of(measure, i));
  };
  for (std::size_t k = 0; k < table.edges.size(); ++k)
    add(std::string(subject.leaflets[k]) + ": free edge (cm)", table.edges[k]);
  for (std::size_t k = 0; k < table.areas.size(); ++k)
    add(std::string(subject.leaflets[k]) + ": area (cm²)", table.areas[k]);
  if (!table.orifice.values.empty()) add("orifice (cm²)", table.orifice);
  return html_table(rows);
}

std::string command_of(const StateTable &table) {
  return "<code>riis states " + table.kind + ".csv --valve " + table.kind + " --count " +
         std::to_string(table.openings.size()) + "</code>";
}

}  // namespace

void check_table(const StateTable &table) {
  const Subject &subject = subject_of(table.kind);
  for (const double opening : table.openings)
    if (!(opening >= 0 && opening <= 1))
      throw std::runtime_error(table.kind + ".csv: opening " + number(opening) + " is not from 0 to 1");
  if (table.openings.size() > most_openings)
    throw std::runtime_error(table.kind + ".csv: " + std::to_string(table.openings.size()) +
                             " openings are more than " + std::to_string(most_openings));
  if (table.areas.size() != subject.leaflets.size() || table.edges.size() > subject.leaflets.size())
    throw std::runtime_error(table.kind + ".csv: " + std::to_string(table.areas.size()) +
                             " leaflets have an area, not " + std::to_string(subject.leaflets.size()));
}

Figure states_figure(const StateTable &table) {
  const Subject &subject = subject_of(table.kind);
  const int columns = static_cast<int>(table.openings.size());
  Figure figure{subject.title, {}, columns, {}, {}, subject.paper, table_of(table, subject)};
  const StatePictures pictures(subject, table.openings);
  pictures.add_from_above(figure);
  pictures.add_from_the_side(figure);
  for (std::size_t k = 0; k < subject.leaflets.size(); ++k)
    figure.key.push_back({leaflet_colours[k], subject.leaflets[k]});
  figure.key.push_back({orifice_colour, "orifice, seen from above"});
  // The annulus is drawn dark, like the leaflets' other edges.
  if (table.kind != "mitral") figure.key.push_back({grey, "edge of " + std::string(subject.disc)});
  const bool has_edges = !table.edges.empty();
  figure.caption =
      std::string(subject.caption) + " Parameters: the defaults; tolerance " + percent(tolerance) + ". The table has " +
      (has_edges ? "the length of each free edge, " : "") +
      "the area of each leaflet and, in brackets, the change since opening " + number(table.openings.front()) +
      (has_edges ? "" : ", which is none, as the leaflets are rigid") + ". The orifice is the part of " + subject.disc +
      " that the leaflets leave uncovered along the axis. This command writes these numbers: " + command_of(table) +
      ".";
  return figure;
}

std::string how_to_show_states(const std::string &kind) {
  return "The states of the " + kind + " valve: <code>riis states " + kind + ".csv --valve " + kind +
         " --count 5</code>, then give riis-figures the file.";
}

}  // namespace riis::figures
