// SPDX-License-Identifier: Apache-2.0
// The functions of riis_vtk.h for meshes in pieces. Reads and writes the list of pieces in a .pvtu file, and reads a piece. Tells
// which nodes of a piece other pieces may also have.
#include <riis/riis_vtk.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkIdList.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include "common/array_view.hpp"
#include "common/xml_text.hpp"
#include "riis_vtk/mesh/mesh.hpp"
#include "riis_vtk/read/grid_files.hpp"

namespace riis::vtk {

// An array that the list declares for every piece.
struct Declared {
  std::string name, type;  // the type's name in XML
  int n_components = 1;
};

}  // namespace riis::vtk

struct riis_vtk_pieces {
  std::string path;  // the path of the .pvtu file; "" if the list was not read from a file
  std::vector<std::string> files;
  std::vector<const char *> paths;  // points into files
  std::vector<riis::vtk::Declared> point_arrays, cell_arrays;
  std::string global_ids;  // the name of the array with the attribute GlobalIds, or ""
  bool has_ids_of_dolfinx = false;
  bool has_ghosts = false;
};

namespace riis::vtk {
namespace {

constexpr std::int64_t most_pieces = 1'000'000;
constexpr const char *ids_of_dolfinx = "vtkOriginalPointIds";

// ---- The list ----

// Returns the paths of the pieces. A relative name starts from the folder of the list.
std::vector<std::string> files_of(const std::string &path, const std::vector<std::optional<std::string>> &sources) {
  if (sources.empty()) fail_file(path, "names no pieces: it has no Piece in a PUnstructuredGrid");
  if (view(sources).size() > most_pieces)
    fail_file(path, "names ", view(sources).size(), " pieces, more than ", most_pieces);
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::vector<std::string> files;
  std::map<std::string, std::size_t> places;
  for (const std::optional<std::string> &source : sources) {
    const std::string which = "Piece " + std::to_string(files.size());
    if (!source || source->empty()) fail_file(path, which, " names no file");
    const std::string file = (folder / *source).string();
    if (ending_of(file) != "vtu") fail_file(path, which, " is ", file, "; a piece must be a .vtu file");
    try {
      check_readable(file);
    } catch (const Failure &failure) {
      fail_file(path, which, ": ", failure.text);
    }
    std::error_code error;
    const std::string place = std::filesystem::canonical(file, error).string();
    const auto [other, is_new] = places.emplace(error ? file : place, files.size());
    if (!is_new) fail_file(path, which, " is the same file as Piece ", other->second, ", ", file);
    files.push_back(file);
  }
  return files;
}

Declared declared_array(XmlAttributes attributes) {
  Declared array{value_of(attributes, "Name").value_or(""), value_of(attributes, "type").value_or("")};
  if (const auto n = value_of(attributes, "NumberOfComponents"); n && !read_number(*n, array.n_components))
    array.n_components = -1;
  // dolfinx 0.5 writes no number of components for scalars. VTK then gives the array one component.
  if (array.n_components == 0) array.n_components = 1;
  return array;
}

void check_declared(const std::string &path, const std::vector<Declared> &arrays) {
  for (const Declared &array : arrays)
    if (array.n_components < 1) fail_file(path, "array ", array.name, " has no valid NumberOfComponents");
}

void set_files(riis_vtk_pieces &pieces, std::vector<std::string> files) {
  pieces.files = std::move(files);
  pieces.paths.clear();
  for (const std::string &file : pieces.files) pieces.paths.push_back(file.c_str());
}

std::unique_ptr<riis_vtk_pieces> read_pieces(const std::string &path, const CaughtOutput &caught) {
  if (ending_of(path) != "pvtu") fail_file(path, "a list of pieces must be a .pvtu file");
  check_xml(path, "PUnstructuredGrid");
  auto made = std::make_unique<riis_vtk_pieces>();
  std::vector<std::optional<std::string>> sources;
  bool has_byte_order = false;
  for_each_element(path, caught, [&](const std::vector<std::string> &way, XmlAttributes attributes) {
    if (way.size() == 1) has_byte_order = value_of(attributes, "byte_order").has_value();
    if (way.size() < 3 || way[0] != "VTKFile" || way[1] != "PUnstructuredGrid") return;
    const std::string &name = way.back();
    if (way.size() == 3 && name == "Piece") sources.push_back(value_of(attributes, "Source"));
    const bool is_array = name == "PDataArray" || name == "PArray" || name == "DataArray" || name == "Array";
    if (way.size() != 4 || !is_array) return;
    if (way[2] == "PPointData") made->point_arrays.push_back(declared_array(attributes));
    if (way[2] == "PCellData") made->cell_arrays.push_back(declared_array(attributes));
  });
  check_declared(path, made->point_arrays);
  check_declared(path, made->cell_arrays);
  // In the files of a function, dolfinx writes an array that numbers the nodes across all ranks. These files are refused, because
  // the last bits of a shared node's coordinates differ between ranks. A file that states the order of bytes was written by VTK.
  // Such a file is accepted, because VTK's filters number the nodes of each piece separately, so that the numbers have another
  // meaning.
  made->has_ids_of_dolfinx = !has_byte_order && std::any_of(made->point_arrays.begin(), made->point_arrays.end(),
                                                            [](const Declared &a) { return a.name == ids_of_dolfinx; });
  made->path = path;
  set_files(*made, files_of(path, sources));
  return made;
}

// ---- Arrays of a piece ----

// Returns the name of an array's type in VTK's XML files.
std::string xml_type_of(vtkAbstractArray *array) {
  const int type = array->GetDataType(), n_bits = 8 * array->GetDataTypeSize();
  switch (type) {
    case VTK_STRING:
      return "String";
    case VTK_BIT:
      return "Bit";
    case VTK_FLOAT:
    case VTK_DOUBLE:
      return joined("Float", n_bits);
    case VTK_UNSIGNED_CHAR:
    case VTK_UNSIGNED_SHORT:
    case VTK_UNSIGNED_INT:
    case VTK_UNSIGNED_LONG:
    case VTK_UNSIGNED_LONG_LONG:
      return joined("UInt", n_bits);
    default:
      return joined("Int", n_bits);
  }
}

std::vector<Declared> arrays_of(vtkFieldData *data) {
  std::vector<Declared> arrays;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i) {
    vtkAbstractArray *array = data->GetAbstractArray(i);
    if (array->GetName()) arrays.push_back({array->GetName(), xml_type_of(array), array->GetNumberOfComponents()});
  }
  return arrays;
}

// Refuses a piece whose arrays differ from the declared arrays. Pieces with different arrays would not form one mesh.
void check_arrays(const riis_vtk_pieces &pieces, const std::string &path, const char *kind, vtkFieldData *data,
                  const std::vector<Declared> &declared) {
  const std::vector<Declared> arrays = arrays_of(data);
  const auto with_name = [](const std::vector<Declared> &in, const std::string &name) {
    return std::find_if(in.begin(), in.end(), [&](const Declared &array) { return array.name == name; });
  };
  for (const Declared &wanted : declared) {
    const auto array = with_name(arrays, wanted.name);
    const std::string which = joined(kind, " array ", wanted.name);
    if (array == arrays.end()) fail_file(path, "has no ", which, ", which ", pieces.path, " declares");
    if (array->n_components != wanted.n_components)
      fail_file(path, which, " has ", array->n_components, " components; ", pieces.path, " declares ",
                wanted.n_components);
    const std::string type = wanted.type == "vtkIdType" ? "Int64" : wanted.type;
    if (array->type != type) fail_file(path, which, " is ", array->type, "; ", pieces.path, " declares ", type);
  }
  for (const Declared &array : arrays) {
    if (with_name(declared, array.name) != declared.end() || array.name == vtkDataSetAttributes::GhostArrayName())
      continue;
    fail_file(path, "has the ", kind, " array ", array.name, ", which ", pieces.path, " does not declare");
  }
}

// Returns the array of global ids, or NULL if the file has none.
vtkDataArray *global_ids_of(vtkUnstructuredGrid *grid) {
  vtkPointData *data = grid->GetPointData();
  vtkAbstractArray *array = data->GetGlobalIds();
  for (const char *name : {"vtkGlobalIds", "GlobalNodeId", "GlobalPointIds"})
    if (!array) array = data->GetAbstractArray(name);
  if (!array) return nullptr;
  const std::string type = xml_type_of(array);
  if (type.find("Int") == std::string::npos || array->GetNumberOfComponents() != 1)
    fail(RIIS_FILE_ERROR, joined("point array ", array->GetName(), " has ", array->GetNumberOfComponents(),
                                 " components of ", type, "; global ids are one whole number for each node"));
  return vtkDataArray::SafeDownCast(array);
}

vtkSmartPointer<vtkUnstructuredGrid> read_piece(const riis_vtk_pieces &pieces, std::int64_t piece,
                                                const CaughtOutput &caught) {
  const std::string &path = view(pieces.files)[piece];
  vtkSmartPointer<vtkUnstructuredGrid> grid = read_grid(path, caught, Points::may_be_missing);
  if (grid->GetNumberOfPoints() > 0) {
    check_arrays(pieces, path, "point", grid->GetPointData(), pieces.point_arrays);
    check_arrays(pieces, path, "cell", grid->GetCellData(), pieces.cell_arrays);
  }
  if (pieces.has_ids_of_dolfinx && !global_ids_of(grid)) grid->GetPointData()->SetActiveGlobalIds(ids_of_dolfinx);
  return grid;
}

// ---- Shared nodes ----

// Mixes the bits of a number.
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

vtkUnsignedCharArray *ghosts_of(vtkDataSetAttributes *data, const char *kind) {
  vtkAbstractArray *array = data->GetAbstractArray(vtkDataSetAttributes::GhostArrayName());
  auto *const ghosts = vtkUnsignedCharArray::SafeDownCast(array);
  if (array && !ghosts)
    fail(RIIS_FILE_ERROR, joined(kind, " array ", vtkDataSetAttributes::GhostArrayName(), " is ", xml_type_of(array),
                                 "; it must be UInt8"));
  return ghosts;
}

// Finds the nodes that other pieces may also have. A face of two cells in one piece lies inside the piece. For each node, the
// hashes of its faces are combined by exclusive or. The hash of a face inside the piece is combined twice, so it cancels out. The
// result tells, without a list of faces, whether all faces of a node are inside. For each node, the answer is wrong with a
// probability of 2^-64.
class NodeRoles {
 public:
  explicit NodeRoles(vtkUnstructuredGrid *grid)
      : grid_(grid),
        cell_ghosts_(ghosts_of(grid->GetCellData(), "cell")),
        point_ghosts_(ghosts_of(grid->GetPointData(), "point")),
        faces_at_(static_cast<std::size_t>(grid->GetNumberOfPoints())),
        uses_(faces_at_.size()) {
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) add(cell);
  }

