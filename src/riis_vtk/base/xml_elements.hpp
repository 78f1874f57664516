// SPDX-License-Identifier: Apache-2.0
// Reads an XML file element by element. It builds no tree, because a hostile file could nest so deeply that destroying the tree
// would overflow the stack.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "riis_vtk/base/vtk_errors.hpp"

namespace riis::vtk {

// Names and values in turn, and then NULL.
using XmlAttributes = const char **;
std::optional<std::string> value_of(XmlAttributes attributes, const char *name);

// Calls visit(way, attributes) for each element that lies at most three elements deep. `way` has the names of the elements around
// it, from the outermost one, and then its own name. Fails if the file is not XML.
using VisitElement = std::function<void(const std::vector<std::string> &way, XmlAttributes attributes)>;
void for_each_element(const std::string &path, const CaughtOutput &caught, const VisitElement &visit);

}  // namespace riis::vtk
