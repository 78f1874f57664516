// SPDX-License-Identifier: Apache-2.0
// Motion of riis_vtk.h: reads the frames of a surface from files into arrays for the core's keyframes.
#include <riis/riis_vtk.h>

#include <memory>

#include "common/array_view.hpp"
#include "common/message.hpp"
#include "riis_vtk/array_names.hpp"
#include "riis_vtk/collection.hpp"
#include "riis_vtk/frames.hpp"
#include "riis_vtk/pieces.hpp"
#include "riis_vtk/surface_data.hpp"
#include "riis_vtk/vtk_errors.hpp"

struct riis_vtk_motion {
  riis::vtk::Frames frames;
  std::vector<std::string> files;
  std::vector<const char *> paths;  // of the files
};

namespace riis::vtk {
namespace {

template <class... Parts>
[[noreturn]] void refuse_argument(const Parts &...parts) {
  fail(RIIS_INVALID_ARGUMENT, Message(parts...).text());
}

LeafletArray leaflet_array_of(const char *leaflets) {
  return leaflets ? LeafletArray{leaflets, true} : LeafletArray{leaflet_array, false};
}

std::vector<double> checked_times(const char *count, std::int64_t n, const double *times) {
  if (n < 1 || n > most_frames) refuse_argument(count, " is ", n, "; it must be from 1 to ", most_frames);
  require(times, "times");
  for (std::int64_t i = 0; i < n; ++i) {
    if (!is_time(times[i]))
      refuse_argument("times[", i, "] is ", times[i], "; it must be finite and at most 1e30 in magnitude");
    if (i > 0 && !(times[i] > times[i - 1]))
      refuse_argument("times[", i, "] is ", times[i], "; it must be above the one before, ", times[i - 1]);
  }
  return {times, times + n};
}

riis_vtk_motion *motion_of(Frames frames, std::vector<std::string> files) {
  auto made = std::make_unique<riis_vtk_motion>();
  made->frames = std::move(frames);
  made->files = std::move(files);
  for (const std::string &file : made->files) made->paths.push_back(file.c_str());
  return made.release();
}

}  // namespace
}  // namespace riis::vtk

using namespace riis::vtk;

extern "C" {

RIIS_API riis_status riis_vtk_motion_read_pvd(const char *path, const char *leaflets, riis_vtk_motion **motion) {
  return guarded([&](const CaughtOutput &caught) {
    require(path, "path");
    require(motion, "motion");
    Collection collection = naming(path, [&] { return read_collection(path, caught); });
    Frames frames = frames_of_files(collection.paths, std::move(collection.times), leaflet_array_of(leaflets), caught);
    *motion = motion_of(std::move(frames), std::move(collection.paths));
  });
}

RIIS_API riis_status riis_vtk_motion_read_files(int64_t n_files, const char *const *paths, const double *times,
                                                const char *leaflets, riis_vtk_motion **motion) {
  return guarded([&](const CaughtOutput &caught) {
    require(motion, "motion");
    std::vector<double> checked = checked_times("n_files", n_files, times);
    require(paths, "paths");
    std::vector<std::string> files;
    for (std::int64_t i = 0; i < n_files; ++i)
      files.push_back(require(paths[i], ("paths[" + std::to_string(i) + "]").c_str()));
    Frames frames = frames_of_files(files, std::move(checked), leaflet_array_of(leaflets), caught);
    *motion = motion_of(std::move(frames), std::move(files));
  });
}

RIIS_API riis_status riis_vtk_motion_read_displacements(const char *path, const char *prefix, int64_t n_times,
                                                        const double *times, const char *leaflets,
                                                        riis_vtk_motion **motion) {
  return guarded([&](const CaughtOutput &caught) {
    require(path, "path");
    if (!*require(prefix, "prefix")) refuse_argument("prefix is \"\"");
    require(motion, "motion");
    const bool in_file = n_times == 0 && !times;
    const std::vector<double> given = in_file ? std::vector<double>{} : checked_times("n_times", n_times, times);
    *motion = naming(path, [&] {
      return motion_of(
          frames_of_displacements(path, prefix, in_file ? nullptr : &given, leaflet_array_of(leaflets), caught),
          {path});
    });
  });
}

RIIS_API riis_status riis_vtk_motion_get_files(const riis_vtk_motion *motion, int64_t *n_files,
                                               const char *const **paths) {
  return guarded([&](const CaughtOutput &) {
    require(motion, "motion");
    if (n_files) *n_files = riis::view(motion->paths).size();
    if (paths) *paths = motion->paths.data();
  });
}

RIIS_API riis_status riis_vtk_motion_number_pieces(riis_vtk_motion *motion) {
  return guarded([&](const CaughtOutput &) {
    require(motion, "motion");
    motion->frames.faces.leaflet_id = pieces_of(motion->frames.faces);
  });
}

RIIS_API void riis_vtk_motion_destroy(riis_vtk_motion **motion) {
  if (!motion) return;
  delete *motion;
  *motion = nullptr;
}

RIIS_API riis_status riis_vtk_motion_get_arrays(const riis_vtk_motion *motion, riis_surface_arrays *arrays,
                                                int64_t struct_size) {
  return guarded(
      [&](const CaughtOutput &) { give_arrays(require(motion, "motion")->frames.faces, arrays, struct_size); });
}

RIIS_API riis_status riis_vtk_motion_get_frames(const riis_vtk_motion *motion, riis_keyframe_arrays *frames,
                                                int64_t struct_size) {
  return guarded([&](const CaughtOutput &) {
    require(motion, "motion");
    check_core(riis_keyframe_arrays_init(frames, struct_size));
    frames->n_keys = riis::view(motion->frames.times).size();
    frames->n_vertices = riis::view(motion->frames.faces.xyz).size() / 3;
    frames->time = motion->frames.times.data();
    frames->xyz = motion->frames.xyz.data();
  });
}

}  // extern "C"
