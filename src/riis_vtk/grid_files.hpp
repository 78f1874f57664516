// SPDX-License-Identifier: Apache-2.0
// In: a path. Out: a VTK data set that has the sizes that the file promised and whose cells name only points that exist. VTK
// continues after many errors and returns an incomplete data set. Here an incomplete file is an error. The scans below find
// most errors before VTK reads the file.
#pragma once

#include <map>
#include <vector>

#include "riis_vtk/files.hpp"

class vtkAbstractArray;
class vtkPolyData;
class vtkUnstructuredGrid;
class vtkXMLDataElement;
class vtkXMLDataParser;

namespace riis::vtk {

// Reads an unstructured grid with at least one point from a .vtu (XML) or .vtk (legacy) file.
vtkSmartPointer<vtkUnstructuredGrid> read_grid(const std::string &path, const CaughtOutput &caught);

// Reads polydata with at least one point from a .vtp (XML) file. The cells are polygons and strips only.
vtkSmartPointer<vtkPolyData> read_polydata(const std::string &path, const CaughtOutput &caught);

// Returns the number of cells of a legacy .vtk file. Fails for a file that is not an unstructured grid or not complete. VTK's
// legacy reader believes every count, reads a truncated file as a smaller one, and ends the process on some files. So the
// sections are checked here before VTK reads them.
std::int64_t check_legacy(const std::string &path);

// Fails for a file that is no VTK XML file of the wanted type, and for a truncated file. VTK's parser stops at appended data
// and does not look for the end of the file. It crashes on a field array of unknown type. Sizes are for XmlSizes. wanted_type
// is the type attribute of the file, such as "PolyData".
void check_xml(const std::string &path, const std::string &wanted_type);

// In: a VTK XML file, and VTK's tree of its elements. Out: nothing, or an error if the file claims more than it holds. VTK
// believes each number of points, cells, values, bytes and blocks, and allocates that much memory before it reads.
class XmlSizes {
 public:
  explicit XmlSizes(const std::string &path);

  // Fails unless the arrays of all pieces and of the field hold as many values as the file claims. The parser must have read
  // the elements.
  void check_pieces(vtkXMLDataParser *parser);
  // Fails unless the file holds n values of the array's type for an element. It also fails if a block of binary data claims to
  // be larger than the file.
  void check_values(vtkXMLDataParser *parser, vtkXMLDataElement *element, std::int64_t n, vtkAbstractArray *array);

 private:
  // The data of an element: text in the file from begin to end, or bytes.
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

  const std::string &path_;
  MappedFile file_;
  std::string_view bytes_;
  // The size of each checked element: its bytes, or the numbers in its text.
  struct Held {
    std::uint64_t n = 0;
    bool is_text = false;
  };
  std::map<vtkXMLDataElement *, Held> held_;
};

}  // namespace riis::vtk
