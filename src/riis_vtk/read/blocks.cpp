// SPDX-License-Identifier: Apache-2.0
// Meshes that consist of several blocks, which are joined here. The blocks come from an Exodus file, which VTK reads, or from the
// .vtu files that a .vtm file lists.
#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <unordered_map>

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkIdList.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt32Array.h>

#ifdef RIIS_VTK_EXODUS
#include <vtkCompositeDataIterator.h>
#include <vtkExodusIIReader.h>
#include <vtkMultiBlockDataSet.h>
#endif

#include "common/array_view.hpp"
#include "riis_vtk/read/grid_files.hpp"
#include "riis_vtk/read/other_files.hpp"

namespace riis::vtk {
namespace {

// A block of a mesh, and the ids of the block's nodes in the joined mesh.
struct Block {
  vtkSmartPointer<vtkUnstructuredGrid> grid;
  std::vector<vtkIdType> new_id;
};

using Grids = std::vector<vtkSmartPointer<vtkUnstructuredGrid>>;

// Copies the arrays that all blocks have with the same type and number of components. `place` gives the position of each value in
// the new array. If several blocks have a value for one position, the value of the first of these blocks is taken.
template <class DataOf, class Place>
void join_arrays(const std::vector<Block> &blocks, vtkIdType n, const DataOf &data_of, const Place &place,
                 vtkDataSetAttributes *to) {
  vtkDataSetAttributes *const first = data_of(blocks[0]);
  for (int i = 0; i < first->GetNumberOfArrays(); ++i) {
    vtkAbstractArray *const model = first->GetAbstractArray(i);
    const char *const name = model->GetName();
    const bool is_in_all = name && std::all_of(blocks.begin(), blocks.end(), [&](const Block &block) {
                             vtkAbstractArray *const array = data_of(block)->GetAbstractArray(name);
                             return array && array->GetDataType() == model->GetDataType() &&
                                    array->GetNumberOfComponents() == model->GetNumberOfComponents();
                           });
    if (!is_in_all) continue;
    const auto joined_array = vtkSmartPointer<vtkAbstractArray>::Take(model->NewInstance());
    joined_array->SetName(name);
    joined_array->SetNumberOfComponents(model->GetNumberOfComponents());
    joined_array->SetNumberOfTuples(n);
    for (std::size_t block = blocks.size(); block-- > 0;) {
      vtkAbstractArray *const array = data_of(blocks[block])->GetAbstractArray(name);
      for (vtkIdType k = 0; k < array->GetNumberOfTuples(); ++k) joined_array->SetTuple(place(block, k), k, array);
    }
    to->AddArray(joined_array);
  }
}

// Joins several blocks to one mesh. The cells keep the order of the blocks. The cell array `block_array` has the number of each
// cell's block.
vtkSmartPointer<vtkUnstructuredGrid> join(const std::vector<Block> &blocks, vtkIdType n_nodes,
                                          const std::vector<std::int32_t> &numbers, const char *block_array) {
  PlainGrid mesh;
  mesh.xyz->SetNumberOfTuples(n_nodes);
  std::vector<vtkIdType> first_cell = {0};
  std::vector<std::int32_t> number_of_cell;
  vtkNew<vtkIdList> corners;
  for (const Block &block : blocks) {
    vtkUnstructuredGrid *const grid = block.grid;
    for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
      grid->GetPoint(i, mesh.xyz->GetPointer(3 * view(block.new_id)[i]));
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
      const int type = grid->GetCellType(cell);
      const bool has_faces = type == VTK_POLYHEDRON;
      has_faces ? grid->GetFaceStream(cell, corners) : grid->GetCellPoints(cell, corners);
      vtkIdType at = 0;
      const vtkIdType end = corners->GetNumberOfIds();
      if (has_faces) mesh.ids->InsertNextValue(corners->GetId(at++));
      while (at < end) {
        vtkIdType n = end;
        if (has_faces) mesh.ids->InsertNextValue(n = corners->GetId(at++));
        for (; n > 0; --n) mesh.ids->InsertNextValue(view(block.new_id)[corners->GetId(at++)]);
      }
      mesh.end_cell(type);
      number_of_cell.push_back(view(numbers)[static_cast<std::int64_t>(first_cell.size()) - 1]);
    }
    first_cell.push_back(first_cell.back() + grid->GetNumberOfCells());
  }
  const auto grid = mesh.grid("");
  join_arrays(
      blocks, n_nodes,
      [](const Block &block) { return static_cast<vtkDataSetAttributes *>(block.grid->GetPointData()); },
      [&](std::size_t block, vtkIdType k) { return view(blocks[block].new_id)[k]; }, grid->GetPointData());
  join_arrays(
      blocks, first_cell.back(),
      [](const Block &block) { return static_cast<vtkDataSetAttributes *>(block.grid->GetCellData()); },
      [&](std::size_t block, vtkIdType k) { return first_cell[block] + k; }, grid->GetCellData());
  const auto array = named_array<vtkTypeInt32Array>(block_array, first_cell.back());
  std::copy(number_of_cell.begin(), number_of_cell.end(), array->GetPointer(0));
  grid->GetCellData()->AddArray(array);
  return grid;
}

bool is_single(vtkUnstructuredGrid *grid) { return grid->GetPoints()->GetDataType() == VTK_FLOAT; }

// ---- .vtm ----

// Returns the global ids of a block's nodes, or NULL if there are none. VTK's attribute, ParaView and Exodus have different names
// for global ids.
vtkDataArray *global_ids_of(vtkUnstructuredGrid *grid) {
  vtkPointData *const data = grid->GetPointData();
  if (vtkDataArray *ids = data->GetGlobalIds()) return ids;
  for (const char *name : {"GlobalPointIds", "GlobalNodeId", "GlobalPointId", "GlobalIds"})
    if (vtkDataArray *ids = data->GetArray(name))
      if (ids->GetNumberOfComponents() == 1) return ids;
  return nullptr;
}

struct HashOfPoint {
  std::size_t operator()(const std::array<double, 3> &point) const {
    std::size_t hash = 0;
    for (const double x : point) hash = hash * 1000003 + std::hash<double>()(x);
    return hash;
  }
};

// Gives numbers to the nodes of all blocks. Nodes of different blocks become one node if they have the same global id. If a block
// has no global ids, its nodes are joined with nodes at equal coordinates. Two nodes of one block always stay different, so that
// slits stay open. Returns the number of nodes.
vtkIdType number_nodes(std::vector<Block> &blocks) {
  const bool have_ids =
      std::all_of(blocks.begin(), blocks.end(), [](const Block &b) { return global_ids_of(b.grid) != nullptr; });
  std::unordered_map<std::int64_t, vtkIdType> of_id;
  std::unordered_map<std::array<double, 3>, vtkIdType, HashOfPoint> of_point;
  vtkIdType n_nodes = 0;
  for (Block &block : blocks) {
    const vtkIdType n = block.grid->GetNumberOfPoints(), n_before = n_nodes;
    vtkDataArray *const ids = have_ids ? global_ids_of(block.grid) : nullptr;
    block.new_id.resize(static_cast<std::size_t>(n));
    for (vtkIdType i = 0; i < n; ++i) {
      std::array<double, 3> point;
      block.grid->GetPoint(i, point.data());
      const auto add = [&](auto &known, const auto &key) {
        const auto [found, is_new] = known.emplace(key, n_nodes);
        if (is_new || found->second >= n_before) return n_nodes++;
        return found->second;
      };
      view(block.new_id)[i] = ids ? add(of_id, ids->GetVariantValue(i).ToTypeInt64()) : add(of_point, point);
    }
  }
  return n_nodes;
}

// Lists the files that a .vtm file names, in the order of the .vtm file. Files that are not .vtu files, such as the surfaces of a
// boundary, are only counted.
void list_files(const XmlElement &parent, std::vector<std::string> &files, std::int64_t &n_others) {
  for (const XmlElement &child : parent.children) {
    const std::string file = child.attribute("file");
    if (child.name == "DataSet" && !file.empty()) {
      if (ending_of(file) == "vtu")
        files.push_back(file);
      else
        ++n_others;
    }
    list_files(child, files, n_others);
  }
}

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> read_blocks(const std::string &path, const CaughtOutput &caught) {
  std::vector<std::string> files;
  std::int64_t n_others = 0;
  {
    const MappedFile file(path, check_readable(path));
    const XmlElement outermost = parse_xml(path, file.bytes());
    if (outermost.name != "VTKFile" || outermost.attribute("type") != "vtkMultiBlockDataSet")
      fail_file(path, "is not a list of blocks: it must hold a VTKFile of the type vtkMultiBlockDataSet");
    list_files(outermost, files, n_others);
  }
  if (files.empty()) fail_file(path, "lists no .vtu file");
  std::vector<Block> blocks;
  std::vector<std::int32_t> numbers;
  bool has_single = false;
  for (std::int32_t number = 0; number < view(files).size(); ++number) {
    const std::string file = (std::filesystem::path(path).parent_path() / view(files)[number]).string();
    const vtkSmartPointer<vtkUnstructuredGrid> grid = read_grid(file, caught, Points::may_be_missing);
    if (grid->GetNumberOfPoints() == 0) continue;  // a part of the model may lie outside of this mesh
    blocks.push_back({grid, {}});
    has_single = has_single || is_single(grid);
    numbers.push_back(number);
  }
  if (blocks.empty()) fail_file(path, "lists only blocks without points");
  const vtkIdType n_nodes = number_nodes(blocks);
  const auto grid = join(blocks, n_nodes, numbers, "riis_block");
  std::string note = has_single ? "its points have single precision" : "";
  if (n_others > 0)
    note +=
        joined(note.empty() ? "" : "; ", n_others, n_others == 1 ? " block" : " blocks", " of other kinds left out");
  if (!note.empty()) add_note(grid, note);
  return grid;
}

// ---- Exodus ----

#ifdef RIIS_VTK_EXODUS

namespace {

// Fails if the file does not begin as NetCDF and HDF5 files do. Without this check, the Exodus library would print errors on
// stderr.
void check_magic(const std::string &path) {
  const MappedFile file(path, check_readable(path));
  const std::string_view first = file.bytes().substr(0, 4);
  if (first.substr(0, 3) != "CDF" && first != "\x89HDF")
    fail_file(path, "is not an Exodus file: it is neither NetCDF nor HDF5");
}

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> read_exodus(const std::string &path, const CaughtOutput &caught) {
  check_magic(path);
  vtkNew<vtkExodusIIReader> reader;
  if (!reader->CanReadFile(path.c_str())) fail_file(path, "is not an Exodus file, or it is damaged or truncated");
  reader->SetFileName(path.c_str());
  // Each block gets all points of the file. In every block, the nodes thus have their numbers in the file. A node that blocks
  // share stays one node.
  reader->SetSqueezePoints(false);
  reader->SetApplyDisplacements(0);
  reader->UpdateInformation();
  caught.check(path);
  for (int i = 0; i < reader->GetNumberOfObjects(vtkExodusIIReader::ELEM_BLOCK); ++i)
    reader->SetObjectStatus(vtkExodusIIReader::ELEM_BLOCK, i, 1);
  reader->SetAllArrayStatus(vtkExodusIIReader::NODAL, 1);
  reader->SetAllArrayStatus(vtkExodusIIReader::ELEM_BLOCK, 1);
  reader->Update();
  caught.check(path);
  std::vector<Block> blocks;
  std::vector<std::int32_t> numbers;
  const auto blocks_of = vtkSmartPointer<vtkCompositeDataIterator>::Take(reader->GetOutput()->NewIterator());
  for (blocks_of->InitTraversal(); !blocks_of->IsDoneWithTraversal(); blocks_of->GoToNextItem()) {
    auto *const grid = vtkUnstructuredGrid::SafeDownCast(blocks_of->GetCurrentDataObject());
    if (!grid || grid->GetNumberOfCells() == 0) continue;
    check_grid(path, grid);
    vtkDataArray *const number = grid->GetCellData()->GetArray("ObjectId");
    numbers.push_back(number ? static_cast<std::int32_t>(number->GetTuple1(0))
                             : static_cast<std::int32_t>(numbers.size()));
    std::vector<vtkIdType> same(static_cast<std::size_t>(grid->GetNumberOfPoints()));
    for (std::int64_t i = 0; i < view(same).size(); ++i) view(same)[i] = i;
    blocks.push_back({grid, std::move(same)});
  }
  if (blocks.empty()) fail_file(path, "holds no block of elements");
  const vtkIdType n_nodes = blocks[0].grid->GetNumberOfPoints();
  for (const Block &block : blocks)
    if (block.grid->GetNumberOfPoints() != n_nodes)
      fail_file(path, "has blocks with ", n_nodes, " and ", block.grid->GetNumberOfPoints(), " nodes");
  const auto grid = join(blocks, n_nodes, numbers, "exodus:block");
  if (is_single(blocks[0].grid)) add_note(grid, "its points have single precision");
  return grid;
}

#else

vtkSmartPointer<vtkUnstructuredGrid> read_exodus(const std::string &path, const CaughtOutput &) {
  check_readable(path);
  fail_file(path, "is an Exodus file, but this riis was built without VTK's IOExodus");
}

#endif

}  // namespace riis::vtk
