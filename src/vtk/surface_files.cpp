// SPDX-License-Identifier: Apache-2.0
// Surfaces of riis_vtk.h: reads a file into arrays for the core, and writes the core's surface to a .vtp file.
#include <riis/riis_vtk.h>

#include <memory>

#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include "vtk/array_names.hpp"
#include "vtk/pieces.hpp"
#include "vtk/surface_data.hpp"
#include "vtk/surface_polydata.hpp"
#include "vtk/vtk_errors.hpp"
#include "vtk/xml_writing.hpp"

struct riis_vtk_surface {
  riis::vtk::Faces faces;
};

namespace riis::vtk {
namespace {

void read_faces(const char *path, const char *leaflets, bool are_required, const CaughtOutput &caught,
                riis_vtk_surface **surface) {
  naming(path, [&] {
    auto made = std::make_unique<riis_vtk_surface>();
    made->faces = faces_of(path, read_surface_data(path, caught), leaflets, are_required);
    *surface = made.release();
  });
}

}  // namespace
}  // namespace riis::vtk

using namespace riis::vtk;

extern "C" {

RIIS_API riis_status riis_vtk_surface_read(const char *path, riis_vtk_surface **surface) {
  return guarded([&](const CaughtOutput &caught) {
    require(path, "path");
    require(surface, "surface");
    read_faces(path, leaflet_array, false, caught, surface);
  });
}

RIIS_API riis_status riis_vtk_surface_read_with_leaflets(const char *path, const char *leaflets,
                                                         riis_vtk_surface **surface) {
  return guarded([&](const CaughtOutput &caught) {
    require(path, "path");
    require(leaflets, "leaflets");
    require(surface, "surface");
    read_faces(path, leaflets, true, caught, surface);
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
    point_at(surface->faces, "arrays", arrays);
  });
}

RIIS_API riis_status riis_vtk_surface_write(const riis_surface *surface, const char *path) {
  return guarded([&](const CaughtOutput &caught) {
    require(surface, "surface");
    require(path, "path");
    naming(path, [&] { write_xml<vtkXMLPolyDataWriter>(path, "vtp", polydata_of(surface), caught); });
  });
}

}  // extern "C"
