// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/xml_scan.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <set>
#include <string_view>

#include "common/array_view.hpp"
#include "riis_vtk/files.hpp"
#include "riis_vtk/text.hpp"
#include "riis_vtk/vtk_errors.hpp"

namespace riis::vtk {
namespace {

// A start tag: the element's name and the values of its attributes "type" and "NumberOfComponents", or "" if it lacks one.
struct Tag {
  std::string_view name, type, n_components;
};

// Walks the start tags of an XML text and passes over comments, instructions and end tags. In an attribute's value, '>' does not
// end the tag and a word is not an attribute.
class Tags {
 public:
  explicit Tags(std::string_view text) : rest_(text) {}

  // Returns false at the end.
  bool next(Tag &tag) {
    for (;;) {
      rest_.remove_prefix(std::min(rest_.find('<'), rest_.size()));
      if (rest_.empty()) return false;
      if (rest_.substr(0, 4) == "<!--") {
        rest_.remove_prefix(std::min(rest_.find("-->", 4), rest_.size()));
        continue;
      }
      rest_.remove_prefix(1);
      tag = {take_until(" \t\r\n/>"), "", ""};
      if (!tag.name.empty() && tag.name[0] != '?' && tag.name[0] != '!') break;
    }
    while (const char quote = next_attribute()) {
      const std::string_view name = attribute_;
      rest_.remove_prefix(1);
      const std::string_view value = take_until(std::string_view(&quote, 1));
      rest_.remove_prefix(std::min<std::size_t>(1, rest_.size()));
      if (name == "type") tag.type = value;
      if (name == "NumberOfComponents") tag.n_components = value;
    }
    return true;
  }

 private:
  // Takes the text before the first of these characters.
  std::string_view take_until(std::string_view characters) {
    const std::string_view text = rest_.substr(0, rest_.find_first_of(characters));
    rest_.remove_prefix(text.size());
    return text;
  }

  // Goes on to the value of the tag's next attribute. Sets attribute_ to its name and returns its quotation mark, or 0 where the
  // tag ends.
  char next_attribute() {
    attribute_ = take_until("=\"'<>");
    if (rest_.empty() || rest_[0] == '<' || rest_[0] == '>') return 0;
    take_until("\"'<>");
    attribute_ = take_word(attribute_);
    return rest_.empty() || rest_[0] == '<' || rest_[0] == '>' ? '\0' : rest_[0];
  }

  std::string_view rest_;
  std::string_view attribute_;
};

// VTK looks for a name of each component, even before it knows where the array is.
void check_components(const std::string &path, std::string_view text, std::string_view given) {
  const std::string_view number = take_word(given);
  std::int64_t n = 0;
  std::from_chars(number.data(), number.data() + number.size(), n);
  if (n > 8 * view(text).size())
    fail_file(path, "has an array of " + std::string(number) + " components, more than it has bits");
}

void check_arrays(const std::string &path, std::string_view text) {
  static const std::set<std::string_view> known = {"Int8",  "UInt8",  "Int16",   "UInt16",  "Int32",  "UInt32",
                                                   "Int64", "UInt64", "Float32", "Float64", "String", "Bit"};
  Tag tag;
  for (Tags tags(text); tags.next(tag) && tag.name != "AppendedData";) {
    const bool is_array = tag.name == "DataArray" || tag.name == "Array";
    if (is_array && known.count(tag.type) == 0) {
      fail_file(path, "has an array of the unknown type '" + std::string(tag.type.substr(0, 40)) + "'");
    }
    if (is_array) check_components(path, text, tag.n_components);
  }
}

// Returns the type in the VTKFile element at the beginning of an XML file, or "" if there is none.
std::string xml_type(std::string_view head) {
  Tag tag;
  for (Tags tags(head); tags.next(tag);) {
    if (tag.name == "VTKFile") return std::string(tag.type);
  }
  return "";
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
  check_arrays(path, bytes);
}

}  // namespace riis::vtk
