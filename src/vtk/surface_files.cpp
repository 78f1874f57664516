// SPDX-License-Identifier: Apache-2.0
// Surfaces of riis_vtk.h: reads a file into arrays for the core, and writes the core's surface to a .vtp file.
#include <riis/riis_vtk.h>

#include <memory>

#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>

#include "vtk/array_names.hpp"
#include "vtk/faces.hpp"
#include "vtk/files.hpp"
#include "vtk/grid_files.hpp"
#include "vtk/pieces.hpp"
#include "vtk/stl_files.hpp"
#include "vtk/surface_polydata.hpp"
#include "vtk/vtk_errors.hpp"
#include "vtk/xml_writing.hpp"

struct riis_vtk_surface {
  riis::vtk::Faces faces;
};

namespace riis::vtk {
namespace {

vtkSmartPointer<vtkPointSet> read_data_set(const std::string &path, const CaughtOutput &caught) {
  const std::string ending = ending_of(path);
  if (ending == "vtp") return read_polydata(path, caught);
  if (ending == "vtu") return read_grid(path, caught);
  if (ending == "stl") return read_stl(path, caught);
  fail_file(path, "a surface must be a .vtp, .vtu or .stl file");
}

void point_at(const Faces &faces, riis_surface_arrays &arrays) {
  arrays.n_vertices = static_cast<int64_t>(faces.xyz.size() / 3);
  arrays.x = faces.xyz.data();
  arrays.y = arrays.x + 1;
  arrays.z = arrays.x + 2;
  arrays.stride = 3;
  arrays.n_faces = static_cast<int64_t>(faces.vertex_ids.size()) / faces.corners_per_face;
  arrays.vertex_ids = faces.vertex_ids.data();
  arrays.vertex_id_bits = 64;
  arrays.index_base = 0;
  arrays.corners_per_face = faces.corners_per_face;
  arrays.leaflet_id = faces.leaflet_id.empty() ? nullptr : faces.leaflet_id.data();
}

}  // namespace
}  // namespace riis::vtk

using namespace riis::vtk;

extern "C" {

RIIS_API riis_status riis_vtk_surface_read(const char *path, riis_vtk_surface **surface) {
  return guarded([&](const CaughtOutput &caught) {
    require(path, "path");
    require(surface, "surface");
    auto made = std::make_unique<riis_vtk_surface>();
    made->faces = faces_of(path, read_data_set(path, caught), leaflet_array, false);
    *surface = made.release();
  });
}

RIIS_API riis_status riis_vtk_surface_read_with_leaflets(const char *path, const char *leaflets,
                                                         riis_vtk_surface **surface) {
  return guarded([&](const CaughtOutput &caught) {
    require(path, "path");
    require(leaflets, "leaflets");
    require(surface, "surface");
    auto made = std::make_unique<riis_vtk_surface>();
    made->faces = faces_of(path, read_data_set(path, caught), leaflets, true);
    *surface = made.release();
  });
}

RIIS_API riis_status riis_vtk_surface_number_pieces(riis_vtk_surface *surface) {
  return guarded([&](const CaughtOutput &) {
    require(surface, "surface");
    surface->faces.leaflet_id = pieces_of(surface->faces);
  });
}

RIIS_API void riis_vtk_surface_destroy(riis_vtk_surface **surface) {
  if (!surface) return;
  delete *surface;
  *surface = nullptr;
}

RIIS_API riis_status riis_vtk_surface_arrays(const riis_vtk_surface *surface, riis_surface_arrays *arrays) {
  return guarded([&](const CaughtOutput &) {
    require(surface, "surface");
    require(arrays, "arrays");
    if (arrays->struct_size != sizeof *arrays) {
      fail(RIIS_INVALID_STRUCT_SIZE, "arrays was not filled by riis_surface_arrays_init: struct_size " +
                                         std::to_string(arrays->struct_size) + ", not " +
                                         std::to_string(sizeof *arrays));
    }
    point_at(surface->faces, *arrays);
  });
}

RIIS_API riis_status riis_vtk_surface_write(const riis_surface *surface, const char *path) {
  return guarded([&](const CaughtOutput &caught) {
    require(surface, "surface");
    require(path, "path");
    write_xml<vtkXMLPolyDataWriter>(path, "vtp", polydata_of(surface), caught);
  });
}

}  // extern "C"
