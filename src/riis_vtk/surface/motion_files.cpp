// SPDX-License-Identifier: Apache-2.0
// The functions of riis_vtk.h for motions of surfaces. Reads the frames of a surface from files, into arrays for the core's
// keyframes. Also reads ParaView's lists of files in time.
#include <riis/riis_vtk.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "common/array_view.hpp"
#include "riis_vtk/read/grid_files.hpp"
#include "riis_vtk/surface/surfaces.hpp"

struct riis_vtk_motion {
  riis::vtk::Frames frames;
  std::vector<std::string> files;
  std::vector<const char *> paths;  // pointers to the texts in `files`
};

namespace riis::vtk {
namespace {

// The attributes of a DataSet element, as texts that are not yet checked.
struct NamedDataSet {
  std::optional<std::string> file, timestep;
};

double time_of(const std::string &path, const std::string &which, const std::string &timestep) {
  std::string_view text = timestep;
  text = text.substr(0, text.find_last_not_of(" \t\r\n") + 1);
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  double time = 0;
  if (!read_number(text, time) || !is_time(time))
    fail_file(path, which, " has the timestep '", timestep.substr(0, 40),
              "', which is not a number from -1e30 to 1e30");
  return time;
}

std::vector<NamedDataSet> data_sets_of(const std::string &path, const CaughtOutput &caught) {
  check_xml(path, "Collection");
  std::vector<NamedDataSet> data_sets;
  for_each_element(path, caught, [&](const std::vector<std::string> &way, XmlAttributes attributes) {
    if (way == std::vector<std::string>{"VTKFile", "Collection", "DataSet"})
      data_sets.push_back({value_of(attributes, "file"), value_of(attributes, "timestep")});
  });
  return data_sets;
}

// The files in a collection, and their times.
struct Collection {
  std::vector<std::string> paths;  // a relative name is preceded by the collection's folder
  std::vector<double> times;       // finite and strictly ascending
};

// Reads a .pvd file, in which ParaView lists files in time. Fails if the file has no list of files, or an empty list. Also fails
// if the timesteps are not numbers in ascending order.
Collection read_collection(const std::string &path, const CaughtOutput &caught) {
  if (ending_of(path) != "pvd") fail_file(path, "a collection of files in time must be a .pvd file");
  const std::vector<NamedDataSet> data_sets = data_sets_of(path, caught);
  if (data_sets.empty()) fail_file(path, "names no files: it has no DataSet in a Collection");
  if (view(data_sets).size() > most_frames)
    fail_file(path, "names ", view(data_sets).size(), " files, more than ", most_frames);
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  Collection collection;
  for (const NamedDataSet &data_set : data_sets) {
    const std::string which = "DataSet " + std::to_string(collection.paths.size());
    if (!data_set.file || data_set.file->empty()) fail_file(path, which, " names no file");
    if (!data_set.timestep) fail_file(path, which, " has no timestep");
    const double time = time_of(path, which, *data_set.timestep);
    if (!collection.times.empty() && !(time > collection.times.back()))
      fail_file(path, which, " has the timestep ", time, ", which is not above the timestep before it, ",
                collection.times.back());
    collection.times.push_back(time);
    collection.paths.push_back((folder / *data_set.file).string());
  }
  return collection;
}

std::vector<double> checked_times(const char *count, std::int64_t n, const double *times) {
  if (n < 1 || n > most_frames) refuse_argument(count, " is ", n, "; it must be from 1 to ", most_frames);
  require(times, "times");
  for (std::int64_t i = 0; i < n; ++i) {
    if (!is_time(times[i]))
      refuse_argument("times[", i, "] is ", times[i], "; it must be finite and at most 1e30 in magnitude");
    if (i > 0 && !(times[i] > times[i - 1]))
      refuse_argument("times[", i, "] is ", times[i], "; it must be above the time before it, ", times[i - 1]);
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
    Frames frames = frames_of_files(collection.paths, std::move(collection.times), LeafletArray(leaflets), caught);
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
    Frames frames = frames_of_files(files, std::move(checked), LeafletArray(leaflets), caught);
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
          frames_of_displacements(path, prefix, in_file ? nullptr : &given, LeafletArray(leaflets), caught), {path});
    });
  });
}

RIIS_API riis_status riis_vtk_motion_read_frames(const char *path, double time_step, const char *leaflets,
                                                 riis_vtk_motion **motion) {
  return guarded([&](const CaughtOutput &caught) {
    require(path, "path");
    require(motion, "motion");
    if (!(time_step > 0 && is_time(time_step))) refuse_argument("time_step is ", time_step, "; it must be above 0");
    *motion = naming(path, [&] {
      if (ending_of(path) != "dat") fail_file(path, "frames of svMultiPhysics must be in a .dat file");
      return motion_of(frames_of_text(path, time_step, LeafletArray(leaflets), caught), {path});
    });
  });
}

RIIS_API riis_status riis_vtk_motion_append(riis_vtk_motion *motion, const riis_vtk_motion *other) {
  return guarded([&](const CaughtOutput &) {
    require(motion, "motion");
    require(other, "other");
    std::vector<std::string> files = motion->files;
    files.insert(files.end(), other->files.begin(), other->files.end());
    std::vector<const char *> paths;
    for (const std::string &file : files) paths.push_back(file.c_str());
    append_frames(motion->frames, other->frames);
    // The texts stay in place when the list of files moves in memory.
    motion->files = std::move(files);
    motion->paths = std::move(paths);
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

RIIS_API void riis_vtk_motion_destroy(riis_vtk_motion **motion) { destroy(motion); }

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
