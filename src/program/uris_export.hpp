// SPDX-License-Identifier: Apache-2.0
// --export-uris: a valve's opening and closing as files of svMultiPhysics, and the block of its input that names them.
#pragma once

#include "program/command_line.hpp"

namespace riis::program {

// Writes the folder, and prints the block on stdout.
void export_uris(const Options &options);

}  // namespace riis::program
