// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/surface_data.hpp"

#include <cstddef>

#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include "riis_vtk/files.hpp"
#include "riis_vtk/grid_files.hpp"
#include "riis_vtk/stl_files.hpp"

namespace riis::vtk {

vtkSmartPointer<vtkPointSet> read_surface_data(const std::string &path, const CaughtOutput &caught) {
  return naming(path, [&]() -> vtkSmartPointer<vtkPointSet> {
    const std::string ending = ending_of(path);
    if (ending == "vtp") return read_polydata(path, caught);
    if (ending == "vtu") return read_grid(path, caught);
    if (ending == "stl") return read_stl(path, caught);
    fail_file(path, "a surface must be a .vtp, .vtu or .stl file");
  });
}

void give_arrays(const Faces &faces, riis_surface_arrays *arrays, std::int64_t struct_size) {
  check_core(riis_surface_arrays_init(arrays, struct_size));
  const double *const xyz = faces.xyz.data();
  arrays->n_vertices = static_cast<int64_t>(faces.xyz.size() / 3);
  arrays->x = xyz;
  arrays->y = xyz + 1;
  arrays->z = xyz + 2;
  arrays->stride = 3;
  arrays->n_faces = static_cast<int64_t>(faces.vertex_ids.size()) / faces.corners_per_face;
  arrays->vertex_ids = faces.vertex_ids.data();
  arrays->id_bits = 64;
  arrays->corners_per_face = faces.corners_per_face;
  arrays->leaflet_id = faces.leaflet_id.empty() ? nullptr : faces.leaflet_id.data();
}

}  // namespace riis::vtk
