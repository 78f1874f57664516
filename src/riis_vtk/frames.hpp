// SPDX-License-Identifier: Apache-2.0
// In: files of a surface at several times, or one file with displacements. Out: the faces of the first file, and the places of
// the vertices at all times.
#pragma once

#include <cmath>

#include "riis_vtk/surfaces.hpp"

namespace riis::vtk {

inline constexpr std::int64_t most_frames = 1'000'000;  // as riis_keyframe_arrays

inline bool is_time(double time) { return std::abs(time) <= 1e30; }  // as riis_keyframe_arrays

struct Frames {
  Faces faces;                // with the vertices of the first frame
  std::vector<double> times;  // (n_keys)
  std::vector<double> xyz;    // (3, n_vertices, n_keys)
};

// Reads a file for each time. Fails for a file with other cells than the first one, and for coordinates that are not finite. In
// .stl files, corners with the same place in the first file become one vertex. They must have the same place in every other
// file.
Frames frames_of_files(const std::vector<std::string> &paths, std::vector<double> times, const LeafletArray &leaflets,
                       const CaughtOutput &caught);

// Reads the frames from the point arrays of displacements in one file. Their names are the prefix, "_" or nothing, and a
// number. The frames ascend by these numbers. If there are no times, the field array TimeValue has them.
Frames frames_of_displacements(const std::string &path, const std::string &prefix, const std::vector<double> *times,
                               const LeafletArray &leaflets, const CaughtOutput &caught);

}  // namespace riis::vtk
