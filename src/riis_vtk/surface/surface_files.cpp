// SPDX-License-Identifier: Apache-2.0
// Reads and writes the surfaces of riis_vtk.h. Reads a file in one of the formats of docs/formats.md into arrays for the core.
// Writes the core's surface to a .vtp file.
#include <riis/riis_vtk.h>

#include <memory>

#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>

#include "riis_vtk/mesh/mesh.hpp"
#include "riis_vtk/mesh/outside_faces.hpp"
#include "riis_vtk/read/grid_files.hpp"
#include "riis_vtk/read/other_files.hpp"
#include "riis_vtk/surface/surfaces.hpp"

namespace riis::vtk {
namespace {

constexpr std::int64_t binary_header_size = 84;  // 80 arbitrary bytes, then the number of triangles
constexpr std::int64_t binary_triangle_size = 50;

// Returns the number of triangles in the header of a binary file. The number is little endian. Returns 0 if the file is too short
// for a header.
std::int64_t binary_count(std::string_view bytes) {
  if (bytes.size() < static_cast<std::size_t>(binary_header_size)) return 0;
  const auto byte = [&](std::size_t i) { return static_cast<std::int64_t>(static_cast<unsigned char>(bytes[i])); };
  return byte(80) | byte(81) << 8 | byte(82) << 16 | byte(83) << 24;
}

// Counts the triangles in an ASCII file. Only the first word of a line is a keyword. For example, in the line "solid endfacet
// part", the word endfacet is part of a name. Blank lines may follow the last endsolid.
std::int64_t ascii_count(const std::string &path, std::string_view text) {
  std::int64_t n = 0;
  std::string keyword;
  while (!text.empty()) {
    std::string_view line = take_line(text);
    const std::string_view word = take_word(line);
    if (word.empty()) continue;
    keyword = lower_case(word);
    n += keyword == "endfacet";
  }
  if (keyword != "endsolid") fail_file(path, "is truncated: endsolid is missing");
  return n;
}

// Returns the number of triangles that a reader of the file must find. VTK ignores the count in a binary file, and the end mark
// in an ASCII file. From a truncated file, VTK therefore reads a smaller surface.
std::int64_t promised_triangles(const std::string &path, std::string_view bytes) {
  const std::int64_t n = binary_count(bytes);
  const std::int64_t n_behind =
      static_cast<std::int64_t>(bytes.size()) - (binary_header_size + n * binary_triangle_size);
  if (n_behind == 0) return n;
  std::string_view begin = bytes;
  if (lower_case(take_word(begin)) == "solid") return ascii_count(path, bytes);
  if (n_behind > 0) {
    fail_file(path, "has ", n_behind, " bytes behind the ", n, " triangles that its header promises");
  }
  fail_file(path, "is truncated or not an STL file: ", bytes.size(), " bytes, ", n, " triangles in its header");
}

// Reads an ASCII or binary .stl file. Returns polydata with the triangles in the order of the file. Each triangle has three
// points that no other triangle has. If points were merged, some triangles would vanish, and the ids of later triangles would
// change.
vtkSmartPointer<vtkPolyData> read_stl(const std::string &path, const CaughtOutput &caught) {
  const std::int64_t n_promised = promised_triangles(path, MappedFile(path, check_readable(path)).bytes());
  if (n_promised == 0) fail_file(path, "holds no faces");
  vtkNew<vtkSTLReader> reader;
  reader->SetFileName(path.c_str());
  reader->MergingOff();
  reader->Update();
  caught.check(path);
  vtkSmartPointer<vtkPolyData> data = reader->GetOutput();
  if (data->GetNumberOfCells() != n_promised) {
    fail_file(path, "gives ", data->GetNumberOfCells(), " of the ", n_promised, " triangles that it promises");
  }
  data->BuildCells();
  return data;
}

}  // namespace

vtkSmartPointer<vtkPointSet> read_surface_data(const std::string &path, const CaughtOutput &caught) {
  return naming(path, [&]() -> vtkSmartPointer<vtkPointSet> {
    const std::string ending = ending_of(path);
    if (ending == "vtp") return read_polydata(path, caught);
    if (ending == "vtu") return read_grid(path, caught);
    if (ending == "vtk") return read_legacy_surface(path, caught);
    if (ending == "stl") return read_stl(path, caught);
    if (ending == "obj" || ending == "ply") {
      const vtkSmartPointer<vtkUnstructuredGrid> grid = ending == "obj" ? read_obj(path) : read_ply(path);
      check_grid(path, grid);
      return grid;
    }
    fail_file(path, "a surface must be a .vtp, .vtu, .vtk, .stl, .obj or .ply file");
  });
}

}  // namespace riis::vtk

struct riis_vtk_surface {
  riis::vtk::Faces faces;
};

using namespace riis::vtk;

extern "C" {

RIIS_API riis_status riis_vtk_surface_read(const char *path, const char *leaflets, riis_vtk_surface **surface) {
  return guarded([&](const CaughtOutput &caught) {
    require(path, "path");
    require(surface, "surface");
    naming(path, [&] {
      auto made = std::make_unique<riis_vtk_surface>();
      made->faces = faces_of(path, read_surface_data(path, caught), LeafletArray(leaflets));
      *surface = made.release();
    });
  });
}

RIIS_API riis_status riis_vtk_mesh_get_boundary(const riis_vtk_mesh *mesh, riis_vtk_surface **boundary) {
  return guarded([&](const CaughtOutput &) {
    require(mesh, "mesh");
    require(boundary, "boundary");
    const Outside outside = outside_of(mesh->grid(), nullptr, nullptr);
    if (!outside.of_volumes) fail(RIIS_INVALID_ARGUMENT, "mesh has no volume cells, so it has no boundary");
    auto made = std::make_unique<riis_vtk_surface>();
    made->faces = faces_of("boundary", outside.faces, LeafletArray(nullptr));
    *boundary = made.release();
  });
}

RIIS_API riis_status riis_vtk_surface_number_pieces(riis_vtk_surface *surface) {
  return guarded([&](const CaughtOutput &) {
    require(surface, "surface");
    surface->faces.leaflet_id = pieces_of(surface->faces);
  });
}

RIIS_API riis_status riis_vtk_surface_append(riis_vtk_surface *surface, const riis_vtk_surface *other) {
  return guarded(
      [&](const CaughtOutput &) { append_faces(require(surface, "surface")->faces, require(other, "other")->faces); });
}

RIIS_API void riis_vtk_surface_destroy(riis_vtk_surface **surface) { destroy(surface); }

RIIS_API riis_status riis_vtk_surface_get_arrays(const riis_vtk_surface *surface, riis_surface_arrays *arrays,
                                                 int64_t struct_size) {
  return guarded([&](const CaughtOutput &) { give_arrays(require(surface, "surface")->faces, arrays, struct_size); });
}

RIIS_API riis_status riis_vtk_surface_write(const riis_surface *surface, const char *path) {
  return guarded([&](const CaughtOutput &caught) {
    require(surface, "surface");
    require(path, "path");
    naming(path, [&] { write_xml<vtkXMLPolyDataWriter>(path, "vtp", polydata_of(surface), caught); });
  });
}

}  // extern "C"
