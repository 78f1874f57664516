// SPDX-License-Identifier: Apache-2.0
// The text of uris_flow.py. CMake writes it into the program, which then finds it wherever it is installed.
#pragma once

namespace riis::program {

extern const char uris_flow_script[];

}  // namespace riis::program
