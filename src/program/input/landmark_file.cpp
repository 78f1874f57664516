// SPDX-License-Identifier: Apache-2.0
#include "program/input/placing.hpp"

#include <riis/riis.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "program/base/text.hpp"

namespace riis::program {
namespace {

// The words for the leaflets of valves with three cusps, of the tricuspid valve, and of valves with any number of cusps. In the
// list, non_coronary stands before non, because the first fitting word counts.
struct LeafletWord {
  const char *word;
  std::int32_t leaflet_id;
};
constexpr LeafletWord leaflet_words[] = {{"right", 0},    {"left", 1},   {"non_coronary", 2}, {"non", 2},
                                         {"anterior", 0}, {"septal", 1}, {"posterior", 2},    {"cusp_0", 0},
                                         {"cusp_1", 1},   {"cusp_2", 2}, {"cusp_3", 3}};

// The words for the roles of landmarks. Some words may name several landmarks, because a valve has several landmarks of one role.
struct RoleWord {
  const char *word;
  std::int32_t role;
  bool is_repeated;
};
const std::vector<RoleWord> role_words = {{"commissure", RIIS_LANDMARK_COMMISSURE, true},
                                          {"nadir", RIIS_LANDMARK_NADIR, true},
                                          {"coaptation", RIIS_LANDMARK_COAPTATION, false},
                                          {"annulus", RIIS_LANDMARK_ANNULUS, true},
                                          {"anterior_horn", RIIS_LANDMARK_ANTERIOR_HORN, false},
                                          {"posterior_horn", RIIS_LANDMARK_POSTERIOR_HORN, false},
                                          {"trigone", RIIS_LANDMARK_TRIGONE, true},
                                          {"posteromedial_commissure", RIIS_LANDMARK_POSTEROMEDIAL, false},
                                          {"anterolateral_commissure", RIIS_LANDMARK_ANTEROLATERAL, false},
                                          {"hinge", RIIS_LANDMARK_HINGE, true},
                                          {"attachment", RIIS_LANDMARK_ATTACHMENT, true}};
const char *const flow_from = "flow_from", *const flow_to = "flow_to";

struct Place {
  std::int32_t role;
  std::array<std::int32_t, 2> leaflet_ids;
  bool may_repeat;  // whether other landmarks may have the same name
};

// Returns the name in small letters. Blanks and hyphens become _.
std::string plain(const std::string &name) {
  std::string made;
  for (const char c : trimmed(name))
    made += c == ' ' || c == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return made;
}

bool is_number(const std::string &text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

// Removes a leaflet's name from the beginning of the text. Returns the id of the leaflet, or -1 if the text does not begin with a
// leaflet's name.
std::int32_t take_leaflet(std::string &text) {
  for (const auto &[name, leaflet_id] : leaflet_words) {
    const std::string word = name;
    if (text.rfind(word, 0) != 0 || (text.size() > word.size() && text[word.size()] != '_')) continue;
    text.erase(0, std::min(text.size(), word.size() + 1));
    return leaflet_id;
  }
  return -1;
}

// Reads the name of a landmark, which begins with the word of a role. After the word, there may be a number, the leaflet of a
// nadir, or the two leaflets of a commissure. After the word attachment, a leaflet and a number may follow.
std::optional<Place> place_of_name(const std::string &name) {
  const std::string text = plain(name);
  for (const RoleWord &known : role_words) {
    const std::string word = known.word;
    if (text == word) return Place{known.role, {-1, -1}, known.is_repeated};
    if (text.rfind(word + "_", 0) != 0) continue;
    std::string rest = text.substr(word.size() + 1);
    if (is_number(rest)) {
      if (known.is_repeated) return Place{known.role, {-1, -1}, false};
      continue;
    }
    const std::int32_t first = take_leaflet(rest);
    if (known.role == RIIS_LANDMARK_ATTACHMENT) {
      if (first >= 0 && (rest.empty() || is_number(rest))) return Place{known.role, {first, -1}, rest.empty()};
      continue;
    }
    const std::int32_t second = first >= 0 ? take_leaflet(rest) : -1;
    if (first < 0 || !rest.empty()) continue;
    if (known.role == RIIS_LANDMARK_NADIR && second < 0) return Place{known.role, {first, -1}, false};
    if (known.role == RIIS_LANDMARK_COMMISSURE && second >= 0 && first != second)
      return Place{known.role, {first, second}, false};
  }
  return std::nullopt;
}

bool is_landmark(const std::string &name) {
  return place_of_name(name) || plain(name) == flow_from || plain(name) == flow_to;
}

// The words for leaflets in messages. The position of a word is the leaflet's id.
const char *const cusp_words_of_three[] = {"right", "left", "non_coronary"};

std::string cusp_word(std::size_t n_cusps, std::size_t cusp) {
  return n_cusps == 3 ? cusp_words_of_three[cusp] : "cusp_" + std::to_string(cusp);
}

std::size_t n_cusps_of(const std::string &kind) {
  if (kind == "coapting" || kind == "trileaflet" || kind == "aortic") return 3;
  return kind == "bicuspid" ? 2 : kind == "quadricuspid" ? 4 : 0;
}

// Returns the names of the nadirs and the commissures of a valve with cusps. Other kinds of valves have none.
std::vector<std::string> names_of_cusps(const std::string &kind) {
  const std::size_t n = n_cusps_of(kind);
  std::vector<std::string> names;
  // Both commissures of a bicuspid valve join the same two cusps, so numbers must distinguish them.
  if (n == 2) return {"nadir_cusp_0", "nadir_cusp_1", "commissure_1", "commissure_2"};
  for (std::size_t cusp = 0; cusp < n; ++cusp) names.push_back("nadir_" + cusp_word(n, cusp));
  for (std::size_t cusp = 0; cusp < n; ++cusp)
    names.push_back("commissure_" + cusp_word(n, cusp) + "_" + cusp_word(n, (cusp + 1) % n));
  return names;
}

class Collector {
 public:
  explicit Collector(LandmarkFile &file) : file_(file) {}

  void add(const std::string &name, const std::array<double, 3> &point) {
    for (std::size_t k = 0; k < 3; ++k)
      if (!std::isfinite(point[k]))
        refuse_file(file_.path, quoted(name) + ": " + "xyz"[k] + " is " + shortest(point[k]) + "; it must be finite");
    const std::string text = plain(name);
    if (text == flow_from || text == flow_to) {
      if (!ends_.emplace(text, point).second) refuse_file(file_.path, quoted(name) + " is given twice");
      return;
    }
    const std::optional<Place> place = place_of_name(name);
    if (!place) refuse_name(name);
    const auto key = std::pair(place->role, std::minmax(place->leaflet_ids[0], place->leaflet_ids[1]));
    const bool names_leaflet = place->leaflet_ids[0] >= 0 && place->role != RIIS_LANDMARK_ATTACHMENT;
    const bool is_new = names_leaflet ? leaflets_.insert({key.first, {key.second.first, key.second.second}}).second
                                      : names_.insert(text).second;
    if (!is_new && !place->may_repeat)
      refuse_file(file_.path, quoted(name) + " is given twice" +
                                  (text == "commissure_cusp_0_cusp_1" || text == "commissure_cusp_1_cusp_0"
                                       ? "; the commissures of a bicuspid valve are commissure_1 and commissure_2"
                                       : ""));
    file_.names.push_back(name);
    file_.roles.push_back(place->role);
    file_.leaflet_ids.insert(file_.leaflet_ids.end(), place->leaflet_ids.begin(), place->leaflet_ids.end());
    file_.xyz.insert(file_.xyz.end(), point.begin(), point.end());
  }

  // Checks the landmarks as a whole. Takes the direction of flow from the two points flow_from and flow_to.
  void finish() {
    if (file_.names.empty()) refuse_file(file_.path, "holds no landmarks");
    if (ends_.empty()) return;
    if (ends_.size() == 1)
      refuse_file(file_.path, ends_.begin()->first + " is given without " +
                                  (ends_.begin()->first == flow_from ? flow_to : flow_from));
    if (file_.flow) refuse_file(file_.path, "the file gives the flow twice: by flow, and by flow_from and flow_to");
    const auto &from = ends_.at(flow_from), &to = ends_.at(flow_to);
    file_.flow = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
    file_.flow_ends = {from[0], from[1], from[2], to[0], to[1], to[2]};
  }

 private:
  [[noreturn]] void refuse_name(const std::string &name) const {
    std::vector<std::string> names;
    for (const RoleWord &word : role_words) names.emplace_back(word.word);
    names.insert(names.end(), {"nadir_right", "nadir_left", "nadir_non_coronary"});
    const std::string kind = file_.wanted.empty() ? file_.valve : file_.wanted;
    const std::string aortic = joined_by(names_of_cusps("coapting"), ", ");
    const std::string mitral = "annulus_1, annulus_2, ... in their order around the annulus, and anterior_horn";
    std::string expected = "; an aortic valve has " + aortic + "; a mitral valve has other names";
    if (const std::vector<std::string> own = names_of_cusps(kind); !own.empty())
      expected = "; the " + kind + " valve has " + joined_by(own, ", ");
    else if (is_mitral_kind(kind))
      expected = "; the " + kind + " valve has " + mitral;
    refuse_file(file_.path, quoted(name) + " is not the name of a landmark" +
                                did_you_mean(plain(name), names, "\"", "\"") + expected +
                                "; riis help landmarks lists all names");
  }

  LandmarkFile &file_;
  std::map<std::string, std::array<double, 3>> ends_;
  std::set<std::string> names_;
  std::set<std::pair<std::int32_t, std::pair<std::int32_t, std::int32_t>>> leaflets_;
};

// Returns the coordinates in three cells of a row.
std::array<double, 3> point_in_row(const std::string &path, const CsvFile::Row &row,
                                   const std::array<std::size_t, 3> &cells) {
  std::array<double, 3> point{};
  for (std::size_t k = 0; k < 3; ++k) point[k] = number_in_file(path, row.cells[cells[k]], row.where);
  return point;
}

// ---- What a file states ----

constexpr const char *why_axes =
    "; mesh stands for the axes of the mesh or of the wall, and LPS and RAS differ by half a turn about z";

Unit stated_unit(const std::string &path, const std::string &text) {
  if (const auto unit = unit_of(text)) return *unit;
  refuse_file(path, "the unit is " + quoted(text) + "; it must be " + one_of(unit_names()));
}

Axes stated_axes(const std::string &path, const std::string &text) {
  for (std::size_t i = 0; i < axes_names().size(); ++i)
    if (text == axes_names()[i]) return static_cast<Axes>(i);
  refuse_file(path, "the axes are " + quoted(text) + "; they must be " + one_of(axes_names()) + why_axes);
}

std::array<double, 3> point_of(const std::string &path, const std::string &name, const Json &value) {
  const auto point = point_in(value);
  if (!point) refuse_file(path, name + " must be three numbers, not " + value.dump());
  return *point;
}

// ---- JSON ----

void read_json(const Json &root, LandmarkFile &file) {
  const CaseValues values(file.path, "", root, {"valve", "unit", "axes", "noise", "flow", "parameters", "landmarks"},
                          "the file");
  file.valve = values.text("valve");
  const std::string no_axes = "missing; they must be " + one_of(axes_names()) + why_axes;
  if (!values.has("unit"))
    values.refuse("unit", "it is missing; it must be " + one_of(unit_names()) +
                              (values.has("axes") ? "" : "; and the axes are " + no_axes));
  file.unit = stated_unit(file.path, values.text("unit"));
  if (!values.has("axes")) values.refuse("axes", "they are " + no_axes);
  file.axes = stated_axes(file.path, values.text("axes"));
  file.noise = values.at_least_zero("noise");
  if (values.has("flow")) file.flow = point_of(file.path, "flow", values.needed("flow"));
  if (values.has("parameters")) file.parameters = values.needed("parameters");
  const Json &list = values.needed("landmarks");
  if (!list.is_object())
    values.refuse("landmarks", std::string("it must be an object of points by name, not of type ") + list.type_name());
  Collector to(file);
  for (const auto &[name, value] : list.items()) {
    const bool is_list = value.is_array() && !value.empty() && value[0].is_array();
    if (!is_list) {
      to.add(name, point_of(file.path, quoted(name), value));
      continue;
    }
    // If several landmarks may share a name, each point of the list gets the name and a number. If only one landmark may have the
    // name, the list must have one point.
    const std::optional<Place> place = place_of_name(name);
    for (std::size_t i = 0; i < value.size(); ++i) {
      const std::string own = place && place->may_repeat ? name + "_" + std::to_string(i + 1) : name;
      to.add(own, point_of(file.path, quoted(own), value[i]));
    }
  }
  to.finish();
}

// ---- 3D Slicer ----

// Returns the unit of a list of points. In 3D Slicer's schema, the unit is a text, or an array whose first entry is the text. The
// default is mm.
Unit slicer_unit(const std::string &path, const Json &list, const std::string &where) {
  const auto found = list.find("coordinateUnits");
  if (found == list.end()) return Unit::millimetre;
  const Json &unit = found->is_array() && !found->empty() ? (*found)[0] : *found;
  if (!unit.is_string()) refuse_file(path, where + ": coordinateUnits is " + found->dump() + "; it must be a text");
  return stated_unit(path, unit.get<std::string>());
}

// A file of 3D Slicer has many keys, which differ between the versions of 3D Slicer. Only the keys that are needed are read.
void read_slicer(const Json &root, LandmarkFile &file) {
  const std::string &path = file.path;
  const Json &lists = root["markups"];
  if (!lists.is_array() || lists.empty()) refuse_file(path, "markups must be an array of at least one list of points");
  const auto text_in = [&](const Json &object, const char *key, const std::string &where) {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_string()) refuse_file(path, where + " has no text " + quoted(key));
    return found->get<std::string>();
  };
  Collector to(file);
  std::size_t n_annulus = 0, annulus_list = 0;
  bool is_whole = false;  // whether a closed curve has given the annulus
  for (std::size_t i = 0; i < lists.size(); ++i) {
    const std::string where = "markups " + std::to_string(i);
    const Json &list = lists[i];
    if (!list.is_object()) refuse_file(path, where + " must be an object, not of type " + list.type_name());
    const std::string system = text_in(list, "coordinateSystem", where);
    if (system != "LPS" && system != "RAS")
      refuse_file(path, where + ": coordinateSystem is " + quoted(system) + "; it must be LPS or RAS");
    const Axes axes = stated_axes(path, system);
    const Unit unit = slicer_unit(path, list, where);
    if (i > 0 && (axes != file.axes || unit != file.unit))
      refuse_file(path,
                  where + " has other axes or another unit than markups 0: save both with the same axes and unit");
    file.axes = axes;
    file.unit = unit;
    const bool is_closed_curve = list.contains("type") && list["type"] == "ClosedCurve";
    const bool is_curve = list.contains("type") && list["type"] == "Curve";
    const auto points = list.find("controlPoints");
    if (points == list.end() || !points->is_array()) refuse_file(path, where + " has no array \"controlPoints\"");
    const std::size_t n_annulus_before = n_annulus;
    for (std::size_t k = 0; k < points->size(); ++k) {
      const Json &point = (*points)[k];
      const std::string at = where + ", control point " + std::to_string(k);
      if (!point.is_object()) refuse_file(path, at + " must be an object, not of type " + point.type_name());
      // A closed curve is an annulus, whatever the names of its points are. An open curve is also an annulus if its points do not
      // have the names of landmarks.
      const std::string given = is_closed_curve ? "" : text_in(point, "label", at);
      const bool is_annulus = is_closed_curve || (is_curve && !is_landmark(given));
      const std::string label = is_annulus ? "annulus_" + std::to_string(++n_annulus) : given;
      const auto status = point.find("positionStatus"), position = point.find("position");
      if (status != point.end() && *status != "defined")
        refuse_file(path,
                    quoted(label) + " has the positionStatus " + status->dump() + "; place the point or delete it");
      if (position == point.end()) refuse_file(path, quoted(label) + " has no position");
      to.add(label, point_of(path, quoted(label), *position));
    }
    if (n_annulus == n_annulus_before) continue;
    // Two open curves may be two parts of an annulus. A closed curve is a whole annulus.
    if (n_annulus_before > 0 && (is_closed_curve || is_whole))
      refuse_file(path, where + " is a second curve of an annulus, after markups " + std::to_string(annulus_list) +
                            ": save the curves of one valve only");
    is_whole = is_closed_curve;
    annulus_list = i;
  }
  to.finish();
}

Axes fcsv_axes(const std::string &path, const std::string &value) {
  if (value.empty())
    refuse_file(path, "states no axes: a line # CoordinateSystem = LPS is missing" + std::string(why_axes));
  if (value == "LPS" || value == "1") return Axes::LPS;
  if (value == "RAS" || value == "0") return Axes::RAS;
  refuse_file(path, "CoordinateSystem is " + quoted(value) + "; it must be LPS or 1, or RAS or 0");
}

// Reads an .fcsv file, which earlier versions of 3D Slicer wrote. Its lengths are in mm. An .fcsv file gives its axes as a name
// or as a number.
void read_fcsv(const std::string &text, LandmarkFile &file) {
  const std::string &path = file.path;
  std::vector<std::string> columns;
  std::string system;
  std::vector<CsvFile::Row> rows;
  for (const CsvLine &line : csv_lines(text)) {
    if (!line.fact)
      rows.push_back({line.where, csv_cells(line.row)});
    else if (line.fact->first == "columns")
      columns = csv_cells(line.fact->second);
    else if (line.fact->first == "CoordinateSystem")
      system = line.fact->second;
  }
  if (columns.empty()) {
    // Versions 4 and 5 write the label as the twelfth of 14 cells. Version 3 writes the label as the first cell.
    const bool is_version_3 = rows.empty() || rows.front().cells.size() < 12;
    columns = is_version_3 ? std::vector<std::string>{"label", "x", "y", "z"}
                           : split("id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label", ",");
  }
  file.axes = fcsv_axes(path, system);
  file.unit = Unit::millimetre;
  const auto column = [&](const char *name) {
    const auto found = std::find(columns.begin(), columns.end(), name);
    if (found == columns.end()) refuse_file(path, std::string("the line # columns names no column ") + name);
    return static_cast<std::size_t>(found - columns.begin());
  };
  const std::size_t label = column("label");
  const std::array<std::size_t, 3> xyz = {column("x"), column("y"), column("z")};
  const std::size_t last = std::max({label, xyz[0], xyz[1], xyz[2]});
  // After the 14 named cells, version 5 adds the status of the point, which is 2 for a placed point.
  constexpr std::size_t n_named = 14;
  Collector to(file);
  for (const CsvFile::Row &row : rows) {
    if (row.cells.size() <= last)
      refuse_file(path, row.where + " has " + std::to_string(row.cells.size()) + " of the " +
                            std::to_string(columns.size()) + " columns");
    if (label == 11 && row.cells.size() > n_named && row.cells[n_named] != "2")
      refuse_file(path, row.where + ": " + quoted(row.cells[label]) + " is not placed, because its status is " +
                            quoted(row.cells[n_named]) + "; place the point or delete it");
    to.add(row.cells[label], point_in_row(path, row, xyz));
  }
  to.finish();
}

// ---- CSV ----

// Reads a table of control points that 3D Slicer exported. The names of the columns show the axes, and lengths are in mm. Returns
// false for another file.
bool read_slicer_table(const std::string &text, LandmarkFile &file) {
  const std::string &path = file.path;
  std::vector<CsvFile::Row> rows;
  for (const CsvLine &line : csv_lines(text))
    if (!line.fact) rows.push_back({line.where, csv_cells(line.row)});
  const std::vector<std::string> columns = rows.empty() ? std::vector<std::string>{} : rows.front().cells;
  const std::string heading = joined_by(columns, ",");
  const bool is_ras = heading.rfind("label,r,a,s", 0) == 0;
  if (!is_ras && heading.rfind("label,l,p,s", 0) != 0) return false;
  file.axes = is_ras ? Axes::RAS : Axes::LPS;
  file.unit = Unit::millimetre;
  const auto defined = static_cast<std::size_t>(std::find(columns.begin(), columns.end(), "defined") - columns.begin());
  Collector to(file);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const CsvFile::Row &row = rows[i];
    if (row.cells.size() < 4) refuse_file(path, row.where + " has fewer than the 4 cells " + heading.substr(0, 11));
    if (defined < row.cells.size() && row.cells[defined] != "1")
      refuse_file(path, row.where + ": " + quoted(row.cells[0]) + " is not placed, because defined is " +
                            quoted(row.cells[defined]) + "; place the point or delete it");
    to.add(row.cells[0], point_in_row(path, row, {1, 2, 3}));
  }
  to.finish();
  return true;
}

void read_csv(const std::string &text, LandmarkFile &file) {
  const std::string &path = file.path;
  if (read_slicer_table(text, file)) return;
  const CsvFile csv = csv_of_text(path, text, {"unit", "axes", "valve", "noise", "flow"}, "NAME,X,Y,Z", 4);
  const std::map<std::string, std::string> &stated = csv.stated;
  Collector to(file);
  for (const CsvFile::Row &row : csv.rows) {
    const bool is_heading = &row == &csv.rows.front() && plain(row.cells[1]) == "x" && plain(row.cells[2]) == "y" &&
                            plain(row.cells[3]) == "z";
    if (is_heading) continue;
    to.add(row.cells[0], point_in_row(path, row, {1, 2, 3}));
  }
  const auto value_of = [&](const char *key) { return stated.count(key) ? stated.at(key) : std::string(); };
  std::vector<std::string> missing;
  if (!stated.count("unit"))
    missing.push_back("states no unit: a line such as # unit = mm is missing; it must be " + one_of(unit_names()));
  if (!stated.count("axes"))
    missing.push_back("states no axes: a line such as # axes = LPS is missing; they must be " + one_of(axes_names()) +
                      why_axes);
  if (!missing.empty()) refuse_file(path, joined_by(missing, "; and "));
  file.unit = stated_unit(path, value_of("unit"));
  file.axes = stated_axes(path, value_of("axes"));
  file.valve = value_of("valve");
  if (stated.count("noise")) {
    file.noise = number_in_file(path, value_of("noise"), "noise");
    if (!(*file.noise >= 0)) refuse_file(path, "noise: " + value_of("noise") + " is below 0");
  }
  if (stated.count("flow")) {
    const CsvFile::Row flow{"flow", csv_cells(value_of("flow"))};
    if (flow.cells.size() != 3) refuse_file(path, "flow: " + quoted(value_of("flow")) + " is not X,Y,Z");
    file.flow = point_in_row(path, flow, {0, 1, 2});
  }
  to.finish();
}

}  // namespace

