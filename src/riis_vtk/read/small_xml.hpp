// SPDX-License-Identifier: Apache-2.0
// In: the bytes of an XML file. Out: its elements. This is enough for XDMF and .vtm files: names, attributes, and the text before
// an element's first child. Declarations and comments are skipped, and a document type is not followed.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace riis::vtk {

struct XmlElement {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string_view text;  // part of the file's bytes
  std::vector<XmlElement> children;

  // Returns the attribute, or "".
  std::string attribute(const std::string &attribute_name) const;
  // Returns the first child of that name, or NULL.
  const XmlElement *child(const std::string &child_name) const;
};

// Returns the outermost element. Fails if the file is truncated or not XML. Elements are at most 64 deep.
XmlElement parse_xml(const std::string &path, std::string_view bytes);

// Returns the text with the five predefined entities replaced.
std::string plain_text(std::string_view text);

}  // namespace riis::vtk
