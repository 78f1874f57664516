// SPDX-License-Identifier: Apache-2.0
// Escapes text for XML. All the code is in this header, because riis_vtk and the program both include it.
#pragma once

#include <string>

namespace riis {

// Escapes text, so that it can stand between XML tags or in an attribute.
inline std::string in_xml(const std::string &text) {
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

}  // namespace riis
