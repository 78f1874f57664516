// SPDX-License-Identifier: Apache-2.0
// Reads meshes of OpenFOAM: the files points, faces, owner and neighbour in a folder polyMesh. The files are text or binary, and
// may be compressed by gzip. The format is described in OpenFOAM's user guide, "Mesh description" and "Basic input/output
// format". VTK's reader of OpenFOAM returns coordinates in single precision. This reader keeps the doubles of the file. A
// tetrahedron, pyramid, prism or hexahedron becomes the cell of VTK with this shape. All other cells become polyhedra.
#include <vtk_zlib.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include <vtkCellType.h>

#include "common/array_view.hpp"
#include "riis_vtk/read/other_files.hpp"

namespace riis::vtk {
namespace {

namespace fs = std::filesystem;
using Ids = std::vector<std::int64_t>;

bool has_file(const fs::path &folder, const char *name) {
  std::error_code error;
  return fs::is_regular_file(folder / name, error) || fs::is_regular_file(folder / (std::string(name) + ".gz"), error);
}

std::optional<double> time_of(const fs::path &folder) {
  double time = 0;
  return read_number(std::string_view(folder.filename().string()), time) ? std::optional<double>(time) : std::nullopt;
}

// Unpacks a gzip file. A damaged file gives an error. The memory grows with the unpacked content, not with a size that the file
// states.
std::string unpacked(const std::string &path, std::string_view packed) {
  z_stream stream{};
  if (inflateInit2(&stream, 15 + 16) != Z_OK) throw std::bad_alloc();
  const std::unique_ptr<z_stream, int (*)(z_stream *)> end(&stream, inflateEnd);
  constexpr std::size_t largest_part = std::size_t{1} << 30;
  std::string content;
  std::vector<unsigned char> part(std::size_t{1} << 20);
  int status = Z_OK;
  while (status != Z_STREAM_END) {
    if (stream.avail_in == 0) {
      const std::string_view next = packed.substr(0, largest_part);
      packed.remove_prefix(next.size());
      stream.next_in = reinterpret_cast<unsigned char *>(const_cast<char *>(next.data()));
      stream.avail_in = static_cast<unsigned>(next.size());
    }
    stream.next_out = part.data();
    stream.avail_out = static_cast<unsigned>(part.size());
    status = inflate(&stream, Z_NO_FLUSH);
    if (status == Z_MEM_ERROR) throw std::bad_alloc();
    if (status != Z_OK && status != Z_STREAM_END)
      fail_file(path, status == Z_BUF_ERROR ? "is truncated: its compressed data ends too early"
                                            : "is damaged: its compressed data is wrong");
    content.append(reinterpret_cast<const char *>(part.data()), part.size() - stream.avail_out);
  }
  return content;
}

// A file of OpenFOAM: a header, followed by lists of numbers.
class FoamFile {
 public:
  FoamFile(const fs::path &folder, const char *name) : path_(path_of(folder, name)) {
    file_.emplace(path_, check_readable(path_));
    std::string_view bytes = file_->bytes();
    if (fs::path(path_).extension() == ".gz") {
      content_ = unpacked(path_, bytes);
      bytes = content_;
    }
    in_.emplace(path_, bytes);
    read_header();
  }
  FoamFile(const FoamFile &) = delete;
  FoamFile &operator=(const FoamFile &) = delete;

  const std::string &path() const { return path_; }
  bool is_compact() const { return class_.find("Compact") != std::string::npos; }
  bool is_single() const { return is_binary_ && scalar_bytes_ == 4; }
  template <class... Parts>
  [[noreturn]] void refuse(const Parts &...parts) const {
    in_->refuse(parts...);
  }

  Ids labels() {
    Ids values;
    read_list(
        is_binary_ ? label_bytes_ : 2, "numbers", [&](std::int64_t n) { values.reserve(static_cast<std::size_t>(n)); },
        [&] { values.push_back(is_binary_ ? in_->integer(label_bytes_) : in_->integer_of(token())); });
    return values;
  }

