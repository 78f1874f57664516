// SPDX-License-Identifier: Apache-2.0
#include "program/input/wall.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "common/array_view.hpp"
#include "program/base/handles.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/input/face_faults.hpp"
#include "program/input/json.hpp"
#include "program/input/mesh_reading.hpp"
#include "program/input/valve_source.hpp"
#include "program/mark/mesh_pieces.hpp"
#include "program/mark/warnings.hpp"

namespace riis::program {
namespace {

// The number of openings at which the program tests whether the wall is near enough.
constexpr std::int32_t n_openings = 11;
// The gap and the skirt are measured at different points, so the gap may exceed the skirt's length by this share.
constexpr double most_beyond = 0.01;
// The largest length of a hole in the wall, as a share of the attachment's length. A longer open line is the end of a vessel.
constexpr double longest_hole = 0.3;

// A change that is tried on the wall of a file. The wall's lengths are multiplied by a factor, or the wall is turned half a turn
// about z, as from the axes LPS to RAS.
struct Change {
  const char *factor;
  bool is_turned;
};

// Makes the wall. The wall is already in the mesh's coordinates, so no other placement applies to it.
Surface make_wall(const ValveOptions &options, const SurfaceFile &file, Change change = {"1", false}) {
  const auto arrays = get<riis_surface_arrays>(riis_vtk_surface_get_arrays, file);
  auto how = defaults<riis_surface_options>();
  how.zero_area = RIIS_ZERO_AREA_SKIP;
  how.scale = std::stod(change.factor);
  how.rotation_axis[2] = 1;
  how.rotation_angle = change.is_turned ? 180 : 0;
  return create_for<Surface>(options.wall, riis_surface_create_from_arrays, &arrays, &how);
}

// Returns the advice for a wall whose axes differ from the valve's.
std::string axes_advice(const ValveOptions &options) {
  if (options.placed.empty()) return "give both the same axes";
  const Json placed = parse_json_file(options.placed, "a placed valve");
  const bool is_ras = placed.contains("axes") && placed["axes"] == "RAS";
  return std::string("place the valve by riis place --axes ") + (is_ras ? "LPS" : "RAS");
}

// Returns a hint if the skirt would reach the wall in another unit or with other axes. Otherwise returns "". The function
// `reaches` tells whether the skirt reaches the wall after such a change.
template <class Reaches>
std::string hint_of_change(const ValveOptions &options, const SurfaceFile &file, const Reaches &reaches) {
  for (const Change change : {Change{"1", true}, Change{"0.1", false}, Change{"10", false}, Change{"0.01", false},
                              Change{"100", false}, Change{"0.001", false}, Change{"1000", false}}) {
    if (!reaches(make_wall(options, file, change))) continue;
    if (!change.is_turned)
      return std::string("; with its lengths times ") + change.factor +
             " the wall would be within --skirt: save the wall in the mesh's unit";
    return "; after half a turn about z the wall would be within --skirt, so the valve and the wall are in different "
           "axes, LPS and RAS: " +
           axes_advice(options);
  }
  return "";
}

// Prints a warning only once in a run, although several stages make the valve again.
void warn_once(const std::string &text) {
  static std::set<std::string> printed;
  if (printed.insert(text).second) warn(text);
}

// Warns of holes in the wall, and of a skirt that is longer than the valve.
void check_sizes(const ValveOptions &options, const riis_surface *wall, const riis_surface *valve) {
  const double largest_side = box_of(info_of(valve)).largest_side();
  if (*options.skirt > largest_side)
    warn_once("--skirt: " + shown(*options.skirt) + " is longer than the valve, whose largest side is " +
              shown(largest_side) + ": lengths have the unit of the mesh" +
              (options.unit ? std::string(", ") + name_of(*options.unit) : ""));
  const OpenLine hole = longest_open_line(wall, longest_hole * attached_edges_of(valve).length);
  if (hole.n_edges == 0) return;
  warn_once(options.wall + ": the wall has a hole of " + counted(hole.n_edges, "edge") + " at " +
            place_text(options, hole.point, hole.length / static_cast<double>(hole.n_edges)) +
            ", through which a skirt may pass: close it");
}

// Refuses a wall that the skirt cannot reach. `when` names the opening, as in "at the opening 0.5 ".
void check_gap(const ValveOptions &options, const riis_surface *surface, const riis_surface *wall,
               const std::string &when) {
  riis_gap gap;
  check(riis_surface_get_gap(surface, wall, nullptr, &gap, sizeof gap), options.wall);
  if (gap.most > (1 + most_beyond) * *options.skirt)
    refuse_data(options.wall + ": " + when + "the wall is not within --skirt, " + shown(*options.skirt) +
                ": the widest gap is " + shown(gap.most) + ", at " + place_text(options, gap.widest_point, 0));
}

// Checks the wall and the skirt's length for the closed valve. The attachment may move when the valve opens. The wall is
// therefore also checked at several openings.
void check_all_openings(const ValveOptions &options, const riis_valve *valve, const riis_surface *wall) {
  const Valve trial = copy_of(valve);
  const auto surface_at = [&](double opening) {
    check(riis_valve_set_scalar(trial, "opening", opening));
    return create<Surface>(riis_surface_create, trial, &options.surface_options);
  };
  check_sizes(options, wall, surface_at(0));
  if (!why_closed(trial, options.surface_options).empty()) return;
  for (const double opening : openings_from_0_to_1(n_openings))
    check_gap(options, surface_at(opening), wall, "at the opening " + shown(opening) + " ");
}

// The gaps at the two ends of each attached edge.
struct Gaps {
  std::vector<double> distance;
  riis_gap measures;
};

Gaps gaps_of(const riis_surface *surface, const riis_surface *wall) {
  const auto attachment = get<riis_attachment>(riis_surface_get_attachment, surface);
  Gaps made{std::vector<double>(static_cast<std::size_t>(2 * attachment.n_edges)), {}};
  check(riis_surface_get_gap(surface, wall, made.distance.data(), &made.measures, sizeof made.measures));
  return made;
}

bool is_reached(const Gaps &gaps, double longest) {
  return gaps.measures.n_without_wall == 0 && gaps.measures.most <= longest;
}

}  // namespace

AttachedReport attached_edges_of(const riis_surface *surface) {
  const auto attachment = get<riis_attachment>(riis_surface_get_attachment, surface);
  AttachedReport made{attachment.n_edges, 0, {0, 0, 0}};
  for (std::int64_t i = 0; i < attachment.n_edges; ++i) {
    const double *const p = attachment.edges + 6 * i, length = distance_between(p, p + 3);
    made.length += length;
    for (int k = 0; k < 3; ++k) made.middle[k] += 0.5 * length * (p[k] + p[k + 3]);
  }
  for (double &x : made.middle) {
    x /= made.length > 0 ? made.length : 1;
    if (std::abs(x) < 1e-9 * made.length) x = 0;  // by rounding
  }
  return made;
}

SurfaceFile read_wall(const std::string &path) {
  static const std::set<std::string> surface_endings = {".vtp", ".stl", ".obj", ".ply"};
  static const std::set<std::string> common_endings = {".vtu", ".vtk"};
  SurfaceFile wall;
  const riis_status status = riis_vtk_surface_read(path.c_str(), nullptr, wall.out());
  if (status == RIIS_OK) return wall;
  const std::string ending = ending_of(path), reason = riis_last_error();
  if (status != RIIS_FILE_ERROR || surface_endings.count(ending) != 0) check_read(status, path, Content::surface);
  MeshFile mesh;
  try {
    mesh = read_mesh_file(path, "");
  } catch (const Refusal &) {
    if (common_endings.count(ending) == 0) throw;
    refuse_data(reason);
  }
  std::int64_t n_volumes = 0;
  check(riis_vtk_mesh_get_volume_cells(mesh, &n_volumes, nullptr));
  if (n_volumes == 0) refuse_data(reason);
  check(riis_vtk_mesh_get_boundary(mesh, wall.out()), path);
  return wall;
}

void set_skirt(const ValveOptions &options, riis_valve *valve, const std::string &subject) {
  if (!options.skirt) return;
  if (options.wall.empty()) {
    check(riis_valve_set_scalar(valve, "skirt_length", *options.skirt / options.surface_options.scale), subject);
    // The library's refusal gives the skirt's length only in the valve's own unit. The program's refusal also gives the length
    // that the user wrote. The library tests the skirt's length before it makes the triangles.
    riis_surface_options how = options.surface_options;
    how.triangulation = RIIS_TRIANGULATION_ADAPTED;
    Surface trial;
    if (riis_surface_create(valve, &how, trial.out()) != RIIS_OK &&
        std::string(riis_last_error()).rfind("skirt_length is ", 0) == 0)
      refuse_usage(subject + ": " + shortest(*options.skirt) +
                   (options.unit ? std::string(" ") + name_of(*options.unit) : "") + ": " + riis_last_error());
    return;
  }
  const SurfaceFile file = read_wall(options.wall);
  const Surface wall = make_wall(options, file);
  const riis_status status = riis_valve_set_skirt_to_wall(valve, wall, *options.skirt, &options.surface_options);
  if (status == RIIS_INVALID_ARGUMENT) {
    const std::string text = riis_last_error(), argument = "wall is not within longest";
    const bool is_far = text.rfind(argument, 0) == 0;
    const std::string reason =
        options.wall + ": " + (is_far ? "the wall is not within --skirt" + text.substr(argument.size()) : text);
    refuse_data(reason + hint_of_change(options, file, [&](const riis_surface *other) {
                  const Valve copy = copy_of(valve);
                  return riis_valve_set_skirt_to_wall(copy, other, *options.skirt, &options.surface_options) == RIIS_OK;
                }));
  }
  check(status, subject);
  check_all_openings(options, valve, wall);
}

SkirtOfFile::SkirtOfFile(const ValveOptions &options, riis_surface_arrays arrays) : options_(options), arrays_(arrays) {
  if (!options.skirt) {
    arrays_.attached = nullptr;
    return;
  }
  const double scale = options.surface_options.scale, longest = *options.skirt;
  arrays_.skirt_length = longest / scale;
  if (options.wall.empty()) return;
  const SurfaceFile file = read_wall(options.wall);
  wall_ = make_wall(options, file);
  const auto surface =
      create_for<Surface>(options.surface, riis_surface_create_from_arrays, &arrays_, &options.surface_options);
  const Gaps gaps = gaps_of(surface, wall_);
  if (!is_reached(gaps, longest))
    refuse_data(options.wall + ": the wall is not within --skirt, " + shown(longest) + ", of the attachment: " +
                (gaps.measures.n_without_wall > 0 ? "it is missed at " + std::to_string(gaps.measures.n_without_wall) +
                                                        " of " + std::to_string(gaps.measures.n_ends) + " ends of edges"
                                                  : "the widest gap is " + shown(gaps.measures.most) + ", at " +
                                                        place_text(options, gaps.measures.widest_point, 0)) +
                hint_of_change(options, file, [&](const riis_surface *other) {
                  return is_reached(gaps_of(surface, other), longest);
                }));
  check_sizes(options, wall_, surface);
  const auto attachment = get<riis_attachment>(riis_surface_get_attachment, surface);
  resize(lengths_, arrays.n_vertices);
  for (std::int64_t i = 0; i < 2 * attachment.n_edges; ++i)
    view(lengths_)[attachment.vertex_id[i]] = view(gaps.distance)[i] / scale;
  arrays_.skirt_lengths = lengths_.data();
}

void SkirtOfFile::check_times(const riis_keyframes *keyframes, const std::vector<double> &times) const {
  if (!wall_) return;
  for (const double time : times)
    check_gap(options_,
              create_for<Surface>(options_.surface, riis_surface_create_from_keyframes, keyframes, time, 0.0,
                                  &options_.surface_options),
              wall_, "at the time " + shown(time) + " ");
}

std::string with_attached_array(std::string text) {
  const std::string field = "arrays.attached";
  const std::size_t at = text.find(field);
  return at == std::string::npos ? text : text.replace(at, field.size(), "the point array riis_attached");
}

Surface wall_of(const ValveOptions &options) { return make_wall(options, read_wall(options.wall)); }

riis_gap gap_to_wall(const ValveOptions &options, const riis_surface *surface) {
  const Surface wall = wall_of(options);
  riis_gap gap;
  check(riis_surface_get_gap(surface, wall, nullptr, &gap, sizeof gap), options.wall);
  return gap;
}

}  // namespace riis::program
