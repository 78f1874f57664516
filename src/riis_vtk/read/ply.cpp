// SPDX-License-Identifier: Apache-2.0
// Reads Stanford's .ply files, as text or binary. Vertices and polygons are read. A property of the faces becomes a cell array if
// it is a single number for each face. Other elements and lists are skipped.
#include <algorithm>
#include <set>
#include <vector>

#include <vtkCellData.h>
#include <vtkCellType.h>

#include "riis_vtk/read/other_files.hpp"

namespace riis::vtk {
namespace {

// Only the program trimesh writes types with 8 bytes.
enum class NumberKind { whole, without_sign, real };
struct PlyType {
  std::string_view name, other_name;
  int n_bytes;
  NumberKind kind;
  bool is_real() const { return kind == NumberKind::real; }
};
constexpr PlyType ply_types[] = {
    {"char", "int8", 1, NumberKind::whole},    {"uchar", "uint8", 1, NumberKind::without_sign},
    {"short", "int16", 2, NumberKind::whole},  {"ushort", "uint16", 2, NumberKind::without_sign},
    {"int", "int32", 4, NumberKind::whole},    {"uint", "uint32", 4, NumberKind::without_sign},
    {"int64", "int64", 8, NumberKind::whole},  {"uint64", "uint64", 8, NumberKind::without_sign},
    {"float", "float32", 4, NumberKind::real}, {"double", "float64", 8, NumberKind::real}};

struct PlyProperty {
  std::string name;
  const PlyType *count;  // the type of the number at a list's beginning; NULL for a single number
  const PlyType *type;
};

struct PlyElement {
  std::string name;
  std::int64_t n;
  std::vector<PlyProperty> properties;

  bool has_number(std::string_view property) const {
    return std::any_of(properties.begin(), properties.end(),
                       [&](const PlyProperty &p) { return !p.count && p.name == property; });
  }
  // Returns the list with the vertices of a face, or NULL.
  const PlyProperty *corners() const {
    const auto found = std::find_if(properties.begin(), properties.end(), [](const PlyProperty &p) {
      return p.count && !p.type->is_real() && (p.name == "vertex_indices" || p.name == "vertex_index");
    });
    return found == properties.end() ? nullptr : &*found;
  }
};

class PlyFile {
 public:
  PlyFile(const std::string &path, std::string_view bytes) : path_(path), in_(path, bytes) {}

  vtkSmartPointer<vtkUnstructuredGrid> read() {
    const std::vector<PlyElement> elements = read_header();
    for (const PlyElement &element : elements) read_element(element);
    if (in_.is_binary ? !in_.rest().empty() : !in_.word().empty())
      in_.refuse("the file holds more data than its header states");
    const auto grid = mesh_.grid(path_);
    for (const auto &array : arrays_) grid->GetCellData()->AddArray(array);
    return grid;
  }

 private:
  // ---- The header ----

