// SPDX-License-Identifier: Apache-2.0
#include "program/patient/patient_mesh.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "common/array_view.hpp"
#include "common/number_from_chars.hpp"
#include "common/vectors.hpp"
#include "program/base/handles.hpp"
#include "program/base/other_program.hpp"
#include "program/base/progress.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/output/outputs.hpp"
#include "program/output/report.hpp"

namespace riis::program {
namespace {

namespace fs = std::filesystem;

// The area of an end may change by at most this share, because the rim of the new surface has longer edges.
constexpr double most_area_change = 0.05;
// The edge length in the middle of an end, as a share of the end's radius. The rim of an end then has at least sixteen edges.
constexpr double end_edge_share = 0.35;
// The time in seconds that gmsh has: a fixed time, and an additional time for each triangle. If gmsh cannot remesh a surface, it
// may run for hours.
constexpr double least_seconds = 120, seconds_per_triangle = 0.01;
// If gmsh may have to run twice, the first run gets this share of the time.
constexpr double first_share = 0.25;
// In the second try, nodes are moved by at most this share of the wall's size. The movement is as small as the rounding errors of
// files in single precision.
constexpr double moved_share = 1e-7;
// An overlap of triangles counts as a self-intersection if it is longer than this share of the wall's size.
constexpr double least_crossing_share = 1e-5;
// The number of triangles of each new patch that are compared with the wall.
constexpr std::size_t n_compared = 9;

// The elements of a gmsh file, with the numbers of their surfaces or volumes. Nodes are counted from 0.
struct GmshMesh {
  std::vector<Vector3> points;
  std::vector<std::pair<std::int64_t, Corners>> triangles;
  std::vector<std::array<std::int64_t, 4>> cells;
};

// Reads a file that gmsh wrote in its ASCII format 2.2. Refuses an incomplete file.
class GmshReader {
 public:
  explicit GmshReader(const std::string &path) : path_(path), text_(text_of_file(path)), next_(text_.data()) {}

  GmshMesh read() {
    GmshMesh mesh;
    std::map<std::int64_t, std::int64_t> place;
    find("$Nodes");
    for (std::int64_t n = number<std::int64_t>(); n > 0; --n) {
      const auto id = number<std::int64_t>();
      place[id] = static_cast<std::int64_t>(mesh.points.size());
      Vector3 point;
      for (double &x : point) x = number<double>();
      mesh.points.push_back(point);
    }
    find("$Elements");
    const auto node = [&] {
      const auto found = place.find(number<std::int64_t>());
      if (found == place.end()) refuse_file(path_, "an element has a node that the file lacks");
      return found->second;
    };
    constexpr std::int64_t line = 1, triangle = 2, tetrahedron = 4, point = 15;
    for (std::int64_t n = number<std::int64_t>(); n > 0; --n) {
      number<std::int64_t>();
      const auto type = number<std::int64_t>(), n_tags = number<std::int64_t>();
      std::int64_t surface = 0;
      for (std::int64_t k = 0; k < n_tags; ++k) {
        const auto tag = number<std::int64_t>();
        if (k == 1) surface = tag;
      }
      std::array<std::int64_t, 4> corner{};
      const std::int64_t n_corners = type == point         ? 1
                                     : type == line        ? 2
                                     : type == triangle    ? 3
                                     : type == tetrahedron ? 4
                                                           : 0;
      if (n_corners == 0) refuse_file(path_, "element type " + std::to_string(type) + " is not expected");
      for (std::int64_t k = 0; k < n_corners; ++k) view(corner)[k] = node();
      if (type == triangle) mesh.triangles.push_back({surface, {corner[0], corner[1], corner[2]}});
      if (type == tetrahedron) mesh.cells.push_back(corner);
    }
    find("$EndElements");
    return mesh;
  }

 private:
  void find(const char *section) {
    const std::size_t at = text_.find(std::string("\n") + section, static_cast<std::size_t>(next_ - text_.data()));
    if (at == std::string::npos)
      refuse_file(path_, std::string("the file lacks ") + section + ", so the file is incomplete");
    next_ = text_.data() + text_.find('\n', at + 1);
    if (at + 1 + std::string(section).size() >= text_.size()) next_ = text_.data() + text_.size();
  }

