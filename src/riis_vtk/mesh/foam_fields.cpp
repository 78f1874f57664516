// SPDX-License-Identifier: Apache-2.0
// Writes cell arrays as fields of OpenFOAM into the folder of a time. The fields are of the types volScalarField and
// volVectorField. They are written as text. Each number has the fewest digits from which the same double is read back. On a
// patch, the field has the values of the cells beside the patch. If OpenFOAM prescribes the type of a patch, such as empty or
// cyclic, the field also has this type.
#include <riis/riis_vtk.h>

#include <algorithm>
#include <filesystem>

#include <vtkCellData.h>

#include "common/array_view.hpp"
#include "riis_vtk/mesh/mesh.hpp"
#include "riis_vtk/read/other_files.hpp"

namespace riis::vtk {
namespace {

namespace fs = std::filesystem;

// Returns the name of OpenFOAM's field for an array. The array riis_K becomes K, and riis_K_u_surface becomes Ku. Names with
// other prefixes are not changed.
std::string field_of(const std::string &array) {
  const std::string prefix = std::string(default_prefix) + "_", velocity = "K_u_surface";
  std::string name = array.rfind(prefix, 0) == 0 ? array.substr(prefix.size()) : array;
  if (name.size() >= velocity.size() && name.compare(name.size() - velocity.size(), velocity.size(), velocity) == 0)
    name = name.substr(0, name.size() - velocity.size()) + "Ku";
  return name;
}

bool ends_with(const std::string &text, const std::string &end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

// OpenFOAM compares the dimensions of fields. For an incompressible fluid, OpenFOAM divides the momentum equation by the density,
// so K is also divided by the density.
const char *dimensions_of(const std::string &array) {
  if (ends_with(array, "K")) return "[0 0 -1 0 0 0 0]";
  if (ends_with(array, "K_u_surface")) return "[0 1 -2 0 0 0 0]";
  if (ends_with(array, "_distance")) return "[0 1 0 0 0 0 0]";
  return ends_with(array, "_velocity") ? "[0 1 -1 0 0 0 0]" : "[0 0 0 0 0 0 0]";
}

// On a patch of one of these types, a field must have the patch's own type.
bool is_constraint(const std::string &type) {
  const char *const types[] = {"empty",
                               "wedge",
                               "symmetry",
                               "symmetryPlane",
                               "cyclic",
                               "cyclicAMI",
                               "cyclicACMI",
                               "cyclicSlip",
                               "processor",
                               "processorCyclic",
                               "nonuniformTransformCyclic"};
  return std::find(std::begin(types), std::end(types), type) != std::end(types);
}

std::string text_of(const std::string &name, vtkDataArray *array, const char *dimensions, const std::string &time,
                    const std::vector<std::array<std::string, 2>> &patches) {
  const bool is_vector = array->GetNumberOfComponents() == 3;
  std::string text =
      joined("FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       ",
             is_vector ? "volVectorField" : "volScalarField", ";\n    location    \"", time, "\";\n    object      ",
             name, ";\n}\n\ndimensions      ", dimensions, ";\n\ninternalField   nonuniform List<",
             is_vector ? "vector" : "scalar", ">\n", array->GetNumberOfTuples(), "\n(\n");
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i) {
    double value[3];
    array->GetTuple(i, value);
    text += is_vector ? joined("(", value[0], " ", value[1], " ", value[2], ")\n") : joined(value[0], "\n");
  }
  text += ")\n;\n\nboundaryField\n{\n";
  for (const auto &[patch, type] : patches)
    text += joined("    ", patch, "\n    {\n        type            ", is_constraint(type) ? type : "zeroGradient",
                   ";\n    }\n");
  return text + "}\n";
}

}  // namespace

void write_foam_fields(const std::string &path, const riis_vtk_mesh &mesh) {
  fs::path folder = path;
  if (!folder.has_filename()) folder = folder.parent_path();
  std::error_code error;
  const std::string foam_case = foam_case_of(folder.string());
  if (mesh.foam_case.empty() || !fs::equivalent(foam_case, mesh.foam_case, error))
    fail_file(path, "is a time folder of a case, but the mesh was not read from this case");
  if (!mesh.centers) fail_file(path, "holds only fields of cells, but the nodes of the mesh are not centres of cells");
  const auto patches = read_patches(foam_case);
  fs::create_directory(folder, error);
  if (error) fail_file(path, "cannot be made: ", error.message());
  vtkCellData *const data = mesh.data->GetCellData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i) {
    vtkDataArray *const array = data->GetArray(i);
    if (!array || !array->GetName() || (array->GetNumberOfComponents() != 1 && array->GetNumberOfComponents() != 3))
      continue;
    const std::string name = field_of(array->GetName());
    const std::string text = text_of(name, array, dimensions_of(array->GetName()), folder.filename().string(), patches);
    ReplacingFile file((folder / name).string());
    file.write(reinterpret_cast<const unsigned char *>(text.data()), static_cast<std::int64_t>(text.size()));
    file.commit("}\n");
  }
}

}  // namespace riis::vtk
