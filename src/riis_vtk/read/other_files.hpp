// SPDX-License-Identifier: Apache-2.0
// Meshes of other programs.
// In: a path. Out: a grid with points in double precision, whose cells have VTK's types and orders of nodes. read_grid checks the
// cells again. No count of a file is believed before the file holds as many bytes as the count needs.
#pragma once

#include <array>
#include <vector>

#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include "riis_vtk/base/files.hpp"

namespace riis::vtk {

// The field array that a grid has if its file holds single precision. riis_vtk_mesh_get_notes reads it.
inline constexpr const char *note_array = "riis_note";
void add_note(vtkUnstructuredGrid *grid, const std::string &note);

// Gmsh's .msh of versions 2 and 4.1, as text or binary (gmsh.cpp).
vtkSmartPointer<vtkUnstructuredGrid> read_gmsh(const std::string &path);

// A case of OpenFOAM, a time of a case, a folder polyMesh, or a file .foam in a case (openfoam.cpp).
bool is_openfoam(const std::string &path);
vtkSmartPointer<vtkUnstructuredGrid> read_openfoam(const std::string &path);
std::string foam_case_of(const std::string &path);

// Whether the path is a folder of a time in a case of OpenFOAM, which may be missing.
bool is_foam_time(const std::string &path);

// XDMF with its data in the file itself or in HDF5 files (xdmf.cpp).
vtkSmartPointer<vtkUnstructuredGrid> read_xdmf(const std::string &path);
void write_xdmf(const std::string &path, vtkUnstructuredGrid *grid);

// Exodus by VTK, and the .vtu files of a .vtm (blocks.cpp).
vtkSmartPointer<vtkUnstructuredGrid> read_exodus(const std::string &path, const CaughtOutput &caught);
vtkSmartPointer<vtkUnstructuredGrid> read_blocks(const std::string &path, const CaughtOutput &caught);

// A mesh while a file is read.
struct PlainGrid {
  vtkNew<vtkDoubleArray> xyz;  // (3, n)
  vtkNew<vtkIdTypeArray>
      ids;  // the nodes of all cells. A polyhedron has the stream of its faces: their number, and then
            // the size and the nodes of each face
  vtkNew<vtkIdTypeArray> ends;  // the first entry is 0, then the end of each cell in ids
  vtkNew<vtkUnsignedCharArray> types;
  bool has_polyhedra = false;

  PlainGrid();
  void add_point(double x, double y, double z) {
    const double point[3] = {x, y, z};
    for (const double coordinate : point) xyz->InsertNextValue(coordinate);
  }
  // Ends the cell whose nodes were appended to ids.
  void end_cell(int vtk_type);
  // Makes the grid. Fails if a coordinate is not finite.
  vtkSmartPointer<vtkUnstructuredGrid> grid(const std::string &path);
};

// The names and the types of the patches of a case's mesh.
std::vector<std::array<std::string, 2>> read_patches(const std::string &foam_case);

// The content of a file, from its beginning to its end, as text or binary numbers. Errors name the file and the position.
class Source {
 public:
  Source(const std::string &path, std::string_view bytes) : path_(path), bytes_(bytes), rest_(bytes) {}

  bool is_binary = false, is_swapped = false;

  std::string_view rest() const { return rest_; }
  void skip(std::size_t n_bytes) { rest_.remove_prefix(n_bytes); }
  std::string_view line() { return take_line(rest_); }
  std::string_view word() { return take_word(rest_); }

  // Returns the number that a word is.
  std::int64_t integer_of(std::string_view text) const;
  double real_of(std::string_view text) const;
  // Reads the next number. A binary one has n_bytes bytes, and a real one of 4 bytes is a float.
  std::int64_t integer(int n_bytes);
  double real(int n_bytes);
  // Returns the next number of things. Fails if the rest of the file cannot hold that many: each takes `least_bytes` or more.
  std::int64_t count(int n_bytes, std::int64_t least_bytes, const char *things);
  void check_count(std::int64_t n, std::int64_t least_bytes, const char *things) const;

  template <class... Parts>
  [[noreturn]] void refuse(const Parts &...parts) const {
    fail_file(path_, place(), joined(parts...));
  }

 private:
  template <class T>
  T raw();
  std::string place() const;

  const std::string &path_;
  std::string_view bytes_, rest_;
};

}  // namespace riis::vtk
