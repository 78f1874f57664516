// SPDX-License-Identifier: Apache-2.0
// In: a VTK XML file, and VTK's tree of its elements. Out: nothing, or an error where the file claims more than it holds. VTK
// believes each number of points, cells, values, bytes and blocks: it takes memory for all that is claimed before it reads.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "riis_vtk/files.hpp"

class vtkAbstractArray;
class vtkXMLDataElement;
class vtkXMLDataParser;

namespace riis::vtk {

class XmlSizes {
 public:
  explicit XmlSizes(const std::string &path);

  // Fails unless the arrays of all pieces, and those of the field, hold as many values as are promised. The parser must have
  // read the elements.
  void check_pieces(vtkXMLDataParser *parser);
  // Fails unless the file holds n values for an element, of the size that the array's values have. It also fails if a block of
  // binary data claims to be larger than the file.
  void check_values(vtkXMLDataParser *parser, vtkXMLDataElement *element, std::int64_t n, vtkAbstractArray *array);

 private:
  // The data of an element: text in the file from begin to end, or bytes.
  struct Place {
    enum Form { ascii, base64, raw } form;
    std::size_t begin, end;
  };

  [[noreturn]] void refuse(vtkXMLDataElement *element, const std::string &reason) const;
  Place place_of(vtkXMLDataParser *parser, vtkXMLDataElement *element) const;
  std::vector<std::uint64_t> words(const Place &place, int size, bool is_big, std::uint64_t n) const;
  std::uint64_t n_bytes_in(vtkXMLDataParser *parser, vtkXMLDataElement *element, const Place &place) const;
  void check_bits(vtkXMLDataParser *parser, vtkXMLDataElement *element, std::int64_t n, std::uint64_t n_bits);
  void check_array(vtkXMLDataParser *parser, vtkXMLDataElement *element, std::int64_t n);
  void check_piece(vtkXMLDataParser *parser, vtkXMLDataElement *piece);
  void check_cells(vtkXMLDataParser *parser, vtkXMLDataElement *cells, std::int64_t n);
  std::int64_t count(vtkXMLDataElement *element, const char *attribute) const;

  const std::string &path_;
  MappedFile file_;
  std::string_view bytes_;
  // What each element that was looked at holds: bytes, or numbers of a text.
  struct Held {
    std::uint64_t n = 0;
    bool is_text = false;
  };
  std::map<vtkXMLDataElement *, Held> held_;
};

}  // namespace riis::vtk
