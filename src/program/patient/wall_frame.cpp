// SPDX-License-Identifier: Apache-2.0
#include "program/patient/wall_frame.hpp"

#include <algorithm>
#include <vector>

#include "program/base/handles.hpp"
#include "program/base/text.hpp"

namespace riis::program {
namespace {

// The largest mean distance of landmarks from their wall, in millimetres. Cusps and annuli are about 25 mm wide.
constexpr double at_wall = 5;
// Another unit or other axes are excluded if the landmarks would then be clearly farther from the wall.
constexpr double clearly_farther = 2;

std::string mm_text(double length) { return printed("%.3g", length) + " mm"; }

Surface wall_surface_of(const PatientWall &wall) {
  const riis_surface_arrays arrays = arrays_of(wall.triangles);
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

}  // namespace

WallFrame frame_of_wall(const PatientWall &wall, const LandmarkFile &landmarks, std::optional<Unit> unit,
                        const std::string &axes) {
  const Surface surface = wall_surface_of(wall);
  const std::string own = name_of(landmarks.axes);
  if (landmarks.axes == Axes::mesh && !axes.empty())
    refuse_usage("--axes: " + landmarks.path + " states the axes mesh, which are those of the wall: leave --axes out");
  std::vector<WallFrame> all, allowed;
  for (const Unit tried : {Unit::millimetre, Unit::centimetre, Unit::metre})
    for (const std::string &turned : {own, std::string(own == "LPS" ? "RAS" : "LPS")}) {
      if (landmarks.axes == Axes::mesh && turned != own) continue;
      all.push_back(frame_with(surface, landmarks, tried, turned));
      if ((!unit || *unit == tried) && (axes.empty() || axes == turned)) allowed.push_back(all.back());
    }
  const auto is_nearer = [](const WallFrame &a, const WallFrame &b) { return a.away < b.away; };
  std::stable_sort(all.begin(), all.end(), is_nearer);
  std::stable_sort(allowed.begin(), allowed.end(), is_nearer);
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