  template <class Number>
  Number number() {
    const char *const end = text_.data() + text_.size();
    while (next_ < end && (*next_ == ' ' || *next_ == '\n' || *next_ == '\r')) ++next_;
    Number value{};
    const auto [after, error] = number_from_chars(next_, end, value);
    if (error != std::errc()) refuse_file(path_, "a number is missing, so the file is incomplete");
    next_ = after;
    return value;
  }

  const std::string &path_;
  const std::string text_;
  const char *next_;
};

// Writes a mesh in gmsh's format 2.2. Each element has a physical group, and belongs to the surface or volume of the same number.
class GmshText {
 public:
  explicit GmshText(const std::vector<Vector3> &points) {
    text_ = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    nodes_ = "$Nodes\n" + std::to_string(points.size()) + "\n";
    for (std::size_t i = 0; i < points.size(); ++i)
      nodes_ += std::to_string(i + 1) + " " + numbers_text(points[i].data(), 3, " ") + "\n";
    nodes_ += "$EndNodes\n";
  }
  void name(int dimension, std::int64_t group, const std::string &name) {
    names_ += std::to_string(dimension) + " " + std::to_string(group) + " " + quoted(name) + "\n";
    ++n_names_;
  }
  // For an element that belongs to no group, `physical` is 0.
  template <class Ids>
  void add(int type, std::int64_t physical, std::int64_t group, const Ids &ids) {
    elements_ += std::to_string(++n_elements_) + " " + std::to_string(type) + " 2 " + std::to_string(physical) + " " +
                 std::to_string(group);
    for (const std::int64_t id : ids) elements_ += " " + std::to_string(id + 1);
    elements_ += "\n";
  }
  std::string text() const {
    std::string text = text_;
    if (n_names_ > 0) text += "$PhysicalNames\n" + std::to_string(n_names_) + "\n" + names_ + "$EndPhysicalNames\n";
    return text + nodes_ + "$Elements\n" + std::to_string(n_elements_) + "\n" + elements_ + "$EndElements\n";
  }

