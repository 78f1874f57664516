// SPDX-License-Identifier: Apache-2.0
// Checks a VTK XML file. The tags are checked before VTK parses the file, and the sizes of arrays before VTK reads them.
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstring>
#include <limits>
#include <set>
#include <utility>

#include <vtkAbstractArray.h>
#include <vtkDataCompressor.h>
#include <vtkEndian.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>

#include "common/array_view.hpp"
#include "riis_vtk/read/grid_files.hpp"

namespace riis::vtk {
namespace {

// A start tag: the name of the element, and the values of its attributes "type" and "NumberOfComponents". If an attribute is
// missing, its value is "".
struct Tag {
  std::string_view name, type, n_components;
};

// Walks through the start tags of an XML text. Comments, instructions and end tags are skipped. Within the value of an attribute,
// '>' does not end the tag, and words are not attributes.
class Tags {
 public:
  explicit Tags(std::string_view text) : rest_(text) {}

  // Finds the next start tag. Returns false at the end of the text.
  bool next(Tag &tag) {
    for (;;) {
      rest_.remove_prefix(std::min(rest_.find('<'), rest_.size()));
      if (rest_.empty()) return false;
      if (rest_.substr(0, 4) == "<!--") {
        rest_.remove_prefix(std::min(rest_.find("-->", 4), rest_.size()));
        continue;
      }
      rest_.remove_prefix(1);
      tag = {take_until(" \t\r\n/>"), "", ""};
      if (!tag.name.empty() && tag.name[0] != '?' && tag.name[0] != '!') break;
    }
    while (const char quote = next_attribute()) {
      const std::string_view name = attribute_;
      rest_.remove_prefix(1);
      const std::string_view value = take_until(std::string_view(&quote, 1));
      rest_.remove_prefix(std::min<std::size_t>(1, rest_.size()));
      if (name == "type") tag.type = value;
      if (name == "NumberOfComponents") tag.n_components = value;
    }
    return true;
  }

 private:
  // Removes and returns the text before the first of these characters.
  std::string_view take_until(std::string_view characters) {
    const std::string_view text = rest_.substr(0, rest_.find_first_of(characters));
    rest_.remove_prefix(text.size());
    return text;
  }

  // Moves to the value of the tag's next attribute, and stores the attribute's name in attribute_. Returns the quotation mark
  // before the value, or 0 at the end of the tag.
  char next_attribute() {
    attribute_ = take_until("=\"'<>");
    if (rest_.empty() || rest_[0] == '<' || rest_[0] == '>') return 0;
    take_until("\"'<>");
    attribute_ = take_word(attribute_);
    return rest_.empty() || rest_[0] == '<' || rest_[0] == '>' ? '\0' : rest_[0];
  }

