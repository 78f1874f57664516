// SPDX-License-Identifier: Apache-2.0
// Reads a file with a surface, or a surface of the core, into a data set. From a data set, makes plain arrays for the core with
// a leaflet id for each face, and finds the connected pieces of faces.
#pragma once

#include <cmath>
#include <vector>

#include <vtkPointSet.h>

#include "riis_vtk/base/files.hpp"

class vtkPolyData;

namespace riis::vtk {

// Reads a file of a surface in any of the formats of docs/formats.md. Checks all cells, as faces_of requires.
vtkSmartPointer<vtkPointSet> read_surface_data(const std::string &path, const CaughtOutput &caught);

// Returns exactly the triangles of the surface, with points in double precision and the arrays that riis_vtk.h names.
vtkSmartPointer<vtkPolyData> polydata_of(const riis_surface *surface);

// Faces as plain arrays: quads if the data set has only quads, and otherwise triangles.
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

// Names the cell array with the leaflet ids of the faces.
struct LeafletArray {
  // `given` is the name of the array that the caller chose, which must exist. NULL means riis_leaflet, which may be missing.
  explicit LeafletArray(const char *given) : name(given ? given : leaflet_array), is_required(given != nullptr) {}

  std::string name;
  bool is_required;
};

// Converts a data set of triangles, quads, polygons and triangle strips to faces. The cells must have been checked. The path is
// only used in messages.
Faces faces_of(const std::string &path, vtkPointSet *data, const LeafletArray &wanted);

// Appends the faces of another surface with their vertices. Each of the joined surfaces becomes a leaflet. Quads are cut if only
// one of the two surfaces has quads. The attachment is lost if only one of the two surfaces has an attachment.
void append_faces(Faces &faces, const Faces &other);

// Returns a number for each vertex, from 0 to the number of vertices minus 1. Two vertices have the same number if and only if
// their coordinates are exactly equal.
std::vector<std::int64_t> places_of(const Faces &faces);

// Returns the piece to which every face belongs. Pieces are numbered in the order of their first faces. Faces are connected
// if they share a vertex or have vertices with exactly equal coordinates.
std::vector<std::int32_t> pieces_of(const Faces &faces);

// Fills the caller's struct with the arrays of the faces. struct_size is the size of the struct in the caller's release of
// riis.h.
void give_arrays(const Faces &faces, riis_surface_arrays *arrays, std::int64_t struct_size);

// Motions.
// In: files of a surface at several times, or one file with displacements. Out: the faces of the first file, and the positions
// of the vertices at all times.

inline constexpr std::int64_t most_frames = 1'000'000;  // the limit of riis_keyframe_arrays

inline bool is_time(double time) { return std::abs(time) <= 1e30; }  // the limit of riis_keyframe_arrays

struct Frames {
  Faces faces;                // with the vertices of the first frame
  std::vector<double> times;  // (n_keys)
  std::vector<double> xyz;    // (3, n_vertices, n_keys)
};

// Reads a file for each time. Fails for a file whose cells differ from the first file's, and for a coordinate that is not finite.
// In .stl files, corners at the same position in the first file become one vertex. In each other file, these corners must also
// share one position.
Frames frames_of_files(const std::vector<std::string> &paths, std::vector<double> times, const LeafletArray &leaflets,
                       const CaughtOutput &caught);

// Reads the frames from point arrays of displacements in one file. Each array's name is the prefix, then "_" or nothing, then a
// number. The frames are in the order of these numbers. If `times` is NULL, the times come from the field array TimeValue.
Frames frames_of_displacements(const std::string &path, const std::string &prefix, const std::vector<double> *times,
                               const LeafletArray &leaflets, const CaughtOutput &caught);

// Reads the frames of svMultiPhysics: a .dat file with the positions of all nodes, frame by frame. The faces are in a .vtu or
// .vtp file in the same folder. For NAME_motion_open.dat the file is NAME_motion_open, NAME_motion or NAME, each also followed by
// _mesh or _face. The times are multiples of the time step, from 0.
Frames frames_of_text(const std::string &path, double time_step, const LeafletArray &leaflets,
                      const CaughtOutput &caught);

// Appends the faces of another motion, as append_faces does. The two motions must have the same times.
void append_frames(Frames &frames, const Frames &other);

}  // namespace riis::vtk