  void read_points(vtkDoubleArray *xyz) {
    read_list(
        is_binary_ ? 3 * scalar_bytes_ : 6, "points", [&](std::int64_t n) { xyz->Allocate(3 * n); },
        [&] {
          if (!is_binary_) expect("(");
          for (int c = 0; c < 3; ++c)
            xyz->InsertNextValue(is_binary_ ? in_->real(scalar_bytes_) : in_->real_of(token()));
          if (!is_binary_) expect(")");
        });
  }

  // Reads lists of nodes one after the other. `ids` gets the nodes of all lists, and `ends` gets 0 and the end of each list in
  // `ids`.
  void read_faces(Ids &ids, Ids &ends) {
    if (is_compact()) {
      ends = labels();
      ids = labels();
      if (ends.empty() || ends.front() != 0 || !std::is_sorted(ends.begin(), ends.end()) ||
          ends.back() != view(ids).size())
        in_->refuse("the offsets of the faces do not fit their list of ", ids.size(), " points");
      return;
    }
    if (is_binary_) in_->refuse("the class is ", class_, "; binary faces are read as faceCompactList");
    ends.push_back(0);
    read_list(
        6, "faces", [](std::int64_t) {},
        [&] {
          const std::int64_t n = in_->integer_of(token());
          in_->check_count(n, 2, "points of a face");
          expect("(");
          for (std::int64_t i = 0; i < n; ++i) ids.push_back(in_->integer_of(token()));
          expect(")");
          ends.push_back(view(ids).size());
        });
  }

  // Reads the values of a field of vectors in the cells. A uniform field has the same value in all `n_cells` cells.
  void read_vectors_of_cells(std::int64_t n_cells, vtkDoubleArray *values) {
    if (class_ != "volVectorField") fail_file(path_, "has the class ", class_, "; a velocity is a volVectorField");
    for (std::string_view key = token(); key != "internalField"; key = token()) {
      if (key.empty()) fail_file(path_, "has no internalField");
      entry("an entry");
    }
    const std::string_view how = token();
    if (how == "uniform") {
      double value[3];
      expect("(");
      for (double &part : value) part = in_->real_of(token());
      expect(")");
      for (std::int64_t i = 0; i < n_cells; ++i) values->InsertNextTuple(value);
    } else if (how == "nonuniform") {
      expect("List<vector>");
      read_points(values);
    } else {
      in_->refuse("internalField begins with \"", std::string(how.substr(0, 40)), "\", not uniform or nonuniform");
    }
    if (values->GetNumberOfTuples() != n_cells)
      fail_file(path_, "has ", values->GetNumberOfTuples(), " values, and the mesh has ", n_cells, " cells");
  }

  // Reads the names and the types of the patches in a file boundary.
  std::vector<std::array<std::string, 2>> patches() {
    std::vector<std::array<std::string, 2>> found;
    const std::int64_t n = in_->integer_of(token());
    in_->check_count(n, 4, "patches");
    expect("(");
    for (std::int64_t i = 0; i < n; ++i) {
      std::array<std::string, 2> patch = {std::string(token()), ""};
      expect("{");
      for (std::string_view key = token(); key != "}"; key = token()) {
        const std::string value = entry("a patch");
        if (key == "type") patch[1] = value;
      }
      found.push_back(patch);
    }
    return found;
  }

 private:
  static std::string path_of(const fs::path &folder, const char *name) {
    const fs::path plain = folder / name;
    std::error_code error;
    return fs::exists(plain, error) ? plain.string() : plain.string() + (has_file(folder, name) ? ".gz" : "");
  }

  void skip_comments() {
    for (;;) {
      const auto begin = std::find_if_not(in_->rest().begin(), in_->rest().end(), is_blank);
      in_->skip(static_cast<std::size_t>(begin - in_->rest().begin()));
      const std::string_view two = in_->rest().substr(0, 2);
      if (two == "//") {
        in_->line();
      } else if (two == "/*") {
        const std::size_t end = in_->rest().find("*/");
        if (end == std::string_view::npos) fail_file(path_, "is truncated: it ends within a comment");
        in_->skip(end + 2);
      } else {
        return;
      }
    }
  }

