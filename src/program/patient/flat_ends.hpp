// SPDX-License-Identifier: Apache-2.0
// In: the file of a patient's wall. Out: a closed surface whose triangles face outwards, and its flat ends, at which the vessels
// were cut.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace riis::program {

// A flat end of the blood.
struct FlatEnd {
  std::string name{};  // "inlet", "outlet", "outlet_2", ...; "" until name_ends, unless --inlet or --outlet chose it
  std::array<double, 3> centre{};
  std::array<double, 3> outward{};  // unit normal, out of the blood
  double area = 0;
  std::int64_t n_triangles = 0;
  bool was_open = false;  // the file has a hole here, which read_patient_wall closed by a flat end
};

// A wall with flat ends: a closed surface around the blood. Lengths have the file's unit, unless scale_wall changed them.
struct PatientWall {
  std::string path;
  std::vector<double> xyz;            // (3, n_vertices); no two vertices are equal, and each has a triangle
  std::vector<std::int64_t> corners;  // (3, n_triangles); seen from outside, they run counter-clockwise
  std::vector<std::int32_t> end_of;   // (n_triangles): the position in `ends`, or -1 at the wall
  std::vector<FlatEnd> ends;          // two or more, the largest first
  double size = 0;                    // the diagonal of the box around the wall
  double area = 0, volume = 0;        // of the whole surface with its ends, and of the blood
  std::vector<std::string> remarks;   // what was changed in the surface, a line each, such as "... are turned outwards"
};

// The points of --inlet and --outlet, in the unit of the wall's file. Each point chooses the nearest flat part.
struct EndPoints {
  std::optional<std::array<double, 3>> inlet{};
  std::vector<std::array<double, 3>> outlets{};  // if there are some, no other flat part is an outlet
};

// Reads a wall from a surface's file or from a volume mesh, whose boundary then is the wall. Finds the wall's flat ends by plane:
// any number of ends, in any direction. Closes flat holes at its ends. Turns triangles outwards. Refuses a surface with other
// holes, with several pieces or with edges of more than two triangles. Refuses a wall with unclear ends, with the list of flat
// parts and the options that choose among the parts.
PatientWall read_patient_wall(const std::string &path, const EndPoints &points = {});

// Multiplies all lengths, such as by 0.001 from millimetres to metres.
void scale_wall(PatientWall &wall, double factor);

// Names the ends that have no name yet. Blood comes from the inlet: the first end on the way along the wall from the place
// upstream of the valve. The other ends are outlet, outlet_2, ..., the largest first. `centre` is the middle of the valve's
// annulus, and `flow` the direction of the blood through the open valve. Refuses a centre outside the wall.
void name_ends(PatientWall &wall, const std::array<double, 3> &centre, const std::array<double, 3> &flow);

// Writes all triangles as a binary .stl file.
void write_wall(const PatientWall &wall, const std::string &path);

}  // namespace riis::program