  std::uint8_t role(vtkIdType node) const {
    const std::uint8_t use = view(uses_)[node];
    if (use & in_volume)
      return view(faces_at_)[node] == 0 && !(use & in_unknown) ? RIIS_VTK_NODE_INSIDE : RIIS_VTK_NODE_SHARED;
    if (use & in_other) return RIIS_VTK_NODE_SHARED;
    const bool is_copy = point_ghosts_ && (point_ghosts_->GetValue(node) & vtkDataSetAttributes::DUPLICATEPOINT) != 0;
    return (use & in_ghost) || is_copy ? RIIS_VTK_NODE_GHOST : RIIS_VTK_NODE_LOOSE;
  }

  std::int64_t n_cells() const { return n_cells_; }

 private:
  enum Use : std::uint8_t { in_volume = 1, in_unknown = 2, in_other = 4, in_ghost = 8 };

  bool is_ghost(vtkIdType cell) const {
    return cell_ghosts_ && (cell_ghosts_->GetValue(cell) & vtkDataSetAttributes::DUPLICATECELL) != 0;
  }

  void add(vtkIdType cell) {
    vtkIdType n = 0;
    const vtkIdType *ids = nullptr;
    grid_->GetCells()->GetCellAtId(cell, n, ids);
    const int type = grid_->GetCellType(cell);
    const CellShape &shape = shape_of(type);
    const bool has_faces = type == VTK_POLYHEDRON || !shape.faces.empty();
    const int use = is_ghost(cell)         ? in_ghost
                    : shape.dimension != 3 ? in_other
                    : has_faces            ? in_volume
                                           : in_volume | in_unknown;
    for (vtkIdType i = 0; i < n; ++i) view(uses_)[ids[i]] |= static_cast<std::uint8_t>(use);
    if (use & in_ghost) return;
    ++n_cells_;
    if (use != in_volume) return;
    if (type == VTK_POLYHEDRON) return add_polyhedron(cell);
    codes_.resize(static_cast<std::size_t>(n));
    for (vtkIdType i = 0; i < n; ++i) view(codes_)[i] = mixed(static_cast<std::uint64_t>(ids[i]));
    for (const CellShape::Face &face : shape.faces) {
      std::uint64_t sum = 0;
      for (const vtkIdType i : face.nodes) sum += view(codes_)[i];
      const std::uint64_t code = mixed(sum);
      for (const vtkIdType i : face.nodes) view(faces_at_)[ids[i]] ^= code;
    }
  }

