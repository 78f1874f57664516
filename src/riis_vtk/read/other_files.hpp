// SPDX-License-Identifier: Apache-2.0
// Reads meshes and surfaces in formats of other programs.
// The input is a path. The result is a grid with points in double precision. The cells of the grid have VTK's types and VTK's
// order of nodes. read_grid checks the cells again. A stated count is believed only if the file has enough bytes for the counted
// items.
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

// The name of a field array with a note, which a reader adds if the numbers in the file have single precision.
// riis_vtk_mesh_get_notes returns this note.
inline constexpr const char *note_array = "riis_note";
// The cell array with the first physical group of each cell, as gmsh gives it. Arrays with this name and an added _2, _3 and so
// on have further groups, or 0.
inline constexpr const char *physical_array = "gmsh:physical";
// A field array in which the numbers and the names of the physical groups of volumes alternate.
inline constexpr const char *region_names_array = "riis_region_names";
void add_note(vtkUnstructuredGrid *grid, const std::string &note);

// Reads gmsh's .msh files of versions 2 and 4.1, as text or binary (gmsh.cpp).
vtkSmartPointer<vtkUnstructuredGrid> read_gmsh(const std::string &path);

// Reads a case of OpenFOAM. The path is the case, a time of the case, a folder polyMesh, or a file .foam in the case
// (openfoam.cpp).
bool is_openfoam(const std::string &path);
vtkSmartPointer<vtkUnstructuredGrid> read_openfoam(const std::string &path);
std::string foam_case_of(const std::string &path);

// Returns whether the path is the folder of a time in an OpenFOAM case. The folder need not exist.
bool is_foam_time(const std::string &path);
// Returns the written times of a case of OpenFOAM as text, such as "0, 0.02, ..., 0.8".
std::string foam_times_of(const std::string &foam_case);
// Reads a field of vectors in the cells, such as U, from the folder of a time.
vtkSmartPointer<vtkDoubleArray> read_foam_vectors(const std::string &folder, const std::string &name,
                                                  std::int64_t n_cells);

// Reads XDMF files, whose data is in the file or in HDF5 files (xdmf.cpp).
vtkSmartPointer<vtkUnstructuredGrid> read_xdmf(const std::string &path);
void write_xdmf(const std::string &path, vtkUnstructuredGrid *grid);

// Reads Exodus files by VTK, and the .vtu files that a .vtm file lists (blocks.cpp).
vtkSmartPointer<vtkUnstructuredGrid> read_exodus(const std::string &path, const CaughtOutput &caught);
vtkSmartPointer<vtkUnstructuredGrid> read_blocks(const std::string &path, const CaughtOutput &caught);

// Reads surfaces: the polygons of .obj and .ply files, with all vertices of the file (obj.cpp, ply.cpp).
vtkSmartPointer<vtkUnstructuredGrid> read_obj(const std::string &path);
vtkSmartPointer<vtkUnstructuredGrid> read_ply(const std::string &path);

// A mesh whose file is being read now.
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

// The content of a file, which is read from its beginning to its end. Numbers are text or binary. Error messages name the file
// and the position.
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
  // Reads the next number. A binary number has n_bytes bytes: 4 or 8, and a whole number also 1 or 2. A real number with 4 bytes
  // is a float.
  std::int64_t integer(int n_bytes, bool is_unsigned = false);
  double real(int n_bytes);
  // Reads the next binary number of this type.
  template <class T>
  T raw();
  // Reads and returns a count. Fails if the rest of the file is too short for so many items. Each item takes at least
  // `least_bytes` bytes.
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

// The inputs are the bytes of an XML file, and the results are its elements. For XDMF and .vtm files it suffices to know the
// elements: names, attributes, and the text before an element's first child. Declarations and comments are skipped. A document
// type is ignored.
struct XmlElement {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string_view text;  // part of the file's bytes
  std::vector<XmlElement> children;

  // Returns the value of the attribute, or "" if it is missing.
  std::string attribute(const std::string &attribute_name) const;
  // Returns the first child with this name, or NULL.
  const XmlElement *child(const std::string &child_name) const;
};

// Returns the outermost element. Fails if the file is truncated or is not XML. Elements may be nested at most 64 deep.
XmlElement parse_xml(const std::string &path, std::string_view bytes);

// Returns the text with the five predefined entities replaced by their characters.
std::string plain_text(std::string_view text);

// Reads datasets of HDF5 files. Only hdf5_file.cpp includes HDF5's headers, and riis_vtk can be built without HDF5. A damaged
// file can crash the HDF5 library.

// Tells whether this build of riis_vtk has HDF5.
extern const bool has_hdf5;

// Reads n numbers of a dataset as doubles or as 64-bit integers. Fails if the dataset has fewer or more numbers, or if numbers
// are missing in the file. `is_single` tells whether the numbers are real numbers of 32 bits in the file.
template <class Number>
std::vector<Number> read_hdf5(const std::string &path, const std::string &name, std::int64_t n, bool &is_single);

// Writes an HDF5 file, which gets its name only when it is complete, like a ReplacingFile.
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
