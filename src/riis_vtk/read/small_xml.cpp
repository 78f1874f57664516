// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/read/other_files.hpp"

#include <algorithm>

#include "common/byte_order_mark.hpp"
#include "riis_vtk/base/files.hpp"

namespace riis::vtk {
namespace {

class XmlParser {
 public:
  XmlParser(const std::string &path, std::string_view bytes) : path_(path), bytes_(bytes), rest_(bytes) {}

  XmlElement document() {
    // A byte of value 0 would end the name of a file too early.
    if (bytes_.find('\0') != std::string_view::npos) fail_file(path_, "is not an XML file: it holds a byte of value 0");
    rest_ = without_byte_order_mark(rest_);
    skip_to_tag();
    if (rest_.empty()) fail_file(path_, "is not an XML file");
    XmlElement outermost = element(0);
    skip_to_tag();
    if (!rest_.empty()) refuse("holds more than one outermost element");
    return outermost;
  }

 private:
  template <class... Parts>
  [[noreturn]] void refuse(const Parts &...parts) const {
    const auto line = 1 + std::count(bytes_.begin(), bytes_.begin() + (rest_.data() - bytes_.data()), '\n');
    fail_file(path_, "line ", line, ": ", joined(parts...));
  }
  [[noreturn]] void truncated() const { fail_file(path_, "is truncated: its XML has no end"); }

  void skip_past(std::string_view end) {
    const std::size_t at = rest_.find(end);
    if (at == std::string_view::npos) truncated();
    rest_.remove_prefix(at + end.size());
  }

  // Skips blanks, comments and declarations.
  void skip_to_tag() {
    for (;;) {
      const auto begin = std::find_if_not(rest_.begin(), rest_.end(), is_blank);
      rest_.remove_prefix(static_cast<std::size_t>(begin - rest_.begin()));
      if (rest_.substr(0, 4) == "<!--") {
        skip_past("-->");
      } else if (rest_.substr(0, 2) == "<?") {
        skip_past("?>");
      } else if (rest_.substr(0, 2) == "<!") {
        const std::string_view declaration = rest_.substr(0, rest_.find('>'));
        if (declaration.find('[') == std::string_view::npos) {
          skip_past(">");
        } else {
          skip_past("]");
          skip_past(">");
        }
      } else {
        if (!rest_.empty() && rest_[0] != '<') refuse("text stands where there must be an element");
        return;
      }
    }
  }

  std::string name() {
    const auto ends = [](char c) { return is_blank(c) || c == '=' || c == '>' || c == '/' || c == '<'; };
    const auto end = std::find_if(rest_.begin(), rest_.end(), ends);
    const auto length = static_cast<std::size_t>(end - rest_.begin());
    if (length == 0) refuse("a name is missing");
    const std::string found(rest_.substr(0, length));
    rest_.remove_prefix(length);
    return found;
  }

  void skip_blanks() {
    const auto begin = std::find_if_not(rest_.begin(), rest_.end(), is_blank);
    rest_.remove_prefix(static_cast<std::size_t>(begin - rest_.begin()));
    if (rest_.empty()) truncated();
  }

  void read_attribute(XmlElement &element) {
    const std::string key = name();
    skip_blanks();
    if (rest_[0] != '=') refuse("the attribute ", key.substr(0, 40), " has no value");
    rest_.remove_prefix(1);
    skip_blanks();
    const char quote = rest_[0];
    if (quote != '"' && quote != '\'') refuse("the value of the attribute ", key.substr(0, 40), " has no quotes");
    rest_.remove_prefix(1);
    const std::size_t length = rest_.find(quote);
    if (length == std::string_view::npos) truncated();
    element.attributes[key] = plain_text(rest_.substr(0, length));
    rest_.remove_prefix(length + 1);
  }

  // Reads an element. The next character is the element's "<".
  XmlElement element(int depth) {
    if (depth > 64) refuse("elements are more than 64 deep");
    rest_.remove_prefix(1);
    XmlElement made;
    made.name = name();
    for (skip_blanks(); rest_[0] != '>' && rest_[0] != '/'; skip_blanks()) read_attribute(made);
    if (rest_[0] == '/') {
      made.text = rest_.substr(0, 0);
      skip_past(">");
      return made;
    }
    rest_.remove_prefix(1);
    made.text = rest_.substr(0, std::min(rest_.find('<'), rest_.size()));
    for (;;) {
      const std::size_t next = rest_.find('<');
      if (next == std::string_view::npos) truncated();
      rest_.remove_prefix(next);
      if (rest_.substr(0, 2) == "<!" || rest_.substr(0, 2) == "<?") {
        skip_past(rest_.substr(0, 4) == "<!--" ? "-->" : ">");
      } else if (rest_.substr(0, 2) == "</") {
        rest_.remove_prefix(2);
        const std::string closed = name();
        if (closed != made.name)
          refuse("</", closed.substr(0, 40), "> stands where there must be </", made.name.substr(0, 40), ">");
        skip_past(">");
        return made;
      } else {
        made.children.push_back(element(depth + 1));
      }
    }
  }

  const std::string &path_;
  std::string_view bytes_, rest_;
};

}  // namespace

std::string XmlElement::attribute(const std::string &attribute_name) const {
  const auto found = attributes.find(attribute_name);
  return found == attributes.end() ? "" : found->second;
}

const XmlElement *XmlElement::child(const std::string &child_name) const {
  const auto found =
      std::find_if(children.begin(), children.end(), [&](const XmlElement &child) { return child.name == child_name; });
  return found == children.end() ? nullptr : &*found;
}

XmlElement parse_xml(const std::string &path, std::string_view bytes) { return XmlParser(path, bytes).document(); }

std::string plain_text(std::string_view text) {
  static const std::pair<std::string_view, char> entities[] = {
      {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}, {"&amp;", '&'}};
  std::string plain;
  while (!text.empty()) {
    const auto *const found = std::find_if(std::begin(entities), std::end(entities), [&](const auto &entity) {
      return text.substr(0, entity.first.size()) == entity.first;
    });
    plain += found == std::end(entities) ? text[0] : found->second;
    text.remove_prefix(found == std::end(entities) ? 1 : found->first.size());
  }
  return plain;
}

}  // namespace riis::vtk
