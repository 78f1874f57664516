// SPDX-License-Identifier: Apache-2.0
// The input is a path. The result is a VTK data set that is as large as the file states, and whose cells refer only to existing
// points. After many errors, VTK continues and returns an incomplete data set. The functions of this header refuse an incomplete
// file. The scans below find most errors before VTK reads the file.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "riis_vtk/base/files.hpp"

class vtkAbstractArray;
class vtkPointSet;
class vtkPolyData;
class vtkUnstructuredGrid;
class vtkXMLDataElement;
class vtkXMLDataParser;

namespace riis::vtk {

// Reads an unstructured grid from a file. All formats of docs/formats.md are allowed. A grid without points is accepted only if
// it is a piece of a mesh.
enum class Points { required, may_be_missing };
vtkSmartPointer<vtkUnstructuredGrid> read_grid(const std::string &path, const CaughtOutput &caught,
                                               Points points = Points::required);

// Fails if an array does not have n values. In the message, `kind` names the kind of data.
void check_array_lengths(const std::string &path, vtkFieldData *data, const char *kind, vtkIdType n);

// Fails if the grid has no points, or if cells have impossible types, sizes or points.
void check_grid(const std::string &path, vtkUnstructuredGrid *grid);

// Reads polydata with at least one point from an XML file .vtp. The polydata may have only polygons and strips as cells.
vtkSmartPointer<vtkPolyData> read_polydata(const std::string &path, const CaughtOutput &caught);

// Reads a legacy .vtk file with polydata or a grid. The data is checked as read_polydata and read_grid check it.
vtkSmartPointer<vtkPointSet> read_legacy_surface(const std::string &path, const CaughtOutput &caught);

// The numbers of nodes of a structured grid along its axes.
struct Lattice {
  std::array<std::int64_t, 3> n;
  std::int64_t n_points() const { return n[0] * n[1] * n[2]; }
  // If an axis has only one node, the grid has no thickness along this axis.
  std::int64_t n_cells() const {
    std::int64_t n_all = 1;
    for (const std::int64_t size : n) n_all *= size > 1 ? size - 1 : 1;
    return n_all;
  }
};
// Fails if the grid has no points, or more points than a mesh may have.
void check_lattice(const std::string &path, const Lattice &lattice);

// Returns the content of a legacy .vtk file. Fails for a kind of data that is not allowed, and for an incomplete file. VTK's
// legacy reader believes every count in a file. VTK's legacy reader takes a truncated file for a smaller mesh, and ends the
// process on some files. Therefore the sections are checked here before VTK reads them.
enum class LegacyKind { unstructured_grid, polydata, structured_points, rectilinear_grid, structured_grid };
enum class LegacyKinds { grid, grid_or_polydata };
struct LegacyContent {
  LegacyKind kind;
  std::int64_t n_cells;
  // The file's bytes, with meshio's names of types replaced by VTK's names. The text is empty if the file has no names of meshio.
  std::string rewritten;
};
LegacyContent check_legacy(const std::string &path, LegacyKinds allowed);
// Returns whether the header says that the file contains a structured grid.
bool is_structured_legacy(const std::string &path);

// Fails if a file is truncated, or is not a VTK XML file of the wanted type. VTK's parser would stop at appended data and not
// look for the end of the file. VTK's parser also crashes on a field array of unknown type. The sizes are checked by XmlSizes.
// `wanted_type` is the type attribute of the file, such as "PolyData".
void check_xml(const std::string &path, const std::string &wanted_type);

// The inputs are a VTK XML file, and VTK's tree of the file's elements. The result is an error if the file states more data than
// it contains. VTK believes every stated number of points, cells, values, bytes and blocks. VTK allocates memory for all this
// data before it reads.
class XmlSizes {
 public:
  explicit XmlSizes(const std::string &path);

  // Fails if an array has fewer values than the file states. The arrays of the pieces and of the field are checked. The parser
  // must have read the elements before this call.
  void check_pieces(vtkXMLDataParser *parser);
  // Fails if the file has fewer than n values for the array of an element. Also fails if the stated size of a binary block
  // exceeds the size of the file.
  void check_values(vtkXMLDataParser *parser, vtkXMLDataElement *element, std::int64_t n, vtkAbstractArray *array);

 private:
  // The data of an element in the file, from `begin` to `end`. The data is text or bytes.
  struct ArrayData {
    enum Form { ascii, base64, raw } form;
    std::size_t begin, end;
  };

  template <class... Parts>
  [[noreturn]] void refuse(vtkXMLDataElement *element, const Parts &...parts) const;
  ArrayData data_of(vtkXMLDataParser *parser, vtkXMLDataElement *element) const;
  std::vector<std::uint64_t> words(const ArrayData &data, int size, bool is_big, std::uint64_t n) const;
  std::uint64_t n_bytes_in(vtkXMLDataParser *parser, vtkXMLDataElement *element, const ArrayData &data) const;
  void check_bits(vtkXMLDataParser *parser, vtkXMLDataElement *element, std::int64_t n, std::uint64_t n_bits);
  void check_array(vtkXMLDataParser *parser, vtkXMLDataElement *element, std::int64_t n);
  void check_piece(vtkXMLDataParser *parser, vtkXMLDataElement *piece);
  void check_cells(vtkXMLDataParser *parser, vtkXMLDataElement *cells, std::int64_t n);
  std::int64_t count(vtkXMLDataElement *element, const char *attribute) const;
  std::array<int, 6> extent(vtkXMLDataElement *element, const char *attribute) const;
  Lattice lattice(vtkXMLDataElement *element) const;
  void check_extents(vtkXMLDataElement *primary) const;

  const std::string &path_;
  MappedFile file_;
  std::string_view bytes_;
  // The size of an element that was checked: how many bytes it has, or how many numbers its text has.
  struct Held {
    std::uint64_t n = 0;
    bool is_text = false;
  };
  std::map<vtkXMLDataElement *, Held> held_;
};

}  // namespace riis::vtk
