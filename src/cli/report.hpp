// SPDX-License-Identifier: Apache-2.0
// In: what a run found and how long it took. Out: JSON for programs, a short table for people.
#pragma once

#include <riis/riis.h>

#include <optional>
#include <string>
#include <vector>

#include "cli/steps.hpp"

namespace riis::cli {

struct Seconds {
  double read = 0;     // files
  double surface = 0;  // triangles
  double scene = 0;    // Embree
  double mesh = 0;     // checking the nodes
  double adjacency = 0;
  double search = 0;
  double write = 0;  // files
  double picture = 0;
};

struct Report {
  std::string surface_name;       // the valve's kind, or a file
  std::optional<double> opening;  // of a valve; a surface from a file has none
  std::string mesh_name;          // "": no mesh was marked
  int64_t n_cells = 0;
  double distance_limit = 0;
  int32_t distance = RIIS_DISTANCE_TRIANGLES;
  riis_surface_info surface{};
  riis_mark_stats marks{};
  Seconds seconds;
  std::vector<std::string> written;  // files
  std::optional<StepTimes> step;
};

// Such as "mitral valve, opening 0.5".
std::string surface_title(const Report &report);
std::string json_of(const Report &report);
std::string table_of(const Report &report);

}  // namespace riis::cli
