// SPDX-License-Identifier: Apache-2.0
// In: a file of landmarks (docs/formats.md): JSON, 3D Slicer's .mrk.json, or CSV. Out: the landmarks as the library takes them.
// Nothing is guessed: a file that does not state its unit and its axes is refused.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "program/base/units.hpp"
#include "program/input/json.hpp"

namespace riis::program {

// The directions of x, y and z. LPS is left, posterior, superior; RAS is right, anterior, superior. `mesh` stands for the
// mesh's own.
enum class Axes { LPS, RAS, mesh };
const std::vector<std::string> &axes_names();
const char *name_of(Axes axes);

struct LandmarkFile {
  std::string path;
  bool is_file = true;                    // false: the landmarks are in memory, and `path` is words for them
  std::vector<std::string> names;         // as in the file
  std::vector<double> xyz;                // (3, n), in the file's unit and axes
  std::vector<std::int32_t> roles;        // RIIS_LANDMARK_*
  std::vector<std::int32_t> leaflet_ids;  // (2, n)
  std::string valve;                      // its kind, or "" if the file does not say
  Unit unit = Unit::millimetre;
  Axes axes = Axes::mesh;
  std::optional<double> noise;
  std::optional<std::array<double, 3>> flow;
  Json parameters;  // an object of sizes that are known, in centimetres; null if there are none

  // Changes lengths to another unit, and coordinates to other axes.
  void convert(Unit to);
  void convert(Axes to);
};

// Reads the text of a file, whose format follows from the ending of its path.
LandmarkFile read_landmarks(const std::string &path, const std::string &text);
// Reads landmarks in memory from an object with the keys of a file. `subject` stands for them in refusals.
LandmarkFile landmarks_of_json(const std::string &subject, const Json &root);

}  // namespace riis::program
