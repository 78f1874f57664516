// SPDX-License-Identifier: Apache-2.0
// In: a JSON file. Out: its value. Deep nesting, keys given twice and control characters in keys are refused, which the parser
// would let pass.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "program/text_file.hpp"

namespace riis::program {

using Json = nlohmann::ordered_json;

// content, such as "parameters", names what the file should hold. The refusal of a file that is nested too deep uses it.
Json parse_json_file(const std::string &path, const std::string &content);

// Refuses a value that is not an object, and a key that is not among these, with the nearest of them. subject names the value.
void check_keys(const std::string &path, const std::string &subject, const Json &value,
                const std::vector<std::string> &keys);

}  // namespace riis::program
