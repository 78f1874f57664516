// SPDX-License-Identifier: Apache-2.0
#include "vtk/xml_scan.hpp"

#include <algorithm>
#include <cctype>
#include <set>
#include <string_view>

#include "vtk/files.hpp"
#include "vtk/vtk_errors.hpp"

namespace riis::vtk {
namespace {

// The value of an attribute of an XML element; "" if it is not there.
std::string_view attribute_of(std::string_view element, std::string_view attribute) {
  constexpr std::string_view blanks = " \t\r\n";
  for (std::size_t at = 0; (at = element.find(attribute, at)) != std::string_view::npos; ++at) {
    const std::size_t equals = element.find_first_not_of(blanks, at + attribute.size());
    if (at == 0 || blanks.find(element[at - 1]) == std::string_view::npos) continue;
    if (equals == std::string_view::npos || element[equals] != '=') continue;
    const std::size_t quote = element.find_first_not_of(blanks, equals + 1);
    const std::size_t end = quote == std::string_view::npos ? quote : element.find(element[quote], quote + 1);
    return end == std::string_view::npos ? "" : element.substr(quote + 1, end - quote - 1);
  }
  return "";
}

void check_array_types(const std::string &path, std::string_view text) {
  static const std::set<std::string_view> known = {"Int8",  "UInt8",  "Int16",   "UInt16",  "Int32",  "UInt32",
                                                   "Int64", "UInt64", "Float32", "Float64", "String", "Bit"};
  for (std::size_t at = 0; (at = text.find("Array", at)) != std::string_view::npos; ++at) {
    if (at + 5 >= text.size() || !std::isspace(static_cast<unsigned char>(text[at + 5]))) continue;
    const std::string_view element = text.substr(at, text.find('>', at) - at);
    const std::string_view type = attribute_of(element, "type");
    if (known.count(type) == 0) {
      fail_file(path, "has an array of the unknown type '" + std::string(type.substr(0, 40)) + "'");
    }
  }
}

// What the VTKFile element at the beginning of an XML file says that the file holds; "" if there is none.
std::string xml_type(std::string_view head) {
  const std::size_t element = head.find("<VTKFile");
  return element == std::string_view::npos ? "" : std::string(attribute_of(head.substr(element), "type"));
}

}  // namespace

void check_xml(const std::string &path, const std::string &wanted_type) {
  const MappedFile file(path, check_readable(path));
  const std::string_view bytes = file.bytes();
  const std::string type = xml_type(bytes.substr(0, 4096));
  if (type.empty()) fail_file(path, "is not a VTK XML file");
  if (type != wanted_type) fail_file(path, "holds " + type + ", not " + wanted_type);
  if (bytes.substr(bytes.size() - std::min<std::size_t>(bytes.size(), 4096)).find("</VTKFile>") ==
      std::string_view::npos) {
    fail_file(path, "is truncated: </VTKFile> is missing");
  }
  check_array_types(path, bytes.substr(0, bytes.find("<AppendedData")));
}

}  // namespace riis::vtk
