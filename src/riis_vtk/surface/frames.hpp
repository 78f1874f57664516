// SPDX-License-Identifier: Apache-2.0
// In: files of a surface at several times, or one file with displacements. Out: the faces of the first file, and the positions
// of the vertices at all times.
#pragma once

#include <cmath>

#include "riis_vtk/surface/surfaces.hpp"

namespace riis::vtk {

inline constexpr std::int64_t most_frames = 1'000'000;  // the limit of riis_keyframe_arrays

inline bool is_time(double time) { return std::abs(time) <= 1e30; }  // the limit of riis_keyframe_arrays

struct Frames {
  Faces faces;                // with the vertices of the first frame
  std::vector<double> times;  // (n_keys)
  std::vector<double> xyz;    // (3, n_vertices, n_keys)
};

// Reads a file for each time. Fails if a file has other cells than the first one, or if a coordinate is not finite. In .stl
// files, corners at the same position in the first file become one vertex. In each other file, these corners must also share one
// position.
Frames frames_of_files(const std::vector<std::string> &paths, std::vector<double> times, const LeafletArray &leaflets,
                       const CaughtOutput &caught);

// Reads the frames from point arrays of displacements in one file. Each array's name is the prefix, then "_" or nothing, then a
// number. The frames are in the order of these numbers. If `times` is NULL, the times come from the field array TimeValue.
Frames frames_of_displacements(const std::string &path, const std::string &prefix, const std::vector<double> *times,
                               const LeafletArray &leaflets, const CaughtOutput &caught);

}  // namespace riis::vtk
