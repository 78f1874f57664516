// SPDX-License-Identifier: Apache-2.0
#include "vtk/surface_data.hpp"

#include <cstddef>

#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include "vtk/files.hpp"
#include "vtk/grid_files.hpp"
#include "vtk/stl_files.hpp"

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

void point_at(const Faces &faces, const char *name, riis_surface_arrays *arrays) {
  require(arrays, name);
  // Callers of the first release lack the velocities, which the init function sets to NULL for the others.
  check_struct_size(arrays->struct_size, offsetof(riis_surface_arrays, vx), sizeof *arrays, name);
  arrays->n_vertices = static_cast<int64_t>(faces.xyz.size() / 3);
  arrays->x = faces.xyz.data();
  arrays->y = arrays->x + 1;
  arrays->z = arrays->x + 2;
  arrays->stride = 3;
  arrays->n_faces = static_cast<int64_t>(faces.vertex_ids.size()) / faces.corners_per_face;
  arrays->vertex_ids = faces.vertex_ids.data();
  arrays->vertex_id_bits = 64;
  arrays->index_base = 0;
  arrays->corners_per_face = faces.corners_per_face;
  arrays->leaflet_id = faces.leaflet_id.empty() ? nullptr : faces.leaflet_id.data();
}

}  // namespace riis::vtk