 private:
  std::string text_, names_, nodes_, elements_;
  std::int64_t n_names_ = 0, n_elements_ = 0;
};
constexpr int gmsh_line = 1, gmsh_triangle = 2, gmsh_tetrahedron = 4;

std::string vtk_array(const std::string &type, const std::string &name, const std::string &numbers,
                      int n_components = 1) {
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" + std::to_string(n_components) +
         "\" format=\"ascii\">\n" + numbers + "</DataArray>\n";
}

std::string id_lines(const std::vector<std::int64_t> &numbers) {
  std::string text;
  for (const std::int64_t number : numbers) text += std::to_string(number) + "\n";
  return text;
}

// Returns a VTK file with the arrays that meshes of SimVascular have. Ids count from 1.
template <class Cell>
std::string vtk_file_text(const std::vector<Vector3> &points, const std::vector<std::int64_t> &node_ids,
                          const std::vector<Cell> &cells, const std::vector<std::int64_t> &element_ids,
                          const std::string &group_array, std::int64_t group) {
  const bool is_volume = std::tuple_size_v<Cell> == 4;
  const std::string kind = is_volume ? "UnstructuredGrid" : "PolyData", part = is_volume ? "Cells" : "Polys";
  std::string places, connectivity, offsets, types, groups;
  for (const Vector3 &point : points) places += numbers_text(point.data(), 3, " ") + "\n";
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (std::size_t k = 0; k < cells[i].size(); ++k)
      connectivity += std::to_string(cells[i][k]) + (k + 1 < cells[i].size() ? " " : "\n");
    offsets += std::to_string((i + 1) * cells[i].size()) + "\n";
    types += "10\n";  // VTK_TETRA
    groups += std::to_string(group) + "\n";
  }
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + kind + "\" version=\"0.1\" byte_order=\"LittleEndian\">\n<" +
         kind + ">\n<Piece NumberOfPoints=\"" + std::to_string(points.size()) + "\" NumberOf" +
         (is_volume ? "Cells" : "Polys") + "=\"" + std::to_string(cells.size()) + "\">\n<PointData>\n" +
         vtk_array("Int32", "GlobalNodeID", id_lines(node_ids)) + "</PointData>\n<CellData>\n" +
         vtk_array("Int32", "GlobalElementID", id_lines(element_ids)) + vtk_array("Int32", group_array, groups) +
         "</CellData>\n<Points>\n" + vtk_array("Float64", "Points", places, 3) + "</Points>\n<" + part + ">\n" +
         vtk_array("Int64", "connectivity", connectivity) + vtk_array("Int64", "offsets", offsets) +
         (is_volume ? vtk_array("UInt8", "types", types) : "") + "</" + part + ">\n</Piece>\n</" + kind +
         ">\n</VTKFile>\n";
}

// Returns the last error in gmsh's log, or "" if there is none. The frame that gmsh draws around its summary is left out.
std::string last_error_in(const std::string &log) {
  std::string last;
  for (const std::string &line : split(log, "\n")) {
    const std::string head = "Error";
    if (line.rfind(head, 0) != 0) continue;
    const std::size_t at = line.find(':');
    const std::string text = at == std::string::npos ? "" : trimmed(line.substr(at + 1));
    const bool is_summary = text.empty() || text[0] == '-' || text == "Mesh generation error summary" ||
                            text == "Check the full log for details" ||
                            std::isdigit(static_cast<unsigned char>(text[0])) != 0;
    if (!is_summary) last = text;
  }
  return last;
}

// The names and the physical groups of the boundaries: the inlet, the outlets and the wall.
struct BoundaryGroup {
  std::string name;
  std::int32_t end;  // the position of the end, or -1 for the wall
};

std::vector<BoundaryGroup> boundary_groups(const PatientWall &wall) {
  std::vector<BoundaryGroup> groups;
  for (std::size_t i = 0; i < wall.ends.size(); ++i)
    groups.push_back({wall.ends[i].name, static_cast<std::int32_t>(i)});
  // The inlet is the first boundary. It is followed by outlet, outlet_2 and so on.
  std::sort(groups.begin(), groups.end(), [](const BoundaryGroup &a, const BoundaryGroup &b) {
    return std::make_pair(a.name.size(), a.name) < std::make_pair(b.name.size(), b.name);
  });
  groups.push_back({"wall", -1});
  return groups;
}

class PatientMesher {
 public:
  PatientMesher(const PatientWall &wall, const PatientMeshOptions &options)
      : wall_(wall),
        options_(options),
        old_(wall.triangles),
        groups_(boundary_groups(wall)),
        gmsh_folder_(options.folder + "/gmsh") {}

  PatientMesh run() {
    make_folder(gmsh_folder_);
    make_folder(options_.folder + "/faces");
    make_surface();
    fill();
    write();
    return std::move(made_);
  }

 private:
  static void make_folder(const std::string &path) {
    std::error_code error;
    fs::create_directories(path, error);
    if (error) refuse_data(path + ": the folder cannot be made: " + error.message());
  }

  std::string in_gmsh(const std::string &name) const { return gmsh_folder_ + "/" + name; }

  // Returns the lines that load the size field. gmsh looks for the field in the folder in which it was started.
  std::string size_lines() const {
    std::error_code error;
    const std::string field = fs::absolute(options_.field, error).string();
    if (field.find_first_of("\"\\\n") != std::string::npos)
      refuse_usage(field +
                   ": gmsh does not read a path with a quotation mark, a backslash or a line break: choose "
                   "another folder");
    std::string text = "Field[1] = Structured;\nField[1].FileName = \"" + field +
                       "\";\nField[1].TextFormat = 1;\nField[1].SetOutsideValue = 1;\nField[1].OutsideValue = " +
                       shortest(options_.largest_edge) + ";\n";
    // Edges are shorter at a small end, and become longer with the distance from the end.
    int n_fields = 1;
    for (const FlatEnd &end : wall_.ends) {
      const double radius = std::sqrt(end.area / pi), edge = end_edge_share * radius;
      if (edge >= options_.largest_edge) continue;
      const std::string field_text = "Field[" + std::to_string(++n_fields) + "]";
      std::string squares;
      for (std::size_t k = 0; k < 3; ++k)
        squares += std::string(k == 0 ? "" : " + ") + "(" + "xyz"[k] + " - (" + shortest(end.centre[k]) + "))^2";
      text += "// " + end.name + "\n" + field_text + " = MathEval;\n" + field_text + ".F = \"" + shortest(edge) +
              " * (1 + (" + squares + ")^1.5 / " + shortest(std::pow(2 * radius, 3)) + ")\";\n";
    }
    if (n_fields > 1) {
      text += "Field[" + std::to_string(n_fields + 1) + "] = Min;\nField[" + std::to_string(n_fields + 1) +
              "].FieldsList = {";
      for (int i = 1; i <= n_fields; ++i) text += (i == 1 ? "" : ", ") + std::to_string(i);
      text += "};\n";
      ++n_fields;
    }
    return text + "Background Field = " + std::to_string(n_fields) +
           ";\nMesh.MeshSizeExtendFromBoundary = 0;\nMesh.MeshSizeFromPoints = 0;\n"
           "Mesh.MeshSizeFromCurvature = 0;\n";
  }

