// SPDX-License-Identifier: Apache-2.0
// In: a path. Out: a VTK data set that has the sizes stated in the file, and whose cells refer only to existing points. VTK
// continues after many errors and returns an incomplete data set. The functions of this file refuse an incomplete file. The scans
// declared below find most errors before VTK reads the file.
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

// Reads an unstructured grid from a file of any of the formats of docs/formats.md. Only a piece of a mesh may be without points.
enum class Points { required, may_be_missing };
vtkSmartPointer<vtkUnstructuredGrid> read_grid(const std::string &path, const CaughtOutput &caught,
                                               Points points = Points::required);

// Fails unless each array has n values. `kind` names the kind of data in the message.
void check_array_lengths(const std::string &path, vtkFieldData *data, const char *kind, vtkIdType n);

// Fails unless the grid has points, and its cells have types, sizes and points that exist.
void check_grid(const std::string &path, vtkUnstructuredGrid *grid);

// Reads polydata with at least one point from a .vtp (XML) file. The cells of polydata are only polygons and strips.
vtkSmartPointer<vtkPolyData> read_polydata(const std::string &path, const CaughtOutput &caught);

// Reads a legacy .vtk file with polydata or with a grid, checked as by read_polydata and read_grid.
vtkSmartPointer<vtkPointSet> read_legacy_surface(const std::string &path, const CaughtOutput &caught);

// The nodes of a structured grid along its axes.
struct Lattice {
  std::array<std::int64_t, 3> n;
  std::int64_t n_points() const { return n[0] * n[1] * n[2]; }
  // An axis with one node has no thickness.
  std::int64_t n_cells() const {
    std::int64_t n_all = 1;
    for (const std::int64_t size : n) n_all *= size > 1 ? size - 1 : 1;
    return n_all;
  }
};
// Fails if the grid has no points, or more points than a mesh may have.
void check_lattice(const std::string &path, const Lattice &lattice);

// Returns the content of a legacy .vtk file. Fails for another kind of data and for a file that is not complete. VTK's legacy
// reader believes every count, reads a truncated file as a smaller one, and ends the process on some files. This function
// therefore checks the sections before VTK reads them.
enum class LegacyKind { unstructured_grid, polydata, structured_points, rectilinear_grid, structured_grid };
enum class LegacyKinds { grid, grid_or_polydata };
struct LegacyContent {
  LegacyKind kind;
  std::int64_t n_cells;
};
LegacyContent check_legacy(const std::string &path, LegacyKinds allowed);
// Returns whether the header says that the file has a grid of one of the structured kinds.
bool is_structured_legacy(const std::string &path);

// Fails for a file that is truncated or is not a VTK XML file of the wanted type. VTK's parser would stop at appended data
// without looking for the end of the file, and it crashes on a field array of unknown type. XmlSizes checks the sizes.
// `wanted_type` is the file's type attribute, such as "PolyData".
void check_xml(const std::string &path, const std::string &wanted_type);

// In: a VTK XML file, and VTK's tree of its elements. Out: an error if the file claims more than it holds. VTK believes every
// stated number of points, cells, values, bytes and blocks, and allocates that much memory before it reads.
class XmlSizes {
 public:
  explicit XmlSizes(const std::string &path);

  // Fails unless the arrays of all pieces and of the field hold as many values as the file claims. The parser must already have
  // read the elements.
  void check_pieces(vtkXMLDataParser *parser);
  // Fails unless the file holds n values of the array's type for an element. Also fails if a block of binary data claims to be
  // larger than the file.
  void check_values(vtkXMLDataParser *parser, vtkXMLDataElement *element, std::int64_t n, vtkAbstractArray *array);

 private:
  // The data of an element, from `begin` to `end` in the file. It is text or bytes.
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
  // The size of a checked element: its number of bytes, or the number of numbers in its text.
  struct Held {
    std::uint64_t n = 0;
    bool is_text = false;
  };
  std::map<vtkXMLDataElement *, Held> held_;
};

}  // namespace riis::vtk
