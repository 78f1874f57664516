// SPDX-License-Identifier: Apache-2.0
// Walks through the sections of a legacy .vtk file before VTK reads the file, and counts its cells.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>
#include <set>

#include <vtkCellType.h>
#include <vtkInformationDoubleKey.h>
#include <vtkInformationDoubleVectorKey.h>
#include <vtkInformationIntegerVectorKey.h>
#include <vtkInformationKeyLookup.h>
#include <vtkInformationStringKey.h>
#include <vtkInformationStringVectorKey.h>

#include "common/array_view.hpp"
#include "common/number_from_chars.hpp"
#include "riis_vtk/read/grid_files.hpp"

namespace riis::vtk {
namespace {

// Returns the number of bytes that a value has in a binary file. Returns 0 for a type of varying size, and -1 for an unknown
// type.
int size_of_type(std::string_view type) {
  using Names = std::initializer_list<std::string_view>;
  const auto is_in = [&](Names names) { return std::find(names.begin(), names.end(), type) != names.end(); };
  if (is_in({"int", "unsigned_int", "vtkidtype", "float"})) return 4;
  if (is_in({"double", "vtktypeint64", "vtktypeuint64", "long", "unsigned_long", "long_long", "unsigned_long_long"}))
    return 8;
  if (is_in({"char", "signed_char", "unsigned_char"})) return 1;
  if (is_in({"short", "unsigned_short"})) return 2;
  return is_in({"string", "utf8_string"}) ? 0 : -1;
}

// meshio writes names of types that VTK does not know. Returns VTK's name for each of them.
const std::map<std::string, std::string> &vtk_names() {
  static const std::map<std::string, std::string> names = {
      {"vtktypeint8", "signed_char"},    {"vtktypeint16", "short"},           {"vtktypeint32", "int"},
      {"vtktypeuint8", "unsigned_char"}, {"vtktypeuint16", "unsigned_short"}, {"vtktypeuint32", "unsigned_int"}};
  return names;
}

// Returns whether VTK would read the whole word as a number of the given type. VTK reads numbers by C++ streams. These streams
// refuse infinite numbers and numbers that are too large, but accept numbers that are too small.
bool is_number(std::string_view word, const std::string &type) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  if (type == "float" || type == "double") {
    double value = 0;
    const auto [end, error] = number_from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size()) return false;
    if (error == std::errc::result_out_of_range)
      return word.find_first_of("eE") < word.find('-', 1) && word.find('-', 1) < word.size();
    return error == std::errc() && std::isfinite(value) &&
           (type == "double" || std::isfinite(static_cast<float>(value)));
  }
  // In text files, VTK writes and reads a byte as a number of 32 bits. A byte above 255 is therefore no fault there.
  const bool is_unsigned = type.rfind("unsigned", 0) == 0 || type == "vtktypeuint64";
  const int n_bits = type == "short" || type == "unsigned_short" ? 16 : size_of_type(type) == 8 ? 64 : 32;
  if (is_unsigned && size_of_type(type) > 1) {
    std::uint64_t value = 0;
    return read_number(word, value) && (n_bits == 64 || value >> n_bits == 0);
  }
  std::int64_t value = 0;
  const std::int64_t most = std::numeric_limits<std::int64_t>::max() >> (64 - n_bits);
  return read_number(word, value) && value <= most && value >= -most - 1;
}

// Returns the number that big-endian bytes represent.
std::uint64_t big_endian(std::string_view bytes) {
  std::uint64_t bits = 0;
  for (const char byte : bytes) bits = bits << 8 | static_cast<unsigned char>(byte);
  return bits;
}