  // Runs gmsh. Returns nothing if gmsh runs longer than the limit.
  static std::optional<ProgramEnd> end_of_gmsh(const std::vector<std::string> &words, double seconds) {
    // SIGTERM does not end gmsh. The program timeout takes only whole seconds.
    const double limit = std::ceil(seconds);
    std::vector<std::string> limited{"timeout", "--foreground", "--signal=KILL", printed("%.0f", limit)};
    limited.insert(limited.end(), words.begin(), words.end());
    const Stage stage("", true);
    ProgramEnd end = run_program(limited);
    if (is_killed(end) && stage.seconds() >= limit) return std::nullopt;
    return end;
  }

  static bool is_killed(const ProgramEnd &end) {
    constexpr int signal_status = 128;  // after a signal, the status of timeout is higher than this
    return end.status < 0 || end.status > signal_status;
  }

  // Runs gmsh on a .geo file. If gmsh wrote no mesh, refuses with gmsh's last error. In the message, `cure` follows gmsh's error.
  // If change_input is given, gmsh first gets only a part of the time. If gmsh does not end in time, change_input is called, and
  // gmsh runs again for the rest of the time.
  GmshMesh run_gmsh(double seconds, const std::string &dimension, const std::string &geo, const std::string &mesh,
                    const std::string &cure, const std::function<void()> &change_input = {}) {
    const std::string log = in_gmsh(fs::path(geo).stem().string() + ".log");
    std::error_code ignored;
    fs::remove(mesh, ignored);
    fs::remove(log, ignored);
    const std::vector<std::string> words{"gmsh", dimension, "-nt",   "1",  "-v", "4", "-log",
                                         log,    "-format", "msh22", "-o", mesh, geo};
    options_.announce(joined_by(words, " "));
    std::optional<ProgramEnd> ended = end_of_gmsh(words, change_input ? first_share * seconds : seconds);
    if (!ended && change_input) {
      change_input();
      ended = end_of_gmsh(words, (1 - first_share) * seconds);
    }
    if (!ended)
      refuse_data("gmsh did not end within " + printed("%.0f", seconds) + " seconds (" + log + "); " + crossing_text() +
                  cure);
    const ProgramEnd &end = *ended;
    if (end.error != 0) refuse_data("gmsh: cannot be run: " + system_text(end.error));
    const std::string log_text = fs::exists(log, ignored) ? text_of_file(log) : "";
    const std::string error = last_error_in(log_text);
    const std::string why = !error.empty() ? error : is_killed(end) ? "a signal ended it" : end.last_message;
    if (!error.empty() || end.status != 0 || !fs::exists(mesh, ignored))
      refuse_data("gmsh fails: " + (why.empty() ? "it writes no mesh" : why) + " (" + log + "); " + crossing_text() +
                  cure);
    made_.written.push_back(log);
    return GmshReader(mesh).read();
  }

