// SPDX-License-Identifier: Apache-2.0
// Draws the pictures and the movie of a run, with their titles.
#pragma once

#include <riis/riis_vtk.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "program/base/handles.hpp"
#include "program/base/options.hpp"
#include "program/base/virtual_display.hpp"
#include "program/input/case.hpp"
#include "program/mark/moving_valve.hpp"
#include "program/output/outputs.hpp"
#include "program/output/report.hpp"

namespace riis::program {

// Refuses views by the valve's axes for several valves, and for a file of triangles, which has no axes. `valve` must have the
// options of the first valve.
void check_views(const MarkOptions &options, std::size_t n_valves, const ValveOptions &valve);

// The inputs are the movie's frames, which are files in a temporary folder. The result is a movie, which the program ffmpeg
// makes.

// Refuses a movie whose ending is not .mp4 or .gif. Refuses every movie if ffmpeg is missing. Does nothing if the path is "".
void check_movie(const std::string &path);

class Movie {
 public:
  // `has_size` tells whether the user gave the size of the frames. If the user gave no size, a .gif is made small.
  Movie(const std::string &path, double frame_rate, bool has_size)
      : path_(path), frame_rate_(frame_rate), has_size_(has_size) {}

  // Returns the path for the next frame. The caller must write a .png file at this path.
  std::string next_frame();
  // Makes the movie from its frames. Afterwards the file of the movie is complete. After a failure, the file is unchanged.
  void encode() const;

 private:
  std::string path_;
  double frame_rate_;
  bool has_size_;
  const TemporaryFolder folder_;  // of the frames
  std::size_t n_frames_ = 0;
};

// Draws the pictures of a run at the first of its times. In a series, also draws the movie. The pictures and the movie show all
// valves as one surface, and the marks of the whole mesh.
class RunPictures {
 public:
  // The mesh gets the arrays that pictures show, so it must not be written to a file afterwards. Without a mesh, the pointer is
  // null. The box `box` must contain the surfaces at all times.
  RunPictures(const Case &all, MeshFile mesh, const Box &box);
  // Returns whether the user wants a picture or a movie.
  static bool are_wanted(const MarkOptions &options);
  // Draws the pictures at the first step, and a frame of the movie at each step. The valves must be at the time of the step. In a
  // series, the call changes the marks of the valves.
  void draw(std::size_t step, std::vector<MovingValve> &valves, Report &report);
  void encode(Report &report);

 private:
  void set_marks_of(std::vector<MovingValve> &valves);
  std::string title(std::size_t step, const std::vector<MovingValve> &valves, const Report &report) const;
  riis_vtk_picture_options how(const std::vector<MovingValve> &valves) const;
  void draw_pictures(const std::vector<MovingValve> &valves, const std::string &title, const riis_surface *surface,
                     Report &report);
  void with_display(const std::function<riis_status()> &draw);
  riis_vtk_film *film(const std::vector<MovingValve> &valves);

  const Case &all_;
  MeshFile mesh_;
  std::optional<FileNodes> nodes_;
  Box box_;
  std::vector<std::string> leaflet_texts_;
  std::vector<const char *> leaflet_names_;  // point into leaflet_texts_
  std::optional<Movie> movie_;
  Surface wall_;                           // of --wall, without a mesh; otherwise null
  std::optional<VirtualDisplay> display_;  // ends after film_
  Film film_;
};

}  // namespace riis::program
