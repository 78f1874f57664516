// SPDX-License-Identifier: Apache-2.0
// In: landmarks of a patient. Out: the sizes and the placement of the valve, as a report and as the file of a placed valve. The
// program and the Python package share this.
#pragma once

#include <riis/riis.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "program/input/landmark_file.hpp"

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

// Sizes the valve by the landmarks and finds its placement. The parameters of `held` keep their values, and so do those that
// the landmarks' file states. The caller sets these.
Placed place_by_landmarks(const LandmarkFile &landmarks, riis_valve *valve, const std::string &kind,
                          const std::vector<std::string> &held, Reader reader);

// Warps the valve to the landmarks, and returns the warp. It is smoothed by the noise; at 0 it meets the landmarks. A warp that
// folds at one of five openings is refused. Other commands check each opening that they take.
Warp warp_to_landmarks(Placed &placed, riis_valve *valve, double noise, Reader reader);

// Refuses landmarks that are not at these nodes of a mesh, (3, n_nodes). `of`, such as " of mesh.vtu", names the mesh. If other
// axes or another unit would bring the landmarks to the nodes, the message says so.
void check_at_nodes(const LandmarkFile &landmarks, std::int64_t n_nodes, const double *nodes, const std::string &of,
                    Reader reader);

std::string place_report(const Placed &placed, Reader reader);
// Returns the file of a placed valve. The second function returns such a file with the valve's present parameters.
std::string placed_file_of(const Placed &placed, const riis_valve *valve);
std::string with_parameters_of(const std::string &placed_file, const riis_valve *valve);

// Returns numbers as text.
std::string numbers_text(const double *numbers, std::size_t n, const char *between,
                         std::string (*as_text)(double) = shortest);

}  // namespace riis::program