  // Remeshes the surface with the edge lengths of the size field, and names the new triangles.
  void make_surface() {
    write_text(in_gmsh("surface.geo"),
               "// The wall has a surface for each end, and its rims as lines, so no angle is needed.\n"
               "Merge \"wall.msh\";\nClassifySurfaces{Pi, 1, 1, Pi};\nCreateGeometry;\n" +
                   size_lines());
    const double seconds = options_.surface_seconds > 0
                               ? options_.surface_seconds
                               : least_seconds + seconds_per_triangle * static_cast<double>(old_.n());
    write_text(in_gmsh("wall.msh"), text_of_wall(old_.points));
    // In rare cases gmsh refines a clean surface and never stops. If the last digits of the coordinates are changed, gmsh
    // succeeds.
    surface_ = run_gmsh(seconds, "-2", in_gmsh("surface.geo"), in_gmsh("surface.msh"), cure_of_surface(),
                        [&] { write_text(in_gmsh("wall.msh"), text_of_wall(moved_points())); });
    name_patches();
    check_closed(surface_);
    check_ends(surface_);
    GmshText text(surface_.points);
    for (const auto &[group, triangle] : surface_.triangles) text.add(gmsh_triangle, group, group, triangle);
    write_text(in_gmsh("named.msh"), text.text());
  }

  std::string cure_of_surface() const {
    return "look for overlapping triangles in " + wall_.path +
           ", and repair or smooth it, for example by Surface Toolbox of 3D Slicer";
  }

  // Tells where the wall intersects itself, or returns "". Most failures of gmsh come from a wall that intersects itself.
  std::string crossing_text() const {
    const riis_surface_arrays arrays = arrays_of(old_);
    auto how = defaults<riis_surface_options>();
    how.half_thickness = least_crossing_share * wall_.size;
    how.zero_area = RIIS_ZERO_AREA_SKIP;
    auto depth = defaults<riis_crossing_options>();
    depth.depth = 1;
    const auto surface = create_for<Surface>(wall_.path, riis_surface_create_from_arrays, &arrays, &how);
    const auto crossings = create<Crossings>(riis_crossings_create);
    check(riis_find_crossings(surface, &depth, crossings));
    const auto found = get<riis_crossing_list>(riis_crossings_get_list, crossings);
    if (found.n_pairs == 0) return "";
    const Vector3 deepest{found.deepest_point[0], found.deepest_point[1], found.deepest_point[2]};
    return "the wall goes through itself at " + counted(found.n_pairs, "pair") + " of triangles, the deepest at " +
           point_text(deepest, wall_.size) + " in the mesh's unit; ";
  }

  std::vector<Vector3> moved_points() const {
    constexpr std::size_t n_steps = 1009;  // a prime: neighbours get different steps
    const double step = moved_share * wall_.size / n_steps;
    std::vector<Vector3> points = old_.points;
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) points[i][k] += step * static_cast<double>(((3 * i + k) * 389) % n_steps);
    return points;
  }

  std::string text_of_wall(const std::vector<Vector3> &points) const {
    GmshText text(points);
    const std::vector<Corners> beyond = neighbours_of(old_);
    for (std::int64_t i = 0; i < old_.n(); ++i) {
      const std::int32_t end = view(wall_.end_of)[i];
      for (std::size_t k = 0; k < 3 && end >= 0; ++k)
        if (view(wall_.end_of)[view(beyond)[i][k]] != end) {
          const Corners &corner = view(old_.corners)[i];
          text.add(gmsh_line, 0, 1 + end, std::array<std::int64_t, 2>{corner[k], corner[(k + 1) % 3]});
        }
    }
    const auto n_ends = static_cast<std::int64_t>(wall_.ends.size());
    for (std::int64_t i = 0; i < old_.n(); ++i) {
      const std::int32_t end = view(wall_.end_of)[i];
      text.add(gmsh_triangle, 0, 1 + (end >= 0 ? end : n_ends), view(old_.corners)[i]);
    }
    return text.text();
  }

