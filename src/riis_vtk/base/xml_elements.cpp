// SPDX-License-Identifier: Apache-2.0
#include <cstring>
#include <exception>

#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkXMLParser.h>

#include "riis_vtk/base/files.hpp"

namespace riis::vtk {
namespace {

class ElementParser : public vtkXMLParser {
 public:
  static ElementParser *New();
  vtkTypeMacro(ElementParser, vtkXMLParser);

  const VisitElement *visit = nullptr;
  std::exception_ptr failure;  // the failure of the function below, which C code calls

 protected:
  void StartElement(const char *name, const char **attributes) override {
    constexpr std::size_t deepest = 3;
    try {
      if (depth_ <= deepest && !failure) {
        way_.resize(depth_);
        way_.emplace_back(name);
        (*visit)(way_, attributes);
      }
    } catch (...) {
      failure = std::current_exception();
    }
    ++depth_;
  }
  void EndElement(const char *) override { --depth_; }

 private:
  std::size_t depth_ = 0;
  std::vector<std::string> way_;
};
vtkStandardNewMacro(ElementParser);

}  // namespace

std::optional<std::string> value_of(XmlAttributes attributes, const char *name) {
  for (; attributes[0] && attributes[1]; attributes += 2)
    if (std::strcmp(attributes[0], name) == 0) return attributes[1];
  return std::nullopt;
}

void for_each_element(const std::string &path, const CaughtOutput &caught, const VisitElement &visit) {
  vtkNew<ElementParser> parser;
  parser->visit = &visit;
  parser->SetFileName(path.c_str());
  const bool parsed = parser->Parse() != 0;
  if (parser->failure) std::rethrow_exception(parser->failure);
  caught.check(path);
  if (!parsed) fail_file(path, "cannot be parsed");
}

}  // namespace riis::vtk