  // Returns the next word, or one of the characters ( ) { } ;. At the end of the file, returns "".
  std::string_view token() {
    skip_comments();
    const std::string_view rest = in_->rest();
    if (rest.empty()) return rest;
    const auto ends = [](char c) { return is_blank(c) || std::string_view("(){};").find(c) != std::string_view::npos; };
    std::size_t length = 1;
    if (rest[0] == '"') {
      length = std::min(rest.find('"', 1), rest.size() - 1) + 1;
    } else if (!ends(rest[0])) {
      while (length < rest.size() && !ends(rest[length])) ++length;
    }
    in_->skip(length);
    return rest.substr(0, length);
  }

  // Reads the rest of an entry, which is a sequence of words up to a ";", or a dictionary in braces. Returns the words as one
  // text.
  std::string entry(const char *within) {
    std::string words;
    for (std::int64_t depth = 0;;) {
      const std::string_view word = token();
      if (word.empty() || (word == "}" && depth == 0)) fail_file(path_, "is truncated: it ends within ", within);
      if (word == ";" && depth == 0) return words;
      words += word;
      if (word == "{") ++depth;
      if (word == "}" && --depth == 0) return words;
    }
  }

  void expect(std::string_view wanted) {
    const std::string_view found = token();
    if (found.empty()) fail_file(path_, "is truncated: it ends before a \"", std::string(wanted), "\"");
    if (found != wanted)
      in_->refuse("\"", std::string(found.substr(0, 40)), "\" stands where there must be a \"", std::string(wanted),
                  "\"");
  }

  void read_header() {
    if (token() != "FoamFile") fail_file(path_, "is not a file of OpenFOAM: it does not begin with FoamFile");
    expect("{");
    std::string format = "ascii", arch;
    for (std::string_view key = token(); key != "}"; key = token()) {
      if (key.empty()) fail_file(path_, "is truncated: it ends within its header");
      const std::string value = entry("its header");
      if (key == "format") format = value;
      if (key == "arch") arch = value;
      if (key == "class") class_ = value;
    }
    if (format != "ascii" && format != "binary")
      fail_file(path_, "has the format ", format, "; it must be ascii or binary");
    is_binary_ = format == "binary";
    in_->is_swapped = arch.find("MSB") != std::string::npos;
    const auto bytes_in = [&](const std::string &name, int bytes) {
      const std::size_t at = arch.find(name + "=");
      if (at == std::string::npos) return bytes;
      const std::string bits = arch.substr(at + name.size() + 1, 2);
      if (bits != "32" && bits != "64") fail_file(path_, "has a ", name, " of ", bits, " bits; 32 and 64 are read");
      return bits == "32" ? 4 : 8;
    };
    label_bytes_ = bytes_in("label", 4);
    scalar_bytes_ = bytes_in("scalar", 8);
  }

  // Reads a list "N (...)", or "N {value}" for N equal values. In a binary list, bytes stand between the parentheses.
  template <class Reserve, class ReadOne>
  void read_list(int least_bytes, const char *things, const Reserve &reserve, const ReadOne &read_one) {
    const std::int64_t n = in_->integer_of(token());
    const bool has_content = n != 0;
    skip_comments();
    if (!has_content && (in_->rest().empty() || (in_->rest()[0] != '(' && in_->rest()[0] != '{'))) return;
    if (!in_->rest().empty() && in_->rest()[0] == '{') {
      // In OpenFOAM, only lists of labels have one value in braces.
      if (is_binary_ || least_bytes != 2) in_->refuse("equal ", things, " in {} are not read");
      return read_equal(n, things, read_one);
    }
    if (in_->rest().empty() || in_->rest()[0] != '(') expect("(");
    in_->skip(1);
    in_->check_count(n, least_bytes, things);
    reserve(n);
    in_->is_binary = is_binary_;
    for (std::int64_t i = 0; i < n; ++i) read_one();
    in_->is_binary = false;
    expect(")");
  }