  void add_polyhedron(vtkIdType cell) {
    grid_->GetFaceStream(cell, stream_);
    vtkIdType at = 0;
    for (vtkIdType n_left = stream_->GetId(at++); n_left > 0; --n_left) {
      const vtkIdType n = stream_->GetId(at++);
      std::uint64_t sum = 0;
      for (vtkIdType k = 0; k < n; ++k) sum += mixed(static_cast<std::uint64_t>(stream_->GetId(at + k)));
      const std::uint64_t code = mixed(sum);
      for (vtkIdType k = 0; k < n; ++k) view(faces_at_)[stream_->GetId(at + k)] ^= code;
      at += n;
    }
  }

  vtkUnstructuredGrid *grid_;
  vtkUnsignedCharArray *cell_ghosts_, *point_ghosts_;  // may be NULL
  std::vector<std::uint64_t> faces_at_;                // by node
  std::vector<std::uint8_t> uses_;                     // by node
  std::vector<std::uint64_t> codes_;
  vtkNew<vtkIdList> stream_;
  std::int64_t n_cells_ = 0;
};

void copy_ids(vtkDataArray *from, std::int64_t *to) {
  switch (from->GetDataType()) {
    vtkTemplateMacro({
      const auto *const values = static_cast<const VTK_TT *>(from->GetVoidPointer(0));
      for (vtkIdType i = 0; i < from->GetNumberOfTuples(); ++i) to[i] = static_cast<std::int64_t>(values[i]);
    });
  }
}