std::string upper_case(std::string text) {
  for (char &c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return text;
}

bool begins_with(std::string_view text, std::string_view what) { return text.substr(0, what.size()) == what; }

// A sequence of whole numbers. The scan has already checked that the numbers exist and are valid.
class Numbers {
 public:
  // In a binary file, `size` is the number of bytes of each number, 4 or 8. In an ASCII file, `size` is 0.
  Numbers(std::string_view from, int size) : rest_(from), size_(size) {}

  std::int64_t next() {
    if (size_ == 0) {
      const std::string_view word = take_word(rest_);
      std::int64_t n = 0;
      std::from_chars(word.data() + (word[0] == '+'), word.data() + word.size(), n);
      return n;
    }
    const std::uint64_t bits = big_endian(rest_.substr(0, static_cast<std::size_t>(size_)));
    rest_.remove_prefix(static_cast<std::size_t>(size_));
    return size_ == 4 ? static_cast<std::int32_t>(bits) : static_cast<std::int64_t>(bits);
  }

  void skip(std::int64_t n) {
    if (size_ != 0) return rest_.remove_prefix(static_cast<std::size_t>(n * size_));
    for (std::int64_t i = 0; i < n; ++i) take_word(rest_);
  }

 private:
  std::string_view rest_;
  int size_;
};

class Scan {
 public:
  Scan(const std::string &path, std::string_view bytes) : path_(path), bytes_(bytes), rest_(bytes) {}

  // Scans the file, and returns its content.
  LegacyContent file(LegacyKinds allowed) {
    header(allowed);
    for (std::string keyword = word(); !keyword.empty(); keyword = word()) section(keyword);
    if (is_structured()) return structured();
    // The format has no mark for the end of a file. Without this check, a file that is cut off after its points would look like a
    // grid without cells.
    if (n_cells_ < 0) refuse("holds no cells (is it truncated?)");
    if (is_polydata()) return content();
    if (n_types_ != n_cells_)
      refuse("has ", std::max<std::int64_t>(n_types_, 0), " types for ", n_cells_, " cells",
             n_types_ < 0 ? " (is it truncated?)" : "");
    if (has_polyhedra()) check_polyhedra();
    return content();
  }

  // Returns whether the file has a structured grid. Only the header is read.
  bool is_structured_file() {
    header(LegacyKinds::grid);
    return is_structured();
  }

 private:
  template <class... Parts>
  [[noreturn]] void refuse(const Parts &...parts) const {
    fail_file(path_, parts...);
  }
  [[noreturn]] void refuse_end() const { refuse("is truncated"); }

  std::string_view line() { return take_line(rest_); }

  // Returns the next word unchanged, or "" at the end of the file. Refuses a word with more than 255 characters, because VTK
  // would read it as two words.
  std::string_view word_as_it_is() {
    constexpr std::size_t longest = 255;
    const std::string_view text = take_word(rest_);
    if (text.size() > longest) refuse("has a word of ", text.size(), " characters, more than ", longest);
    return text;
  }

  // Returns the next word in lower case, or "" at the end of the file. In most places, the format does not distinguish capital
  // letters from small letters.
  std::string word() { return lower_case(word_as_it_is()); }

  // The next two functions return the next word, and fail at the end of the file.
  std::string_view next_as_it_is() {
    const std::string_view text = word_as_it_is();
    if (text.empty()) refuse_end();
    return text;
  }
  std::string next() { return lower_case(next_as_it_is()); }

  // Reads the name of a type, and returns VTK's name for this type.
  std::string next_type() {
    const std::string_view text = next_as_it_is();
    const std::string name = lower_case(text);
    const auto found = vtk_names().find(name);
    if (found == vtk_names().end()) return name;
    meshio_types_.push_back(text);
    return found->second;
  }

  LegacyContent content() const {
    LegacyContent made{kind_, n_cells_, ""};
    const char *copied = bytes_.data();
    for (const std::string_view type : meshio_types_) {
      made.rewritten.append(copied, type.data()).append(vtk_names().at(lower_case(type)));
      copied = type.data() + type.size();
    }
    if (!meshio_types_.empty()) made.rewritten.append(copied, bytes_.data() + bytes_.size());
    return made;
  }

  std::int64_t number_of(std::string_view text) const {
    std::int64_t n = 0;
    if (!read_number(text, n)) refuse("has '", text, "' for a number");
    return n;
  }

  // Reads and returns a count. Each counted item takes at least one bit, so a count must not exceed the number of bits in the
  // rest of the file.
  std::int64_t count() {
    const std::int64_t n = number_of(next());
    if (n < 0) refuse("has the count ", n);
    if (n > n_bits_left()) refuse_end();
    return n;
  }

  std::int64_t n_bits_left() const { return 8 * view(rest_).size(); }

  void header(LegacyKinds allowed) {
    const std::string magic = "# vtk datafile version ";
    const std::string first = lower_case(line());
    if (first.rfind(magic, 0) != 0) refuse("is not a legacy VTK file");
    std::string version = first.substr(magic.size());
    while (!version.empty() && is_blank(version.back())) version.pop_back();
    // A file of an unknown version is refused, because VTK would read it like an old version. A version number is also refused if
    // it is too large for VTK.
    const std::size_t dot = version.find('.');
    std::int64_t minor = 0;
    constexpr std::size_t longest = 16;
    if (version.size() > longest || dot == std::string::npos || !read_number(version.substr(0, dot), version_) ||
        !read_number(version.substr(dot + 1), minor) || version_ < 1 || version_ > 5 || minor < 0 || minor > 99)
      refuse("has the version '", version.substr(0, 40), "'");
    line();
    const std::string encoding = next();
    if (encoding != "ascii" && encoding != "binary") refuse("is neither ASCII nor BINARY");
    binary_ = encoding == "binary";
    if (next() != "dataset") refuse("holds no data set");
    const std::string kind = next();
    static const std::map<std::string, LegacyKind> kinds = {{"unstructured_grid", LegacyKind::unstructured_grid},
                                                            {"polydata", LegacyKind::polydata},
                                                            {"structured_points", LegacyKind::structured_points},
                                                            {"rectilinear_grid", LegacyKind::rectilinear_grid},
                                                            {"structured_grid", LegacyKind::structured_grid}};
    const auto found = kinds.find(kind);
    if (found != kinds.end()) kind_ = found->second;
    if (found == kinds.end() || (allowed == LegacyKinds::grid ? is_polydata() : is_structured()))
      refuse("holds ", kind, ", not unstructured_grid");
  }

  bool is_polydata() const { return kind_ == LegacyKind::polydata; }
  bool is_structured() const { return kind_ != LegacyKind::unstructured_grid && !is_polydata(); }

  // Returns the content of a structured grid after its sections were scanned.
  LegacyContent structured() {
    if (!lattice_) refuse("has no DIMENSIONS (is it truncated?)");
    static const char *const names[3] = {"X_COORDINATES", "Y_COORDINATES", "Z_COORDINATES"};
    for (std::size_t axis = 0; axis < 3 && kind_ == LegacyKind::rectilinear_grid; ++axis)
      if (n_coordinates_[axis] != lattice_->n[axis])
        refuse("has ", n_coordinates_[axis], " ", names[axis], " for ", lattice_->n[axis], " points along the axis");
    if (kind_ == LegacyKind::structured_grid && n_points_ != lattice_->n_points())
      refuse("has ", n_points_, " points, and DIMENSIONS of ", lattice_->n_points());
    n_cells_ = lattice_->n_cells();
    return content();
  }

  void skip_bytes(std::int64_t n) {
    if (n > view(rest_).size()) refuse_end();
    rest_.remove_prefix(static_cast<std::size_t>(n));
  }

  // Skips n words of an ASCII file. Refuses a word that is not a number of the given type, because VTK would stop reading there
  // without an error.
  void skip_words(std::int64_t n, const std::string &type) {
    for (std::int64_t i = 0; i < n; ++i) {
      const std::string_view word = take_word(rest_);
      if (word.empty()) refuse_end();
      check_number(word, type);
    }
  }

  void check_number(std::string_view word, const std::string &type) const {
    if (!is_number(word, type)) refuse("has '", word.substr(0, 40), "' for a number of type ", type);
  }

  // Skips a string in a binary file. The two highest bits of the string's first byte tell how many bytes hold its length.
  void skip_binary_string() {
    const int n_length_bytes = 8 >> (static_cast<unsigned char>(rest_[0]) >> 6);
    const std::uint64_t word = big_endian(rest_.substr(0, static_cast<std::size_t>(n_length_bytes)));
    skip_bytes(n_length_bytes);
    skip_bytes(static_cast<std::int64_t>(word & ((std::uint64_t{1} << (8 * n_length_bytes - 2)) - 1)));
  }

  void skip_strings(std::int64_t n) {
    for (std::int64_t i = 0; i < n; ++i) {
      if (rest_.empty()) refuse_end();
      binary_ ? skip_binary_string() : static_cast<void>(line());
    }
  }

  // Skips n values, which begin on the next line. `n` must not exceed the number of bits in the rest of the file.
  void skip_values(std::int64_t n, const std::string &type) {
    line();
    if (type == "bit") return binary_ ? skip_bytes((n + 7) / 8) : skip_words(n, "int");
    const int size = size_of_type(type);
    if (size < 0) refuse("has values of the unknown type ", type);
    if (size == 0) return skip_strings(n);
    binary_ ? skip_bytes(n * size) : skip_words(n, type);
  }

  // Skips an array. The array has n tuples, and the file gives the size of a tuple. VTK's writer may add a block METADATA after
  // the tuples.
  void skip_tuples(std::int64_t n, std::int64_t width, const std::string &type) {
    if (width > 0 && n > n_bits_left() / width) refuse_end();
    skip_values(n * width, type);
    std::string_view behind = rest_;
    if (!begins_with(lower_case(take_word(behind)), "metadata")) return;
    rest_ = behind;
    skip_metadata(width);
  }

  // Skips a block METADATA, whose keyword has already been read. The block ends with a blank line. However, a line with the name
  // of a component may also be blank, so not every blank line ends the block. VTK compares only the beginning of a keyword such
  // as INFORMATION. For example, VTK reads "INFORMATION8 1" as 8 keys.
  void skip_metadata(std::int64_t n_components) {
    line();
    while (!rest_.empty()) {
      std::string_view text = line();
      const std::string_view word = take_word(text);
      const std::string keyword = lower_case(word);
      if (keyword.empty()) return;
      constexpr std::string_view information = "information";
      if (begins_with(keyword, information)) {
        text = {word.data() + information.size(), word.size() - information.size() + text.size()};
        return skip_information(number_of(take_word(text)));
      }
      const bool are_names = begins_with(keyword, "component_names");
      for (std::int64_t i = 0; are_names && i < n_components && !rest_.empty(); ++i) line();
    }
  }

  // Skips the rest of a block METADATA. The rest consists of keys, each with a line NAME and a line DATA. VTK looks for the
  // stated number of keys, even beyond the blank line. If VTK cannot read the number of keys, its search never ends.
  void skip_information(std::int64_t n_keys) {
    std::int64_t n_found = 0;
    vtkInformationKey *key = nullptr;
    while (!rest_.empty()) {
      std::string_view text = line();
      const std::string_view keyword = take_word(text);
      if (keyword.empty()) break;
      if (keyword == "NAME") {
        const std::string name(take_word(text));
        take_word(text);
        key = vtkInformationKeyLookup::Find(name, std::string(take_word(text)));
        ++n_found;
      } else if (key) {
        if (keyword != "DATA") refuse("has metadata with '", keyword.substr(0, 40), "' in the place of DATA");
        skip_data(key, text);
        key = nullptr;
      } else if (const std::string lower = lower_case(keyword);
                 begins_with(lower, "information") || begins_with(lower, "component_names")) {
        // Lines with these beginnings are refused, because VTK would take them for the beginning of another block.
        refuse("has metadata with '", keyword.substr(0, 40), "' behind INFORMATION");
      }
    }
    if (n_found != n_keys || key) refuse("has INFORMATION of ", n_keys, " keys and gives ", n_found);
  }

  // Skips the values of a key of METADATA, if VTK knows the key. The values are a string, a number, or a count followed by as
  // many strings or numbers.
  void skip_data(vtkInformationKey *key, std::string_view text) {
    if (vtkInformationStringKey::SafeDownCast(key)) return;
    const bool are_texts = vtkInformationStringVectorKey::SafeDownCast(key) != nullptr;
    const bool are_reals = vtkInformationDoubleVectorKey::SafeDownCast(key) != nullptr;
    const bool are_many = are_texts || are_reals || vtkInformationIntegerVectorKey::SafeDownCast(key);
    const std::int64_t n = are_many ? number_of(take_word(text)) : 1;
    if (n < 0 || n > n_bits_left()) refuse("has metadata with the count ", n);
    for (std::int64_t i = 0; i < n; ++i) {
      if (are_texts)
        line();
      else
        check_number(take_word(text), are_reals || vtkInformationDoubleKey::SafeDownCast(key) ? "double" : "int");
    }
  }

  void section(const std::string &keyword) {
    if (keyword == "field") {
      field();
    } else if (is_structured() && structured_section(keyword)) {
      return;
    } else if (keyword == "points" && kind_ != LegacyKind::structured_points && kind_ != LegacyKind::rectilinear_grid) {
      n_points_ = count();
      skip_tuples(n_points_, 3, next_type());
    } else if (is_list_of_cells(keyword)) {
      if (!lists_.insert(keyword).second) refuse("has ", upper_case(keyword), " twice");
      cells(upper_case(keyword));
    } else if (keyword == "cell_types" && !is_structured()) {
      if (n_types_ >= 0) refuse("has CELL_TYPES twice");
      n_types_ = count();
      types_ = values_behind_line();
      skip_values(n_types_, "int");
    } else if (keyword == "point_data" || keyword == "cell_data") {
      n_tuples_ = count();
      if (is_structured()) check_tuples(keyword == "point_data");
    } else if (keyword == "metadata") {
      skip_metadata(0);
    } else if (!attribute(keyword)) {
      refuse("has the unknown keyword '", keyword.substr(0, 40), "'");
    }
  }

  // Reads a section that occurs only in structured grids. Returns false for a keyword of another section.
  bool structured_section(const std::string &keyword) {
    if (keyword == "dimensions") {
      if (lattice_) refuse("has DIMENSIONS twice");
      lattice_.emplace();
      for (std::int64_t &n : lattice_->n) {
        n = number_of(next());
        if (n > std::numeric_limits<int>::max()) refuse("has the count ", n);
      }
      check_lattice(path_, *lattice_);
    } else if (kind_ == LegacyKind::structured_points &&
               (keyword == "origin" || keyword == "spacing" || keyword == "aspect_ratio")) {
      skip_words(3, "double");
    } else if (kind_ == LegacyKind::rectilinear_grid && keyword.size() == 13 && keyword.substr(1) == "_coordinates" &&
               keyword[0] >= 'x' && keyword[0] <= 'z') {
      std::int64_t &n = n_coordinates_[static_cast<std::size_t>(keyword[0] - 'x')];
      n = count();
      skip_tuples(n, 1, next_type());
    } else {
      return false;
    }
    return true;
  }

  // VTK allocates memory for the stated number of tuples before it compares this number with the grid.
  void check_tuples(bool are_points) const {
    if (!lattice_) refuse("has data before DIMENSIONS");
    const std::int64_t n = are_points ? lattice_->n_points() : lattice_->n_cells();
    if (n_tuples_ != n) refuse("has ", are_points ? "POINT_DATA " : "CELL_DATA ", n_tuples_, " for ", n);
  }

  void field() {
    next();
    const std::int64_t n_arrays = count();
    for (std::int64_t i = 0; i < n_arrays; ++i) {
      if (next_as_it_is() == "NULL_ARRAY") continue;  // VTK accepts this word only in capitals
      const std::int64_t width = count();
      const std::int64_t n = count();
      skip_tuples(n, width, next_type());
    }
  }

  bool is_list_of_cells(std::string_view keyword) const {
    if (!is_polydata()) return keyword == "cells" && !is_structured();
    return keyword == "vertices" || keyword == "lines" || keyword == "polygons" || keyword == "triangle_strips";
  }

  // Skips a list of cells. `name` is the keyword of the list.
  void cells(const std::string &name) {
    const std::int64_t first = count();
    const std::int64_t second = count();
    if (version_ >= 5) {
      // In version 5, a section of cells states the number of offsets and the number of corners.
      add_cells(std::max<std::int64_t>(first - 1, 0));
      if (first == 0) return;
      if (next() != "offsets") refuse("has ", name, " without OFFSETS");
      type_of_offsets_ = next_type();
      offsets_ = values_behind_line();
      skip_tuples(first, 1, type_of_offsets_);
      if (next() != "connectivity") refuse("has cell offsets without CONNECTIVITY");
      n_corners_ = second;
      type_of_corners_ = next_type();
      corners_ = values_behind_line();
      skip_tuples(second, 1, type_of_corners_);
    } else {
      add_cells(first);
      counted_cells(first, second, name);
    }
  }

  void add_cells(std::int64_t n) { n_cells_ = std::max<std::int64_t>(n_cells_, 0) + n; }

  // Skips the cells of a file of version 4 or earlier. A cell is stored as its number of corners, followed by its corners.
  // n_values is the count of all these numbers.
  void counted_cells(std::int64_t n_cells, std::int64_t n_values, const std::string &name) {
    line();
    corners_ = rest_;
    std::int64_t n_left = n_values;
    for (std::int64_t i = 0; i < n_cells; ++i) {
      const std::int64_t n_corners = binary_ ? binary_int() : number_of(next());
      if (n_corners < 0 || n_corners >= n_left)
        refuse("cell ", i, " has ", n_corners, " points, more than ", name, " has");
      n_left -= 1 + n_corners;
      binary_ ? skip_bytes(4 * n_corners) : skip_words(n_corners, "int");
    }
    if (n_left != 0) refuse("has ", name, " with ", n_left, " numbers too many");
  }

  // Returns the values of an array. The type of the array has just been read. The values begin on the next line of the file.
  std::string_view values_behind_line() const {
    std::string_view values = rest_;
    take_line(values);
    return values;
  }

  Numbers numbers(std::string_view values, const std::string &type) const {
    const int size = size_of_type(type);
    if (size < 4 || type == "float" || type == "double") refuse("has polyhedra, and cells of type ", type);
    return {values, binary_ ? size : 0};
  }

  // VTK stores the type of a cell in a byte, so only the lowest byte counts.
  bool has_polyhedra() const {
    Numbers types = numbers(types_, "int");
    for (std::int64_t i = 0; i < n_types_; ++i)
      if ((types.next() & 255) == VTK_POLYHEDRON) return true;
    return false;
  }

  // Checks the faces of polyhedra, because VTK's reader uses them without a check.
  void check_polyhedra() const {
    Numbers types = numbers(types_, "int"), corners = numbers(corners_, type_of_corners_);
    Numbers offsets = numbers(offsets_, type_of_offsets_);
    std::int64_t offset = version_ >= 5 ? offsets.next() : 0;
    if (offset != 0) refuse("has broken cell offsets");
    for (std::int64_t i = 0; i < n_cells_; ++i) {
      std::int64_t n = 0;
      if (version_ >= 5) {
        const std::int64_t next = offsets.next();
        if (next < offset || next > n_corners_) refuse("has broken cell offsets");
        n = next - offset;
        offset = next;
      } else {
        n = corners.next();
      }
      if ((types.next() & 255) == VTK_POLYHEDRON)
        check_polyhedron(i, n, corners);
      else
        corners.skip(n);
    }
  }

  // Checks the n numbers of a polyhedron's faces. The number of faces comes first, and then the number of points and the points
  // of each face.
  void check_polyhedron(std::int64_t cell, std::int64_t n, Numbers &corners) const {
    const auto broken = [&] { refuse("cell ", cell, " has broken polyhedron faces"); };
    if (n < 1) broken();
    std::int64_t n_left = n - 1;
    const std::int64_t n_faces = corners.next();
    for (std::int64_t face = 0; face < n_faces; ++face) {
      if (n_left < 1) broken();
      const std::int64_t n_points = corners.next();
      if (n_points < 0 || n_points > --n_left) broken();
      n_left -= n_points;
      for (std::int64_t i = 0; i < n_points; ++i) {
        const std::int64_t point = corners.next();
        if (point < 0 || point >= n_points_) refuse("cell ", cell, " names point ", point, " of ", n_points_);
      }
    }
    if (n_faces < 0 || n_left != 0) broken();
  }

  std::int32_t binary_int() {
    if (rest_.size() < 4) refuse_end();
    const auto value = static_cast<std::int32_t>(big_endian(rest_.substr(0, 4)));
    rest_.remove_prefix(4);
    return value;
  }

  // Skips an array of POINT_DATA or CELL_DATA. Returns false for any other keyword.
  bool attribute(const std::string &keyword) {
    static const std::map<std::string, int> widths = {{"vectors", 3},   {"normals", 3},    {"tensors", 9},
                                                      {"tensors6", 6},  {"global_ids", 1}, {"pedigree_ids", 1},
                                                      {"edge_flags", 1}};
    const auto found = widths.find(keyword);
    if (found != widths.end()) {
      next();
      skip_tuples(n_tuples_, found->second, next_type());
    } else if (keyword == "scalars") {
      scalars();
    } else if (keyword == "texture_coordinates") {
      next();
      const std::int64_t width = count();
      skip_tuples(n_tuples_, width, next_type());
    } else if (keyword == "color_scalars") {
      next();
      skip_tuples(n_tuples_, count(), type_of_colors());
    } else if (keyword == "lookup_table") {
      next();
      skip_tuples(count(), 4, type_of_colors());
    } else {
      return false;
    }
    return true;
  }

  // In a binary file, colours are bytes. In an ASCII file, colours are numbers from 0 to 1.
  std::string type_of_colors() const { return binary_ ? "unsigned_char" : "float"; }

  void scalars() {
    next();
    const std::string type = next_type();
    std::string after = next();
    std::int64_t width = 1;
    if (after != "lookup_table") {
      width = number_of(after);
      if (width < 1 || width > n_bits_left()) refuse("has SCALARS of ", after, " components");
      after = next();
    }
    if (after != "lookup_table") refuse("has SCALARS without LOOKUP_TABLE");
    next();
    skip_tuples(n_tuples_, width, type);
  }

  const std::string &path_;
  std::string_view bytes_, rest_;
  std::vector<std::string_view> meshio_types_;  // names of types that meshio wrote, at their places in the file
  std::int64_t version_ = 0;                    // major version
  bool binary_ = false;
  LegacyKind kind_ = LegacyKind::unstructured_grid;
  std::optional<Lattice> lattice_;               // of a structured grid
  std::array<std::int64_t, 3> n_coordinates_{};  // of a rectilinear grid
  std::set<std::string> lists_;                  // the keywords of the lists of cells so far
  std::int64_t n_cells_ = -1;                    // -1 if not known yet
  std::int64_t n_types_ = -1;
  std::int64_t n_points_ = 0;
  // Views of the arrays of cells. Each view begins at its array. Files up to version 4 have no offsets. In such files, each cell
  // begins with its number of corners, and the corners follow.
  std::string_view types_, offsets_, corners_;
  std::string type_of_offsets_ = "int", type_of_corners_ = "int";
  std::int64_t n_corners_ = 0;
  std::int64_t n_tuples_ = 0;  // the number of tuples in each array of the present POINT_DATA or CELL_DATA
};

}  // namespace

LegacyContent check_legacy(const std::string &path, LegacyKinds allowed) {
  const MappedFile file(path, check_readable(path));
  return Scan(path, file.bytes()).file(allowed);
}

bool is_structured_legacy(const std::string &path) {
  const MappedFile file(path, check_readable(path));
  return Scan(path, file.bytes()).is_structured_file();
}

}  // namespace riis::vtk
