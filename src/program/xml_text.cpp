// SPDX-License-Identifier: Apache-2.0
#include "program/xml_text.hpp"

namespace riis::program {

std::string in_xml(const std::string &text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '&')
      escaped += "&amp;";
    else if (c == '<')
      escaped += "&lt;";
    else if (c == '>')
      escaped += "&gt;";
    else if (c == '"')
      escaped += "&quot;";
    else
      escaped += c;
  }
  return escaped;
}

}  // namespace riis::program