std::vector<std::string> checked_files(std::int64_t n_files, const char *const *files) {
  if (n_files < 1 || n_files > most_pieces)
    refuse_argument("n_files is ", n_files, "; it must be from 1 to ", most_pieces);
  require(files, "files");
  std::vector<std::string> names;
  for (std::int64_t i = 0; i < n_files; ++i)
    names.emplace_back(require(files[i], ("files[" + std::to_string(i) + "]").c_str()));
  return names;
}

// ---- Writing ----

std::string pieces_text(const std::vector<Declared> &arrays) {
  std::string text;
  for (const Declared &array : arrays) {
    text += joined("      <", array.type == "String" ? "PArray" : "PDataArray", " type=\"", array.type, "\" Name=\"",
                   in_xml(array.name), "\" NumberOfComponents=\"", array.n_components, "\"/>\n");
  }
  return text;
}

std::string pieces_text(const riis_vtk_pieces &pieces, const std::string &path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  const std::string ids = pieces.global_ids.empty() ? "" : " GlobalIds=\"" + in_xml(pieces.global_ids) + "\"";
  std::string text = joined(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n  <PUnstructuredGrid GhostLevel=\"",
      pieces.has_ghosts ? 1 : 0, "\">\n    <PPointData", ids, ">\n", pieces_text(pieces.point_arrays),
      "    </PPointData>\n    <PCellData>\n", pieces_text(pieces.cell_arrays),
      "    </PCellData>\n    <PPoints>\n      <PDataArray type=\"Float64\" Name=\"Points\" "
      "NumberOfComponents=\"3\"/>\n    </PPoints>\n");
  for (const std::string &file : pieces.files) {
    const std::filesystem::path source(file);
    const std::string name =
        (source.is_absolute() == folder.is_absolute() ? source.lexically_proximate(folder) : source).string();
    text += joined("    <Piece Source=\"", in_xml(name), "\"/>\n");
  }
  return text + "  </PUnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace
}  // namespace riis::vtk

using namespace riis::vtk;