  // gmsh gives new numbers to its patches, and turns some patches over. Each new patch gets the name of the part of the boundary
  // that it covers.
  void name_patches() {
    std::map<std::int64_t, std::vector<std::size_t>> patches;
    for (std::size_t i = 0; i < surface_.triangles.size(); ++i) patches[surface_.triangles[i].first].push_back(i);
    std::map<std::int32_t, std::int64_t> group_of_end;
    for (std::size_t i = 0; i < groups_.size(); ++i) group_of_end[groups_[i].end] = static_cast<std::int64_t>(i) + 1;
    for (const auto &[number, triangles] : patches) {
      std::map<std::int32_t, int> votes;
      double along = 0;
      const std::size_t step = std::max<std::size_t>(1, triangles.size() / n_compared);
      for (std::size_t i = step / 2; i < triangles.size(); i += step) {
        const Corners &corner = surface_.triangles[triangles[i]].second;
        const Vector3 &a = view(surface_.points)[corner[0]], &b = view(surface_.points)[corner[1]],
                      &c = view(surface_.points)[corner[2]];
        const std::int64_t nearest = nearest_on_wall(1.0 / 3 * (a + b + c));
        ++votes[view(wall_.end_of)[nearest]];
        along += dot(unit_vector(cross(b - a, c - a)), unit_vector(old_.area_of(nearest)));
      }
      const auto most = std::max_element(votes.begin(), votes.end(),
                                         [](const auto &a, const auto &b) { return a.second < b.second; });
      for (const std::size_t i : triangles) {
        surface_.triangles[i].first = group_of_end[most->first];
        if (along < 0) std::swap(surface_.triangles[i].second[1], surface_.triangles[i].second[2]);
      }
    }
  }