  // Removes and returns a line, which ends in a line feed or in a single carriage return.
  std::string_view take_own_line(std::string_view &text) const {
    if (!has_returns_) return take_line(text);
    const std::string_view line = text.substr(0, text.find('\r'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    return line;
  }

  std::vector<PlyElement> read_header() {
    if (in_.word() != "ply") fail_file(path_, "is not a PLY file: it does not begin with ply");
    has_returns_ = in_.rest().substr(0, 1) == "\r" && in_.rest().substr(0, 2) != "\r\n";
    if (has_returns_)
      in_.skip(1);
    else
      in_.line();
    std::vector<PlyElement> elements;
    std::string_view format;
    for (;;) {
      if (in_.rest().empty()) fail_file(path_, "is truncated: its header has no end_header");
      std::string_view rest = in_.rest(), line = take_own_line(rest);
      const std::string_view keyword = take_word(line);
      if (keyword == "format") {
        format = take_word(line);
      } else if (keyword == "element") {
        const std::string name(take_word(line));
        elements.push_back({name, in_.integer_of(take_word(line)), {}});
      } else if (keyword == "property") {
        if (elements.empty()) in_.refuse("a property comes before the first element");
        elements.back().properties.push_back(property_of(line));
      } else if (keyword != "end_header" && keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
        in_.refuse("the keyword '", keyword.substr(0, 40), "' does not belong to a header");
      }
      in_.skip(in_.rest().size() - rest.size());
      if (keyword == "end_header") break;
    }
    if (format != "ascii" && format != "binary_little_endian" && format != "binary_big_endian")
      fail_file(path_, "has the format '", format.substr(0, 40), "'");
    in_.is_binary = format != "ascii";
    in_.is_swapped = format == "binary_big_endian";
    return elements;
  }

  PlyProperty property_of(std::string_view line) const {
    std::string_view word = take_word(line);
    const PlyType *count = nullptr;
    if (word == "list") {
      count = &type_of(take_word(line));
      if (count->is_real()) in_.refuse("a list has the number of its values as ", count->name);
      word = take_word(line);
    }
    const PlyType &type = type_of(word);
    return {std::string(take_word(line)), count, &type};
  }

  const PlyType &type_of(std::string_view word) const {
    const auto *const found = std::find_if(std::begin(ply_types), std::end(ply_types), [&](const PlyType &type) {
      return word == type.name || word == type.other_name;
    });
    if (found == std::end(ply_types)) in_.refuse("'", word.substr(0, 40), "' is not a type of numbers");
    return *found;
  }

  // ---- The numbers ----

  std::int64_t whole_number(const PlyType &type) {
    return in_.integer(type.n_bytes, type.kind == NumberKind::without_sign);
  }
  double number(const PlyType &type) {
    return type.is_real() ? in_.real(type.n_bytes) : static_cast<double>(whole_number(type));
  }

  // Returns the number of values in the next list.
  std::int64_t length_of(const PlyProperty &list) {
    const std::int64_t n = whole_number(*list.count);
    in_.check_count(n, in_.is_binary ? list.type->n_bytes : 1, "values of a list");
    return n;
  }
  void skip_list(const PlyProperty &list) {
    for (std::int64_t n = length_of(list); n > 0; --n) number(*list.type);
  }

  // ---- Elements ----

  void read_element(const PlyElement &element) {
    if (element.n == 0) return;
    if (!names_.insert(element.name).second) fail_file(path_, "has the element ", element.name, " twice");
    std::int64_t least_bytes = 0;
    for (const auto &[name, count, type] : element.properties)
      least_bytes += in_.is_binary ? (count ? count : type)->n_bytes : 1;
    if (least_bytes == 0) fail_file(path_, "has the element ", element.name, " without properties");
    in_.check_count(element.n, least_bytes, ("elements " + element.name).c_str());
    if (element.name == "vertex") {
      if (!element.has_number("x") || !element.has_number("y") || !element.has_number("z"))
        fail_file(path_, "has vertices without x, y or z");
      for (std::int64_t i = 0; i < element.n; ++i) read_vertex(element);
    } else if (element.name == "face") {
      if (!element.corners()) fail_file(path_, "has faces without vertex_indices, a list of whole numbers");
      for (const PlyProperty &property : element.properties)
        if (!property.count) arrays_.push_back(named_array<vtkDoubleArray>(property.name, element.n));
      for (std::int64_t i = 0; i < element.n; ++i) read_face(element, i);
    } else if (element.name == "tristrips") {
      fail_file(path_, "holds triangle strips, which are not read");
    } else {
      for (std::int64_t i = 0; i < element.n; ++i) skip(element);
    }
  }

  void read_vertex(const PlyElement &element) {
    double xyz[3] = {0, 0, 0};
    for (const PlyProperty &property : element.properties) {
      if (property.count) {
        skip_list(property);
        continue;
      }
      const double value = number(*property.type);
      const std::string_view axes = "xyz";
      const std::size_t axis = property.name.size() == 1 ? axes.find(property.name) : axes.npos;
      if (axis != axes.npos) xyz[axis] = value;
    }
    mesh_.add_point(xyz[0], xyz[1], xyz[2]);
    expect_end_of_line();
  }

  void read_face(const PlyElement &element, std::int64_t face) {
    std::size_t array = 0;
    for (const PlyProperty &property : element.properties) {
      if (!property.count) {
        arrays_[array++]->SetValue(face, number(*property.type));
      } else if (&property != element.corners()) {
        skip_list(property);
      } else {
        const std::int64_t n = length_of(property);
        if (n < 3) in_.refuse("face ", face, " has ", n, " corners");
        for (std::int64_t i = 0; i < n; ++i) mesh_.ids->InsertNextValue(whole_number(*property.type));
        mesh_.end_cell(n == 3 ? VTK_TRIANGLE : n == 4 ? VTK_QUAD : VTK_POLYGON);
      }
    }
    expect_end_of_line();
  }

  void skip(const PlyElement &element) {
    for (const PlyProperty &property : element.properties)
      property.count ? skip_list(property) : static_cast<void>(number(*property.type));
    expect_end_of_line();
  }

  // In a text file, each vertex and each face is on a separate line.
  void expect_end_of_line() const {
    if (in_.is_binary) return;
    std::string_view rest = in_.rest(), line = take_own_line(rest);
    if (!take_word(line).empty()) in_.refuse("a line has more or fewer numbers than the header states");
  }

  const std::string &path_;
  Source in_;
  bool has_returns_ = false;  // lines end in a carriage return alone
  PlainGrid mesh_;
  std::set<std::string> names_;                          // of the elements
  std::vector<vtkSmartPointer<vtkDoubleArray>> arrays_;  // of the faces
};

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> read_ply(const std::string &path) {
  const MappedFile file(path, check_readable(path));
  return PlyFile(path, file.bytes()).read();
}

}  // namespace riis::vtk
