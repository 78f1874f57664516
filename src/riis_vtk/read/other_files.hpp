// SPDX-License-Identifier: Apache-2.0
// Meshes and surfaces of other programs.
// In: a path. Out: a grid with points in double precision, whose cells have VTK's types and orders of nodes. read_grid checks the
// cells again. No count of a file is believed before the file is known to hold as many bytes as the count needs.
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include "riis_vtk/base/files.hpp"

namespace riis::vtk {

// The field array that a grid has if its file holds single precision. riis_vtk_mesh_get_notes reads it.
inline constexpr const char *note_array = "riis_note";
// The cell array with the first of gmsh's physical groups. Arrays of its name, _2, _3 and so on have further groups, or 0.
inline constexpr const char *physical_array = "gmsh:physical";
// The field array with the numbers and the names of the physical groups of volumes, in turn.
inline constexpr const char *region_names_array = "riis_region_names";
void add_note(vtkUnstructuredGrid *grid, const std::string &note);

// Gmsh's .msh of versions 2 and 4.1, as text or binary (gmsh.cpp).
vtkSmartPointer<vtkUnstructuredGrid> read_gmsh(const std::string &path);

// A case of OpenFOAM, a time of a case, a folder polyMesh, or a file .foam in a case (openfoam.cpp).
bool is_openfoam(const std::string &path);
vtkSmartPointer<vtkUnstructuredGrid> read_openfoam(const std::string &path);
std::string foam_case_of(const std::string &path);

// Whether the path is a folder of a time in a case of OpenFOAM. The folder may be missing.
bool is_foam_time(const std::string &path);

// XDMF with its data in the file itself or in HDF5 files (xdmf.cpp).
vtkSmartPointer<vtkUnstructuredGrid> read_xdmf(const std::string &path);
void write_xdmf(const std::string &path, vtkUnstructuredGrid *grid);

// Exodus by VTK, and the .vtu files of a .vtm (blocks.cpp).
vtkSmartPointer<vtkUnstructuredGrid> read_exodus(const std::string &path, const CaughtOutput &caught);
vtkSmartPointer<vtkUnstructuredGrid> read_blocks(const std::string &path, const CaughtOutput &caught);

// Surfaces: the polygons of .obj and .ply files, with the vertices of the file (obj.cpp, ply.cpp).
vtkSmartPointer<vtkUnstructuredGrid> read_obj(const std::string &path);
vtkSmartPointer<vtkUnstructuredGrid> read_ply(const std::string &path);

// A mesh while a file is read.
struct PlainGrid {
  vtkNew<vtkDoubleArray> xyz;  // (3, n)
  vtkNew<vtkIdTypeArray>
      ids;  // the nodes of all cells. A polyhedron has the stream of its faces: their number, and then
            // the size and the nodes of each face
  vtkNew<vtkIdTypeArray> ends;  // the first entry is 0; then follows the end of each cell in ids
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

  // Returns the number that a word stands for.
  std::int64_t integer_of(std::string_view text) const;
  double real_of(std::string_view text) const;
  // Reads the next number. A binary number has n_bytes bytes. A real number of 4 bytes is a float.
  std::int64_t integer(int n_bytes);
  double real(int n_bytes);
  // Reads the next binary number of this type.
  template <class T>
  T raw();
  // Returns the next count. Fails if the rest of the file cannot hold so many items, of which each takes `least_bytes` or more.
  std::int64_t count(int n_bytes, std::int64_t least_bytes, const char *things);
  void check_count(std::int64_t n, std::int64_t least_bytes, const char *things) const;

  template <class... Parts>
  [[noreturn]] void refuse(const Parts &...parts) const {
    fail_file(path_, place(), joined(parts...));
  }

 private:
  std::string place() const;

  const std::string &path_;
  std::string_view bytes_, rest_;
};

// In: the bytes of an XML file. Out: its elements. Elements suffice for XDMF and .vtm files: names, attributes, and the text
// before an element's first child. Declarations and comments are skipped, and a document type is not followed.
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

// Datasets of HDF5 files. Only hdf5_file.cpp includes HDF5's headers, and riis_vtk can be built without HDF5. HDF5 itself can
// crash on a damaged file.

// Whether this build has HDF5.
extern const bool has_hdf5;

// Reads n numbers of a dataset as doubles or as 64-bit integers. Fails unless the dataset has exactly n numbers and the file
// holds them all. is_single tells whether they are real numbers of 32 bits in the file.
template <class Number>
std::vector<Number> read_hdf5(const std::string &path, const std::string &name, std::int64_t n, bool &is_single);

// Writes an HDF5 file. Like a ReplacingFile, the file gets its name when it is complete.
class Hdf5Writer {
 public:
  explicit Hdf5Writer(const std::string &path);
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer &) = delete;
  Hdf5Writer &operator=(const Hdf5Writer &) = delete;

  const std::string &path() const { return path_; }
  void write(const std::string &dataset, const double *values, std::int64_t n_rows, std::int64_t n_columns);
  void write(const std::string &dataset, const std::int64_t *values, std::int64_t n_rows, std::int64_t n_columns);
  void commit();

 private:
  void close();

  std::string path_;
  ReplacingFile file_;
  std::int64_t id_ = -1;  // HDF5's identifier of the file; below 0 if it is closed
};

}  // namespace riis::vtk
