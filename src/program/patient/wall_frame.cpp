// SPDX-License-Identifier: Apache-2.0
#include "program/patient/wall_frame.hpp"

#include <algorithm>
#include <vector>

#include "common/array_view.hpp"
#include "common/elementary.hpp"
#include "program/base/handles.hpp"
#include "program/base/text.hpp"

namespace riis::program {
namespace {

// The largest mean distance of landmarks from their wall, in millimetres. Cusps and annuli are about 25 mm wide.
constexpr double at_wall = 5;
// Another unit or other axes are excluded if the landmarks would then be clearly farther from the wall.
constexpr double clearly_farther = 2;
// The mean distance of a usual valve's landmarks from their middle, in centimetres. The range is narrower than a factor of ten,
// so that at most one unit fits.
constexpr double least_size = 0.4, largest_size = 3;

std::string mm_text(double length) { return printed("%.3g", length) + " mm"; }

Surface wall_surface_of(const PatientWall &wall) {
  auto arrays = defaults<riis_surface_arrays>();
  arrays.n_vertices = view(wall.xyz).size() / 3;
  arrays.x = wall.xyz.data();
  arrays.y = wall.xyz.data() + 1;
  arrays.z = wall.xyz.data() + 2;
  arrays.stride = 3;
  arrays.n_faces = view(wall.corners).size() / 3;
  arrays.vertex_ids = wall.corners.data();
  arrays.id_bits = 64;
  auto how = defaults<riis_surface_options>();
  how.zero_area = RIIS_ZERO_AREA_SKIP;
  return create_for<Surface>(wall.path, riis_surface_create_from_arrays, &arrays, &how);
}

// The place where the closed cusps meet is in the middle of the vessel, not at the wall.
bool is_at_wall(std::int32_t role) { return role != RIIS_LANDMARK_COAPTATION && role != RIIS_LANDMARK_HINGE; }

WallFrame frame_with(const riis_surface *wall, const LandmarkFile &given, Unit unit, const std::string &axes) {
  LandmarkFile landmarks = given;
  landmarks.convert(unit);
  if (axes != name_of(given.axes)) landmarks.convert(axes == "LPS" ? Axes::LPS : Axes::RAS);
  const std::vector<double> distance = distances_to(wall, landmarks.xyz);
  WallFrame frame{unit, axes, 0, 0, ""};
  double n = 0;
  for (std::size_t i = 0; i < distance.size(); ++i) {
    if (!is_at_wall(landmarks.roles[i])) continue;
    const double here = factor_between(unit, Unit::millimetre) * distance[i];
    frame.away += here;
    ++n;
    if (here <= frame.worst) continue;
    frame.worst = here;
    frame.farthest = landmarks.names[i];
  }
  frame.away /= std::max(n, 1.0);
  return frame;
}

// Returns the options that choose a frame's unit and axes, or words for the unit and the axes.
std::string options_of(const WallFrame &frame, const WallFrame &other) {
  std::vector<std::string> options;
  if (frame.unit != other.unit) options.push_back(std::string("--wall-unit ") + name_of(frame.unit));
  if (frame.axes != other.axes) options.push_back("--axes " + frame.axes);
  return joined_by(options, " ");
}

// Returns all units and axes of the wall with the distances of the landmarks, the nearest first.
std::vector<WallFrame> frames_of(const riis_surface *wall, const LandmarkFile &landmarks) {
  const std::string own = name_of(landmarks.axes);
  std::vector<WallFrame> all;
  for (const Unit tried : {Unit::millimetre, Unit::centimetre, Unit::metre})
    for (const std::string &turned : {own, std::string(own == "LPS" ? "RAS" : "LPS")})
      if (landmarks.axes != Axes::mesh || turned == own) all.push_back(frame_with(wall, landmarks, tried, turned));
  std::stable_sort(all.begin(), all.end(), [](const WallFrame &a, const WallFrame &b) { return a.away < b.away; });
  return all;
}

// Returns the mean distance of the landmarks from their middle, in centimetres.
double size_of(const LandmarkFile &landmarks) {
  const std::size_t n = landmarks.names.size();
  double middle[3] = {0, 0, 0}, sum = 0;
  for (std::size_t i = 0; i < 3 * n; ++i) middle[i % 3] += landmarks.xyz[i] / static_cast<double>(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double *const point = landmarks.xyz.data() + 3 * i;
    sum += hypotenuse(point[0] - middle[0], point[1] - middle[1], point[2] - middle[2]);
  }
  return factor_between(landmarks.unit, Unit::centimetre) * sum / static_cast<double>(n);
}

bool is_usual(double size) { return size >= least_size && size <= largest_size; }

// Returns the change of a file of landmarks that states another unit for the same numbers.
std::string cure_of_unit(const LandmarkFile &landmarks, Unit other) {
  const std::string &path = landmarks.path, name = name_of(other);
  if (has_ending(path, ".fcsv"))
    return "multiply its numbers by " + shortest(factor_between(other, Unit::millimetre)) +
           ", because an .fcsv file is always in mm";
  if (has_ending(path, ".csv")) return "write # unit = " + name + " in it";
  const std::string slicer = ".mrk.json";
  const bool is_slicer =
      path.size() > slicer.size() && path.compare(path.size() - slicer.size(), slicer.size(), slicer) == 0;
  return "write " + std::string(is_slicer ? "\"coordinateUnits\"" : "\"unit\"") + ": \"" + name + "\" in it";
}

// Refuses landmarks that have the size of a valve and lie at the wall only if their numbers have another unit than the file
// states.
void check_stated_unit(const riis_surface *wall, const LandmarkFile &landmarks) {
  for (const Unit other : {Unit::millimetre, Unit::centimetre, Unit::metre}) {
    LandmarkFile relabelled = landmarks;
    relabelled.unit = other;
    if (other == landmarks.unit || !is_usual(size_of(relabelled))) continue;
    const WallFrame frame = frames_of(wall, relabelled)[0];
    if (frame.away > at_wall) continue;
    refuse_data(landmarks.path + ": its numbers are probably in " + name_of(other) + ", but it states " +
                name_of(landmarks.unit) + ": in " + name_of(other) +
                " the landmarks have the size of a valve, and are " + mm_text(frame.away) +
                " from the wall on average: " + cure_of_unit(landmarks, other));
  }
}

}  // namespace

WallFrame frame_of_wall(const PatientWall &wall, const LandmarkFile &landmarks, std::optional<Unit> unit,
                        const std::string &axes) {
  const Surface surface = wall_surface_of(wall);
  if (landmarks.axes == Axes::mesh && !axes.empty())
    refuse_usage("--axes: " + landmarks.path + " states the axes mesh, which are those of the wall: leave --axes out");
  const std::vector<WallFrame> all = frames_of(surface, landmarks);
  if (all[0].away > at_wall || !is_usual(size_of(landmarks))) check_stated_unit(surface, landmarks);
  std::vector<WallFrame> allowed;
  for (const WallFrame &frame : all)
    if ((!unit || *unit == frame.unit) && (axes.empty() || axes == frame.axes)) allowed.push_back(frame);
  const WallFrame &best = allowed[0];
  if (best.away > at_wall) {
    const std::string text =
        landmarks.path + ": the landmarks are " + mm_text(best.away) + " from the wall of " + wall.path + " on average";
    if (all[0].away <= at_wall)
      refuse_data(text + "; they are " + mm_text(all[0].away) + " from it with " + options_of(all[0], best));
    refuse_data(
        text + ", and farther with other units and axes. On their wall they are nearer than " + mm_text(at_wall) +
        ": are both files of the same patient and the same image? Load both in 3D Slicer, and set the landmarks anew");
  }
  if (allowed.size() > 1 && allowed[1].away <= std::min(at_wall, clearly_farther * best.away))
    refuse_usage(wall.path + ": its " + (allowed[1].unit == best.unit ? "axes are" : "unit is") +
                 " not clear, because the landmarks are " + mm_text(best.away) + " from it with " +
                 options_of(best, allowed[1]) + ", and " + mm_text(allowed[1].away) + " with " +
                 options_of(allowed[1], best) + ": write one of them");
  return best;
}

}  // namespace riis::program
