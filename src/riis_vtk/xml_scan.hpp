// SPDX-License-Identifier: Apache-2.0
// In: the path of a VTK XML file. Out: nothing, or an error for a file of another kind or a file that is cut off. VTK's parser
// stops at appended data without looking for the end of the file. It crashes on a field array whose type it does not know. Sizes
// are for xml_sizes.hpp.
#pragma once

#include <string>

namespace riis::vtk {

// wanted_type is the type attribute of the file, such as "PolyData".
void check_xml(const std::string &path, const std::string &wanted_type);

}  // namespace riis::vtk
