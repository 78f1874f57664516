// SPDX-License-Identifier: Apache-2.0
// In: an export and the mesh of the solver's run. Out: what svMultiPhysics will do with the export in this mesh, as lines for the
// solver's input and as a table of frames.
#pragma once

#include <string>
#include <vector>

#include "program/base/options.hpp"
#include "program/svmultiphysics/uris_leaflets.hpp"
#include "program/svmultiphysics/uris_motion.hpp"

namespace riis::program {

struct UrisForecast {
  std::vector<std::string> lines;
  std::string table;  // CSV
};

// Refuses an export whose valve can never open or never close in this mesh. Warns of a drop that is too small.
UrisForecast forecast_of(const ExportOptions &options, const UrisMotion &motion, UrisLeaflets &leaflets);

}  // namespace riis::program
