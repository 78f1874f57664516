// SPDX-License-Identifier: Apache-2.0
// Draws the pictures of a run with their titles.
#pragma once

#include <riis/riis_vtk.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "program/case.hpp"
#include "program/handles.hpp"
#include "program/moving_valve.hpp"
#include "program/options.hpp"
#include "program/report.hpp"
#include "program/warnings.hpp"

namespace riis::program {

// Returns the names of a valve's leaflets, or no names for a file, whose leaflets have numbers.
std::vector<const char *> leaflet_names(const ValveOptions &options);

// Returns a title such as "Mitral valve". A file's title is its base name.
std::string title_of_valve(const ValveOptions &options);

// Returns the picture's title. A file's title is its base name. The title of a kind of valve begins with a capital, as the
// other captions do.
std::string picture_title(const ValveOptions &options, const riis_valve *valve, const Report &report);

// Draws options.pictures. mesh and result may be NULL; leaks are shown with a result.
void draw_pictures(const MarkOptions &options, const std::string &title, const std::vector<const char *> &names,
                   const riis_surface *surface, const riis_vtk_mesh *mesh, const riis_marks *result, Report &report);

// In: frames, as files in a folder of their own. Out: a movie, by the program ffmpeg.

// Refuses a movie that is neither .mp4 nor .gif, and any movie on a machine without ffmpeg. Does nothing for "".
void check_movie(const std::string &path);

class Movie {
 public:
  // Makes a temporary folder, which the destructor removes.
  Movie(const std::string &path, double frame_rate);
  ~Movie();
  Movie(const Movie &) = delete;
  Movie &operator=(const Movie &) = delete;

  // Returns the path of the next frame, a .png file for the caller to write.
  std::string next_frame();
  // Makes the movie of the frames. Afterwards the movie's file is complete or unchanged.
  void encode() const;

 private:
  std::string path_, folder_;
  double frame_rate_;
  std::size_t n_frames_ = 0;
};

// Draws the pictures at one time and the movie of a series. They show all valves in one surface, and their marks in the whole
// mesh.

class SeriesPictures {
 public:
  // The mesh gets the arrays that pictures show, so this mesh is not written to a file. box contains the surfaces at all times.
  SeriesPictures(const Case &all, MeshFile mesh, const Box &box);
  // Tells whether the user wants a picture or a movie.
  static bool are_wanted(const MarkOptions &options);
  // Draws the pictures at the first step, and a frame of the movie at each step. The valves are at the step's time. Their marks
  // change.
  void draw(std::size_t step, std::vector<MovingValve> &valves, Report &report);
  void encode(Report &report);

 private:
  void set_marks_of(std::vector<MovingValve> &valves);
  std::string title(std::size_t step, const std::vector<MovingValve> &valves) const;
  riis_vtk_film *film();

  const Case &all_;
  MeshFile mesh_;
  Mesh nodes_;
  Box box_;
  std::vector<std::string> leaflet_texts_;
  std::vector<const char *> leaflet_names_;  // point into the texts
  std::optional<Movie> movie_;
  Film film_;
};

}  // namespace riis::program
