// SPDX-License-Identifier: Apache-2.0
// Text between the tags of XML, or in an attribute.
#pragma once

#include <string>

namespace riis::program {

std::string in_xml(const std::string &text);

}  // namespace riis::program
