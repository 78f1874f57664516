// SPDX-License-Identifier: Apache-2.0
// In: a data set of triangles, quads, polygons and triangle strips, whose cells have been checked. Out: plain arrays of
// triangles, or of quads where the data set holds nothing else, with a leaflet id for each face.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

class vtkPointSet;

namespace riis::vtk {

struct Faces {
  std::vector<double> xyz;               // (3, n_vertices): all points, used or not
  std::vector<std::int64_t> vertex_ids;  // (corners_per_face, n_faces); a quad's corners 1 and 3 end an inner diagonal
  std::vector<std::int32_t> leaflet_id;  // (n_faces); empty if the data set names none
  std::int32_t corners_per_face = 3;
};

// Returns the places of all points, (3, n).
std::vector<double> coordinates_of(vtkPointSet *data);

// The path is only for the message. Leaflet ids come from the cell array of the given name, which must exist if it is required.
Faces faces_of(const std::string &path, vtkPointSet *data, const std::string &leaflets, bool is_required);

}  // namespace riis::vtk
