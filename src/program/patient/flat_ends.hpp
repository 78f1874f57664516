// SPDX-License-Identifier: Apache-2.0
// The input is the file of a patient's wall. The results are a closed surface, the flat ends at which the vessels were cut, and
// the unit and the axes of the file. The triangles of the surface face outwards.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/triangles.hpp"
#include "program/input/placing.hpp"

namespace riis::program {

// A flat end of the blood, at which a vessel was cut.
struct FlatEnd {
  std::string name{};  // "inlet", "outlet", "outlet_2", ...; "" until name_ends, unless --inlet or --outlet chose it
  std::array<double, 3> centre{};
  std::array<double, 3> outward{};  // unit normal, out of the blood
  double area = 0;
  std::int64_t n_triangles = 0;
  bool was_open = false;  // the file has a hole here, which read_patient_wall closed by a flat end
};

// A wall with its flat ends: a closed surface around the blood. Lengths are in the file's unit until scale_wall changes them.
struct PatientWall {
  std::string path;
  Triangles triangles;               // which face outwards; no two vertices are equal, and each has a triangle
  std::vector<std::int32_t> end_of;  // (n_triangles): the position in `ends`, or -1 at the wall
  std::vector<FlatEnd> ends;         // two or more, the largest first
  double size = 0;                   // the diagonal of the box around the wall
  double area = 0, volume = 0;       // of the whole surface with its ends, and of the blood
  std::vector<std::string> remarks;  // what was changed in the surface, a line each, such as "... are turned outwards"
};

// The points of --inlet and --outlet, in the unit of the wall's file. Each point chooses the flat part that is nearest to it.
struct EndPoints {
  std::optional<std::array<double, 3>> inlet{};
  std::vector<std::array<double, 3>> outlets{};  // if there are some, no other flat part is an outlet
};

// Reads a wall from the file of a surface, or of a volume mesh. The boundary of the volume mesh is the wall. Finds the flat parts
// of the wall that are ends. A wall may have any number of ends, in any direction. Closes flat holes at the ends. Turns triangles
// outwards. Refuses a surface with other holes, with several pieces, or with edges that belong to more than two triangles.
// Refuses a wall whose ends are unclear. The message lists the flat parts and the options that choose among them.
PatientWall read_patient_wall(const std::string &path, const EndPoints &points = {});

// Multiplies all lengths by a factor, such as 0.001 from millimetres to metres.
void scale_wall(PatientWall &wall, double factor);

// Names the ends that have no name yet. A path along the wall starts upstream of the valve. The inlet is the first end that this
// path reaches. All other ends are called outlet, outlet_2 and so on, beginning with the largest. `centre` is the middle of the
// valve's annulus, and `flow` is the direction of the blood through the open valve. Refuses a centre that is outside the wall.
void name_ends(PatientWall &wall, const std::array<double, 3> &centre, const std::array<double, 3> &flow);

// Writes all triangles as a binary .stl file.
void write_wall(const PatientWall &wall, const std::string &path);

// A file of a wall states neither a unit nor axes. The landmarks state both and lie at the wall, so they tell the unit and the
// axes of the wall.
struct WallFrame {
  Unit unit = Unit::millimetre;
  std::string axes;      // "LPS", "RAS" or "mesh"
  double away = 0;       // mean distance of the landmarks from the wall, in millimetres
  double worst = 0;      // the largest of these distances
  std::string farthest;  // the landmark with this distance
};

// The lengths of the wall are in the unit of its file. `unit` and `axes` are set only if the user stated them. Refuses landmarks
// that are not at the wall. If two units or axes fit about equally well, refuses to choose one of them.
WallFrame frame_of_wall(const PatientWall &wall, const LandmarkFile &landmarks, std::optional<Unit> unit,
                        const std::string &axes);

// The input is the file of a wall. The result is a closed surface whose triangles face outwards.

using Corners = Triangles::Corners;

// A hole that was flat enough to be closed. A fan of triangles closes the hole.
struct ClosedHole {
  std::int64_t first = 0, n_triangles = 0;  // the triangles of the fan
  Vector3 centre{};
};

struct ClosedSurface {
  Triangles triangles;               // closed, in one piece, facing outwards
  std::vector<ClosedHole> holes;     // whose fans are the last triangles
  std::vector<std::string> remarks;  // what was changed, a line each
};

// Reads and repairs the surface. Vertices at one place become one vertex. Refuses a surface that read_patient_wall would refuse,
// and says how to repair the file.
ClosedSurface read_closed_surface(const std::string &path);

// Returns a point in the form X,Y,Z that options accept, with digits down to a thousandth of `size`.
std::string point_text(const Vector3 &point, double size);

}  // namespace riis::program
