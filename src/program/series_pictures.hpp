// SPDX-License-Identifier: Apache-2.0
// Pictures of valves at one time, and the movie of a series: all valves in one surface, and their marks in the whole mesh.
#pragma once

#include <riis/riis_vtk.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "program/case.hpp"
#include "program/handles.hpp"
#include "program/movie.hpp"
#include "program/moving_valve.hpp"
#include "program/warnings.hpp"

namespace riis::program {

class SeriesPictures {
 public:
  // The mesh gets the arrays that pictures show, so it is not written. box holds the surfaces at all times.
  SeriesPictures(const Case &all, MeshFile mesh, const Box &box);
  // Whether the user wants a picture or a movie.
  static bool are_wanted(const Options &options);
  // Draws the pictures at the first step, and a frame of the movie at each. The valves are where they are to be drawn; their
  // marks change.
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
