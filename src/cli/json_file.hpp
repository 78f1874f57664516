// SPDX-License-Identifier: Apache-2.0
// In: a JSON file. Out: its value. Deep nesting, keys given twice and control characters in keys are refused, which the parser
// would let pass.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace riis::cli {

using Json = nlohmann::ordered_json;

// Refuses the file. The reason may hold pieces of the file, of any length.
[[noreturn]] void refuse_file(const std::string &path, const std::string &reason);

// content, such as "parameters", names what the file should hold. The refusal of a file that is nested too deep uses it.
Json parse_json_file(const std::string &path, const std::string &content);

}  // namespace riis::cli
