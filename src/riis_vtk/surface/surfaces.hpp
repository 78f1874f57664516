// SPDX-License-Identifier: Apache-2.0
// Reads a surface from a file or takes a surface from the core, and makes a data set of this surface. Makes plain arrays for the
// core from the data set, with a leaflet id for each face. Also finds the connected pieces of a surface's faces.
#pragma once

#include <cmath>
#include <vector>

#include <vtkPointSet.h>

#include "riis_vtk/base/files.hpp"

class vtkPolyData;

namespace riis::vtk {

// Reads the file of a surface. All formats of docs/formats.md are allowed. Checks all cells, as faces_of requires.
vtkSmartPointer<vtkPointSet> read_surface_data(const std::string &path, const CaughtOutput &caught);

// Returns a data set with exactly the surface's triangles. The points have double precision, and the arrays are those of
// riis_vtk.h.
vtkSmartPointer<vtkPolyData> polydata_of(const riis_surface *surface);

// Faces as plain arrays. If the data set has only quads, the faces are quads. Otherwise the faces are triangles.
struct Faces {
  std::vector<double> xyz;  // (3, n_vertices), all points, used or not
  // (corners_per_face, n_faces); the diagonal from a quad's first corner to its third lies inside the quad
  std::vector<std::int64_t> vertex_ids;
  std::vector<std::int32_t> leaflet_id;  // (n_faces); empty if the data set has no leaflet ids
  std::vector<std::uint8_t> attached;    // (n_vertices), 1 at the attachment; empty if the data set does not tell
  std::int32_t corners_per_face = 3;
  std::int32_t n_joined = 1;  // the number of surfaces that append_faces has joined
};

// Returns the positions of all points, (3, n).
std::vector<double> coordinates_of(vtkPointSet *data);

// The name of the cell array with the faces' leaflet ids.
struct LeafletArray {
  // `given` is the name of an array that the caller chose. This array must exist. NULL stands for the array riis_leaflet, which
  // may be missing.
  explicit LeafletArray(const char *given) : name(given ? given : leaflet_array), is_required(given != nullptr) {}

  std::string name;
  bool is_required;
};

// Converts a data set of triangles, quads, polygons and triangle strips to faces. The cells must have been checked before. The
// path is used only in messages.
Faces faces_of(const std::string &path, vtkPointSet *data, const LeafletArray &wanted);

// Appends the faces and the vertices of another surface. Each appended surface becomes a leaflet. If only one of the two surfaces
// has quads, its quads are cut into triangles. If only one of the two surfaces has an attachment, the attachment is lost.
void append_faces(Faces &faces, const Faces &other);

// Returns for each vertex a number below the number of vertices. Two vertices have the same number if and only if their
// coordinates are exactly equal.
std::vector<std::int64_t> places_of(const Faces &faces);

// For each face, returns the piece to which the face belongs. Pieces are numbered in the order of their first faces. Two faces
// are connected if they share a vertex, or if a vertex of one has exactly the coordinates of a vertex of the other.
std::vector<std::int32_t> pieces_of(const Faces &faces);

// Stores the arrays of the faces in the caller's struct. struct_size is the size of the struct in the caller's release of riis.h.
void give_arrays(const Faces &faces, riis_surface_arrays *arrays, std::int64_t struct_size);

// Motions of surfaces.
// The inputs are files of a surface at several times, or one file with displacements. The results are the faces of the first
// file, and the positions of the vertices at all times.

inline constexpr std::int64_t most_frames = 1'000'000;  // the limit of riis_keyframe_arrays

inline bool is_time(double time) { return std::abs(time) <= 1e30; }  // the limit of riis_keyframe_arrays

struct Frames {
  Faces faces;                // with the vertices of the first frame
  std::vector<double> times;  // (n_keys)
  std::vector<double> xyz;    // (3, n_vertices, n_keys)
};

// Reads a surface file for each time. Fails if the cells of a file differ from those of the first file, or if a coordinate is not
// finite. In .stl files, corners that are at one position in the first file become one vertex. In every later .stl file, all
// corners of a vertex must again be at one position.
Frames frames_of_files(const std::vector<std::string> &paths, std::vector<double> times, const LeafletArray &leaflets,
                       const CaughtOutput &caught);

// Reads the frames of a motion from point arrays with displacements. All arrays of the motion are in one file. The name of an
// array is the prefix, then "_" or nothing, then a number. The numbers in the names give the order of the frames. If `times` is
// NULL, the field array TimeValue gives the times.
Frames frames_of_displacements(const std::string &path, const std::string &prefix, const std::vector<double> *times,
                               const LeafletArray &leaflets, const CaughtOutput &caught);

// Reads the frames that svMultiPhysics uses: a .dat file with the positions of all nodes, frame by frame. The faces are in a .vtu
// or .vtp file in the same folder. For NAME_motion_open.dat, the file with the faces is NAME_motion_open, NAME_motion or NAME.
// The name of the file with the faces may also end in _mesh or _face. The times are multiples of the time step, beginning with 0.
Frames frames_of_text(const std::string &path, double time_step, const LeafletArray &leaflets,
                      const CaughtOutput &caught);

// Appends the faces of another motion, as append_faces does. Both motions must have the same times.
void append_frames(Frames &frames, const Frames &other);

}  // namespace riis::vtk