  std::string_view rest_;
  std::string_view attribute_;
};

// The number of components is checked before the data, because VTK looks for the names of all components first.
void check_components(const std::string &path, std::string_view text, std::string_view given) {
  const std::string_view number = take_word(given);
  std::int64_t n = 0;
  std::from_chars(number.data(), number.data() + number.size(), n);
  if (n > 8 * view(text).size()) fail_file(path, "has an array of ", number, " components, more than it has bits");
}

void check_arrays(const std::string &path, std::string_view text) {
  static const std::set<std::string_view> known = {"Int8",  "UInt8",  "Int16",   "UInt16",  "Int32",  "UInt32",
                                                   "Int64", "UInt64", "Float32", "Float64", "String", "Bit"};
  Tag tag;
  for (Tags tags(text); tags.next(tag) && tag.name != "AppendedData";) {
    const bool is_array = tag.name == "DataArray" || tag.name == "Array";
    if (is_array && known.count(tag.type) == 0) {
      fail_file(path, "has an array of the unknown type '", tag.type.substr(0, 40), "'");
    }
    if (is_array) check_components(path, text, tag.n_components);
  }
}

// Returns the type of the element VTKFile at the beginning of an XML file, or "" if there is no such element.
std::string xml_type(std::string_view head) {
  Tag tag;
  for (Tags tags(head); tags.next(tag);) {
    if (tag.name == "VTKFile") return std::string(tag.type);
  }
  return "";
}

// Returns the least number of bits that a value needs. A string needs at least its final byte.
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

// Returns the largest number of bytes that one byte of compressed data can stand for. Runs of zeros shrink to 1/1032 of their
// size in zlib, and to 1/255 in LZ4. LZMA has no limit, but the strongest compression that was measured with it is to 1/7000.
std::uint64_t most_from_a_byte(vtkDataCompressor *compressor) {
  return std::strcmp(compressor->GetClassName(), "vtkLZMADataCompressor") == 0 ? 20'000 : 1'100;
}

// Returns the six bits for a character of base64. Returns 0 for other characters and for the padding at the end, because VTK
// stops there.
std::uint32_t bits_of_character(char c) {
  if (c >= 'A' && c <= 'Z') return static_cast<std::uint32_t>(c - 'A');
  if (c >= 'a' && c <= 'z') return static_cast<std::uint32_t>(c - 'a' + 26);
  if (c >= '0' && c <= '9') return static_cast<std::uint32_t>(c - '0' + 52);
  return c == '+' ? 62 : c == '/' ? 63 : 0;
}

bool is_named(vtkXMLDataElement *element, const char *name) { return std::strcmp(element->GetName(), name) == 0; }

bool is_structured(vtkXMLDataParser *parser) {
  static const std::set<std::string> types = {"ImageData", "RectilinearGrid", "StructuredGrid"};
  const char *const type = parser->GetRootElement()->GetAttribute("type");
  return type && types.count(type) != 0;
}

template <class Visit>
void for_each_nested(vtkXMLDataElement *element, const Visit &visit) {
  for (int i = 0; i < element->GetNumberOfNestedElements(); ++i) visit(element->GetNestedElement(i));
}

}  // namespace

void check_xml(const std::string &path, const std::string &wanted_type) {
  const MappedFile file(path, check_readable(path));
  const std::string_view bytes = file.bytes();
  const std::string type = xml_type(bytes.substr(0, 4096));
  if (type.empty()) fail_file(path, "is not a VTK XML file");
  if (type != wanted_type) fail_file(path, "holds ", type, ", not ", wanted_type);
  if (bytes.substr(bytes.size() - std::min<std::size_t>(bytes.size(), 4096)).find("</VTKFile>") ==
      std::string_view::npos) {
    fail_file(path, "is truncated: </VTKFile> is missing");
  }
  check_arrays(path, bytes);
}

XmlSizes::XmlSizes(const std::string &path) : path_(path), file_(path, check_readable(path)), bytes_(file_.bytes()) {}

template <class... Parts>
void XmlSizes::refuse(vtkXMLDataElement *element, const Parts &...parts) const {
  const char *name = element->GetAttribute("Name");
  fail_file(path_, "is damaged: array ", name ? std::string(name).substr(0, 40) : "without a name", " ", parts...);
}

// Finds the data in the same way as VTK. If an element has an offset, its data is appended, and its attribute "format" is
// ignored.
XmlSizes::ArrayData XmlSizes::data_of(vtkXMLDataParser *parser, vtkXMLDataElement *element) const {
  const std::size_t size = bytes_.size();
  if (element->GetAttribute("offset")) {
    vtkTypeInt64 offset = 0;
    element->GetScalarAttribute("offset", offset);
    vtkXMLDataElement *appended = parser->GetRootElement()->FindNestedElementWithName("AppendedData");
    const char *encoding = appended ? appended->GetAttribute("encoding") : nullptr;
    const vtkTypeInt64 start = parser->GetAppendedDataPosition();
    // The comparison uses a difference, because the sum of the offset and the start could overflow.
    const bool is_inside = offset >= 0 && start >= 0 && start <= static_cast<vtkTypeInt64>(size) &&
                           offset <= static_cast<vtkTypeInt64>(size) - start;
    return {encoding && std::strcmp(encoding, "raw") == 0 ? ArrayData::raw : ArrayData::base64,
            is_inside ? static_cast<std::size_t>(start + offset) : size, size};
  }
  const char *format = element->GetAttribute("format");
  std::size_t begin = std::min(bytes_.find('>', static_cast<std::size_t>(element->GetXMLByteIndex())), size - 1) + 1;
  while (begin < size && std::isspace(static_cast<unsigned char>(bytes_[begin]))) ++begin;
  return {format && std::strcmp(format, "binary") == 0 ? ArrayData::base64 : ArrayData::ascii, begin,
          std::min(bytes_.find('<', begin), size)};
}

// Returns the first n words. Fails if the text has fewer than n words.
std::vector<std::uint64_t> XmlSizes::words(const ArrayData &data, int size, bool is_big, std::uint64_t n) const {
  const auto byte = [&](std::uint64_t i) -> std::uint64_t {
    if (data.form == ArrayData::raw) return static_cast<unsigned char>(bytes_[data.begin + i]);
    const char *four = &bytes_[data.begin + i / 3 * 4];
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

// Returns the stated number of bytes in a block of binary data. An uncompressed block begins with its number of bytes. A
// compressed block begins with the number of parts, the size of a part, the size of a smaller last part, and the compressed sizes
// of the parts. In base64, the numbers at the beginning are encoded separately from the data.
std::uint64_t XmlSizes::n_bytes_in(vtkXMLDataParser *parser, vtkXMLDataElement *element, const ArrayData &data) const {
  vtkXMLDataElement *root = parser->GetRootElement();
  const char *header_type = root->GetAttribute("header_type"), *byte_order = root->GetAttribute("byte_order");
  const int word = header_type && std::strcmp(header_type, "UInt64") == 0 ? 8 : 4;
#ifdef VTK_WORDS_BIGENDIAN
  const bool is_big = !byte_order || std::strcmp(byte_order, "BigEndian") == 0;
#else
  const bool is_big = byte_order && std::strcmp(byte_order, "BigEndian") == 0;
#endif
  const auto n_decoded = [&](std::uint64_t n) { return data.form == ArrayData::raw ? n : n / 4 * 3; };
  const std::uint64_t n_held = n_decoded(data.end - data.begin), word_size = static_cast<std::uint64_t>(word);
  if (!parser->GetCompressor()) {
    if (n_held < word_size) return 0;
    const std::uint64_t n = words(data, word, is_big, 1)[0];
    if (n > n_held - word_size) refuse(element, "claims ", n, " bytes, and the file holds ", n_held - word_size);
    return n;
  }
  if (n_held < 3 * word_size) return 0;
  const std::vector<std::uint64_t> head = words(data, word, is_big, 3);
  const std::uint64_t n_blocks = head[0], block = head[1], last = head[2];
  if (n_blocks == 0) return 0;
  if (n_blocks > n_held / word_size - 3)
    refuse(element, "claims ", n_blocks, " compressed blocks, and the file holds ", n_held, " bytes");
  if (block == 0 || last > block) refuse(element, "claims compressed blocks of ", block, " bytes, the last of ", last);
  const std::uint64_t n_head = (3 + n_blocks) * word_size;
  const std::uint64_t n_before = data.form == ArrayData::raw ? n_head : (n_head + 2) / 3 * 4;
  std::uint64_t n_left = n_decoded(data.end - std::min<std::uint64_t>(data.begin + n_before, data.end)), n_bytes = 0;
  const std::vector<std::uint64_t> sizes = words(data, word, is_big, 3 + n_blocks);
  for (std::uint64_t i = 0; i < n_blocks; ++i) {
    const std::uint64_t compressed = sizes[3 + i], uncompressed = i + 1 == n_blocks && last > 0 ? last : block;
    if (compressed > n_left)
      refuse(element, "claims a compressed block of ", compressed, " bytes, and the file holds ", n_left);
    n_left -= compressed;
    if (uncompressed / most_from_a_byte(parser->GetCompressor()) > compressed)
      refuse(element, "claims a block of ", uncompressed, " bytes, compressed to ", compressed);
    n_bytes += uncompressed;
  }
  return n_bytes;
}

void XmlSizes::check_bits(vtkXMLDataParser *parser, vtkXMLDataElement *element, std::int64_t n, std::uint64_t n_bits) {
  const auto [found, is_new] = held_.try_emplace(element);
  Held &held = found->second;
  if (is_new) {
    const ArrayData data = data_of(parser, element);
    held.is_text = data.form == ArrayData::ascii;
    // In a text, a number takes at least two characters: a digit and the blank before the next number.
    held.n = held.is_text ? (data.end - data.begin + 1) / 2 : n_bytes_in(parser, element, data);
  }
  // Each number of a text stands for one value, or for eight values of one bit.
  const std::uint64_t n_values = held.is_text ? held.n * (n_bits == 1 ? 8 : 1) : held.n * 8 / n_bits;
  if (n < 0 || static_cast<std::uint64_t>(n) > n_values)
    refuse(element, "must have ", n, " values and has ", held.is_text ? "at most " : "", n_values);
}

void XmlSizes::check_values(vtkXMLDataParser *parser, vtkXMLDataElement *element, std::int64_t n,
                            vtkAbstractArray *array) {
  check_bits(parser, element, n, bits_of(array));
}

// Checks an array with n tuples.
void XmlSizes::check_array(vtkXMLDataParser *parser, vtkXMLDataElement *element, std::int64_t n) {
  int width = 1;
  element->GetScalarAttribute("NumberOfComponents", width);
  if (width < 0) refuse(element, "claims ", width, " components");
  const std::int64_t n_components = std::max(width, 1);
  if (n > std::numeric_limits<std::int64_t>::max() / n_components)
    refuse(element, "claims ", n, " times ", n_components, " values");
  check_bits(parser, element, n * n_components, bits_of(element->GetAttribute("type")));
}

// Returns the value of an attribute. If the attribute is missing or is not a number, returns 0. For a missing or wrong attribute,
// VTK also reads 0, or refuses the file.
std::int64_t XmlSizes::count(vtkXMLDataElement *element, const char *attribute) const {
  vtkIdType n = 0;
  if (!element->GetScalarAttribute(attribute, n)) return 0;
  if (n < 0) fail_file(path_, "is damaged: ", attribute, " is ", n);
  return n;
}

void XmlSizes::check_cells(vtkXMLDataParser *parser, vtkXMLDataElement *cells, std::int64_t n) {
  if (n == 0) return;
  for (const char *const name : {"offsets", "types"}) {
    if (!is_named(cells, "Cells") && std::strcmp(name, "types") == 0) continue;
    vtkXMLDataElement *array = cells->FindNestedElementWithNameAndAttribute("DataArray", "Name", name);
    if (!array) fail_file(path_, "promises ", n, " cells and has no array of their ", name);
    check_array(parser, array, n);
  }
}

std::array<int, 6> XmlSizes::extent(vtkXMLDataElement *element, const char *attribute) const {
  std::array<int, 6> made{};
  if (element->GetVectorAttribute(attribute, 6, made.data()) != 6)
    fail_file(path_, "is damaged: ", attribute, " has not six numbers");
  return made;
}

Lattice XmlSizes::lattice(vtkXMLDataElement *element) const {
  const std::array<int, 6> ends = extent(element, "Extent");
  Lattice made{};
  for (std::size_t axis = 0; axis < 3; ++axis) made.n[axis] = std::int64_t{ends[2 * axis + 1]} - ends[2 * axis] + 1;
  check_lattice(path_, made);
  return made;
}

// VTK allocates memory for the whole extent before it reads the pieces.
void XmlSizes::check_extents(vtkXMLDataElement *primary) const {
  const std::array<int, 6> whole = extent(primary, "WholeExtent");
  int n_pieces = 0;
  for_each_nested(primary, [&](vtkXMLDataElement *nested) {
    if (!is_named(nested, "Piece")) return;
    ++n_pieces;
    if (extent(nested, "Extent") != whole) fail_file(path_, "has a piece whose Extent is not the WholeExtent");
  });
  if (n_pieces != 1) fail_file(path_, "has ", n_pieces, " pieces; a structured grid must have one");
}

void XmlSizes::check_piece(vtkXMLDataParser *parser, vtkXMLDataElement *piece) {
  constexpr std::pair<const char *, const char *> kinds[] = {{"Cells", "NumberOfCells"},
                                                             {"Verts", "NumberOfVerts"},
                                                             {"Lines", "NumberOfLines"},
                                                             {"Strips", "NumberOfStrips"},
                                                             {"Polys", "NumberOfPolys"}};
  std::int64_t n_points = count(piece, "NumberOfPoints"), n_cells = 0;
  if (is_structured(parser)) {
    const Lattice grid = lattice(piece);
    n_points = grid.n_points();
    n_cells = grid.n_cells();
    for_each_nested(piece, [&](vtkXMLDataElement *nested) {
      if (!is_named(nested, "Coordinates")) return;
      const int n_axes = std::min(3, nested->GetNumberOfNestedElements());
      for (int axis = 0; axis < n_axes; ++axis)
        check_array(parser, nested->GetNestedElement(axis), grid.n[static_cast<std::size_t>(axis)]);
    });
  }
  for (const auto &[name, attribute] : kinds) {
    const std::int64_t n = count(piece, attribute);
    if (n > std::numeric_limits<std::int64_t>::max() - n_cells) fail_file(path_, "is damaged: ", attribute, " is ", n);
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
  if (is_structured(parser)) check_extents(primary);
  for_each_nested(primary, [&](vtkXMLDataElement *nested) {
    if (is_named(nested, "Piece")) check_piece(parser, nested);
    if (is_named(nested, "FieldData"))
      for_each_nested(nested,
                      [&](vtkXMLDataElement *array) { check_array(parser, array, count(array, "NumberOfTuples")); });
  });
}

}  // namespace riis::vtk