  // A list of equal entries may be much longer than its file, so it needs a separate limit. The limit is the number of entries
  // that a mesh with one block of cells could need.
  template <class ReadOne>
  void read_equal(std::int64_t n, const char *things, const ReadOne &read_one) {
    constexpr std::int64_t most = 1 << 20;
    if (n < 0 || n > most) in_->refuse("claims ", n, " equal ", things, "; at most ", most, " are read");
    in_->skip(1);
    const Source before = *in_;
    for (std::int64_t i = 0; i < n; ++i) {
      in_.emplace(before);
      read_one();
    }
    expect("}");
  }

  std::string path_, content_, class_;
  std::optional<MappedFile> file_;
  std::optional<Source> in_;
  bool is_binary_ = false;
  int label_bytes_ = 4, scalar_bytes_ = 8;
};

// The folders of a mesh. If points move, the file points is in the folder of a time.
struct Folders {
  fs::path mesh, points;
};

// The faces of one folder, and the cells on the two sides of each face.
struct Faces {
  Ids node_ids, ends, owner, neighbor;
  std::int64_t n_cells = 0;

  std::int64_t n_faces() const { return static_cast<std::int64_t>(ends.size()) - 1; }
  std::int64_t size(std::int64_t face) const { return view(ends)[face + 1] - view(ends)[face]; }
  std::int64_t node(std::int64_t face, std::int64_t i) const { return view(node_ids)[view(ends)[face] + i]; }
};

Faces read_all_faces(const Folders &folders, std::int64_t n_points) {
  Faces faces;
  FoamFile face_file(folders.mesh, "faces"), owner_file(folders.mesh, "owner"),
      neighbor_file(folders.mesh, "neighbour");
  face_file.read_faces(faces.node_ids, faces.ends);
  faces.owner = owner_file.labels();
  faces.neighbor = neighbor_file.labels();
  // Old versions of OpenFOAM write -1 as the neighbour of a boundary face.
  while (!faces.neighbor.empty() && faces.neighbor.back() == -1) faces.neighbor.pop_back();
  const std::int64_t n = faces.n_faces();
  if (view(faces.owner).size() != n)
    fail_file(owner_file.path(), "has ", faces.owner.size(), " entries for ", n, " faces");
  if (view(faces.neighbor).size() > n)
    fail_file(neighbor_file.path(), "has ", faces.neighbor.size(), " entries for ", n, " faces");
  for (std::int64_t face = 0; face < n; ++face) {
    if (faces.size(face) < 3) fail_file(face_file.path(), "face ", face, " has ", faces.size(face), " points");
    for (std::int64_t i = 0; i < faces.size(face); ++i)
      if (faces.node(face, i) < 0 || faces.node(face, i) >= n_points)
        fail_file(face_file.path(), "face ", face, " names point ", faces.node(face, i), " of ", n_points);
  }
  const auto check_cells = [&](const Ids &cells, const FoamFile &file) {
    for (std::int64_t face = 0; face < view(cells).size(); ++face) {
      const std::int64_t cell = view(cells)[face];
      if (cell < 0 || cell >= n)
        fail_file(file.path(), "face ", face, " names cell ", cell, ", and there are ", n, " faces");
      faces.n_cells = std::max(faces.n_cells, cell + 1);
    }
  };
  check_cells(faces.owner, owner_file);
  check_cells(faces.neighbor, neighbor_file);
  return faces;
}

// The faces of a cell. An entry has the number of a face, and tells whether the face's normal points out of the cell.
struct CellFace {
  std::int64_t face;
  bool is_outward;
};

using Corners = std::vector<vtkIdType>;

Corners corners_of(const Faces &faces, CellFace of, bool outward) {
  Corners corners;
  for (std::int64_t i = 0; i < faces.size(of.face); ++i) corners.push_back(faces.node(of.face, i));
  if (of.is_outward != outward) std::reverse(corners.begin() + 1, corners.end());
  return corners;
}

Corners sorted(Corners corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
}

// A linear cell of VTK with a base. All other nodes of the cell are one apex, or one node above each node of the base.
struct Shape {
  int vtk_type;
  std::int64_t n_faces, base_size, n_nodes;
  bool base_is_outward;
};
constexpr Shape shapes[] = {{VTK_TETRA, 4, 3, 4, false},
                            {VTK_PYRAMID, 5, 4, 5, false},
                            {VTK_WEDGE, 5, 3, 6, true},
                            {VTK_HEXAHEDRON, 6, 4, 8, false}};

// Returns the node that shares an edge of the cell with `corner` and is not in the base. Returns -1 if no node fits, or if
// several nodes fit.
vtkIdType node_above(const Faces &faces, const std::vector<CellFace> &cell, const Corners &base, vtkIdType corner) {
  vtkIdType above = -1;
  for (const CellFace of : cell) {
    const std::int64_t n = faces.size(of.face);
    for (std::int64_t i = 0; i < n; ++i) {
      if (faces.node(of.face, i) != corner) continue;
      for (const std::int64_t next : {(i + 1) % n, (i + n - 1) % n}) {
        const vtkIdType node = faces.node(of.face, next);
        if (std::find(base.begin(), base.end(), node) != base.end() || node == above) continue;
        if (above >= 0) return -1;
        above = node;
      }
    }
  }
  return above;
}

// Returns the nodes of a cell of this shape in VTK's order. For a cell of another shape, returns no nodes.
Corners nodes_as(const Shape &shape, const Faces &faces, const std::vector<CellFace> &cell) {
  if (static_cast<std::int64_t>(cell.size()) != shape.n_faces) return {};
  const auto base_face =
      std::find_if(cell.begin(), cell.end(), [&](CellFace of) { return faces.size(of.face) == shape.base_size; });
  if (base_face == cell.end()) return {};
  const Corners base = corners_of(faces, *base_face, shape.base_is_outward);
  Corners top;
  for (const vtkIdType corner : base) top.push_back(node_above(faces, cell, base, corner));
  const bool has_apex = shape.n_nodes == shape.base_size + 1;
  if (has_apex && std::count(top.begin(), top.end(), top[0]) != shape.base_size) return {};
  if (std::find(top.begin(), top.end(), -1) != top.end()) return {};
  // The faces that a cell of the shape must have.
  std::vector<Corners> wanted = {sorted(base)}, found;
  const auto n = static_cast<std::size_t>(shape.base_size);
  for (std::size_t i = 0; i < n; ++i) {
    Corners side = {base[i], base[(i + 1) % n], top[i]};
    if (!has_apex) side.push_back(top[(i + 1) % n]);
    wanted.push_back(sorted(side));
  }
  if (!has_apex) wanted.push_back(sorted(top));
  for (const CellFace of : cell) found.push_back(sorted(corners_of(faces, of, true)));
  std::sort(wanted.begin(), wanted.end());
  std::sort(found.begin(), found.end());
  Corners nodes = base;
  nodes.insert(nodes.end(), top.begin(), has_apex ? top.begin() + 1 : top.end());
  const Corners in_order = sorted(nodes);
  const bool are_distinct = std::adjacent_find(in_order.begin(), in_order.end()) == in_order.end();
  return wanted == found && are_distinct ? nodes : Corners();
}

// If VTK has a linear cell of this shape, adds this cell. Otherwise adds a polyhedron with the cell's faces.
void add_cell(const Faces &faces, const std::vector<CellFace> &cell, PlainGrid &mesh) {
  for (const Shape &shape : shapes) {
    const Corners nodes = nodes_as(shape, faces, cell);
    if (nodes.empty()) continue;
    for (const vtkIdType node : nodes) mesh.ids->InsertNextValue(node);
    return mesh.end_cell(shape.vtk_type);
  }
  mesh.ids->InsertNextValue(static_cast<vtkIdType>(cell.size()));
  for (const CellFace of : cell) {
    mesh.ids->InsertNextValue(faces.size(of.face));
    for (const vtkIdType node : corners_of(faces, of, true)) mesh.ids->InsertNextValue(node);
  }
  mesh.end_cell(VTK_POLYHEDRON);
}

void add_cells(const std::string &path, const Faces &faces, PlainGrid &mesh) {
  std::vector<std::int64_t> end(static_cast<std::size_t>(faces.n_cells) + 1);
  for (const Ids *cells : {&faces.owner, &faces.neighbor})
    for (const std::int64_t cell : *cells) ++view(end)[cell + 1];
  for (std::int64_t cell = 0; cell < faces.n_cells; ++cell) {
    if (view(end)[cell + 1] < 4)
      fail_file(path, "cell ", cell, " has ", view(end)[cell + 1], " faces; a cell has at least 4");
    view(end)[cell + 1] += view(end)[cell];
  }
  std::vector<CellFace> all(faces.owner.size() + faces.neighbor.size());
  std::vector<std::int64_t> next(end.begin(), end.end() - 1);
  for (const bool is_outward : {true, false}) {
    const Ids &cells = is_outward ? faces.owner : faces.neighbor;
    for (std::int64_t face = 0; face < view(cells).size(); ++face)
      view(all)[view(next)[view(cells)[face]]++] = {face, is_outward};
  }
  std::vector<CellFace> cell;
  for (std::int64_t i = 0; i < faces.n_cells; ++i) {
    cell.assign(all.begin() + view(end)[i], all.begin() + view(end)[i + 1]);
    add_cell(faces, cell, mesh);
  }
}

// Reads the mesh of a folder. Returns whether the numbers in its files have single precision.
bool read_folder(const Folders &folders, PlainGrid &mesh) {
  FoamFile points(folders.points, "points");
  points.read_points(mesh.xyz);
  const Faces faces = read_all_faces(folders, mesh.xyz->GetNumberOfTuples());
  add_cells(folders.mesh.string(), faces, mesh);
  return points.is_single();
}

// ---- Decomposed cases ----

// Returns the ids that the nodes or the cells of the parts have in the whole mesh, in one list for each part. Fails if the ids
// are not exactly the numbers from 0 to the largest id.
std::vector<Ids> read_addresses(const std::vector<fs::path> &folders, const char *name, const Ids &sizes) {
  std::vector<Ids> all;
  std::int64_t n_claimed = 0, most = -1;
  for (std::size_t i = 0; i < folders.size(); ++i) {
    if (!has_file(folders[i], name))
      fail_file(folders[i].string(), "has no file ", name, "; reconstructParMesh -constant joins the parts");
    FoamFile file(folders[i], name);
    all.push_back(file.labels());
    if (all[i].size() != static_cast<std::size_t>(sizes[i]))
      fail_file(file.path(), "has ", all[i].size(), " entries for ", sizes[i]);
    n_claimed += sizes[i];
    for (const std::int64_t id : all[i]) most = std::max(most, id);
  }
  std::vector<bool> is_known(static_cast<std::size_t>(std::clamp(most + 1, std::int64_t{0}, n_claimed)));
  for (std::size_t i = 0; i < folders.size(); ++i)
    for (const std::int64_t id : all[i]) {
      if (id < 0 || id >= n_claimed)
        fail_file(folders[i].string(), name, " names ", id, ", and all parts have ", n_claimed);
      is_known[static_cast<std::size_t>(id)] = true;
    }
  const auto missing = std::find(is_known.begin(), is_known.end(), false);
  if (missing != is_known.end())
    fail_file(folders[0].string(), name, " of no part names ", static_cast<std::int64_t>(missing - is_known.begin()));
  return all;
}

std::int64_t n_of(const std::vector<Ids> &addresses) {
  std::int64_t most = -1;
  for (const Ids &ids : addresses)
    for (const std::int64_t id : ids) most = std::max(most, id);
  return most + 1;
}

// Joins the parts of a decomposed case to one mesh. Nodes and cells have the order of the whole mesh. If several parts share a
// node, the node is taken from the first of these parts.
bool read_parts(const std::string &path, const std::vector<fs::path> &folders, PlainGrid &whole) {
  std::vector<std::unique_ptr<PlainGrid>> parts;
  Ids n_points, n_cells;
  bool is_single = false;
  for (const fs::path &folder : folders) {
    parts.push_back(std::make_unique<PlainGrid>());
    is_single = read_folder({folder, folder}, *parts.back()) || is_single;
    n_points.push_back(parts.back()->xyz->GetNumberOfTuples());
    n_cells.push_back(parts.back()->types->GetNumberOfValues());
  }
  const std::vector<Ids> point_ids = read_addresses(folders, "pointProcAddressing", n_points);
  const std::vector<Ids> cell_ids = read_addresses(folders, "cellProcAddressing", n_cells);
  whole.xyz->SetNumberOfTuples(n_of(point_ids));
  std::vector<std::array<std::int64_t, 2>> part_of(static_cast<std::size_t>(n_of(cell_ids)), {-1, -1});
  for (std::size_t part = parts.size(); part-- > 0;) {
    for (std::int64_t i = 0; i < n_points[part]; ++i)
      std::copy_n(parts[part]->xyz->GetPointer(3 * i), 3, whole.xyz->GetPointer(3 * view(point_ids[part])[i]));
    for (std::int64_t i = 0; i < n_cells[part]; ++i) {
      auto &place = view(part_of)[view(cell_ids[part])[i]];
      if (place[0] >= 0) fail_file(path, "cell ", view(cell_ids[part])[i], " is in two parts");
      place = {static_cast<std::int64_t>(part), i};
    }
  }
  for (const auto &place : part_of) {
    const PlainGrid &part = *view(parts)[place[0]];
    const Ids &new_id = view(point_ids)[place[0]];
    const int type = part.types->GetValue(place[1]);
    vtkIdType at = part.ends->GetValue(place[1]);
    const vtkIdType end = part.ends->GetValue(place[1] + 1);
    if (type == VTK_POLYHEDRON) whole.ids->InsertNextValue(part.ids->GetValue(at++));
    while (at < end) {
      std::int64_t n = end - at;
      if (type == VTK_POLYHEDRON) whole.ids->InsertNextValue(n = part.ids->GetValue(at++));
      for (; n > 0; --n) whole.ids->InsertNextValue(view(new_id)[part.ids->GetValue(at++)]);
    }
    whole.end_cell(type);
  }
  return is_single;
}

// ---- Folders ----

bool is_mesh(const fs::path &folder) { return has_file(folder, "faces") && has_file(folder, "owner"); }

// Returns the folders polyMesh of the parts of a decomposed case, in the order of the parts. For other cases, returns no folders.
std::vector<fs::path> parts_of(const fs::path &root) {
  std::vector<fs::path> folders;
  std::error_code error;
  for (std::size_t i = 0; fs::is_directory(root / ("processor" + std::to_string(i)), error); ++i)
    folders.push_back(root / ("processor" + std::to_string(i)) / "constant" / "polyMesh");
  return folders;
}

// Returns the folders of the times of a case.
std::map<double, fs::path> times_of(const fs::path &root) {
  std::map<double, fs::path> found;
  std::error_code error;
  for (const fs::directory_entry &entry : fs::directory_iterator(root, error))
    if (const std::optional<double> time = time_of(entry.path())) found[*time] = entry.path();
  return found;
}

// Finds the latest folder of a case in which this file of the mesh exists. The time of the folder must not be after the given
// time.
fs::path latest_with(const fs::path &root, double time, const char *file) {
  fs::path latest = root / "constant" / "polyMesh";
  for (const auto &[at, folder] : times_of(root))
    if (at <= time && has_file(folder / "polyMesh", file)) latest = folder / "polyMesh";
  return latest;
}

// Returns whether the case has a folder such as processors4. Each file in the folder processors4 has the parts of all processes.
bool has_collated_parts(const fs::path &root) {
  std::error_code error;
  const fs::directory_iterator entries(root, error);
  return !error && std::any_of(begin(entries), end(entries), [](const fs::directory_entry &entry) {
    return entry.path().filename().string().rfind("processors", 0) == 0;
  });
}

fs::path parent_of(const fs::path &path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

}  // namespace

bool is_openfoam(const std::string &path) {
  std::error_code error;
  return ending_of(path) == "foam" || fs::is_directory(path, error);
}

bool is_foam_time(const std::string &path) {
  fs::path folder = path;
  if (!folder.has_filename()) folder = folder.parent_path();
  return time_of(folder) && is_mesh(parent_of(folder) / "constant" / "polyMesh");
}

std::string foam_times_of(const std::string &foam_case) {
  const std::map<double, fs::path> times = times_of(foam_case);
  std::string text;
  std::size_t i = 0;
  for (const auto &[time, folder] : times) {
    if (i < 2 || i + 1 == times.size())
      text += (text.empty() ? "" : ", ") + folder.filename().string();
    else if (i == 2)
      text += ", ...";
    ++i;
  }
  return text;
}

std::string foam_case_of(const std::string &path) {
  fs::path root = path;
  if (ending_of(path) == "foam" && !fs::is_directory(root)) root = parent_of(root);
  if (!root.has_filename()) root = root.parent_path();  // a path may end with a slash
  if (root.filename() == "polyMesh") root = parent_of(root);
  if (root.filename() == "constant" || is_foam_time(root.string())) root = parent_of(root);
  return root.string();
}

std::vector<std::array<std::string, 2>> read_patches(const std::string &foam_case) {
  return FoamFile(fs::path(foam_case) / "constant" / "polyMesh", "boundary").patches();
}

vtkSmartPointer<vtkDoubleArray> read_foam_vectors(const std::string &folder, const std::string &name,
                                                  std::int64_t n_cells) {
  const auto values = vtkSmartPointer<vtkDoubleArray>::New();
  values->SetNumberOfComponents(3);
  FoamFile(folder, name.c_str()).read_vectors_of_cells(n_cells, values);
  return values;
}

vtkSmartPointer<vtkUnstructuredGrid> read_openfoam(const std::string &path) {
  fs::path root = path;
  if (ending_of(path) == "foam" && !fs::is_directory(root)) root = parent_of(root);
  if (!root.has_filename()) root = root.parent_path();  // a path may end with a slash
  PlainGrid mesh;
  bool is_single = false;
  const fs::path constant = root / "constant" / "polyMesh";
  const std::optional<double> time = time_of(root);
  if (is_mesh(root)) {
    is_single = read_folder({root, root}, mesh);
  } else if (is_mesh(constant)) {
    is_single = read_folder({constant, constant}, mesh);
  } else if (time && is_mesh(parent_of(root) / "constant" / "polyMesh")) {
    const fs::path whole = parent_of(root);
    is_single = read_folder({latest_with(whole, *time, "faces"), latest_with(whole, *time, "points")}, mesh);
  } else if (const std::vector<fs::path> parts = parts_of(root); !parts.empty()) {
    is_single = read_parts(path, parts, mesh);
  } else if (has_collated_parts(root)) {
    fail_file(path, "has all its parts in one folder; OpenFOAM's program reconstructParMesh -constant joins the parts");
  } else if (fs::exists(root / "md.idx")) {
    fail_file(path, "is a folder of ADIOS2, which riis cannot read");
  } else {
    fail_file(path, "is a directory, but not a case of OpenFOAM: it lacks constant/polyMesh");
  }
  const auto grid = mesh.grid(path);
  if (is_single) add_note(grid, "its points have single precision");
  return grid;
}

}  // namespace riis::vtk
