// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/xml_sizes.hpp"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <limits>
#include <utility>

#include <vtkAbstractArray.h>
#include <vtkDataCompressor.h>
#include <vtkEndian.h>
#include <vtkType.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>

#include "riis_vtk/vtk_errors.hpp"

namespace riis::vtk {
namespace {

// Returns the fewest bits that a value takes. A string takes at least the byte that ends it.
std::uint64_t bits_of(const char *type) {
  static const std::map<std::string_view, std::uint64_t> sizes = {{"Bit", 1},    {"Int16", 16},  {"UInt16", 16},
                                                                  {"Int32", 32}, {"UInt32", 32}, {"Float32", 32},
                                                                  {"Int64", 64}, {"UInt64", 64}, {"Float64", 64}};
  const auto found = sizes.find(type ? type : "");
  return found == sizes.end() ? 8 : found->second;
}

std::uint64_t bits_of(vtkAbstractArray *array) {
  if (array->GetDataType() == VTK_BIT) return 1;
  if (array->GetDataType() == VTK_STRING) return 8;
  return 8 * static_cast<std::uint64_t>(array->GetDataTypeSize());
}

// The most bytes that a byte of compressed data stands for. Runs of zeros take 1/1032 of their size by zlib, 1/255 by LZ4. LZMA
// has no such bound: 1/7000 was measured.
std::uint64_t most_from_a_byte(vtkDataCompressor *compressor) {
  return std::strcmp(compressor->GetClassName(), "vtkLZMADataCompressor") == 0 ? 20'000 : 1'100;
}

// Returns the six bits of a character of base64, and 0 for the filling behind the data. Its other characters do not matter here:
// VTK stops at them.
std::uint32_t bits_of_character(char c) {
  if (c >= 'A' && c <= 'Z') return static_cast<std::uint32_t>(c - 'A');
  if (c >= 'a' && c <= 'z') return static_cast<std::uint32_t>(c - 'a' + 26);
  if (c >= '0' && c <= '9') return static_cast<std::uint32_t>(c - '0' + 52);
  return c == '+' ? 62 : c == '/' ? 63 : 0;
}

bool is_named(vtkXMLDataElement *element, const char *name) { return std::strcmp(element->GetName(), name) == 0; }

template <class Visit>
void for_each_nested(vtkXMLDataElement *element, const Visit &visit) {
  for (int i = 0; i < element->GetNumberOfNestedElements(); ++i) visit(element->GetNestedElement(i));
}

}  // namespace

XmlSizes::XmlSizes(const std::string &path) : path_(path), file_(path, check_readable(path)), bytes_(file_.bytes()) {}

void XmlSizes::refuse(vtkXMLDataElement *element, const std::string &reason) const {
  const char *name = element->GetAttribute("Name");
  fail_file(path_, "is damaged: array " + (name ? std::string(name).substr(0, 40) : "without a name") + " " + reason);
}

// Finds the data as VTK does: appended data if there is an offset, whatever the format is.
XmlSizes::Place XmlSizes::place_of(vtkXMLDataParser *parser, vtkXMLDataElement *element) const {
  const std::size_t size = bytes_.size();
  if (element->GetAttribute("offset")) {
    vtkTypeInt64 offset = 0;
    element->GetScalarAttribute("offset", offset);
    vtkXMLDataElement *appended = parser->GetRootElement()->FindNestedElementWithName("AppendedData");
    const char *encoding = appended ? appended->GetAttribute("encoding") : nullptr;
    const vtkTypeInt64 start = parser->GetAppendedDataPosition();
    // A sum that might overflow is not made.
    const bool is_inside = offset >= 0 && start >= 0 && start <= static_cast<vtkTypeInt64>(size) &&
                           offset <= static_cast<vtkTypeInt64>(size) - start;
    return {encoding && std::strcmp(encoding, "raw") == 0 ? Place::raw : Place::base64,
            is_inside ? static_cast<std::size_t>(start + offset) : size, size};
  }
  const char *format = element->GetAttribute("format");
  std::size_t begin = std::min(bytes_.find('>', static_cast<std::size_t>(element->GetXMLByteIndex())), size - 1) + 1;
  while (begin < size && std::isspace(static_cast<unsigned char>(bytes_[begin]))) ++begin;
  return {format && std::strcmp(format, "binary") == 0 ? Place::base64 : Place::ascii, begin,
          std::min(bytes_.find('<', begin), size)};
}

// Returns the first n words, which must be there.
std::vector<std::uint64_t> XmlSizes::words(const Place &place, int size, bool is_big, std::uint64_t n) const {
  const auto byte = [&](std::uint64_t i) -> std::uint64_t {
    if (place.form == Place::raw) return static_cast<unsigned char>(bytes_[place.begin + i]);
    const char *four = &bytes_[place.begin + i / 3 * 4];
    const std::uint32_t bits = bits_of_character(four[0]) << 18 | bits_of_character(four[1]) << 12 |
                               bits_of_character(four[2]) << 6 | bits_of_character(four[3]);
    return bits >> (16 - 8 * (i % 3)) & 255;
  };
  const auto n_bytes = static_cast<std::uint64_t>(size);
  std::vector<std::uint64_t> made(n);
  for (std::uint64_t word = 0; word < n; ++word)
    for (std::uint64_t i = 0; i < n_bytes; ++i)
      made[word] |= byte(word * n_bytes + i) << 8 * (is_big ? n_bytes - 1 - i : i);
  return made;
}

// Returns how many bytes of values a block of binary data claims. An uncompressed block begins with that number. A compressed
// one begins with the number of its parts, the size of each, that of the last if it is smaller, and the compressed sizes. In
// base64 these numbers are written apart.
std::uint64_t XmlSizes::n_bytes_in(vtkXMLDataParser *parser, vtkXMLDataElement *element, const Place &place) const {
  vtkXMLDataElement *root = parser->GetRootElement();
  const char *header_type = root->GetAttribute("header_type"), *byte_order = root->GetAttribute("byte_order");
  const int word = header_type && std::strcmp(header_type, "UInt64") == 0 ? 8 : 4;
#ifdef VTK_WORDS_BIGENDIAN
  const bool is_big = !byte_order || std::strcmp(byte_order, "BigEndian") == 0;
#else
  const bool is_big = byte_order && std::strcmp(byte_order, "BigEndian") == 0;
#endif
  const auto n_decoded = [&](std::uint64_t n) { return place.form == Place::raw ? n : n / 4 * 3; };
  const std::uint64_t n_held = n_decoded(place.end - place.begin), word_size = static_cast<std::uint64_t>(word);
  if (!parser->GetCompressor()) {
    if (n_held < word_size) return 0;
    const std::uint64_t n = words(place, word, is_big, 1)[0];
    if (n > n_held - word_size)
      refuse(element,
             "claims " + std::to_string(n) + " bytes, and the file holds " + std::to_string(n_held - word_size));
    return n;
  }
  if (n_held < 3 * word_size) return 0;
  const std::vector<std::uint64_t> head = words(place, word, is_big, 3);
  const std::uint64_t n_blocks = head[0], block = head[1], last = head[2];
  if (n_blocks == 0) return 0;
  if (n_blocks > n_held / word_size - 3)
    refuse(element, "claims " + std::to_string(n_blocks) + " compressed blocks, and the file holds " +
                        std::to_string(n_held) + " bytes");
  if (block == 0 || last > block)
    refuse(element,
           "claims compressed blocks of " + std::to_string(block) + " bytes, the last of " + std::to_string(last));
  const std::uint64_t n_head = (3 + n_blocks) * word_size;
  const std::uint64_t n_before = place.form == Place::raw ? n_head : (n_head + 2) / 3 * 4;
  std::uint64_t n_left = n_decoded(place.end - std::min(place.begin + n_before, place.end)), n_bytes = 0;
  const std::vector<std::uint64_t> sizes = words(place, word, is_big, 3 + n_blocks);
  for (std::uint64_t i = 0; i < n_blocks; ++i) {
    const std::uint64_t compressed = sizes[3 + i], uncompressed = i + 1 == n_blocks && last > 0 ? last : block;
    if (compressed > n_left)
      refuse(element, "claims a compressed block of " + std::to_string(compressed) + " bytes, and the file holds " +
                          std::to_string(n_left));
    n_left -= compressed;
    if (uncompressed / most_from_a_byte(parser->GetCompressor()) > compressed)
      refuse(element, "claims a block of " + std::to_string(uncompressed) + " bytes, compressed to " +
                          std::to_string(compressed));
    n_bytes += uncompressed;
  }
  return n_bytes;
}

void XmlSizes::check_bits(vtkXMLDataParser *parser, vtkXMLDataElement *element, std::int64_t n, std::uint64_t n_bits) {
  const auto [found, is_new] = held_.try_emplace(element);
  Held &held = found->second;
  if (is_new) {
    const Place place = place_of(parser, element);
    held.is_text = place.form == Place::ascii;
    // A number takes a character at least, and a blank before the next.
    held.n = held.is_text ? (place.end - place.begin + 1) / 2 : n_bytes_in(parser, element, place);
  }
  // Each number of a text is one value, or eight values of one bit.
  const std::uint64_t n_values = held.is_text ? held.n * (n_bits == 1 ? 8 : 1) : held.n * 8 / n_bits;
  if (n < 0 || static_cast<std::uint64_t>(n) > n_values)
    refuse(element, "must have " + std::to_string(n) + " values and has " + (held.is_text ? "at most " : "") +
                        std::to_string(n_values));
}

void XmlSizes::check_values(vtkXMLDataParser *parser, vtkXMLDataElement *element, std::int64_t n,
                            vtkAbstractArray *array) {
  check_bits(parser, element, n, bits_of(array));
}

// Checks an array of n tuples.
void XmlSizes::check_array(vtkXMLDataParser *parser, vtkXMLDataElement *element, std::int64_t n) {
  int width = 1;
  element->GetScalarAttribute("NumberOfComponents", width);
  if (width < 0) refuse(element, "claims " + std::to_string(width) + " components");
  const std::int64_t n_components = std::max(width, 1);
  if (n > std::numeric_limits<std::int64_t>::max() / n_components)
    refuse(element, "claims " + std::to_string(n) + " times " + std::to_string(n_components) + " values");
  check_bits(parser, element, n * n_components, bits_of(element->GetAttribute("type")));
}

// Returns 0 for an attribute that is missing or is no number. VTK takes it for 0 also, or refuses the file.
std::int64_t XmlSizes::count(vtkXMLDataElement *element, const char *attribute) const {
  vtkIdType n = 0;
  if (!element->GetScalarAttribute(attribute, n)) return 0;
  if (n < 0) fail_file(path_, std::string("is damaged: ") + attribute + " is " + std::to_string(n));
  return n;
}

void XmlSizes::check_cells(vtkXMLDataParser *parser, vtkXMLDataElement *cells, std::int64_t n) {
  if (n == 0) return;
  for (const char *const name : {"offsets", "types"}) {
    if (!is_named(cells, "Cells") && std::strcmp(name, "types") == 0) continue;
    vtkXMLDataElement *array = cells->FindNestedElementWithNameAndAttribute("DataArray", "Name", name);
    if (!array) fail_file(path_, "promises " + std::to_string(n) + " cells and has no array of their " + name);
    check_array(parser, array, n);
  }
}

void XmlSizes::check_piece(vtkXMLDataParser *parser, vtkXMLDataElement *piece) {
  constexpr std::pair<const char *, const char *> kinds[] = {{"Cells", "NumberOfCells"},
                                                             {"Verts", "NumberOfVerts"},
                                                             {"Lines", "NumberOfLines"},
                                                             {"Strips", "NumberOfStrips"},
                                                             {"Polys", "NumberOfPolys"}};
  const std::int64_t n_points = count(piece, "NumberOfPoints");
  std::int64_t n_cells = 0;
  for (const auto &[name, attribute] : kinds) {
    const std::int64_t n = count(piece, attribute);
    if (n > std::numeric_limits<std::int64_t>::max() - n_cells)
      fail_file(path_, std::string("is damaged: ") + attribute + " is " + std::to_string(n));
    n_cells += n;
    const char *const wanted = name;
    for_each_nested(piece, [&](vtkXMLDataElement *nested) {
      if (is_named(nested, wanted)) check_cells(parser, nested, n);
    });
  }
  for_each_nested(piece, [&](vtkXMLDataElement *nested) {
    const bool are_points = is_named(nested, "Points") || is_named(nested, "PointData");
    if (are_points || is_named(nested, "CellData"))
      for_each_nested(nested,
                      [&](vtkXMLDataElement *array) { check_array(parser, array, are_points ? n_points : n_cells); });
  });
}

void XmlSizes::check_pieces(vtkXMLDataParser *parser) {
  vtkXMLDataElement *root = parser->GetRootElement();
  const char *type = root->GetAttribute("type");
  vtkXMLDataElement *primary = type ? root->FindNestedElementWithName(type) : nullptr;
  if (!primary) return;
  for_each_nested(primary, [&](vtkXMLDataElement *nested) {
    if (is_named(nested, "Piece")) check_piece(parser, nested);
    if (is_named(nested, "FieldData"))
      for_each_nested(nested,
                      [&](vtkXMLDataElement *array) { check_array(parser, array, count(array, "NumberOfTuples")); });
  });
}

}  // namespace riis::vtk
