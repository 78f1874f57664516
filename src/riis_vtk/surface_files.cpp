// SPDX-License-Identifier: Apache-2.0
// Surfaces of riis_vtk.h: reads a file into arrays for the core, and writes the core's surface to a .vtp file.
#include <riis/riis_vtk.h>

#include <memory>

#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include "riis_vtk/array_names.hpp"
#include "riis_vtk/pieces.hpp"
#include "riis_vtk/surface_data.hpp"
#include "riis_vtk/surface_polydata.hpp"
#include "riis_vtk/vtk_errors.hpp"
#include "riis_vtk/xml_writing.hpp"

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
      made->faces =
          faces_of(path, read_surface_data(path, caught), leaflets ? leaflets : leaflet_array, leaflets != nullptr);
      *surface = made.release();
    });
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