  std::int64_t nearest_on_wall(const Vector3 &point) const {
    std::int64_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::int64_t i = 0; i < old_.n(); ++i) {
      // The distance of a triangle is computed only if a corner of the triangle is near.
      const double distance = old_.distance(i, point);
      if (distance < least) least = distance, nearest = i;
    }
    return nearest;
  }

  // Refuses a surface if a triangle has a side without a neighbour.
  void check_closed(const GmshMesh &mesh) const {
    std::set<std::pair<std::int64_t, std::int64_t>> sides;
    std::int64_t n_open = 0;
    for (const auto &[group, corner] : mesh.triangles)
      for (std::size_t k = 0; k < 3; ++k)
        if (!sides.emplace(corner[k], corner[(k + 1) % 3]).second) ++n_open;
    for (const auto &[a, b] : sides) n_open += sides.count({b, a}) == 0;
    if (n_open > 0)
      refuse_data("gmsh made a surface that is not closed at " + counted(n_open, "edge") + " (" +
                  in_gmsh("surface.log") + "); " + cure_of_surface());
  }

  // Refuses a surface if an end was lost or has another area.
  void check_ends(const GmshMesh &mesh) const {
    std::vector<double> areas(groups_.size(), 0);
    for (const auto &[group, corner] : mesh.triangles) {
      const Vector3 &a = view(mesh.points)[corner[0]];
      view(areas)[group - 1] += 0.5 * norm(cross(view(mesh.points)[corner[1]] - a, view(mesh.points)[corner[2]] - a));
    }
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      if (groups_[i].end < 0) continue;
      const double before = view(wall_.ends)[groups_[i].end].area;
      if (std::abs(areas[i] - before) > most_area_change * before)
        refuse_data("gmsh changed the area of the " + groups_[i].name + " from " + printed("%.3g", before) + " to " +
                    printed("%.3g", areas[i]) + " (" + in_gmsh("surface.log") + "): choose a smaller --largest-edge, " +
                    shortest_of(std::sqrt(before) / 4) + " or less");
    }
  }
  static std::string shortest_of(double x) { return printed("%.2g", x); }

  // Fills the surface with tetrahedra.
  void fill() {
    write_text(in_gmsh("volume.geo"),
               "Merge \"named.msh\";\nSurface Loop(1) = Surface{:};\nVolume(1) = {1};\n"
               "Physical Volume(\"blood\", " +
                   std::to_string(groups_.size() + 1) +
                   ") = {1};\n// Delaunay keeps close to the size field.\nMesh.Algorithm3D = 1;\n"
                   "Mesh.Binary = 0;\n" +
                   size_lines());
    mesh_ = run_gmsh(24 * 3600, "-3", in_gmsh("volume.geo"), in_gmsh("volume.msh"), cure_of_surface());
    if (mesh_.cells.empty())
      refuse_data("gmsh made no tetrahedra (" + in_gmsh("volume.log") + "); " + cure_of_surface());
    measure_cells();
    find_faces();
    leave_out_nodes();
  }

  // Turns cells over if their volume is negative, and measures all cells.
  void measure_cells() {
    made_.least_quality = 1;
    for (auto &cell : mesh_.cells) {
      const auto point = [&](std::size_t k) { return view(mesh_.points)[cell[k]]; };
      if (dot(cross(point(1) - point(0), point(2) - point(0)), point(3) - point(0)) < 0) std::swap(cell[2], cell[3]);
      const Vector3 a = point(1) - point(0), b = point(2) - point(0), c = point(3) - point(0);
      const double six_volumes = dot(cross(a, b), c);
      made_.volume += six_volumes / 6;
      const double surface = norm(cross(a, b)) + norm(cross(b, c)) + norm(cross(c, a)) + norm(cross(b - a, c - a));
      const Vector3 to_middle = dot(a, a) * cross(b, c) + dot(b, b) * cross(c, a) + dot(c, c) * cross(a, b);
      // The radius of the inner sphere is six_volumes / surface. The radius of the outer sphere is norm(to_middle) / (2
      // six_volumes).
      const double quality = six_volumes > 0 ? 6 * six_volumes * six_volumes / (surface * norm(to_middle)) : 0;
      made_.least_quality = std::min(made_.least_quality, quality);
      for (const Vector3 &edge : {a, b, c, b - a, c - a, c - b})
        made_.longest_edge = std::max(made_.longest_edge, norm(edge));
    }
  }

  // Finds the cell of each boundary triangle, and makes the triangle face outwards.
  void find_faces() {
    std::map<Corners, std::int64_t> group;
    const auto key = [](Corners corner) {
      std::sort(corner.begin(), corner.end());
      return corner;
    };
    for (const auto &[number, corner] : mesh_.triangles) group[key(corner)] = number;
    faces_.assign(groups_.size(), {});
    std::map<Corners, std::pair<Corners, std::int64_t>> outer;
    constexpr std::size_t sides[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};  // outwards
    for (std::size_t i = 0; i < mesh_.cells.size(); ++i)
      for (const auto &side : sides) {
        const auto &cell = mesh_.cells[i];
        const Corners face{cell[side[0]], cell[side[1]], cell[side[2]]};
        const auto found = outer.find(key(face));
        if (found == outer.end())
          outer[key(face)] = {face, static_cast<std::int64_t>(i)};
        else
          outer.erase(found);
      }
    std::int64_t n_unknown = 0;
    for (const auto &[sorted, face] : outer) {
      const auto found = group.find(sorted);
      if (found == group.end() || found->second < 1 || found->second > static_cast<std::int64_t>(groups_.size()))
        ++n_unknown;
      else
        view(faces_)[found->second - 1].push_back(face);
    }
    if (n_unknown > 0 || outer.size() != group.size())
      refuse_data("gmsh's tetrahedra do not end at its surface: " +
                  counted(n_unknown + std::abs(static_cast<std::int64_t>(group.size()) -
                                               static_cast<std::int64_t>(outer.size())),
                          "face") +
                  " differ (" + in_gmsh("volume.log") + "); " + cure_of_surface());
  }

  // Removes nodes that belong to no cell.
  void leave_out_nodes() {
    std::vector<std::int64_t> number(mesh_.points.size(), -1);
    for (const auto &cell : mesh_.cells)
      for (const std::int64_t id : cell) view(number)[id] = 0;
    std::vector<Vector3> kept;
    for (std::size_t i = 0; i < number.size(); ++i) {
      if (number[i] < 0) continue;
      number[i] = static_cast<std::int64_t>(kept.size());
      kept.push_back(mesh_.points[i]);
    }
    for (auto &cell : mesh_.cells)
      for (std::int64_t &id : cell) id = view(number)[id];
    for (auto &faces : faces_)
      for (auto &[corner, cell] : faces)
        for (std::int64_t &id : corner) id = view(number)[id];
    mesh_.points = std::move(kept);
  }

  void write() {
    made_.n_nodes = static_cast<std::int64_t>(mesh_.points.size());
    made_.n_cells = static_cast<std::int64_t>(mesh_.cells.size());
    GmshText text(mesh_.points);
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      const auto group = static_cast<std::int64_t>(i) + 1;
      text.name(2, group, groups_[i].name);
      for (const auto &[corner, cell] : faces_[i]) text.add(gmsh_triangle, group, group, corner);
      write_boundary(i);
    }
    const auto blood = static_cast<std::int64_t>(groups_.size()) + 1;
    text.name(3, blood, "blood");
    for (const auto &cell : mesh_.cells) text.add(gmsh_tetrahedron, blood, blood, cell);
    write_file("mesh.msh", text.text());
    std::vector<std::int64_t> node_ids, element_ids;
    for (std::int64_t i = 1; i <= made_.n_nodes; ++i) node_ids.push_back(i);
    for (std::int64_t i = 1; i <= made_.n_cells; ++i) element_ids.push_back(i);
    write_file("mesh.vtu", vtk_file_text(mesh_.points, node_ids, mesh_.cells, element_ids, "ModelRegionID", 1));
  }

  void write_boundary(std::size_t i) {
    Boundary boundary;
    boundary.name = groups_[i].name;
    boundary.group = static_cast<std::int32_t>(i) + 1;
    boundary.n_faces = static_cast<std::int64_t>(faces_[i].size());
    std::map<std::int64_t, std::int64_t> number;
    for (const auto &[corner, cell] : faces_[i])
      for (const std::int64_t id : corner) number[id] = 0;
    std::vector<Vector3> points;
    std::vector<std::int64_t> node_ids, element_ids;
    for (auto &[id, of_face] : number) {
      of_face = static_cast<std::int64_t>(points.size());
      points.push_back(view(mesh_.points)[id]);
      node_ids.push_back(id + 1);
    }
    std::vector<Corners> corners;
    Vector3 sum{};
    for (const auto &[corner, cell] : faces_[i]) {
      corners.push_back({number[corner[0]], number[corner[1]], number[corner[2]]});
      element_ids.push_back(cell + 1);
      const Vector3 &a = view(mesh_.points)[corner[0]], &b = view(mesh_.points)[corner[1]],
                    &c = view(mesh_.points)[corner[2]];
      const Vector3 area = 0.5 * cross(b - a, c - a);
      sum = sum + area;
      boundary.area += norm(area);
      boundary.centre = boundary.centre + norm(area) / 3 * (a + b + c);
    }
    boundary.centre = 1 / boundary.area * boundary.centre;
    if (groups_[i].end >= 0) boundary.outward = unit_vector(sum);
    write_file("faces/" + boundary.name + ".vtp",
               vtk_file_text(points, node_ids, corners, element_ids, "ModelFaceID", boundary.group));
    made_.boundaries.push_back(boundary);
  }

  void write_file(const std::string &name, const std::string &text) {
    write_text(options_.folder + "/" + name, text);
    made_.written.push_back(options_.folder + "/" + name);
  }

  const PatientWall &wall_;
  const PatientMeshOptions &options_;
  const Triangles &old_;  // of the wall
  const std::vector<BoundaryGroup> groups_;
  const std::string gmsh_folder_;
  GmshMesh surface_, mesh_;
  std::vector<std::vector<std::pair<Corners, std::int64_t>>>
      faces_;  // by group: triangles of the boundary and their cells
  PatientMesh made_;
};

}  // namespace

std::string require_gmsh() {
  std::string version;
  const ProgramEnd end = run_program({"gmsh", "--version"}, nullptr, [&](const std::string &line) { version = line; });
  if (end.error == ENOENT)
    refuse_data(
        "gmsh: there is no such program in PATH, but riis needs it to make the mesh; on Debian and Ubuntu 'sudo "
        "apt-get install "
        "gmsh' installs it");
  if (end.error != 0) refuse_data("gmsh: cannot be run: " + system_text(end.error));
  if (end.status != 0)
    refuse_data("gmsh: its option --version fails" + (end.last_message.empty() ? "" : ": " + end.last_message));
  return version.empty() ? end.last_message : version;
}

PatientMesh mesh_patient(const PatientWall &wall, const PatientMeshOptions &options) {
  return PatientMesher(wall, options).run();
}

}  // namespace riis::program
