// SPDX-License-Identifier: Apache-2.0
// In: a path. Out: the text of the file, or a refusal that names the file.
#pragma once

#include <string>

namespace riis::program {

// Refuses the file. The reason may hold pieces of the file, of any length.
[[noreturn]] void refuse_file(const std::string &path, const std::string &reason);

// Refuses a file that cannot be read or is empty.
std::string text_of_file(const std::string &path);

}  // namespace riis::program
