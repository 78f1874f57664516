// SPDX-License-Identifier: Apache-2.0
// Skips the byte order mark with which text files from Windows may begin. All the code is in this header, because riis_vtk and
// the program both include it.
#pragma once

#include <string_view>

namespace riis {

inline std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view mark = "\xef\xbb\xbf";
  return text.substr(0, mark.size()) == mark ? text.substr(mark.size()) : text;
}

}  // namespace riis