extern "C" {

RIIS_API riis_status riis_vtk_pieces_read(const char *path, riis_vtk_pieces **pieces) {
  return guarded([&](const CaughtOutput &caught) {
    require(path, "path");
    require(pieces, "pieces");
    naming(path, [&] { *pieces = read_pieces(path, caught).release(); });
  });
}

RIIS_API riis_status riis_vtk_pieces_create(const riis_vtk_mesh *mesh, int64_t n_files, const char *const *files,
                                            riis_vtk_pieces **pieces) {
  return guarded([&](const CaughtOutput &) {
    vtkUnstructuredGrid *grid = require(mesh, "mesh")->grid();
    std::vector<std::string> names = checked_files(n_files, files);
    require(pieces, "pieces");
    auto made = std::make_unique<riis_vtk_pieces>();
    set_files(*made, std::move(names));
    made->point_arrays = arrays_of(grid->GetPointData());
    made->cell_arrays = arrays_of(grid->GetCellData());
    vtkDataArray *const ids = grid->GetPointData()->GetGlobalIds();
    if (ids && ids->GetName()) made->global_ids = ids->GetName();
    made->has_ghosts = grid->GetCellData()->HasArray(vtkDataSetAttributes::GhostArrayName()) != 0;
    *pieces = made.release();
  });
}

RIIS_API riis_status riis_vtk_pieces_set_files(riis_vtk_pieces *pieces, int64_t n_files, const char *const *files) {
  return guarded([&](const CaughtOutput &) {
    require(pieces, "pieces");
    set_files(*pieces, checked_files(n_files, files));
  });
}

RIIS_API void riis_vtk_pieces_destroy(riis_vtk_pieces **pieces) { destroy(pieces); }

RIIS_API riis_status riis_vtk_pieces_get_files(const riis_vtk_pieces *pieces, int64_t *n_files,
                                               const char *const **paths) {
  return guarded([&](const CaughtOutput &) {
    require(pieces, "pieces");
    if (n_files) *n_files = riis::view(pieces->files).size();
    if (paths) *paths = pieces->paths.data();
  });
}

RIIS_API riis_status riis_vtk_pieces_read_mesh(const riis_vtk_pieces *pieces, int64_t piece, riis_vtk_mesh **mesh) {
  return guarded([&](const CaughtOutput &caught) {
    require(pieces, "pieces");
    const std::int64_t n = riis::view(pieces->files).size();
    if (piece < 0 || piece >= n) refuse_argument("piece is ", piece, "; there are ", n, " pieces");
    require(mesh, "mesh");
    naming(riis::view(pieces->files)[piece], [&] {
      auto made = std::make_unique<riis_vtk_mesh>();
      made->data = read_piece(*pieces, piece, caught);
      make_points_double(made->data);
      *mesh = made.release();
    });
  });
}

RIIS_API riis_status riis_vtk_pieces_write(const riis_vtk_pieces *pieces, const char *path) {
  return guarded([&](const CaughtOutput &) {
    require(pieces, "pieces");
    require(path, "path");
    naming(path, [&] {
      if (ending_of(path) != "pvtu") fail_file(path, "the file's ending must be .pvtu");
      const std::string text = pieces_text(*pieces, path);
      ReplacingFile file(path);
      file.write(reinterpret_cast<const unsigned char *>(text.data()), riis::view(text).size());
      file.commit("</VTKFile>");
    });
  });
}

RIIS_API riis_status riis_vtk_mesh_get_sharing(const riis_vtk_mesh *mesh, int64_t n_nodes, uint8_t *role,
                                               int64_t *global_id, riis_vtk_sharing *sharing, int64_t struct_size) {
  return guarded([&](const CaughtOutput &) {
    vtkUnstructuredGrid *grid = require(mesh, "mesh")->grid();
    const vtkIdType n = grid->GetNumberOfPoints();
    if (n_nodes != n) refuse_argument("n_nodes is ", n_nodes, "; the mesh has ", n, " nodes");
    require(sharing, "sharing");
    check_struct_size(struct_size, sizeof *sharing, sizeof *sharing, "sharing");
    vtkDataArray *const ids = global_ids_of(grid);
    const NodeRoles roles(grid);
    const VolumeCounts counts = count_volumes(grid, ghosts_of(grid->GetCellData(), "cell"));
    if (n > 0) require(role, "role");
    for (vtkIdType i = 0; i < n; ++i) role[i] = roles.role(i);
    if (ids && global_id) copy_ids(ids, global_id);
    *sharing = {roles.n_cells(), counts.n_volumes, counts.n_unknown, ids ? 1 : 0, 0};
  });
}

}  // extern "C"