const std::vector<std::string> &axes_names() {
  static const std::vector<std::string> names = {"LPS", "RAS", "mesh"};
  return names;
}
const char *name_of(Axes axes) { return axes_names()[static_cast<std::size_t>(axes)].c_str(); }

void LandmarkFile::convert(Unit to) {
  const double factor = factor_between(unit, to);
  for (std::vector<double> *const points : {&xyz, &flow_ends})
    for (double &x : *points) x *= factor;
  if (noise) *noise *= factor;
  unit = to;
}

void LandmarkFile::convert(Axes to) {
  const bool is_turned = axes != to && axes != Axes::mesh && to != Axes::mesh;
  axes = to;
  if (!is_turned) return;
  for (std::vector<double> *const points : {&xyz, &flow_ends})
    for (std::size_t i = 0; i < points->size(); ++i)
      if (i % 3 != 2) (*points)[i] = -(*points)[i];
  if (flow) flow = {-(*flow)[0], -(*flow)[1], (*flow)[2]};
}

void check_names_of_cusps(const LandmarkFile &landmarks, const std::string &kind) {
  const auto n_cusps = static_cast<std::int32_t>(n_cusps_of(kind));
  const std::string points = " valve has the points " + joined_by(names_of_cusps(kind), ", ");
  for (std::size_t i = 0; i < landmarks.roles.size() && n_cusps > 0; ++i)
    if (std::max(landmarks.leaflet_ids[2 * i], landmarks.leaflet_ids[2 * i + 1]) >= n_cusps)
      refuse_file(landmarks.path,
                  quoted(landmarks.names[i]) + " names a cusp that a " + kind + " valve lacks: a " + kind + points);
  for (const RoleWord &word : role_words) {
    const auto n = std::count(landmarks.roles.begin(), landmarks.roles.end(), word.role);
    const bool is_of_cusp = word.role == RIIS_LANDMARK_NADIR || word.role == RIIS_LANDMARK_COMMISSURE;
    if (n_cusps > 0 && is_of_cusp && n > n_cusps)
      refuse_file(landmarks.path, "has " + std::to_string(n) + " " + word.word + "s, which are " +
                                      std::to_string(n - n_cusps) + " too many: a " + kind + points);
  }
  std::set<std::array<std::int32_t, 3>> given;
  std::size_t n_without = 0;
  for (std::size_t i = 0; i < landmarks.roles.size(); ++i) {
    const std::int32_t role = landmarks.roles[i];
    if (role != RIIS_LANDMARK_NADIR && role != RIIS_LANDMARK_COMMISSURE) continue;
    const auto [a, b] = std::minmax(landmarks.leaflet_ids[2 * i], landmarks.leaflet_ids[2 * i + 1]);
    if (b < 0 || (role == RIIS_LANDMARK_COMMISSURE && a < 0))
      ++n_without;
    else
      given.insert({role, a, b});
  }
  // A landmark that names no leaflet may be any of the missing landmarks.
  if (n_without > 0 || given.empty()) return;
  std::vector<std::string> missing;
  for (const std::string &name : names_of_cusps(kind)) {
    const std::optional<Place> place = place_of_name(name);
    const auto [a, b] = std::minmax(place->leaflet_ids[0], place->leaflet_ids[1]);
    if (b >= 0 && given.count({place->role, a, b}) == 0) missing.push_back(name);
  }
  if (missing.empty()) return;
  refuse_file(landmarks.path, "lacks " + joined_by(missing, ", ") + ", which the " + kind + " valve needs: add " +
                                  (missing.size() == 1 ? "this point" : "these points"));
}

