// SPDX-License-Identifier: Apache-2.0
// Reads a file with a surface, or a surface of the core, into a data set. From a data set it makes plain arrays for the core,
// with a leaflet id for each face, and the connected pieces of faces.
#pragma once

#include <vector>

#include <vtkPointSet.h>

#include "riis_vtk/files.hpp"

class vtkPolyData;

namespace riis::vtk {

// Reads a .vtp, .vtu or .stl file. All cells have been checked, as faces_of requires.
vtkSmartPointer<vtkPointSet> read_surface_data(const std::string &path, const CaughtOutput &caught);

// Returns exactly the triangles of the surface, with double points and the arrays that riis_vtk.h names.
vtkSmartPointer<vtkPolyData> polydata_of(const riis_surface *surface);

// Triangles as plain arrays, or quads if the data set has only quads.
struct Faces {
  std::vector<double> xyz;               // (3, n_vertices): all points, used or not
  std::vector<std::int64_t> vertex_ids;  // (corners_per_face, n_faces); a quad's corners 1 and 3 end an inner diagonal
  std::vector<std::int32_t> leaflet_id;  // (n_faces); empty if the data set names none
  std::int32_t corners_per_face = 3;
};

// Returns the places of all points, (3, n).
std::vector<double> coordinates_of(vtkPointSet *data);

// The cell array with the faces' leaflet ids, and whether it is required.
struct LeafletArray {
  // given is the caller's name for it. NULL: riis_leaflet, which may be missing.
  explicit LeafletArray(const char *given) : name(given ? given : leaflet_array), is_required(given != nullptr) {}

  std::string name;
  bool is_required;
};

// Converts a data set of triangles, quads, polygons and triangle strips, whose cells have been checked. The path is only for
// the message.
Faces faces_of(const std::string &path, vtkPointSet *data, const LeafletArray &wanted);

// Returns the number of each vertex's place, which is below the number of vertices. Vertices at exactly the same coordinates have
// the same place.
std::vector<std::size_t> places_of(const Faces &faces);

// Returns the piece of every face. Pieces are numbered in the order of their first faces. Faces are connected if they share a
// vertex or have vertices with exactly the same coordinates.
std::vector<std::int32_t> pieces_of(const Faces &faces);

// Fills the caller's struct with the arrays of the faces. Its size tells the release of riis.h with which the caller was
// compiled.
void give_arrays(const Faces &faces, riis_surface_arrays *arrays, std::int64_t struct_size);

}  // namespace riis::vtk
