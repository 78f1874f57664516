// SPDX-License-Identifier: Apache-2.0
// In: landmarks of a patient. Out: the sizes and the placement of the valve, as a report and as the file of a placed valve. The
// program and the Python package share this.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "program/landmark_file.hpp"

namespace riis::program {

// Who reads a message. Options are written like --unit mm for the program, and like unit='mm' for Python.
enum class Reader { program, python };

// What the user says of the landmarks besides their file.
struct PlaceRequest {
  Reader reader = Reader::program;
  std::optional<Unit> unit;     // to which lengths are converted
  std::string axes;             // "LPS" or "RAS", to which coordinates are converted; "": those of the landmarks
  std::optional<double> noise;  // in the unit after the conversion
  std::optional<std::vector<double>> flow;  // in the axes after the conversion
};
// Changes landmarks as the user says.
void adapt(LandmarkFile &landmarks, const PlaceRequest &request);
// Returns the kind of valve that the user gives, or "", or else the landmarks' own. Refuses two kinds that differ.
std::string kind_of(const LandmarkFile &landmarks, const std::string &given, Reader reader);

// A size of the valve.
struct Size {
  riis_parameter parameter;
  std::vector<double> values;
  double standard_error;
  int32_t state;
};

struct Placed {
  LandmarkFile landmarks;
  std::string kind;
  std::vector<Size> sizes;
  riis_placement placement;
  std::vector<double> residuals;
  double noise;                        // stated, mesh units
  std::vector<double> places;          // (3, n), of the landmarks on the valve
  riis_surface_options where;          // the placement
  std::optional<riis_warp_info> warp;  // without a warp there is none
  double warp_noise;                   // by which the warp is smoothed; 0: it meets the landmarks
  std::vector<double> still_off;       // distances of the landmarks from their places on the warped valve
};

// Sizes the valve by the landmarks and finds its placement. The parameters of `held` keep their values, and so do those that the
// landmarks' file states, which this function does not set.
Placed place_by_landmarks(const LandmarkFile &landmarks, riis_valve *valve, const std::string &kind,
                          const std::vector<std::string> &held, Reader reader);

// Adds the quality of a warp that takes the landmarks' places to the landmarks, and that the valve has. A warp that folds at one of
// five openings is refused. Other commands check each opening that they take.
void add_warp(Placed &placed, const riis_valve *valve, const riis_warp *warp, double noise);

// Returns the library's message with the names of the file for landmarks, and the words of the file for fields.
std::string in_words_of_file(std::string text, const LandmarkFile &landmarks);
// Refuses the landmarks with the library's message, if it refused them.
void check_landmarks(riis_status status, const LandmarkFile &landmarks, Reader reader = Reader::program);

// Refuses landmarks that are not at these nodes of a mesh, (3, n_nodes). `of`, such as " of mesh.vtu", names the mesh. If other axes
// or another unit would bring the landmarks to the nodes, the message says so.
void check_at_nodes(const LandmarkFile &landmarks, std::int64_t n_nodes, const double *nodes, const std::string &of,
                    Reader reader);

std::string place_report(const Placed &placed, Reader reader);
// Returns the file of a placed valve. The second function returns such a file with the valve's present parameters.
std::string placed_file_of(const Placed &placed, const riis_valve *valve);
std::string with_parameters_of(const std::string &placed_file, const riis_valve *valve);

riis_points points_of(const std::vector<double> &xyz);
// Returns numbers as text.
std::string numbers_text(const double *numbers, std::size_t n, const char *between,
                         std::string (*as_text)(double) = shortest);

}  // namespace riis::program
