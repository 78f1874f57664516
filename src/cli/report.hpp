// SPDX-License-Identifier: Apache-2.0
// In: what a run found and how long it took. Out: JSON for programs, a short table for people.
#pragma once

#include <riis/riis.h>

#include <string>
#include <vector>

namespace riis::cli {

struct Seconds {
  double read = 0;     // files
  double surface = 0;  // triangles
  double scene = 0;    // Embree
  double mesh = 0;     // checking the nodes
  double search = 0;
  double write = 0;  // files
  double picture = 0;
};

struct Report {
  std::string surface_name;  // what the surface is of, for people
  bool from_file = false;    // a valve always has triangles without area to leave out, a file should not
  std::string mesh_name;     // "": no mesh was marked
  int64_t n_cells = 0;
  double distance_limit = 0;
  riis_surface_info surface{};
  riis_mark_stats marks{};
  Seconds seconds;
  std::vector<std::string> written;  // files
};

std::string json_of(const Report &report);
std::string table_of(const Report &report);

}  // namespace riis::cli
