// SPDX-License-Identifier: Apache-2.0
// Reads Wavefront's .obj files: the vertices and the polygons. Texture coordinates, normals, groups and materials are skipped. A
// face may refer to vertices that come after it in the file.
#include <algorithm>
#include <array>
#include <vector>

#include <vtkCellType.h>

#include "common/array_view.hpp"
#include "common/byte_order_mark.hpp"
#include "riis_vtk/read/other_files.hpp"

namespace riis::vtk {
namespace {

// Keywords that do not concern the positions of faces.
constexpr std::array<std::string_view, 16> keywords_to_skip = {
    "vt",     "vn",     "vp",     "g",     "s",        "o",   "mg",         "mtllib",
    "usemtl", "usemap", "maplib", "bevel", "c_interp", "lod", "shadow_obj", "trace_obj"};

class ObjFile {
 public:
  ObjFile(const std::string &path, std::string_view bytes) : path_(path), bytes_(bytes), in_(path, bytes) {}

  vtkSmartPointer<vtkUnstructuredGrid> read() {
    in_.skip(bytes_.size() - without_byte_order_mark(bytes_).size());
    while (!in_.rest().empty()) {
      // Error messages name the line at which `in_` stands. Only the copy `rest` moves on, so `in_` still stands at the
      // statement's first line.
      std::string_view rest = in_.rest();
      read_statement(statement(rest));
      in_.skip(in_.rest().size() - rest.size());
    }
    check_corners();
    return mesh_.grid(path_);
  }

 private:
  // Removes one statement from the text and returns it. If a line ends in a backslash, the next line belongs to the same
  // statement, except in a comment.
  std::string_view statement(std::string_view &text) {
    joined_.clear();
    for (;;) {
      std::string_view line = text.substr(0, text.find(line_end_));
      text.remove_prefix(std::min(line.size() + 1, text.size()));
      line = line.substr(0, line.find('#'));
      while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
      const bool goes_on = !line.empty() && line.back() == '\\' && !text.empty();
      if (!goes_on && joined_.empty()) return line;
      joined_.append(line.substr(0, line.size() - (goes_on ? 1 : 0))).append(" ");
      if (!goes_on) return joined_;
    }
  }

  void read_statement(std::string_view text) {
    const std::string_view keyword = take_word(text);
    if (keyword == "v") {
      read_vertex(text);
    } else if (keyword == "f" || keyword == "fo") {  // fo is the old name of a face
      read_face(text);
    } else if (keyword == "l" || keyword == "p") {
      in_.refuse("'", keyword, "' is not a face; a surface has faces only");
    } else if (!keyword.empty() &&
               std::find(keywords_to_skip.begin(), keywords_to_skip.end(), keyword) == keywords_to_skip.end()) {
      in_.refuse("the keyword '", keyword.substr(0, 40), "' is not read");
    }
  }

  // Reads the coordinates x, y and z. A weight or a colour may follow the coordinates.
  void read_vertex(std::string_view text) {
    std::array<double, 7> values{};
    std::size_t n = 0;
    for (std::string_view word = take_word(text); !word.empty(); word = take_word(text)) {
      if (n == values.size()) in_.refuse("a vertex has more than ", values.size(), " numbers");
      values[n++] = in_.real_of(word);
    }
    if (n < 3) in_.refuse("a vertex has ", n, " numbers; it needs x, y and z");
    mesh_.add_point(values[0], values[1], values[2]);
  }

  void read_face(std::string_view text) {
    std::int64_t n = 0;
    for (std::string_view word = take_word(text); !word.empty(); word = take_word(text), ++n)
      mesh_.ids->InsertNextValue(corner_of(word));
    if (n < 3) in_.refuse("a face has ", n, " corners");
    mesh_.end_cell(n == 3 ? VTK_TRIANGLE : n == 4 ? VTK_QUAD : VTK_POLYGON);
    positions_.push_back(bytes_.size() - in_.rest().size());
  }

  // Returns the vertex of a corner such as 7, 7/1, 7/1/3 or 7//3. A negative number counts backwards from the last vertex.
  std::int64_t corner_of(std::string_view word) const {
    constexpr int most_numbers = 3;
    const std::string_view corner = word;
    const auto take_number = [&] {
      const std::string_view number = word.substr(0, word.find('/'));
      word.remove_prefix(std::min(number.size() + 1, word.size()));
      return number;
    };
    const std::int64_t given = in_.integer_of(take_number());
    for (int n = 1; !word.empty(); ++n) {
      if (n == most_numbers) in_.refuse("the corner '", corner.substr(0, 40), "' has more than 3 numbers");
      if (const std::string_view number = take_number(); !number.empty()) in_.integer_of(number);
    }
    const std::int64_t n_vertices = mesh_.xyz->GetNumberOfTuples();
    if (given == 0 || given < -n_vertices)
      in_.refuse("a face names vertex ", given, "; ", n_vertices, " come before it");
    return given > 0 ? given - 1 : n_vertices + given;
  }

  void check_corners() const {
    const std::int64_t n_vertices = mesh_.xyz->GetNumberOfTuples();
    for (std::int64_t face = 0; face < view(positions_).size(); ++face)
      for (vtkIdType i = mesh_.ends->GetValue(face); i < mesh_.ends->GetValue(face + 1); ++i) {
        if (mesh_.ids->GetValue(i) < n_vertices) continue;
        Source at(path_, bytes_);
        at.skip(view(positions_)[face]);
        at.refuse("a face names vertex ", mesh_.ids->GetValue(i) + 1, "; the file has ", n_vertices);
      }
  }

  const std::string &path_;
  std::string_view bytes_;
  Source in_;
  // In old files, a carriage return alone ends a line.
  char line_end_ = bytes_.find('\n') == std::string_view::npos ? '\r' : '\n';
  std::string joined_;  // a statement of several lines
  PlainGrid mesh_;
  std::vector<std::size_t> positions_;  // where each face begins in the file
};

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> read_obj(const std::string &path) {
  const MappedFile file(path, check_readable(path));
  return ObjFile(path, file.bytes()).read();
}

}  // namespace riis::vtk