bool is_mitral_kind(const std::string &kind) { return kind == "mitral" || kind == "mitral_coapting"; }

std::string landmark_ending(const std::string &path) {
  const std::string slicer = ".mrk.json";
  const bool is_slicer =
      path.size() > slicer.size() && path.compare(path.size() - slicer.size(), slicer.size(), slicer) == 0;
  return is_slicer ? slicer : ending_of(path);
}

LandmarkFile read_landmarks(const std::string &path, const std::string &text, const std::string &kind) {
  LandmarkFile file;
  file.path = path;
  file.wanted = kind;
  if (has_ending(path, ".csv")) {
    read_csv(text, file);
    return file;
  }
  if (has_ending(path, ".fcsv")) {
    read_fcsv(text, file);
    return file;
  }
  if (!has_ending(path, ".json")) refuse_file(path, "landmarks must be a .json, .mrk.json, .fcsv or .csv file");
  const Json root = parse_json(path, text, "landmarks");
  if (root.is_object() && root.contains("markups"))
    read_slicer(root, file);
  else
    read_json(root, file);
  return file;
}

LandmarkFile landmarks_of_json(const std::string &subject, const Json &root) {
  LandmarkFile file;
  file.path = subject;
  file.is_file = false;
  read_json(root, file);
  return file;
}

}  // namespace riis::program
