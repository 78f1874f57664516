// SPDX-License-Identifier: Apache-2.0
// In: a JSON file. Out: its value, with what the parser would let pass refused: deep nesting, keys given twice, control
// characters in keys.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace riis::cli {

using Json = nlohmann::ordered_json;

// Refuses the file. The reason may hold pieces of it, of any length.
[[noreturn]] void refuse_file(const std::string &path, const std::string &reason);

// content, such as "parameters", is what the file should hold, for the refusal of one that is nested too deep.
Json parse_json_file(const std::string &path, const std::string &content);

}  // namespace riis::cli
