// SPDX-License-Identifier: Apache-2.0
// In: the path of a .pvd file, ParaView's collection of files in time. Out: the files and their times.
#pragma once

#include <string>
#include <vector>

#include "riis_vtk/vtk_errors.hpp"

namespace riis::vtk {

struct Collection {
  std::vector<std::string> paths;  // those of relative files begin with the collection's folder
  std::vector<double> times;       // finite and strictly ascending
};

// Fails for a file that is no collection, names no files, or whose timesteps are no ascending numbers.
Collection read_collection(const std::string &path, const CaughtOutput &caught);

}  // namespace riis::vtk
